"""Motions of drivers."""

import math

import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.model import MechanismError, harmonic_motion, polynomial_motion, table_motion
from tests.curve_values import jumps, value

TIME = st.floats(-10.0, 10.0)
POINTS = [(0.5, 1.0), (1.0, 2.0), (2.0, -1.0), (2.5, 0.25)]


@given(TIME)
def test_a_polynomial(t):
    curve = polynomial_motion(1.0, -2.0, 0.0, 0.5)
    assert value(curve, t) == pytest.approx(1 - 2 * t + 0.5 * t**3, abs=1e-10)
    assert value(curve, t, 2) == pytest.approx(3 * t, abs=1e-10)


@given(TIME)
def test_a_harmonic(t):
    curve = harmonic_motion(0.5, 2.0, 3.0, 0.25)
    assert value(curve, t) == pytest.approx(0.5 + 2 * math.sin(3 * t + 0.25), abs=1e-12)
    assert value(curve, t, 1) == pytest.approx(6 * math.cos(3 * t + 0.25), abs=1e-12)


def test_a_table_goes_through_its_points_smoothly():
    curve = table_motion(POINTS)
    assert [value(curve, t) for t, _ in POINTS] == pytest.approx([v for _, v in POINTS], abs=1e-14)
    assert jumps(curve, 0) == pytest.approx([0.0] * 4, abs=1e-14)
    assert jumps(curve, 1) == pytest.approx([0.0] * 4, abs=1e-13)
    assert jumps(curve, 2)[1:-1] == pytest.approx([0.0] * 2, abs=1e-12)  # not where the rest begins and ends


@given(st.floats(0.0, 1e6))
def test_a_table_rests_before_and_after(away):
    curve = table_motion(POINTS)
    before = math.nextafter(0.5, 0.0) - away
    assert [value(curve, before, order) for order in range(4)] == [1.0, 0.0, 0.0, 0.0]
    assert [value(curve, 2.5 + away, order) for order in range(4)] == [0.25, 0.0, 0.0, 0.0]


@pytest.mark.parametrize("points", [[], POINTS[:2], [(0.0, 1.0), (1.0, 1.0), (1.0, 2.0)]])
def test_what_is_no_table_is_refused(points):
    with pytest.raises(MechanismError, match="at least 3 points at increasing places"):
        table_motion(points)
