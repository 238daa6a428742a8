"""Conditions on numbers that may be symbolic: positive where they hold, and not where a number is NaN.

Limits of a parameter may be known (`Symbol.limits`): a condition that all values within them meet is the number 1.
"""

from __future__ import annotations

import math

from .functions import Number, is_plain, sqrt, where_positive


def plain(x: Number) -> Number:
    """A plain number as a float, which numpy never warns about; any other as it is."""
    return float(x) if is_plain(x) else x


def unless(condition: Number) -> Number:
    """1 where `condition` is not positive, also where it is NaN; else 0."""
    return where_positive(condition, 0.0, 1.0)


def both(a: Number, b: Number) -> Number:
    """Where `a` and `b` hold."""
    if is_plain(b):
        a, b = b, a  # what is known records nothing
    return where_positive(a, b, 0.0)


def finite(*numbers: Number) -> Number:
    """Where all numbers are finite; parameters with known limits are."""
    known = [float(x) for x in numbers if is_plain(x)]
    holds: Number = 1.0 if all(map(math.isfinite, known)) else 0.0
    for x in numbers:
        if not is_plain(x) and _limits(x) is None:
            holds = holds + (x - x)
    return holds


def positive(x: Number) -> Number:
    """Where 0 < x, which may be infinite."""
    return 1.0 if _is_known(x, above=0.0) else plain(x)


def not_negative(x: Number) -> Number:
    """Where 0 <= x, which may be infinite."""
    return 1.0 if _is_known(x, low=0.0) else where_positive(-plain(x), 0.0, plain(x) + 1.0)


def finite_positive(x: Number) -> Number:
    """Where 0 < x < infinity."""
    return both(positive(x), finite(x))


def finite_not_negative(x: Number) -> Number:
    """Where 0 <= x < infinity."""
    return 1.0 if _is_known(x, low=0.0) else where_positive(-plain(x), 0.0, finite(x))


def not_zero(x: Number) -> Number:
    """Where x > 0 or x < 0."""
    return 1.0 if _is_known(x, above=0.0) else where_positive(plain(x), 1.0, -plain(x))


def is_zero(x: Number) -> Number:
    """Where x = 0."""
    return where_positive(plain(x), 0.0, not_negative(x))


def within(x: Number, low: float, high: float) -> Number:
    """Where low <= x <= high, for finite limits."""
    if _is_known(x, low=low, high=high):
        return 1.0
    return where_positive(low - plain(x), 0.0, where_positive(plain(x) - high, 0.0, finite(x)))


def true_or_false(x: Number) -> Number:
    """Where x is 0 or 1; nowhere else does rounding make the product 0."""
    if _is_known(x, low=0.0, high=1.0, whole=True):
        return 1.0
    return is_zero(plain(x) * (1.0 - plain(x)))


def length(vector: tuple[Number, Number]) -> Number:
    """Length of a vector."""
    x, y = map(plain, vector)
    return sqrt(x * x + y * y)


def size(x: Number) -> Number:
    """|x|; never a negative zero, which a message would show."""
    return where_positive(-plain(x), -plain(x), plain(x))


def _limits(x: Number) -> Number:
    return getattr(x, "limits", None)


def _is_known(
    x: Number, low: float = -math.inf, high: float = math.inf, above: float = -math.inf, whole: bool = False
) -> bool:
    """Whether x is a parameter whose limits keep it within `low`..`high`, above `above`, and whole."""
    limits = _limits(x)
    if limits is None:
        return False
    return bool(low <= limits.low and limits.high <= high and above < limits.low and whole <= limits.whole)
