"""Sums and products with their rounding errors: two numbers that carry twice the digits of one.

The engine compiles all functions of this folder, so each has scalars only, raises nothing, and calls only what stands
above it (here, or in what it imports). `split_exponent` and `scaled` are exact in any form: the engine has its own.
"""

from __future__ import annotations

import math

_SPLITTER = 134217729.0  # 2^27 + 1


def two_sum(a: float, b: float) -> tuple[float, float]:
    """The sum a + b, rounded, and its error. Source: Knuth, The Art of Computer Programming 2, 4.2.2, theorem B."""
    s = a + b
    t = s - a
    return s, (a - (s - t)) + (b - t)


def quick_two_sum(a: float, b: float) -> tuple[float, float]:
    """The sum a + b for |a| >= |b|, rounded, and its error. Source: Dekker 1971, Numerische Mathematik 18."""
    s = a + b
    return s, b - (s - a)


def two_product(a: float, b: float) -> tuple[float, float]:
    """The product a b, rounded, and its error, for |a|, |b| < 2^990. Source: Dekker 1971, Numerische Mathematik 18."""
    p = a * b
    t = _SPLITTER * a
    a_high = t - (t - a)
    a_low = a - a_high
    t = _SPLITTER * b
    b_high = t - (t - b)
    b_low = b - b_high
    return p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low


def quotient(a: float, a_low: float, b: float, b_low: float) -> tuple[float, float]:
    """(a + a_low)/(b + b_low) as a number and what it lacks. Source: one step of long division."""
    q = a / b
    p, error = two_product(q, b)
    return q, ((a - p) - error + a_low - q * b_low) / b


def split_exponent(x: float) -> tuple[float, int]:
    """Take x > 0 apart, (m, k), x = m 2^k with 0.5 <= m < 1. Source: `math.frexp`."""
    return math.frexp(x)


def scaled(x: float, k: int) -> float:
    """The product x 2^k for 0.25 <= x < 4, rounded where that is below the normal numbers; -1100 < k < 1026.

    Source: `math.ldexp`.
    """
    half = k // 2
    return x * math.ldexp(1.0, half) * math.ldexp(1.0, k - half)
