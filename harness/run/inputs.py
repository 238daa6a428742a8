"""Input signals from a CSV table."""

from __future__ import annotations

import csv
import hashlib
import io
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import numpy as np
import numpy.typing as npt

from ..errors import UsageError
from ..fmu.description import Description, Value, Variable
from ..fmu.units import UnitMismatchError
from ..fmu.values import settable_variable

# A CSV table of numbers: columns joined by commas or semicolons, numbers with decimal points or commas.

#: The first heading, and what stands behind it.
_FIRST = re.compile(r'\s*"?[^",;]*"?\s*([,;])')
_DECIMAL_COMMA = re.compile(r"\s*[+-]?(\d+,\d*|,\d+)([eE][+-]?\d+)?\s*", re.ASCII)
_DECIMAL_POINT = re.compile(r"\s*[+-]?(\d+\.\d*|\.\d+)([eE][+-]?\d+)?\s*", re.ASCII)
#: What may be a whole number with its thousands apart: 1,234 but not 0,125.
_THOUSANDS = re.compile(r"\s*[+-]?[1-9]\d{0,2},\d{3}\s*", re.ASCII)


@dataclass(frozen=True)
class CsvTable:
    """A table of texts.

    Attributes:
        header: the cells of the first line.
        rows: of each line below that is not empty, its number in the file and its cells, as many as in the header;
            numbers have decimal points.
        note: how the file was understood, where it is not as usual; "" else.
    """

    header: list[str]
    rows: list[tuple[int, list[str]]]
    note: str = ""


def read_csv(data: bytes, path: Path) -> CsvTable:
    """Read the contents `data` of the file `path`.

    What stands behind the first heading joins the columns. Commas within numbers are decimal commas where semicolons
    join columns.

    Raises:
        UsageError: no text, no table, or one whose numbers may mean this or that; the message names the line.
    """
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise unreadable(path, error) from error
    first = _FIRST.match(text)
    delimiter = ";" if first is not None and first[1] == ";" else ","
    try:
        reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter)
        lines = [(reader.line_num, cells) for cells in reader if any(cell.strip() for cell in cells)]
    except csv.Error as error:
        raise unreadable(path, error) from error
    if len(lines) < 2:
        raise UsageError(f"{path}: needs a line of headings (time, then inputs) and at least one row of values.")
    (_, header), rows = lines[0], lines[1:]
    for line, cells in rows:
        if len(cells) != len(header):
            raise UsageError(
                f"{path}, line {line}: has {len(cells)} values, but there are {len(header)} headings."
                f"{_way_out(cells, len(header), delimiter)}"
            )
    if delimiter == ",":
        return CsvTable(header, rows)
    rows, commas = _with_points(rows, path)
    numbers = ", numbers have decimal commas" if commas else ""
    return CsvTable(header, rows, f"{path.name}: columns are joined by semicolons{numbers}.")


def unreadable(path: Path, error: Exception) -> UsageError:
    """What to raise for the file `path` that cannot be read."""
    return UsageError(f"The input file '{path}' cannot be read: {error}.")


def _way_out(cells: list[str], headings: int, delimiter: str) -> str:
    if delimiter == "," and any(";" in cell for cell in cells):
        return " Its values are joined by semicolons: join the headings by semicolons, too."
    if delimiter == "," and len(cells) == 2 * headings:
        return " If its numbers have decimal commas, join columns by semicolons, or write decimal points."
    if delimiter == ";" and len(cells) == 1 and "," in cells[0]:
        return " Its values are joined by commas: join the headings by commas, too."
    return ""


def _with_points(rows: list[tuple[int, list[str]]], path: Path) -> tuple[list[tuple[int, list[str]]], bool]:
    """Rows whose numbers have decimal points, and whether they had commas."""
    commas = [(line, cell) for line, cells in rows for cell in cells if _DECIMAL_COMMA.fullmatch(cell)]
    points = [(line, cell) for line, cells in rows for cell in cells if _DECIMAL_POINT.fullmatch(cell)]
    if not commas:
        return rows, False
    line, cell = commas[0]
    if points:
        other, point = points[0]
        raise UsageError(
            f"{path}: '{cell.strip()}' in line {line} has a comma and '{point.strip()}' in line {other} a point, so it "
            "is not clear which of them begins the decimals; write all numbers alike, without marks between thousands."
        )
    if all(_THOUSANDS.fullmatch(cell) for _, cell in commas):
        raise UsageError(
            f"{path}, line {line}: '{cell.strip()}' may be a number with three decimals or one above a thousand, and "
            "so may all others with a comma; write decimal points, or another number of decimals."
        )
    exchanged = [
        (line, [cell.replace(",", ".") if _DECIMAL_COMMA.fullmatch(cell) else cell for cell in cells])
        for line, cells in rows
    ]
    return exchanged, True


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
        note: how that file was understood, where it is not as usual; "" else.
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
    (above). The rows must cover the run from `start_time` to `stop_time` [s].

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
    return bool(number) if variable.type == "Boolean" else float(number)


def check_no_overlap(inputs: InputSignals, start_values: Mapping[str, Value]) -> None:
    """Refuse an input that is both set and driven by the table.

    Raises:
        UsageError: naming it.
    """
    for variable in inputs.variables:
        if variable.name in start_values:
            raise UsageError(f"'{variable.name}' is in the input table and in --set; give it in one place.")
