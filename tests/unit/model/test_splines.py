"""Splines against scipy's, and what makes them splines."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.interpolate import CubicSpline, make_interp_spline

from mechanism_fmu.model import Curve, MechanismError, spline_profile
from mechanism_fmu.model.curves import spline_pieces
from tests.curve_values import jumps, value

WIDTH = st.floats(0.5, 1.5)
VALUE = st.floats(-2.0, 2.0)


def points(fewest):
    return st.lists(st.tuples(WIDTH, VALUE), min_size=fewest, max_size=9)


def spline(given_points, degree, periodic):
    """Knots, values and the curve; of a clamped spline the last width is not used."""
    widths, values = np.array(given_points).T
    if not periodic:
        widths = widths[:-1]
    knots = np.cumsum([0.25, *widths])
    pieces = spline_pieces(knots.tolist(), values.tolist(), degree, periodic)
    return knots, values, Curve(pieces, float(knots[0]), float(knots[-1] - knots[0]), periodic)


def scipy_spline(knots, values, degree, periodic):
    if periodic:
        values = [*values, values[0]]
    if degree == 3:
        return CubicSpline(knots, values, bc_type="periodic" if periodic else "clamped")
    resting = [(1, 0.0), (2, 0.0)]
    return make_interp_spline(knots, values, k=5, bc_type="periodic" if periodic else (resting, resting))


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("degree", [3, 5])
@given(data=st.data())
@settings(deadline=None, max_examples=50)
def test_values_and_derivatives_are_those_of_scipy(degree, periodic, data):
    knots, values, curve = spline(data.draw(points(6)), degree, periodic)
    theirs = scipy_spline(knots, values, degree, periodic)
    places = np.linspace(knots[0], knots[-1], 41)[:-1]
    for order, tolerance in enumerate((1e-12, 1e-11, 1e-10)):
        ours = [value(curve, x, order) for x in places]
        np.testing.assert_allclose(ours, theirs(places, order), rtol=0, atol=tolerance)


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("degree", [3, 5])
@given(data=st.data())
@settings(deadline=None, max_examples=50)
def test_it_goes_through_its_points_with_all_derivatives_but_the_last_continuous(degree, periodic, data):
    knots, values, curve = spline(data.draw(points(3)), degree, periodic)
    np.testing.assert_allclose([value(curve, x) for x in knots[: len(values)]], values, rtol=0, atol=1e-12)
    for order in range(degree):
        np.testing.assert_allclose(jumps(curve, order), 0.0, rtol=0, atol=1e-10 * 10**order)


@pytest.mark.parametrize(("degree", "resting"), [(3, [1]), (5, [1, 2])])
def test_a_clamped_one_rests_at_both_ends(degree, resting):
    curve = Curve(spline_pieces([0.0, 1.0, 1.5, 3.0], [1.0, -1.0, 2.0, 0.5], degree, periodic=False))
    for order in resting:
        assert value(curve, 0.0, order) == pytest.approx(0.0, abs=1e-12)
        assert value(curve, 3.0, order) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("degree", [3, 5])
def test_a_constant_stays_constant(degree):
    curve = spline_profile([0.25] * 5, [0.0, 0.5, 2.0, 3.0, 5.0], degree)
    for x in np.linspace(0, 7, 23):
        assert [value(curve, x, order) for order in range(4)] == pytest.approx([0.25, 0, 0, 0], abs=1e-13)


@pytest.mark.parametrize(
    ("arguments", "fragments"),
    [
        (([0.0, 1.0], [1.0, 2.0], 3, False), ["at least 3 points", "at 0, 1."]),
        (([0.0, 2.0, 1.0], [1.0, 2.0, 1.0], 3, False), ["increasing", "0, 2, 1."]),
        (([0.0, 1.0, math.nan], [1.0, 2.0, 1.0], 3, False), ["increasing", "nan"]),
        (([0.0, 1.0, 2.0], [1.0, 2.0], 3, True), ["at least 3 points", "0, 1, 2; the last one", "repeats"]),
        (([0.0, 1.0, 2.0, 3.0], [1.0, 2.0], 3, False), ["4 places for 2 values"]),
        (([0.0, 1.0, 2.0, 3.0], [1.0, 2.0], 3, True), ["3 places for 2 values"]),
        (([0.0, 1.0, 2.0], [1.0, 2.0, 3.0], 4, False), ["degree 4", "3 (C2) or 5 (C4)"]),
    ],
)
def test_what_is_no_spline_is_refused(arguments, fragments):
    with pytest.raises(MechanismError) as refusal:
        spline_pieces(*arguments)
    for fragment in fragments:
        assert fragment in str(refusal.value)
