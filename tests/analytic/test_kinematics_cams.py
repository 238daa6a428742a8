"""Lift of cam followers over a turn, its derivatives, and pressure angles, in closed form."""

import math

import numpy as np
import pytest

from mechanism_fmu.kinematics import cam_report
from mechanism_fmu.model import GROUND, Body, CamFollower, Mechanism, Revolute
from mechanism_fmu.model.curves.motions import Move, modified_sine, polynomial_345
from mechanism_fmu.model.curves.profiles import circle, motion_profile
from tests.slide_cam import EGG, SLIDE_CAM, cam_mechanism

STEPS = 72


def slide_cam(alpha):
    """Rho and its first two derivatives by the formula of the slides."""
    alpha = np.mod(alpha, 2 * math.pi)
    on = alpha < 2 * math.pi / 3
    c, s = np.cos(3 * alpha), np.sin(3 * alpha)
    return np.where(on, 1.25 - 0.25 * c, 1.0), np.where(on, 0.75 * s, 0.0), np.where(on, 2.25 * c, 0.0)


def egg(alpha):
    c1, s1, c2, s2 = np.cos(alpha), np.sin(alpha), np.cos(2 * alpha), np.sin(2 * alpha)
    return (
        1 + 0.1 * c1 + 0.05 * c2 + 0.02 * s1,
        -0.1 * s1 - 0.1 * s2 + 0.02 * c1,
        -0.1 * c1 - 0.2 * c2 - 0.02 * s1,
    )


def course(report):
    """Height of the follower and its two derivatives by the cam's angle."""
    return np.array(report.motion.of("follower.y"))


def test_lifts_of_the_slides():
    report = cam_report(cam_mechanism("roller"), "pair", "cam", 12)
    height = course(report)[0]
    assert height[0] == pytest.approx(1.532285823696, abs=1e-12)
    assert height[1] == pytest.approx(1.75, abs=1e-12)
    assert height[-1] == pytest.approx(height[0], abs=1e-12)


@pytest.mark.parametrize(("profile", "values"), [(SLIDE_CAM, slide_cam), (EGG, egg)], ids=["slides", "egg"])
def test_lift_over_a_roller(profile, values):
    """The roller's centre is on the parallel curve: rho e + r n. From its angle on the cam follows the cam's angle.

    With the polar coordinates (P, beta) of the centre, y(phi) = P where beta = pi/2 - phi.
    """
    report = cam_report(cam_mechanism("roller", profile), "pair", "cam", STEPS)
    alpha = report.motion.of("pair.alpha_i")[0]
    rho, rate, bend = values(alpha)
    long = np.hypot(rho, rate)
    centre = (rho + 0.25 * (rho - 1j * rate) / long) * np.exp(1j * alpha)
    g = (rate + 1j * rho) * np.exp(1j * alpha)
    kappa = (rho**2 + 2 * rate**2 - rho * bend) / long**3
    y, first, second = course(report)
    np.testing.assert_allclose(centre * np.exp(1j * report.cam_angle), 1j * y, rtol=0, atol=1e-10)
    # Along the parallel curve: dc = g (1 + r kappa) dalpha; in polar coordinates dc/c = dP/P + i dbeta.
    ratio = g * (1 + 0.25 * kappa) / centre
    np.testing.assert_allclose(first, -y * ratio.real / ratio.imag, rtol=0, atol=1e-10)
    # Radius of the curve in polar form, with ' by beta: K = (P^2 + 2 P'^2 - P P'') / (P^2 + P'^2)^1.5.
    parallel = kappa / (1 + 0.25 * kappa)
    expected = (y**2 + 2 * first**2 - parallel * (y**2 + first**2) ** 1.5) / y
    at_join = np.abs(np.mod(alpha + 0.1, 2 * math.pi / 3) - 0.1) < 1e-6  # there rho'' of the slides' cam has two values
    chosen = ~at_join if profile is SLIDE_CAM else slice(None)
    np.testing.assert_allclose(second[chosen], expected[chosen], rtol=0, atol=1e-10)
    np.testing.assert_allclose(report.relative_curvature[chosen], (kappa + 4)[chosen], rtol=1e-10)
    np.testing.assert_allclose(report.pressure_angle, np.arctan(np.abs(first) / y), rtol=0, atol=1e-8)


@pytest.mark.parametrize(("kind", "roller"), [("flat", 0.0), ("roller", 0.25)])
def test_lift_of_an_eccentric_circle(kind, roller):
    """Flat face: R + e sin(phi). Roller: e sin(phi) + sqrt((R + r)^2 - e^2 cos(phi)^2)."""
    big, e = 1.0, 0.3
    mechanism = cam_mechanism(kind, circle(big), angle=0.2, height=1.4, centre=(e, 0.0))
    report = cam_report(mechanism, "pair", "cam", STEPS)
    phi = report.cam_angle
    s, c = e * np.sin(phi), e * np.cos(phi)
    if kind == "flat":
        expected = np.array([big + s, c, -s])
        pressure = np.zeros_like(phi)
    else:
        w = np.sqrt((big + roller) ** 2 - c**2)
        w1 = c * s / w
        w2 = (c**2 - s**2 - w1**2) / w
        expected = np.array([s + w, c + w1, -s + w2])
        pressure = np.arcsin(np.abs(c) / (big + roller))
    np.testing.assert_allclose(course(report), expected, rtol=0, atol=1e-10)
    np.testing.assert_allclose(np.sin(report.pressure_angle), np.sin(pressure), rtol=0, atol=2e-8)
    steep = pressure > 0.01
    np.testing.assert_allclose(report.pressure_angle[steep], pressure[steep], rtol=0, atol=1e-9)
    np.testing.assert_allclose(report.relative_curvature, 1 / big + (0 if kind == "flat" else 4), rtol=1e-12)


