"""Declaration of tables: a class with a line for each column, which is also the view of a block's words.

    class Joints(Table, rows="joints", prefix="joint_"):
        kind = integer()
        data = real(9)

declares the fields `joint_kind`, int64 of shape (joints,), and `joint_data`, float64 of shape (joints, 9), and
`Joints(block).data` is the latter, in the block itself. A shape is given in names of sizes (`Sizes`) and numbers.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any, ClassVar, NamedTuple, Self, cast

import numpy as np

# What a word of the state may hold: of every field, and of every column of one whose columns differ.
#
# A saved state comes from outside. What indexes anything must be within its range before the engine sees it.

#: Whole numbers are counted up to here: a double still holds each.
MOST = 2.0**53


class Holds(NamedTuple):
    """What words may hold: numbers from `low` to `high`, and one more for each of what `of` counts.

    Attributes:
        low, high: limits, inclusive; both infinite for any number.
        of: a size whose value is added to `high`, or None.
        whole: whether only whole numbers may stand there.
        nan: whether NaN may stand there, too.
    """

    low: float
    high: float
    of: str | None = None
    whole: bool = False
    nan: bool = False


#: Largest finite number.
_LARGEST = math.nextafter(math.inf, 0.0)

#: Numbers that are neither infinite nor NaN.
FINITE = Holds(-_LARGEST, _LARGEST)
NOT_NEGATIVE = Holds(0.0, _LARGEST)
#: A number that is infinite where there is none.
NOT_NAN = Holds(-math.inf, math.inf)
#: A number from which nothing but numbers follows; NaN where the motion has failed.
ANY = Holds(-math.inf, math.inf, nan=True)
FLAG = Holds(0, 1, whole=True)
COUNT = Holds(0, MOST, whole=True)
#: A whole number that counts in both directions.
WHOLE = Holds(-MOST, MOST, whole=True)


def whole(low: int, high: int, of: str | None = None) -> Holds:
    """Whole numbers from `low` to `high`, or to `high` plus the size `of`."""
    return Holds(low, high, of, whole=True)


def index_of(size: str) -> Holds:
    """An index of one of `size` things, or `codes.NONE`."""
    return Holds(-1, -1, size, whole=True)


Array = np.ndarray[Any, np.dtype[Any]]


class Field(NamedTuple):
    """A field of the block.

    Attributes:
        section: "tables" (the mechanism), "state" (all that a saved state restores) or "work" (scratch).
        name: unique in the block.
        shape: names of sizes, or numbers.
        integer: whether it is int64, not float64.
        holds: what may stand in it, of every field of the state: for each column where the columns differ; the last
            declaration is that of all columns behind it, too.
        columns: names of its columns, where they differ.
    """

    section: str
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
    section = "work" if work else "tables" if holds is None else "state"
    return cast(Array, _Column(Field(section, name, shape, integer, allowed, columns), alone))


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
