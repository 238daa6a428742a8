"""The ratchet's parameters-to-tables function accepts symbolic numbers: here dual numbers, for derivatives."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
from derivatives import Dual, assert_derivatives_agree, dual, tables

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


@pytest.mark.parametrize(("name", "point"), CASES)
def test_derivatives_agree_with_differences(name, point):
    assert_derivatives_agree(MODEL, vars(MODEL.values(**POINTS[point])), name)


@pytest.mark.parametrize("point", ["base case", "beam shorter than the face", "other lengths"])
def test_a_guided_pawls_start_angle_is_solved_whatever_is_given(point):
    values = vars(MODEL.values(**POINTS[point]))
    for table, numbers in tables(MODEL, values | {"pawl_angle_start": 0.7}).items():
        np.testing.assert_array_equal(numbers, tables(MODEL, values)[table], err_msg=table)


@pytest.mark.parametrize("point", POINTS)
def test_values_of_dual_numbers_are_those_of_floats(point):
    values = vars(MODEL.values(**POINTS[point]))
    symbolic = tables(MODEL, {name: Dual(float(x)) for name, x in values.items()})
    assert sum(numbers.size for numbers in symbolic.values()) > 100
    for table, numbers in tables(MODEL, values).items():
        if numbers.dtype == float:
            np.testing.assert_allclose([dual(x).a for x in symbolic[table].flat], numbers.ravel(), rtol=1e-14)
        else:
            np.testing.assert_array_equal(symbolic[table], numbers)