@pytest.mark.parametrize("x", [0.0, 0.1], ids=["radial", "offset"])
def test_knife_edge_on_an_eccentric_circle(x):
    """The distance of the edge from the circle's centre is R: the pressure angle is that of this line to the guide."""
    big, e = 1.0, 0.3
    mechanism = cam_mechanism("point", circle(big), height=1.0, x=x, centre=(e, 0.0))
    report = cam_report(mechanism, "pair", "cam", STEPS)
    phi = report.cam_angle
    across = x - e * np.cos(phi)
    np.testing.assert_allclose(course(report)[0], e * np.sin(phi) + np.sqrt(big**2 - across**2), rtol=0, atol=1e-10)
    steep = np.abs(across) > 0.01
    expected = np.arcsin(np.abs(across) / big)
    np.testing.assert_allclose(report.pressure_angle[steep], expected[steep], rtol=0, atol=1e-9)
    assert report.pressure_angle.max() == pytest.approx(math.asin((e + x) / big), abs=1e-9)
    assert np.all(np.isinf(report.relative_curvature))


def test_pressure_angle_of_a_swinging_roller():
    """At the roller's centre: between the line of both centres and the way of the arm's end, at right angles to it."""
    big, e, roller, arm = 1.0, 0.3, 0.25, 1.5
    pivot = (-1.5, 1.4)
    mechanism = Mechanism(
        bodies=(Body("cam", 1.0, 1.0), Body("arm", 1.0, 1.0, (-1.5, 1.4, 0.0))),
        joints=(
            Revolute("hinge", "cam", (0.0, 0.0), GROUND, (0.0, 0.0)),
            Revolute("pivot", "arm", (0.0, 0.0), GROUND, pivot),
        ),
        contacts=(CamFollower("pair", "cam", circle(big), "arm", circle(roller), (e, 0.0), (arm, 0.0)),),
    )
    report = cam_report(mechanism, "pair", "cam", STEPS)
    psi = report.motion.of("arm.angle")[0]
    line = complex(*pivot) + arm * np.exp(1j * psi) - e * np.exp(1j * report.cam_angle)
    np.testing.assert_allclose(np.abs(line), big + roller, rtol=0, atol=1e-10)
    expected = np.arccos(np.abs((line / np.abs(line) * np.conj(1j * np.exp(1j * psi))).real))
    np.testing.assert_allclose(report.pressure_angle, expected, rtol=0, atol=1e-8)


def test_a_point_follower_is_lifted_as_the_motion_program_says():
    """Exactly base + lift, with its derivatives; the cam turns from under it, so that alpha = pi/2 - phi."""
    base, lift, width = 1.0, 0.3, 2.0
    program = motion_profile(base, [Move(lift, width, polynomial_345), Move(lift, 1.0)], modified_sine)
    report = cam_report(cam_mechanism("point", program, angle=math.pi / 2, height=1.0), "pair", "cam", STEPS)
    alpha = np.mod(math.pi / 2 - report.cam_angle + 1e-12, 2 * math.pi)
    u = alpha / width
    rising, dwelling = u < 1, (u >= 1) & (alpha < 3.0)
    up = lift * np.array(
        [
            10 * u**3 - 15 * u**4 + 6 * u**5,
            (30 * u**2 - 60 * u**3 + 30 * u**4) / width,
            (60 * u - 180 * u**2 + 120 * u**3) / width**2,
        ]
    )
    sign = np.array([[1], [-1], [1]])
    found = course(report) - base * np.array([[1], [0], [0]])
    np.testing.assert_allclose(found[:, rising], (sign * up)[:, rising], rtol=0, atol=1e-10)
    np.testing.assert_allclose(found[:, dwelling], np.array([[lift], [0], [0]]) + 0 * found[:, dwelling], atol=1e-10)
    falling = alpha > 3.0
    v = (alpha[falling] - 3.0) / (2 * math.pi - 3.0)
    k = lift / (4 + math.pi)
    outer = np.where(v <= 1 / 8, 0.0, 4.0) + math.pi * v - np.sin(4 * math.pi * v) / 4
    middle = 2 + math.pi * v - 9 / 4 * np.sin(4 * math.pi * v / 3 + math.pi / 3)
    down = k * np.where((v < 1 / 8) | (v > 7 / 8), outer, middle)
    np.testing.assert_allclose(found[0, falling], lift - down, rtol=0, atol=1e-10)
    assert rising.any()
    assert dwelling.any()
