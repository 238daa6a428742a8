"""How a table is declared: a class with a line for each column, which is also the view of a block's words.

    class Joints(Table, rows="joints", prefix="joint_"):
        kind = integer()
        data = real(9)

declares the fields `joint_kind`, int64 of shape (joints,), and `joint_data`, float64 of shape (joints, 9), and
`Joints(block).data` is the latter, in the block itself. A shape is given in names of sizes (`Sizes`) and numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, NamedTuple, Self, cast

import numpy as np

from .contents import Holds

Array = np.ndarray[Any, np.dtype[Any]]


class Field(NamedTuple):
    """A field of the block.

    Attributes:
        room: "tables" (the mechanism), "state" (all that a saved state restores) or "work" (scratch).
        name: unique in the block.
        shape: names of sizes, or numbers.
        integer: whether it is int64, not float64.
        holds: what may stand in it, of every field of the state: for each column where the columns differ; the last
            declaration is that of all columns behind it, too.
        columns: names of its columns, where they differ.
    """

    room: str
    name: str
    shape: tuple[str | int, ...]
    integer: bool = False
    holds: tuple[Holds, ...] | None = None
    columns: tuple[str, ...] = ()


Allowed = Holds | Mapping[str, Holds]


class _Column(NamedTuple):
    """A column as its class declares it."""

    field: Field
    alone: bool


def real(
    *shape: str | int, name: str = "", work: bool = False, holds: Allowed | None = None, alone: bool = False
) -> Array:
    """A column of float64.

    Args:
        shape: names of sizes, or numbers; of each row where the class has rows.
        name: of the field, if it is not that of the column behind the prefix of the class.
        work: whether it is scratch.
        holds: of a column of the state, what may stand there; by names of columns where these differ.
        alone: whether the shape is given whole in a class that has rows.
    """
    return _column(shape, name, work, holds, alone, integer=False)


def integer(
    *shape: str | int, name: str = "", work: bool = False, holds: Allowed | None = None, alone: bool = False
) -> Array:
    """A column of int64; arguments as of `real`."""
    return _column(shape, name, work, holds, alone, integer=True)


def _column(
    shape: tuple[str | int, ...], name: str, work: bool, holds: Allowed | None, alone: bool, *, integer: bool
) -> Array:
    columns = tuple(holds) if isinstance(holds, Mapping) else ()
    allowed = None if holds is None else tuple(holds.values()) if isinstance(holds, Mapping) else (holds,)
    room = "work" if work else "tables" if holds is None else "state"
    return cast(Array, _Column(Field(room, name, shape, integer, allowed, columns), alone))


class Table:
    """A view of some fields of a block; each subclass declares them."""

    #: The fields of a table, by column.
    fields: ClassVar[dict[str, Field]]
    #: Finds a field in a block: `layout.field_of`, which is made of all tables.
    _look: ClassVar[Callable[[Array, str], Array]]
    _last: ClassVar[Any] = (None, None)

    def __init_subclass__(cls, rows: str = "", prefix: str = "") -> None:
        """Read the columns of a class.

        Args:
            rows: the size that is the length of each column; "" where the shapes are given whole.
            prefix: of the fields' names.
        """
        super().__init_subclass__()
        cls.fields = {}
        for column, declared in vars(cls).items():
            if isinstance(declared, _Column):
                field = declared.field
                shape = field.shape if declared.alone or not rows else (rows, *field.shape)
                cls.fields[column] = field._replace(name=field.name or prefix + column, shape=shape)

    def __new__(cls, block: Array) -> Self:
        """The table in a block."""
        seen = cls._last  # plain Python looks at the same block again and again
        if seen[0] is not block:
            view = super().__new__(cls)
            for column, field in cls.fields.items():
                setattr(view, column, cls._look(block, field.name))
            cls._last = seen = block, view
        return cast(Self, seen[1])
