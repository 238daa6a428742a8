"""The ratchet's parameters-to-tables function accepts symbolic numbers: here dual numbers, for derivatives."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from itertools import product
from types import SimpleNamespace

import numpy as np
import pytest

from mechanism_fmu.model.compile import compile_tables
from models.ratchet.model import MODEL

PARAMETERS = [p.name for p in MODEL.parameters if p.type != "Boolean"]
POINTS = {
    "base case": {},
    "beam shorter than the face": {"tooth_slope_angle": math.radians(105), "restitution": 0.5},
    "other lengths": {"tooth_count": 17, "pawl_length": 0.09, "crank_length": 0.12, "wheel_angle_start": 1.25},
    "free pawl": {"guided": 0, "friction": 0.2},
    "free pawl at a given angle": {"guided": 0, "pawl_angle_start": 3.3},
}
#: The start angle is a number only where it is given: 0 chooses another formula, and a guided pawl's is solved.
SOLVED = [point for point, changes in POINTS.items() if "pawl_angle_start" not in changes]
CASES = [
    (name, point)
    for name in PARAMETERS
    for point in POINTS
    if (name, point) not in product(["pawl_angle_start"], SOLVED)
]


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
        return Dual(math.sqrt(self.a), self.b / (2 * math.sqrt(self.a)))

    def arctan2(self, x):
        x = dual(x)
        return Dual(math.atan2(self.a, x.a), (self.b * x.a - self.a * x.b) / (self.a**2 + x.a**2))

    def where_positive(self, positive, otherwise):
        return positive if self.a > 0 else otherwise


def dual(x):
    return x if isinstance(x, Dual) else Dual(float(x))


def tables(values: dict) -> dict[str, np.ndarray]:
    compiled = compile_tables(MODEL.mechanism(SimpleNamespace(**values)))
    return {f.name: np.asarray(getattr(compiled, f.name)) for f in fields(compiled)}


@pytest.mark.parametrize(("name", "point"), CASES)
def test_derivatives_agree_with_differences(name, point):
    values = vars(MODEL.values(**POINTS[point]))
    size = 1e-6 * max(abs(values[name]), 1e-3)
    exact = tables(values | {name: Dual(values[name], 1.0)})
    plus, minus = (tables(values | {name: values[name] + d}) for d in (size, -size))
    moved = set()
    for table, numbers in exact.items():
        if np.issubdtype(numbers.dtype, np.integer):
            np.testing.assert_array_equal(plus[table], numbers)
            continue
        derivative = np.array([dual(x).b for x in numbers.flat])
        difference = ((plus[table] - minus[table]) / (2 * size)).ravel()
        scale = max(1.0, np.abs(difference).max(initial=0.0))
        np.testing.assert_allclose(derivative, difference, rtol=0, atol=2e-6 * scale, err_msg=table)
        moved |= {table} if derivative.any() else set()
    assert moved, f"no table depends on {name}"


@pytest.mark.parametrize("point", ["base case", "beam shorter than the face", "other lengths"])
def test_a_guided_pawls_start_angle_is_solved_whatever_is_given(point):
    values = vars(MODEL.values(**POINTS[point]))
    for table, numbers in tables(values | {"pawl_angle_start": 0.7}).items():
        np.testing.assert_array_equal(numbers, tables(values)[table], err_msg=table)


@pytest.mark.parametrize("point", POINTS)
def test_values_of_dual_numbers_are_those_of_floats(point):
    values = vars(MODEL.values(**POINTS[point]))
    symbolic = tables({name: Dual(float(x)) for name, x in values.items()})
    for table, numbers in tables(values).items():
        if numbers.dtype == float:
            np.testing.assert_allclose([dual(x).a for x in symbolic[table].flat], numbers.ravel(), rtol=1e-14)
        else:
            np.testing.assert_array_equal(symbolic[table], numbers)
