"""A CSV table of numbers: columns joined by commas or semicolons, numbers with decimal points or commas."""

from __future__ import annotations

import csv
import io
import re
from dataclasses import dataclass
from pathlib import Path

from .errors import UsageError

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
