"""Exponential, logarithm, power and hyperbolic tangent, within one unit in the last place of the normal numbers.

A number is taken apart into its exponent and what is between sqrt(1/2) and sqrt(2); the series are Taylor's, of e^y and
of the area hyperbolic tangent.
"""

from __future__ import annotations

import math

from .exact import quick_two_sum, quotient, scaled, split_exponent, two_product, two_sum

_ROUNDER = 6755399441055744.0
_PER_LN2 = 1.4426950408889634
#: ln 2 in parts: a multiple of 32 bits and the rest.
_LN2, _LN2_REST = 0.6931471803691238, 1.9082149292705877e-10
#: e^x is infinite above, and zero below.
_GREATEST, _LEAST = 709.782712893384, -745.1332191019412


def _exponential(x: float, low: float) -> tuple[float, float, int]:
    """e^(x + low) = (1 + y + rest) 2^k as (y, rest, k), |y| <= 0.35: Taylor up to y^14/14!."""
    n = (x * _PER_LN2 + _ROUNDER) - _ROUNDER
    y = x - n * _LN2
    less = n * _LN2_REST
    reduced = y - less
    low += (y - reduced) - less
    y = reduced
    z = y * y
    series = (1.0 / 6.0 + y / 24.0) + z * (
        (1.0 / 120.0 + y / 720.0)
        + z
        * (
            (1.0 / 5040.0 + y / 40320.0)
            + z
            * (
                (1.0 / 362880.0 + y / 3628800.0)
                + z * ((1.0 / 39916800.0 + y / 479001600.0) + z * (1.0 / 6227020800.0 + y / 87178291200.0))
            )
        )
    )
    rest = 0.5 * z + y * z * series
    return y, rest + low * (1.0 + (y + rest)), int(n)


def _raised(x: float, low: float) -> float:
    """e^(x + low)."""
    if x > _GREATEST + 1.0:
        return math.inf
    if x < _LEAST - 1.0:
        return 0.0
    y, rest, k = _exponential(x, low)
    s, error = quick_two_sum(1.0, y)
    return scaled(s + (error + rest), k)


def exp(x: float) -> float:
    """Exponential of a number of unit 1; infinite above 709.78.

    Args:
        x: number of unit 1.

    Source: own, from the sources above.
    """
    if math.isnan(x):
        return math.nan
    return _raised(x, 0.0)


def _logarithm(x: float) -> tuple[float, float]:
    """The natural logarithm of a finite x > 0 as a number and what it lacks, to 2^-64 of it."""
    m, k = split_exponent(x)
    if m < 0.7071067811865476:
        m, k = 2.0 * m, k - 1
    # ln m = 2 artanh s = 2 s + s^3 (2/3 + s^2 (2/5 + ...)), s = (m - 1)/(m + 1)
    s, s_low = quotient(m - 1.0, 0.0, *two_sum(m, 1.0))
    z, z_low = two_product(s, s)
    z_low += 2.0 * s * s_low
    series = 2.0 / 5.0 + z * (
        2.0 / 7.0
        + z
        * (
            2.0 / 9.0
            + z
            * (
                2.0 / 11.0
                + z
                * (
                    2.0 / 13.0
                    + z
                    * (
                        2.0 / 15.0
                        + z * (2.0 / 17.0 + z * (2.0 / 19.0 + z * (2.0 / 21.0 + z * (2.0 / 23.0 + z * (2.0 / 25.0)))))
                    )
                )
            )
        )
    )
    # the factor of s^3, its third included to twice the digits
    factor, factor_low = quick_two_sum(2.0 / 3.0, z * series)
    factor_low += 3.700743415417188e-17
    cube, cube_low = two_product(z, s)
    cube_low += z * s_low + z_low * s
    third, third_low = two_product(cube, factor)
    third_low += cube * factor_low + cube_low * factor
    high, low = quick_two_sum(2.0 * s, third)
    low += 2.0 * s_low + third_low
    if k != 0:
        high, error = quick_two_sum(k * _LN2, high)
        low += error + k * _LN2_REST
    return quick_two_sum(high, low)


def log(x: float) -> float:
    """Natural logarithm of a number of unit 1; of what is not positive, not a number.

    Args:
        x: number of unit 1, > 0.

    Source: own, from the sources above.
    """
    if not x > 0.0:
        return math.nan
    if math.isinf(x):
        return math.inf
    return _logarithm(x)[0]


def power(base: float, exponent: float) -> float:
    """A number > 0 to a power, 0 to a power > 0, or any number to the power 0; else not a number.

    Args:
        base: number of unit 1, >= 0, finite.
        exponent: number of unit 1, finite.

    Source: own, from the sources above.
    """
    if exponent == 0.0:
        return 1.0
    if base == 0.0 and exponent > 0.0:
        return 0.0
    if not 0.0 < base < math.inf or not abs(exponent) < math.inf:
        return math.nan
    high, low = _logarithm(base)
    x = exponent * high
    if x > _GREATEST + 1.0:
        return math.inf
    if x < _LEAST - 1.0:
        return 0.0
    x, error = two_product(exponent, high)
    return _raised(x, error + exponent * low)


def tanh(x: float) -> float:
    """Hyperbolic tangent of a number of unit 1.

    Args:
        x: number of unit 1.

    Source: own, from the sources above: e^2x - 1 over e^2x + 1.
    """
    if math.isnan(x):
        return math.nan
    half = abs(x)
    if half > 22.0:
        return math.copysign(1.0, x)
    if half < 1e-9:
        return x
    y, rest, k = _exponential(2.0 * half, 0.0)
    if k == 0:
        less, less_low = quick_two_sum(y, rest)
    else:
        s, error = quick_two_sum(1.0, y)
        error += rest
        less, less_error = two_sum(scaled(s, k), -1.0)
        less, less_low = two_sum(less, less_error + scaled(1.0, k) * error)
    more, more_low = two_sum(less, 2.0)
    t, t_low = quotient(less, less_low, more, more_low + less_low)
    return math.copysign(t + t_low, x)
