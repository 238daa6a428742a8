"""Recording of variables at every communication point."""

from __future__ import annotations

from array import array

import numpy as np
import pandas as pd

from .description import Description, Variable
from .slave import Observable

_DTYPES = {"Real": "float64", "Integer": "int64", "Boolean": "bool"}


def recorded_variables(description: Description) -> list[Variable]:
    """All inputs and outputs that are numbers, without arrays: the buffered impacts have their own table."""
    return [
        variable
        for variable in description.of("input", "output")
        if variable.type in _DTYPES and "[" not in variable.name
    ]


class Recorder:
    """An observer that keeps variables at every communication point, 8 bytes each."""

    def __init__(self, variables: list[Variable]) -> None:
        self._variables = variables
        self._names = tuple(variable.name for variable in variables)
        self._numbers = array("d")

    def started(self, unit: Observable, time: float) -> None:
        """Keep the initial values."""
        self.stepped(unit, time)

    def stepped(self, unit: Observable, time: float) -> None:
        """Keep the values at the end of a step."""
        self._numbers.append(time)
        self._numbers.extend(map(float, unit.get(self._names)))

    def table(self) -> pd.DataFrame:
        """One row for each communication point: `time` [s], then the variables by name, in their units."""
        numbers = np.array(self._numbers).reshape(-1, 1 + len(self._names))
        # column by column: pandas takes ten times as long to convert the types of a table
        types = ["float64", *(_DTYPES[variable.type] for variable in self._variables)]
        columns = zip(["time", *self._names], numbers.T, types, strict=True)
        return pd.DataFrame({name: column.astype(kind) for name, column, kind in columns})
