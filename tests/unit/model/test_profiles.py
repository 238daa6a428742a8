"""Profiles of cams and slots: the slides' cam and the simple ones."""

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.optimize import brentq

from mechanism_fmu.model import (
    MechanismError,
    circle,
    constant,
    cosine,
    harmonic_profile,
    piecewise_profile,
    slot,
    spline_profile,
)
from tests.curve_values import jumps, value

TURN = 2 * math.pi
THIRD = TURN / 3
#: ME451: rho = -1/4 cos 3 alpha + 5/4 on [0, 2 pi/3), 1 elsewhere.
SLIDES = piecewise_profile((0.0, [constant(1.25), cosine(-0.25, 3.0)]), (THIRD, [constant(1.0)]))


def curvature(curve, alpha):
    """Of a curve in polar coordinates, positive where it is convex."""
    rho, first, second = (value(curve, alpha, order) for order in range(3))
    return (rho**2 + 2 * first**2 - rho * second) / (rho**2 + first**2) ** 1.5


@given(st.floats(-10.0, 10.0))
def test_the_cam_of_the_slides(alpha):
    within = alpha % TURN
    expected = -0.25 * math.cos(3 * within) + 1.25 if within < THIRD else 1.0
    assert value(SLIDES, alpha) == pytest.approx(expected, abs=1e-14)


def test_the_cam_of_the_slides_is_smooth_but_for_its_curvature():
    assert jumps(SLIDES, 0) == pytest.approx([0, 0], abs=1e-15)
    assert jumps(SLIDES, 1) == pytest.approx([0, 0], abs=1e-14)
    assert jumps(SLIDES, 2) == pytest.approx([-9 / 4, 9 / 4], abs=1e-13)


def test_the_cam_of_the_slides_is_hollow_at_its_joins():
    beyond = 1e-9
    assert curvature(SLIDES, beyond) == pytest.approx(-1.25, abs=1e-6)
    assert curvature(SLIDES, THIRD - beyond) == pytest.approx(-1.25, abs=1e-6)
    assert curvature(SLIDES, THIRD / 2) == pytest.approx(5 / 3, rel=1e-12)
    assert curvature(SLIDES, 4.0) == 1.0
    hollow = math.radians(14.96)
    assert brentq(lambda alpha: curvature(SLIDES, alpha), 0.01, 1.0) == pytest.approx(hollow, abs=1e-4)
    assert brentq(lambda alpha: curvature(SLIDES, alpha), 1.1, THIRD - 0.01) == pytest.approx(THIRD - hollow, abs=1e-4)


def test_a_roller_is_round():
    assert [value(circle(0.25), 40.0, order) for order in range(4)] == [0.25, 0, 0, 0]
    assert curvature(circle(0.25), 1.0) == pytest.approx(4.0)


@given(st.floats(-10.0, 10.0))
def test_a_harmonic_profile_sums_its_terms(alpha):
    curve = harmonic_profile(1.0, [0.1, 0.0, 0.02], [0.0, -0.05])
    expected = 1 + 0.1 * math.cos(alpha) + 0.02 * math.cos(3 * alpha) - 0.05 * math.sin(2 * alpha)
    assert value(curve, alpha) == pytest.approx(expected, abs=1e-13)
    slope = -0.1 * math.sin(alpha) - 0.06 * math.sin(3 * alpha) - 0.1 * math.cos(2 * alpha)
    assert value(curve, alpha, 1) == pytest.approx(slope, abs=1e-13)


@pytest.mark.parametrize("degree", [3, 5])
def test_a_spline_profile_goes_through_its_points_turn_after_turn(degree):
    angles = [0.3, 1.0, 2.5, 4.0]
    radii = [1.0, 1.2, 0.9, 1.1]
    curve = spline_profile(radii, angles, degree)
    for turn in (-2, 0, 3):
        found = [value(curve, angle + turn * TURN) for angle in angles]
        assert found == pytest.approx(radii, abs=1e-12)


def test_the_points_of_a_spline_profile_are_equidistant_unless_it_is_said():
    radii = [1.0, 1.2, 0.9, 1.1, 1.0]
    curve = spline_profile(radii)
    assert [value(curve, TURN * k / 5) for k in range(5)] == pytest.approx(radii, abs=1e-14)


@pytest.mark.parametrize("degree", [3, 5])
def test_a_slot_is_open(degree):
    points = [(-0.5, 1.0), (0.0, 1.1), (0.25, 1.0), (0.5, 1.2)]
    curve = slot(points, degree)
    assert not curve.periodic
    assert (curve.start, curve.span) == (-0.5, 1.0)
    np.testing.assert_allclose([value(curve, a) for a, _ in points], [rho for _, rho in points], rtol=1e-13)
    assert [value(curve, a, 1) for a in (-0.5, 0.5)] == pytest.approx([0, 0], abs=1e-13)


@pytest.mark.parametrize(
    ("make", "fragment"),
    [
        (lambda: spline_profile([]), "at least 3 points"),
        (lambda: spline_profile([1.0, 1.1]), "at least 3 points"),
        (lambda: spline_profile([1.0, 1.1, 1.2], [0.0, 1.0]), "2 places for 3 values"),
        (lambda: spline_profile([1.0, 1.1, 1.2], [0.0, 2.0, 7.0]), "0, 2, 7, 6.28319"),
        (lambda: slot([]), "at least 3 points"),
        (lambda: slot([(0.0, 1.0), (0.0, 1.1), (1.0, 1.0)]), "increasing places"),
    ],
)
def test_what_is_no_profile_is_refused(make, fragment):
    with pytest.raises(MechanismError, match=fragment):
        make()
