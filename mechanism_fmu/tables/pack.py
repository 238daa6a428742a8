"""From a mechanism's tables to an instance's block."""

from __future__ import annotations

from typing import Any

from .declare import Array
from .layout import FIELDS, allocate, field_of
from .sizes import GIVEN_SIZES


def pack(tables: Any) -> Array:
    """A block for the tables of a mechanism (any object with the table fields of `layout` as attributes).

    Returns:
        float64 of shape (words,), with inputs at their start values and no motion begun.

    """
    block = allocate({size: _number(size, tables) for size in GIVEN_SIZES})
    write_tables(block, tables)
    field_of(block, "inputs")[:] = tables.input_start
    return block


def write_tables(block: Array, tables: Any) -> None:
    """Write tables of the same structure into a block, leaving its state as it is."""
    for field in FIELDS:
        if field.room == "tables":
            field_of(block, field.name)[...] = getattr(tables, field.name)


def _number(size: str, tables: Any) -> int:
    """The length of the tables with so many rows, or the number of that name."""
    for field in FIELDS:
        if field.room == "tables" and field.shape[0] == size:
            return len(getattr(tables, field.name))
    number: int = getattr(tables, size)
    return number
