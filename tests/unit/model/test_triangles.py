"""Sides and angles of triangles, also where there is no such triangle."""

import math

import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.model.four_bar import angle_between, root


@pytest.mark.parametrize(
    ("square", "expected"), [(9.0, 3.0), (2.0, math.sqrt(2)), (0.0, 0.0), (-1e-9, 0.0), (-4.0, 0.0)]
)
def test_roots(square, expected):
    assert root(square) == expected


@pytest.mark.parametrize(
    ("adjacent", "square", "expected"),
    [
        (1.0, 4.0, math.pi / 3),
        (-1.0, 4.0, 2 * math.pi / 3),
        (0.0, 9.0, math.pi / 2),
        (4.0, 25.0, math.atan(3 / 4)),
        (3.0, 4.0, 0.0),
        (-3.0, 4.0, math.pi),
    ],
)
def test_angles(adjacent, square, expected):
    assert angle_between(adjacent, square) == pytest.approx(expected, abs=1e-15)


@given(st.floats(-1.0, 1.0))
def test_an_angle_has_its_cosine(cosine):
    assert math.cos(angle_between(cosine)) == pytest.approx(cosine, abs=1e-15)


@given(st.floats(1e-3, 1e3), st.floats(1e-3, 1e3), st.floats(0.01, math.pi - 0.01))
def test_the_law_of_cosines(a, b, angle):
    opposite = a * a + b * b - 2 * a * b * math.cos(angle)
    scale = max(a / b, b / a)
    assert angle_between(a * a + b * b - opposite, 4 * a * a * b * b) == pytest.approx(angle, abs=1e-12 * scale)
