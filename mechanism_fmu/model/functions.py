"""Elementary functions for parameters-to-tables functions.

They take floats, and any symbolic number that brings the method of the same name (CasADi's do), so that a model's
formulas can be evaluated, differentiated or traced without being written twice.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

__all__ = ["Number", "atan2", "cos", "sin", "sqrt", "tan", "where_positive"]

#: A float, or a symbolic stand-in for one.
Number = Any


def is_plain(x: object) -> bool:
    """Whether a number is a plain one, not a symbolic."""
    return isinstance(x, (int, float, np.number, np.bool_))


def _apply(name: str, x: Number) -> Number:
    method = getattr(x, name, None)
    return getattr(math, name)(x) if method is None else method()


def sin(x: Number) -> Number:
    """Sine of `x` [rad]."""
    return _apply("sin", x)


def cos(x: Number) -> Number:
    """Cosine of `x` [rad]."""
    return _apply("cos", x)


def tan(x: Number) -> Number:
    """Tangent of `x` [rad]."""
    return _apply("tan", x)


def sqrt(x: Number) -> Number:
    """Square root of `x` >= 0."""
    return _apply("sqrt", x)


def atan2(y: Number, x: Number) -> Number:
    """Angle [rad] of the point (x, y), in (-pi, pi]."""
    if hasattr(x, "arctan2") and not hasattr(y, "arctan2"):
        y = y + 0 * x  # a float beside a symbol becomes a symbol
    method = getattr(y, "arctan2", None)
    return math.atan2(y, x) if method is None else method(x)


def where_positive(condition: Number, positive: Number, otherwise: Number) -> Number:
    """`positive` where `condition > 0`, else `otherwise`: a choice of values, never of structure."""
    method = getattr(condition, "where_positive", None)
    if method is None:
        return positive if condition > 0 else otherwise
    return method(positive, otherwise)
