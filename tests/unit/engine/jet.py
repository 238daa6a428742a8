"""Numbers that carry their first two derivatives along one direction (forward differentiation, exact to rounding)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Union

Number = Union["Jet", float]


@dataclass(frozen=True)
class Jet:
    """f, f' and f'' along a line."""

    value: float
    first: float = 0.0
    second: float = 0.0

    def __add__(self, other: Number) -> Jet:
        o = _jet(other)
        return Jet(self.value + o.value, self.first + o.first, self.second + o.second)

    def __mul__(self, other: Number) -> Jet:
        o = _jet(other)
        return Jet(
            self.value * o.value,
            self.first * o.value + self.value * o.first,
            self.second * o.value + 2 * self.first * o.first + self.value * o.second,
        )

    def __sub__(self, other: Number) -> Jet:
        return self + _jet(other) * -1.0

    __radd__ = __add__
    __rmul__ = __mul__


def cos(x: Jet) -> Jet:
    """Cosine."""
    return _chain(x, math.cos(x.value), -math.sin(x.value), -math.cos(x.value))


def sin(x: Jet) -> Jet:
    """Sine."""
    return _chain(x, math.sin(x.value), math.cos(x.value), -math.sin(x.value))


def _chain(x: Jet, f: float, df: float, ddf: float) -> Jet:
    return Jet(f, df * x.first, ddf * x.first**2 + df * x.second)


def _jet(x: Number) -> Jet:
    return x if isinstance(x, Jet) else Jet(x)
