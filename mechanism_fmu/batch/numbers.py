"""Parameters to tables for many designs at once: a model's recorded calculation, vectorised."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import elementary
from ..model.functions import Number
from ..model.symbol import Symbol
from ..model.trace import Trace

Array = np.ndarray[Any, np.dtype[Any]]
#: A number of each design, shape (designs,), or one for all, a float.
Column = Any


def _each(function: Callable[..., float]) -> Callable[..., Column]:
    """An elementary function for columns: numpy's own sines differ from it in the last bit."""

    def all_of_them(*operands: Column) -> Column:
        columns = np.broadcast_arrays(*operands)
        found = [function(*values) for values in zip(*(column.ravel().tolist() for column in columns), strict=True)]
        return np.array(found).reshape(columns[0].shape)

    return all_of_them


_APPLY: dict[str, Callable[..., Column]] = {
    "add": np.add,
    "subtract": np.subtract,
    "multiply": np.multiply,
    "divide": np.divide,
    "negate": np.negative,
    "sin": _each(elementary.sin),
    "cos": _each(elementary.cos),
    "tan": _each(elementary.tan),
    "sqrt": np.sqrt,
    "atan2": _each(elementary.atan2),
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


# What came of many designs.


@dataclass(frozen=True)
class BatchResult:
    """What came of many designs, in SI units. Columns have the shape (designs,), and NaN where a design has failed.

    Attributes:
        designs: what was asked: parameters and inputs by name, each of shape (designs,).
        values: outputs and calculated parameters at the time reached, by name, each of shape (designs,).
        least, greatest: of the same, over the start, all communication points and the end; empty if not asked for.
        impact_count: number of impacts until then, shape (designs,).
        impacts: the first impacts of each design, by field as in the FMU's `impacts[k].<field>`, shape (designs, kept);
            NaN where there were fewer.
        reached: time reached [s]; of a failed design the last good instant, NaN if it did not start.
        events: of each design, the names of its first events in their order, as many as were asked for, behind what is
            closed and what sticks at the start.
        pulled: of each contact, by name, the first time [s] at which it pulled where a real one would open, as a guided
            one may; infinite: never.
        failures: why a design failed, in the FMU's words; "" of those that did not.
        warnings: what the FMU's log warns of, at the start and where contacts pull; "" of those that did well.
        compiled: how the engine was compiled: "ahead of time" or "just in time".
        threads: how many ran them.

    Source: `Batch`.
    """

    designs: Mapping[str, Array]
    values: Mapping[str, Array]
    least: Mapping[str, Array]
    greatest: Mapping[str, Array]
    impact_count: Array
    impacts: Mapping[str, Array]
    reached: Array
    events: tuple[tuple[str, ...], ...]
    pulled: Mapping[str, Array]
    failures: tuple[str, ...]
    warnings: tuple[str, ...]
    compiled: str
    threads: int

    def table(self) -> dict[str, Array]:
        """All columns under the names of the FMU's variables, for `pandas.DataFrame`.

        Designs and outputs as they are called, extremes as `<output>.least` and `<output>.greatest`, impacts as
        `impacts[k].<field>`, and `impacts`, `time_reached` [s],
        `<contact>.pulls_from` [s], `failure` and `warning`.
        """
        kept = {
            f"impacts[{k + 1}].{name}": column[:, k]
            for name, column in self.impacts.items()
            for k in range(column.shape[1])
        }
        return {
            **self.designs,
            **self.values,
            **{f"{name}.least": column for name, column in self.least.items()},
            **{f"{name}.greatest": column for name, column in self.greatest.items()},
            "impacts": self.impact_count,
            **kept,
            "time_reached": self.reached,
            **{f"{name}.pulls_from": column for name, column in self.pulled.items()},
            "failure": np.array(self.failures, object),
            "warning": np.array(self.warnings, object),
        }
