"""Sine, cosine, tangent and the angle of a point, within one unit in the last place.

Angles are taken modulo pi/2 in the manner of Cody and Waite (Software Manual for the Elementary Functions, 1980); what
is left, at most pi/4, goes into the Taylor series.
"""

from __future__ import annotations

import math

from .exact import quick_two_sum, quotient, two_product, two_sum

_QUARTER = 0.7853981633974483
_QUADRANTS_PER_RADIAN = 0.6366197723675814
#: pi/2 in parts: a multiple of 33 bits and the rest; the same in three such multiples and the rest.
_HALF_PI, _HALF_PI_REST = 1.5707963267341256, 6.077100506506192e-11
_HALF_PI_2, _HALF_PI_3, _HALF_PI_4 = 6.077100506303966e-11, 2.0222662487111665e-21, 8.4784276603689e-32
#: Quadrants up to here are numbers of 20 bits: times 33 bits that is exact.
_NEAR = 1048576.0
#: Angles from here on [rad], 1.1e12, have no sine: two neighbouring numbers are 2e-4 rad and more apart.
FARTHEST = _NEAR * _NEAR
#: Added and taken away again, it rounds to a whole number.
_ROUNDER = 6755399441055744.0
#: Below it, x^3/6 is nothing beside x.
_TINY = 1e-9


def _subtracted(x: float, many: float, n: float) -> tuple[float, float]:
    """What is left of `x` without (many + n) pi/2, and what that lacks.

    From `x`, many times the first part of pi/2 is away already. Both are whole numbers of at most 20 bits, `many` times
    2^20. Parts go in the order of their size: where little is left, each step before was exact.
    """
    rest, error = two_sum(x - n * _HALF_PI, -many * _HALF_PI_2)
    rest, error_2 = two_sum(rest, -n * _HALF_PI_2)
    rest, error_3 = two_sum(rest, -many * _HALF_PI_3)
    rest, error_4 = two_sum(rest, -n * _HALF_PI_3)
    return quick_two_sum(rest, (error + error_2 + error_3 + error_4) - (many + n) * _HALF_PI_4)


def reduced(x: float) -> tuple[float, float, int]:
    """An angle modulo pi/2: at most pi/4, what that lacks, and the quadrant 0..3, for |x| < `FARTHEST`."""
    if abs(x) <= _QUARTER:
        return x, 0.0, 0
    n = (x * _QUADRANTS_PER_RADIAN + _ROUNDER) - _ROUNDER
    if abs(n) < _NEAR:
        rest = x - n * _HALF_PI
        y = rest - n * _HALF_PI_REST
        if abs(y) > 0.03125:
            return y, (rest - y) - n * _HALF_PI_REST, int(n) & 3
        y, low = _subtracted(x, 0.0, n)  # little is left: what the parts lack would be much of it
        return y, low, int(n) & 3
    many = ((x * _QUADRANTS_PER_RADIAN / _NEAR + _ROUNDER) - _ROUNDER) * _NEAR
    x -= many * _HALF_PI
    n = ((x - many * _HALF_PI_REST) * _QUADRANTS_PER_RADIAN + _ROUNDER) - _ROUNDER
    y, low = _subtracted(x, many, n)
    return y, low, int(n) & 3


def _sine_rest(y: float, low: float) -> float:
    """What sin(y + low) has beside y, for at most pi/4: Taylor up to y^17/17!."""
    z = y * y
    w = z * z
    series = (-1.0 / 6.0 + z / 120.0) + w * (
        (-1.0 / 5040.0 + z * (1.0 / 362880.0))
        + w * ((-1.0 / 39916800.0 + z * (1.0 / 6227020800.0)) + w * (-1.0 / 1307674368000.0 + z / 355687428096000.0))
    )
    return y * z * series + low * (1.0 - 0.5 * z)


def _cosine(y: float, low: float) -> tuple[float, float]:
    """1 - y^2/2, rounded, and what cos(y + low) has beside it, for at most pi/4: Taylor up to y^16/16!."""
    z = y * y
    w = z * z
    series = (1.0 / 24.0 - z / 720.0) + w * (
        (1.0 / 40320.0 - z * (1.0 / 3628800.0))
        + w * ((1.0 / 479001600.0 - z * (1.0 / 87178291200.0)) + w * (1.0 / 20922789888000.0))
    )
    half = 0.5 * z
    most = 1.0 - half
    return most, ((1.0 - most) - half) + (w * series - y * low)


