"""Dual numbers for parameters-to-tables functions, and their derivatives against differences."""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np

from mechanism_fmu.model.compile import compile_tables


@dataclass(frozen=True, eq=False)
class Dual:
    """a + b eps with eps^2 = 0. It has no comparisons and no float(): a formula that branches on it fails."""

    a: float
    b: float = 0.0

    def __add__(self, other):
        other = dual(other)
        return Dual(self.a + other.a, self.b + other.b)

    def __mul__(self, other):
        other = dual(other)
        return Dual(self.a * other.a, self.a * other.b + self.b * other.a)

    def __truediv__(self, other):
        other = dual(other)
        return Dual(self.a / other.a, (self.b * other.a - self.a * other.b) / other.a**2)

    def __neg__(self):
        return Dual(-self.a, -self.b)

    def __sub__(self, other):
        return self + (-dual(other))

    def __rsub__(self, other):
        return dual(other) - self

    def __rtruediv__(self, other):
        return dual(other) / self

    __radd__, __rmul__ = __add__, __mul__

    def __bool__(self):
        raise TypeError("a symbolic number cannot choose a branch")

    def sin(self):
        return Dual(math.sin(self.a), math.cos(self.a) * self.b)

    def cos(self):
        return Dual(math.cos(self.a), -math.sin(self.a) * self.b)

    def sqrt(self):
        root = math.sqrt(self.a)
        return Dual(root, self.b / (2 * root) if self.b else 0.0)  # what does not change may be the root of 0

    def arctan2(self, x):
        x = dual(x)
        return Dual(math.atan2(self.a, x.a), (self.b * x.a - self.a * x.b) / (self.a**2 + x.a**2))

    def where_positive(self, positive, otherwise):
        return positive if self.a > 0 else otherwise

    @property
    def nominal(self):
        return self.a


def dual(x):
    return x if isinstance(x, Dual) else Dual(float(x))


def tables(model, values):
    """All tables of a model for parameter values by name, which may be dual numbers."""
    compiled = compile_tables(model.mechanism(SimpleNamespace(**values)))
    return {name: np.asarray(value) for name, value in {**compiled.columns, **compiled.numbers}.items()}


def assert_derivatives_agree(model, values, name):
    """Derivatives of all tables by the parameter `name` are those of differences, and not all of them are zero."""
    size = 1e-6 * max(abs(values[name]), 1e-3)
    exact = tables(model, values | {name: Dual(values[name], 1.0)})
    plus, minus = (tables(model, values | {name: values[name] + d}) for d in (size, -size))
    moved = False
    for table, numbers in exact.items():
        if np.issubdtype(numbers.dtype, np.integer):
            np.testing.assert_array_equal(plus[table], numbers)
            continue
        derivative = np.array([dual(x).b for x in numbers.flat])
        difference = ((plus[table] - minus[table]) / (2 * size)).ravel()
        scale = max(1.0, np.abs(difference).max(initial=0.0))
        np.testing.assert_allclose(derivative, difference, rtol=0, atol=2e-6 * scale, err_msg=table)
        moved = moved or bool(derivative.any())
    assert moved, f"no table depends on {name}"
