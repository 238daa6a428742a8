"""Recording of variables at every communication point."""

from __future__ import annotations

from array import array

import numpy as np
import pandas as pd

from .description import Description, Variable
from .slave import Observable

_DTYPES = {"Real": "float64", "Integer": "int64", "Boolean": "bool"}
#: Integers of 64 bits, which a double cannot hold, with the code of their array and their type in the table.
_WIDE = {"Int64": ("q", "int64"), "UInt64": ("Q", "uint64"), "Enumeration": ("q", "int64")}


def recorded_variables(description: Description) -> list[Variable]:
    """All inputs and outputs that are numbers, without arrays: the buffered impacts have their own table.

    What ticks by a clock is left out: it has no value at a communication point (`Variable.in_event_mode_only`).
    """
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
        self._wide = {
            place: array(_WIDE[variable.fmi_type][0])
            for place, variable in enumerate(variables)
            if variable.fmi_type in _WIDE
        }

    def started(self, unit: Observable, time: float) -> None:
        """Keep the initial values."""
        self.stepped(unit, time)

    def stepped(self, unit: Observable, time: float) -> None:
        """Keep the values at the end of a step."""
        self._numbers.append(time)
        values = unit.get(self._names)
        self._numbers.extend(map(float, values))
        for place, numbers in self._wide.items():
            numbers.append(int(values[place]))

    def table(self) -> pd.DataFrame:
        """One row for each communication point: `time` [s], then the variables by name, in their units."""
        numbers = np.array(self._numbers).reshape(-1, 1 + len(self._names))
        exact = {
            self._names[place]: np.array(values, dtype=_WIDE[self._variables[place].fmi_type][1])
            for place, values in self._wide.items()
        }
        # column by column: pandas takes ten times as long to convert the types of a table
        types = ["float64", *(_DTYPES[variable.type] for variable in self._variables)]
        columns = zip(["time", *self._names], numbers.T, types, strict=True)
        table = {name: column.astype(kind) for name, column, kind in columns if name not in exact}
        return pd.DataFrame({name: exact.get(name, table.get(name)) for name in ["time", *self._names]})