def sine_cosine(x: float) -> tuple[float, float]:
    """Sine and cosine of an angle [rad]; not a number from `FARTHEST` on.

    Args:
        x: angle [rad].

    Source: own, from the sources above.
    """
    if not abs(x) < FARTHEST:
        return math.nan, math.nan
    if abs(x) < _TINY:
        return x, 1.0
    y, low, quadrant = reduced(x)
    s = y + _sine_rest(y, low)
    c, rest = _cosine(y, low)
    c += rest
    if quadrant == 0:
        return s, c
    if quadrant == 1:
        return c, -s
    if quadrant == 2:
        return -s, -c
    return -c, s


def sin(x: float) -> float:
    """Sine of an angle [rad]; not a number from `FARTHEST` on.

    Args:
        x: angle [rad].

    Source: own, from the sources above.
    """
    return sine_cosine(x)[0]


def cos(x: float) -> float:
    """Cosine of an angle [rad]; not a number from `FARTHEST` on.

    Args:
        x: angle [rad].

    Source: own, from the sources above.
    """
    return sine_cosine(x)[1]


def tan(x: float) -> float:
    """Tangent of an angle [rad]; not a number from `FARTHEST` on.

    Args:
        x: angle [rad].

    Source: own, from the sources above.
    """
    if not abs(x) < FARTHEST:
        return math.nan
    if abs(x) < _TINY:
        return x
    y, low, quadrant = reduced(x)
    s, s_low = quick_two_sum(y, _sine_rest(y, low))
    c, rest = _cosine(y, low)
    c, c_low = quick_two_sum(c, rest - 0.5 * two_product(y, y)[1])
    if quadrant % 2 == 0:
        t, t_low = quotient(s, s_low, c, c_low)
        return t + t_low
    t, t_low = quotient(c, c_low, s, s_low)
    return -(t + t_low)


def _eighths(k: int) -> tuple[float, float]:
    """The angle whose tangent is k/8, 0 <= k <= 8, as a number and what it lacks."""
    if k == 0:
        return 0.0, 0.0
    if k == 1:
        return 0.12435499454676144, -3.1253241424539383e-18
    if k == 2:
        return 0.24497866312686414, 1.0698755618734451e-17
    if k == 3:
        return 0.35877067027057225, -2.4623815582638635e-17
    if k == 4:
        return 0.4636476090008061, 2.2698777452961687e-17
    if k == 5:
        return 0.5585993153435624, -5.4556305485916264e-18
    if k == 6:
        return 0.6435011087932844, 1.5834785051444286e-17
    if k == 7:
        return 0.7188299996216245, -2.1478388444456983e-17
    return 0.7853981633974483, 3.061616997868383e-17


def _angle(small: float, big: float) -> tuple[float, float]:
    """The angle, 0 to pi/4, whose tangent is small/big, and what it lacks; 0 <= small <= big, big > 0, finite."""
    if small < big * 1e-18:
        return small / big, 0.0
    if big > 1e150:
        small, big = small * 2.0**-600, big * 2.0**-600
    elif big < 1e-150:
        small, big = small * 2.0**600, big * 2.0**600
    k = math.floor(small / big * 8.0 + 0.5)
    # the tangent of what the angle has beside that of k/8: (small - k/8 big)/(big + k/8 small)
    p, error = two_product(0.125 * k, big)
    above, above_low = two_sum(small, -p)
    q, q_error = two_product(0.125 * k, small)
    below, below_low = two_sum(big, q)
    t, t_low = quotient(above, above_low - error, below, below_low + q_error)
    z = t * t
    series = -1.0 / 3.0 + z * (
        0.2 + z * (-1.0 / 7.0 + z * (1.0 / 9.0 + z * (-1.0 / 11.0 + z * (1.0 / 13.0 - z / 15.0))))
    )
    high, low = _eighths(k)
    s, error = two_sum(high, t)
    return quick_two_sum(s, error + (low + (t_low + t * z * series)))


def atan2(y: float, x: float) -> float:
    """Angle of the point (x, y) [rad], in [-pi, pi], with the signs of zeros as in IEEE 754.

    Args:
        y: coordinate of the point, of the unit of `x`.
        x: coordinate of the point.

    Source: own; a table of angles and the Taylor series.
    """
    if math.isnan(x) or math.isnan(y):
        return math.nan
    across, along = abs(y), abs(x)
    if math.isinf(across) or math.isinf(along):
        across, along = (1.0 if math.isinf(across) else 0.0), (1.0 if math.isinf(along) else 0.0)
    angle, low = 0.0, 0.0
    if across > along:
        angle, low = _angle(along, across)
        angle, error = two_sum(1.5707963267948966, -angle)
        low = error + (6.123233995736766e-17 - low)
    elif along > 0.0:
        angle, low = _angle(across, along)
    if math.copysign(1.0, x) < 0.0:
        angle, error = two_sum(3.141592653589793, -angle)
        low = error + (1.2246467991473532e-16 - low)
    return math.copysign(angle + low, y)
