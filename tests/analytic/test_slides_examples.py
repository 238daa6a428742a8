"""The worked examples of the ME451 slides: example 3.4.1, and the tangents of cam and roller."""

import cmath
import math

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.special import ellipk

from mechanism_fmu.slides import (
    cam_tangent,
    carried_gear,
    falling_gear,
    rolled_angle,
    roller_tangent,
    tangents_of_the_rows,
)

ANGLES = st.floats(-7.0, 7.0)


@pytest.mark.parametrize(("to", "expected"), [(-90, -math.pi), (90, math.pi / 2)])
def test_gear_2_turns_as_the_slides_say_when_its_carrier_is_driven(to, expected):
    carrier, gear = carried_gear(math.radians(to))
    assert (carrier[0], gear[0]) == pytest.approx((math.pi / 6, 0.0), abs=1e-14)
    assert gear[-1] == pytest.approx(expected, abs=1e-13)
    # rolling without slip: the arcs from the marks to the point of contact are equal
    np.testing.assert_allclose(1.0 * (carrier - math.pi / 6), 2.0 * (gear - (carrier - math.pi / 6)), atol=1e-13)
    np.testing.assert_allclose(gear, [rolled_angle(angle) for angle in carrier], rtol=0, atol=1e-13)


def test_gear_2_falls_like_the_pendulum_that_it_is():
    fall = falling_gear()
    inertia, moment = 1.0 * 3.0**2 + 0.5 * 1.0 * 2.0**2 * 1.5**2, 3.0 * 9.81
    assert fall.bottom_gear == pytest.approx(-math.pi, abs=1e-9)
    assert fall.bottom_time == pytest.approx(ellipk(math.sin(math.pi / 3) ** 2) * math.sqrt(inertia / moment), abs=1e-8)
    assert fall.bottom_speed == pytest.approx(-math.sqrt(2 * moment * 1.5 / inertia), rel=1e-7)
    np.testing.assert_allclose(fall.gear, [rolled_angle(angle) for angle in fall.carrier], rtol=0, atol=1e-9)
    assert math.degrees(fall.carrier.min()) == pytest.approx(-210.0, abs=0.01)


def test_a_fall_that_is_watched_too_briefly_is_refused():
    with pytest.raises(ValueError, match=r"not at the bottom by 0\.1 s"):
        falling_gear([0.0, 0.1])


@given(ANGLES, ANGLES, ANGLES, ANGLES)
def test_the_written_out_tangents_are_those_of_the_rows(alpha_1, alpha_2, phi_1, phi_2):
    first, second = tangents_of_the_rows(alpha_1, alpha_2, phi_1, phi_2)
    np.testing.assert_allclose(cam_tangent(alpha_1, phi_1), first, rtol=0, atol=3e-15)
    np.testing.assert_allclose(roller_tangent(alpha_2, phi_2), second, rtol=0, atol=1e-15)


@pytest.mark.parametrize("alpha", [0.3, 1.0, 1.7, 2.0, 3.0, 5.5])
def test_the_written_out_tangents_are_derivatives_of_the_points(alpha):
    """By a complex step through rho e: exact to rounding."""
    a = alpha + 1e-30j
    rho = 5 / 4 - cmath.cos(3 * a) / 4 if alpha < 2 * math.pi / 3 else 1.0
    for radius, tangent in ((rho, cam_tangent(alpha)), (0.25, roller_tangent(alpha))):
        point = radius * cmath.cos(a), radius * cmath.sin(a)
        np.testing.assert_allclose(tangent, [x.imag / 1e-30 for x in point], rtol=0, atol=4e-15)
