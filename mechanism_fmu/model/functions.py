"""Elementary functions for parameters-to-tables functions and for laws of force.

They take floats, and any symbolic number that brings the method of the same name (CasADi's do), so that a model's
formulas can be evaluated, differentiated or traced without being written twice. `exp`, `log`, `tanh` and `power` take
floats and the arguments of laws (`laws.law_operations`), but no parameters.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .. import elementary

__all__ = [
    "Number",
    "atan2",
    "cos",
    "exp",
    "log",
    "maximum",
    "minimum",
    "power",
    "sin",
    "smoothstep",
    "sqrt",
    "tan",
    "tanh",
    "where",
    "where_positive",
]

#: A float, or a symbolic stand-in for one.
Number = Any


def is_plain(x: object) -> bool:
    """Whether a number is a plain one, not a symbolic."""
    return isinstance(x, (int, float, np.number, np.bool_))


def nominal(x: Number) -> float:
    """A plain number as a float; a symbolic one where all parameters have the values at which they start.

    It is NaN where these are not known. Only what belongs to the structure may follow from it.
    """
    return float(x) if is_plain(x) else float(getattr(x, "nominal", math.nan))


def _law(*operands: Number) -> Any:
    """The law that one of the operands belongs to, or None."""
    return next((x.law for x in operands if hasattr(x, "law")), None)


def _apply(name: str, x: Number) -> Number:
    if hasattr(x, "law"):
        return x.law.apply(name, x)
    method = getattr(x, name, None)
    return _evaluated(name, x) if method is None else method()


#: Where functions of plain numbers have values.
_DOMAINS = dict.fromkeys(("sin", "cos", "tan"), "Give an angle below 1e12 rad.") | {
    "sqrt": "Give x >= 0.",
    "log": "Give x > 0.",
    "exp": "Give x <= 709.",
    "power": "Give a base >= 0, or > 0 for exponents below 0; a whole power of any number is a product.",
}


def _square_root(x: float) -> float:
    return math.sqrt(x) if x >= 0.0 else math.nan


def _evaluated(name: str, *numbers: Number) -> float:
    """A function of plain numbers.

    Raises:
        ValueError: it has no value there, or one that no float holds.
    """
    function = _square_root if name == "sqrt" else getattr(elementary, name)
    value: float = function(*map(float, numbers))
    if not math.isfinite(value) and all(map(math.isfinite, numbers)):
        given = ", ".join(f"{x:.9g}" for x in numbers)
        raise ValueError(f"{name}({given}) has no finite value. {_DOMAINS[name]}")
    return value


def sin(x: Number) -> Number:
    """Sine of `x` [rad].

    Args:
        x: angle [rad].

    Source: `mechanism_fmu.elementary`: the same bits on every platform.
    """
    return _apply("sin", x)


def cos(x: Number) -> Number:
    """Cosine of `x` [rad].

    Args:
        x: angle [rad].

    Source: `mechanism_fmu.elementary`: the same bits on every platform.
    """
    return _apply("cos", x)


def tan(x: Number) -> Number:
    """Tangent of `x` [rad].

    Args:
        x: angle [rad].

    Source: `mechanism_fmu.elementary`: the same bits on every platform.
    """
    return _apply("tan", x)


def sqrt(x: Number) -> Number:
    """Square root of `x` >= 0.

    Args:
        x: number of any unit, >= 0.

    Source: `math.sqrt`.
    """
    return _apply("sqrt", x)


def exp(x: Number) -> Number:
    """Exponential of `x`.

    Args:
        x: number of unit 1, at most 709.

    Source: `mechanism_fmu.elementary`: the same bits on every platform.
    """
    return _apply("exp", x)


def log(x: Number) -> Number:
    """Natural logarithm of `x` > 0.

    Args:
        x: number of unit 1, > 0.

    Source: `mechanism_fmu.elementary`: the same bits on every platform.
    """
    return _apply("log", x)


def tanh(x: Number) -> Number:
    """Hyperbolic tangent of `x`: a smooth step from -1 to 1.

    Args:
        x: number of unit 1.

    Source: `mechanism_fmu.elementary`: the same bits on every platform.
    """
    return _apply("tanh", x)


def power(base: Number, exponent: Number) -> Number:
    """`base` >= 0 to a power.

    Args:
        base: number of unit 1, >= 0.
        exponent: number of unit 1.

    Source: `mechanism_fmu.elementary`: the same bits on every platform.
    """
    law = _law(base, exponent)
    return _evaluated("power", base, exponent) if law is None else law.apply("power", base, exponent)


def atan2(y: Number, x: Number) -> Number:
    """Angle [rad] of the point (x, y), in (-pi, pi].

    Args:
        y: coordinates of the point, of one unit.
        x: coordinates of the point, of one unit.

    Source: `mechanism_fmu.elementary`: the same bits on every platform.
    """
    law = _law(y, x)
    if law is not None:
        return law.apply("atan2", y, x)
    if hasattr(x, "arctan2") and not hasattr(y, "arctan2"):
        y = y + 0 * x  # a float beside a symbol becomes a symbol
    method = getattr(y, "arctan2", None)
    return _evaluated("atan2", y, x) if method is None else method(x)


def where_positive(condition: Number, positive: Number, otherwise: Number) -> Number:
    """`positive` where `condition > 0`, else `otherwise`: a choice of values, never of structure.

    Args:
        condition: number of any unit, which is compared with 0.
        positive: values of one unit.
        otherwise: values of one unit.

    Source: definition.
    """
    law = _law(condition, positive, otherwise)
    if law is not None:
        return law.apply("where_positive", condition, positive, otherwise)
    method = getattr(condition, "where_positive", None)
    if method is None:
        return positive if condition > 0 else otherwise
    return method(positive, otherwise)


def where(condition: Any, positive: Number, otherwise: Number) -> Number:
    """`positive` where a comparison such as `x > 0.1` holds, else `otherwise`: in laws, where nothing may branch.

    Args:
        condition: a comparison, or a number of any unit that is compared with 0.
        positive: values of one unit.
        otherwise: values of one unit.

    Source: definition.
    """
    if hasattr(condition, "choose"):
        return condition.choose(positive, otherwise)
    if isinstance(condition, bool | np.bool_):
        condition = 1.0 if condition else 0.0
    return where_positive(condition, positive, otherwise)


def minimum(a: Number, b: Number) -> Number:
    """The lesser of two numbers.

    Args:
        a: numbers of one unit.
        b: numbers of one unit.

    Source: definition.
    """
    law = _law(a, b)
    return where_positive(b - a, a, b) if law is None else law.apply("minimum", a, b)


def maximum(a: Number, b: Number) -> Number:
    """The greater of two numbers.

    Args:
        a: numbers of one unit.
        b: numbers of one unit.

    Source: definition.
    """
    law = _law(a, b)
    return where_positive(a - b, a, b) if law is None else law.apply("maximum", a, b)


def smoothstep(x: Number, low: Number, high: Number) -> Number:
    """0 up to `low`, 1 from `high` on, and 3 u^2 - 2 u^3 between, u = (x - low)/(high - low): its slope has no jump.

    Args:
        x: number of any unit.
        low: where the step begins and ends, of the same unit; low < high.
        high: where the step begins and ends, of the same unit; low < high.

    Source: textbook: the cubic with values 0 and 1 and slopes 0 at the ends, by Hermite interpolation; the name is that
        of the OpenGL Shading Language.
    """
    u = minimum(maximum((x - low) / (high - low), 0.0), 1.0)
    return u * u * (3.0 - 2.0 * u)
