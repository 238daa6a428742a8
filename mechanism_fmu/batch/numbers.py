"""A model's recorded calculation for many designs at once: the very numbers that each design alone would give."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from ..model.functions import Number
from ..model.symbol import Symbol
from ..model.trace import Trace

Array = np.ndarray[Any, np.dtype[Any]]
#: A number of each design, shape (designs,), or one for all, a float.
Column = Any


def _each(function: Callable[..., float]) -> Callable[..., Column]:
    """One of `math`'s functions for columns: numpy's own sines differ from it in the last bit."""

    def one(*operands: float) -> float:
        try:
            return function(*operands)
        except ValueError:
            return math.nan

    def all_of_them(*operands: Column) -> Column:
        columns = np.broadcast_arrays(*operands)
        found = [one(*values) for values in zip(*(column.ravel().tolist() for column in columns), strict=True)]
        return np.array(found).reshape(columns[0].shape)

    return all_of_them


_APPLY: dict[str, Callable[..., Column]] = {
    "add": np.add,
    "subtract": np.subtract,
    "multiply": np.multiply,
    "divide": np.divide,
    "negate": np.negative,
    "sin": _each(math.sin),
    "cos": _each(math.cos),
    "tan": _each(math.tan),
    "sqrt": np.sqrt,
    "atan2": _each(math.atan2),
    "where_positive": lambda condition, positive, otherwise: np.where(condition > 0, positive, otherwise),
}


class Numbers:
    """The numbers of a trace for parameter values; what does not depend on a varied parameter is calculated once.

    Args:
        traced: the calculation.
        values: of all parameters by name, each a column or one number.
        same: results that are the same for all designs, by the number of their operation; more are added. To be shared
            by calculations that vary the same parameters and give the others the same values.
    """

    def __init__(self, traced: Trace, values: Mapping[str, Column], same: dict[int, float]) -> None:
        self._traced = traced
        given = (values[parameter.name] for parameter in traced.model.parameters)
        self._given = [column if np.ndim(column) else float(column) for column in given]
        self._known: dict[int, Column] = dict(same)
        self._same = same

    def of(self, wanted: Iterable[Number]) -> list[Column]:
        """Recorded numbers, in their order; what does not exist is NaN or infinite, and nothing fails."""
        wanted = list(wanted)
        with np.errstate(all="ignore"):
            for number in self._traced.needed(wanted, self._known):
                self._known[number] = found = self._calculated(number)
                if isinstance(found, float):
                    self._same[number] = found
        return [self._known[x.number] if isinstance(x, Symbol) else float(x) for x in wanted]

    def _calculated(self, number: int) -> Column:
        operation = self._traced.operations[number]
        if operation.name == "parameter":
            return self._given[int(operation.value)]
        if operation.name == "constant":
            return operation.value
        operands = [self._known[i] for i in operation.operands]
        found = _APPLY[operation.name](*operands)
        return found if any(isinstance(x, np.ndarray) for x in operands) else float(found)
