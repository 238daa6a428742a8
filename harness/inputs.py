"""Input signals from a CSV table."""

from __future__ import annotations

import hashlib
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import numpy as np
import numpy.typing as npt

from .assignments import settable_variable
from .csv_table import read_csv, unreadable
from .description import Description, Value, Variable
from .errors import UsageError
from .units import UnitMismatchError

_HEADING = re.compile(r"\s*(\S+)(?:\s+\[\s*(\S+)\s*\])?\s*")

_NUMBER = re.compile(r"\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*", re.ASCII)

_HALF_A_NANOSECOND = 0.5e-9


@dataclass(frozen=True)
class InputSignals:
    """Values of inputs over time.

    Attributes:
        variables: the inputs, one a column.
        times: of the rows [s], strictly increasing, shape (rows,).
        values: in the units of the variables, shape (rows, columns).
        file: name of the table they come from; "" for none.
        digest: SHA-256 of that file, in hexadecimal.
        note: how that file was understood, where it is not as usual (`csv_table`); "" else.
    """

    variables: tuple[Variable, ...]
    times: npt.NDArray[np.float64]
    values: npt.NDArray[np.float64]
    file: str = ""
    digest: str = ""
    note: str = ""

    def at(self, time: float) -> dict[str, Value]:
        """Values at `time` [s]: Real inputs interpolated linearly, others from the last row that is not later."""
        row = max(int(np.searchsorted(self.times, time, side="right")) - 1, 0)
        following = min(row + 1, len(self.times) - 1)
        span = self.times[following] - self.times[row]
        fraction = (time - self.times[row]) / span if span > 0.0 else 0.0
        blended = self.values[row] + fraction * (self.values[following] - self.values[row])
        return {
            variable.name: _typed(blended[i] if variable.type == "Real" else self.values[row, i], variable)
            for i, variable in enumerate(self.variables)
        }


def read_inputs(
    path: Path,
    description: Description,
    start_time: float,
    stop_time: float,
    followed: Mapping[str, str] = MappingProxyType({}),
) -> InputSignals:
    """Read a table of input signals.

    The first row names the columns: `time` first, then inputs of the FMU, each with an optional unit in brackets,
    as in `time [ms],drive_torque [N.mm]`. Semicolons may join them, and numbers then have decimal commas or points
    (`csv_table`). The rows must cover the run from `start_time` to `stop_time` [s].

    Args:
        path: of the file.
        description: whose inputs they are.
        start_time: of the run [s].
        stop_time: of the run [s].
        followed: for inputs that are connected, what they follow.

    Raises:
        UsageError: the file, a heading, a cell or the time column cannot be used; the message names the line.
    """
    data = _bytes(path)
    table = read_csv(data, path)
    names, units = _headings(table.header, path)
    for name in names[1:]:
        if name in followed:
            raise UsageError(f"{path}: '{name}' follows {followed[name]}, by a connection; no table can drive it.")
    variables = [_input_variable(name, description, path) for name in names[1:]]
    time_axis = Variable("time", reference=-1, type="Real", causality="independent", unit="s")
    columns = [
        _column(_cells(table.rows, i, path), variable, unit, description, path)
        for i, (variable, unit) in enumerate(zip([time_axis, *variables], units, strict=True))
    ]
    values, digest = np.column_stack(columns[1:]), hashlib.sha256(data).hexdigest()
    signals = InputSignals(tuple(variables), columns[0], values, path.name, digest, table.note)
    _check_times(signals.times, start_time, stop_time, path)
    return signals


def _bytes(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise unreadable(path, error) from error


def _headings(header: Sequence[str], path: Path) -> tuple[list[str], list[str]]:
    names, units = [], []
    for heading in header:
        match = _HEADING.fullmatch(heading)
        if match is None:
            raise UsageError(
                f"{path}: '{heading}' is no heading; write name or name [unit], joined by commas or semicolons."
            )
        names.append(match[1])
        units.append(match[2] or "")
    if names[0] != "time":
        raise UsageError(f"{path}: the first column is '{names[0]}', but it must be 'time', e.g. 'time [s]'.")
    if len(names) == 1:
        raise UsageError(
            f"{path}: has a time column only; add a column for each input (columns joined by commas or semicolons)."
        )
    for name in names:
        if names.count(name) > 1:
            raise UsageError(f"{path}: the column '{name}' is there twice; keep one.")
    return names, units


def _input_variable(name: str, description: Description, path: Path) -> Variable:
    try:
        variable = settable_variable(name, description)
    except UsageError as error:
        raise UsageError(f"{path}: {error}") from None
    if variable.causality != "input":
        raise UsageError(f"{path}: '{name}' is a parameter, which cannot change during a run; set its value instead")
    if variable.type == "String":
        raise UsageError(f"{path}: '{name}' is a String input, which a table cannot drive; set its value instead")
    return variable


def _cells(rows: Sequence[tuple[int, Sequence[str]]], column: int, path: Path) -> npt.NDArray[np.float64]:
    numbers = []
    for line, cells in rows:
        number = float(cells[column]) if _NUMBER.fullmatch(cells[column]) else math.nan
        if not math.isfinite(number):
            raise UsageError(f"{path}, line {line}: '{cells[column].strip()}' is not a finite number.")
        numbers.append(number)
    return np.array(numbers)


def _column(
    numbers: npt.NDArray[np.float64], variable: Variable, unit: str, description: Description, path: Path
) -> npt.NDArray[np.float64]:
    """Numbers in the unit of the variable."""
    if variable.type != "Real" and bool(np.any(numbers != np.round(numbers))):
        raise UsageError(f"{path}: '{variable.name}' is {variable.type}; give whole numbers.")
    if not unit:
        return numbers
    if not variable.unit:
        raise UsageError(f"{path}: '{variable.name}' has no unit; leave out [{unit}].")
    try:
        return np.array([description.units.convert(float(x), unit, variable.unit) for x in numbers])
    except UnitMismatchError as mismatch:
        raise UsageError(f"{path}, column '{variable.name}': {mismatch}.") from None


def _check_times(times: npt.NDArray[np.float64], start_time: float, stop_time: float, path: Path) -> None:
    backwards = np.flatnonzero(np.diff(times) <= 0.0)
    if backwards.size:
        earlier, later = times[backwards[0]], times[backwards[0] + 1]
        raise UsageError(f"{path}: time must increase from row to row, but {later:g} s follows {earlier:g} s.")
    if times[0] > start_time + _HALF_A_NANOSECOND or times[-1] < stop_time - _HALF_A_NANOSECOND:
        raise UsageError(
            f"{path}: covers {times[0]:g} s to {times[-1]:g} s, but the run goes from {start_time:g} s to "
            f"{stop_time:g} s; add rows, or change the stop time."
        )


def _typed(number: float, variable: Variable) -> Value:
    if variable.type == "Integer":
        return round(number)
    if variable.type == "Boolean":
        return bool(number)
    return float(number)


def check_no_overlap(inputs: InputSignals, start_values: Mapping[str, Value]) -> None:
    """Refuse an input that is both set and driven by the table.

    Raises:
        UsageError: naming it.
    """
    for variable in inputs.variables:
        if variable.name in start_values:
            raise UsageError(f"'{variable.name}' is in the input table and in --set; give it in one place.")
