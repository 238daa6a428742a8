"""Memory layout of an instance's block: header, tables, state, work; and how tables are written into one.

The tables describe the mechanism and change only with its parameters (an input's value is written into `force_data`);
the state is everything that a saved state must restore, in one piece; work is scratch that no result depends on.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from . import members, motion, parts
from .declare import Array, Field, Table
from .sizes import GIVEN_SIZES, SIZES, complete as completed, sizes_of

#: Every table, in the order of its module: whatever is imported first, the order is this one.
TABLES: tuple[type[Table], ...] = tuple(
    table
    for module in (parts, motion, members)
    for table in vars(module).values()
    if isinstance(table, type) and issubclass(table, Table) and table is not Table
)
#: Every field, in the order of the block: tables, then the state in one piece, then scratch.
FIELDS = tuple(
    field
    for section in ("tables", "state", "work")
    for table in TABLES
    for field in table.fields.values()
    if field.section == section
)
_FIRST_OFFSET = len(SIZES)
_HEADER = _FIRST_OFFSET + len(FIELDS)
FIELDS_BY_NAME = {field.name: field for field in FIELDS}
_SLOTS = {field.name: _FIRST_OFFSET + i for i, field in enumerate(FIELDS)}


def size_slot(name: str) -> int:
    """The header word that holds the size `name`."""
    return SIZES.index(name)


def slot(name: str) -> int:
    """The header word that holds the offset of the field `name`."""
    return _SLOTS[name]


def allocate(sizes: dict[str, int]) -> Array:
    """A zeroed block with its header filled in.

    Args:
        sizes: those of `GIVEN_SIZES`, by name.

    Returns:
        The block, float64 of shape (words,).

    """
    complete = completed(sizes)
    offsets = [_HEADER]
    for field in FIELDS:
        offsets.append(offsets[-1] + int(np.prod(shape_of(field, complete))))
    block = np.zeros(offsets[-1])
    block[:_HEADER].view(np.int64)[:] = [*(complete[name] for name in SIZES), *offsets[:-1]]
    return block


def field_of(block: Array, name: str) -> Array:
    """A view of the field `name`, in its own shape and type."""
    field = FIELDS_BY_NAME[name]
    shape = shape_of(field, sizes_of(block))
    start = int(block[:_HEADER].view(np.int64)[_SLOTS[name]])
    flat = block[start : start + int(np.prod(shape))]
    return (flat.view(np.int64) if field.integer else flat).reshape(shape)


Table._look = staticmethod(field_of)


def state_of(block: Array) -> Array:
    """A view of the whole state, shape (words,): copy it to save, write it to restore."""
    header = block[:_HEADER].view(np.int64)
    first = next(f.name for f in FIELDS if f.section == "state")
    return block[int(header[_SLOTS[first]]) : scratch_begins(block)]


def scratch_begins(block: Array) -> int:
    """The first word of a block's scratch, on which no result depends: it is the last part, and the largest."""
    after = next(f.name for f in FIELDS if f.section == "work")
    return int(block[:_HEADER].view(np.int64)[_SLOTS[after]])


def shape_of(field: Field, sizes: dict[str, int]) -> tuple[int, ...]:
    """The shape of a field for given sizes."""
    return tuple(sizes[n] if isinstance(n, str) else n for n in field.shape)


# From a mechanism's tables to an instance's block.


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
        if field.section == "tables":
            field_of(block, field.name)[...] = getattr(tables, field.name)


def _number(size: str, tables: Any) -> int:
    """The length of the tables with so many rows, or the number of that name."""
    for field in FIELDS:
        if field.section == "tables" and field.shape[0] == size:
            return len(getattr(tables, field.name))
    number: int = getattr(tables, size)
    return number
