"""What a word of the state may hold: of every field, and of every column of one whose columns differ.

A saved state comes from outside. What indexes anything must be within its range before the engine sees it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

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
