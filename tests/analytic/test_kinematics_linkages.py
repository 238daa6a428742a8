"""Kinematic analysis of linkages against their closed form."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st

from benchmarks.four_bar import FourBar
from benchmarks.slider_crank import SliderCrank
from mechanism_fmu.kinematics import analyse
from mechanism_fmu.kinematics.equations import Equations
from mechanism_fmu.model import GROUND, AngleDriver, Body, Distance, Gears, Mechanism, PointLineContact, Revolute
from mechanism_fmu.model.curves.motions import harmonic_motion, polynomial_motion, table_motion
from models.four_bar.model import MODEL as FOUR_BAR
from models.slider_crank.model import MODEL as SLIDER_CRANK

TURN = np.linspace(0.0, 1.0, 37)
#: Coefficients of the angle of the crank over time: a little more than a turn in 1 s, at growing speed.
CRANK = (0.3, 5.0, 1.4)


def driven(model, motion, **values):
    mechanism = model.build(model.values(**values))
    drive = AngleDriver("drive_angle", "crank", motion)
    return replace(
        mechanism, joints=(*mechanism.joints, drive), forces=(), inputs=(), outputs=(), calculated=(), held=()
    )


def assert_links_move_so(motion, names, links_at, courses):
    """`courses`: angle, speed and acceleration of the crank over time; links by `benchmarks.eksergian`."""
    for k in range(len(motion.time)):
        theta, speed, acceleration = (course[k] for course in courses)
        for name, link in zip(names, links_at(theta), strict=True):
            x, y, angle = (np.array([q[k] for q in motion.of(f"{name}.{c}")]) for c in ("x", "y", "angle"))
            point, along, bend = link.centre
            rates = (along * speed, along * acceleration + bend * speed**2)
            np.testing.assert_allclose(x, [c.real for c in (point, *rates)], rtol=1e-10, atol=1e-10)
            np.testing.assert_allclose(y, [c.imag for c in (point, *rates)], rtol=1e-10, atol=1e-10)
            turn = link.angle
            assert math.remainder(angle[0] - turn.value, 2 * math.pi) == pytest.approx(0.0, abs=1e-10)
            expected = [turn.rate * speed, turn.rate * acceleration + turn.curvature * speed**2]
            np.testing.assert_allclose(angle[1:], expected, rtol=1e-10, atol=1e-10)


def crank_course(times):
    a, b, c = CRANK
    return a + b * times + c * times**2, b + 2 * c * times, np.full_like(times, 2 * c)


@pytest.mark.parametrize("crossed", [False, True], ids=["open", "crossed"])
def test_four_bar(crossed):
    motion = analyse(driven(FOUR_BAR, polynomial_motion(*CRANK), crossed=crossed, crank_angle_start=0.2), TURN)
    links = FourBar(crossed=crossed).links
    assert_links_move_so(motion, ("crank", "coupler", "rocker"), links, crank_course(TURN))


@pytest.mark.parametrize("offset", [0.0, 0.03])
def test_slider_crank(offset):
    motion = analyse(driven(SLIDER_CRANK, polynomial_motion(*CRANK), offset=offset), TURN)
    assert_links_move_so(motion, ("crank", "rod", "slider"), SliderCrank(offset=offset).links, crank_course(TURN))


def test_a_motion_by_points_leads_the_linkage_through_them():
    """Angles at 5 times; between them, the spline's own derivatives drive the linkage."""
    points = [(0.0, 0.3), (0.2, 0.9), (0.5, 2.5), (0.8, 2.1), (1.0, 4.0)]
    motion = analyse(driven(FOUR_BAR, table_motion(points), crank_angle_start=0.3), np.linspace(0.0, 1.2, 49))
    angle, speed, acceleration = motion.of("crank.angle")
    for time, value in points:
        assert angle[round(time * 40)] == pytest.approx(value, abs=1e-12)
    np.testing.assert_allclose([angle[40:] - 4.0, speed[40:]], 0.0, atol=1e-12)
    assert_links_move_so(motion, ("crank", "coupler", "rocker"), FourBar().links, (angle, speed, acceleration))


@pytest.mark.parametrize(("start", "end"), [(-math.pi, -90.0), (0.0, 30.0)])
def test_gear_of_the_slides(start, end):
    """Example 3.4.1: gear 2 is turned, and the carrier's angle is pi/6 + 2/3 phi_2."""
    carrier = math.pi / 6 + 2 / 3 * start
    mechanism = Mechanism(
        bodies=(Body("gear", 1.0, 2.0, (3.0 * math.cos(carrier), 3.0 * math.sin(carrier), start)),),
        joints=(
            Distance("carrier", GROUND, (0.0, 0.0), "gear", (0.0, 0.0), 3.0),
            Gears("mesh", GROUND, 1.0, math.pi / 6, "gear", 2.0, 7 * math.pi / 6),
            AngleDriver("drive", "gear", polynomial_motion(start, -1.5, 0.3)),
        ),
    )
    motion = analyse(mechanism, np.linspace(0.0, 2.0, 11))
    assert math.degrees(carrier) == pytest.approx(end)
    phi, speed, acceleration = motion.of("gear.angle")
    e = 3 * np.exp(1j * (math.pi / 6 + 2 / 3 * phi))
    turn, gain = 2 / 3 * speed, 2 / 3 * acceleration
    for k, expected in enumerate((e, 1j * turn * e, (1j * gain - turn**2) * e)):
        found = motion.of("gear.x")[k] + 1j * motion.of("gear.y")[k]
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-10)


def test_pin_in_a_straight_slot():
    """A crank's pin turns a wheel whose slot passes its centre, as in a Geneva drive."""
    a, d = 1.0, math.sqrt(2.0)
    mechanism = Mechanism(
        bodies=(Body("crank", 1.0, 1.0, (0.0, 0.0, 0.2)), Body("wheel", 1.0, 1.0, (d, 0.0, -0.4))),
        joints=(
            Revolute("crank_hinge", "crank", (0.0, 0.0), GROUND, (0.0, 0.0)),
            Revolute("wheel_hinge", "wheel", (0.0, 0.0), GROUND, (d, 0.0)),
            AngleDriver("drive", "crank", harmonic_motion(0.1, 0.6, 2.0)),
        ),
        contacts=(
            PointLineContact("slot", "crank", (a, 0.0), "wheel", (0.0, 0.0), (0.0, 1.0), closed=True, guided=True),
        ),
    )
    motion = analyse(mechanism, np.linspace(0.0, 3.0, 31))
    theta, speed, acceleration = motion.of("crank.angle")
    z = d - a * np.exp(-1j * theta)  # from the pin to the wheel's hinge, mirrored
    rate = 1j * a * np.exp(-1j * theta)
    psi1 = -(rate / z).imag
    psi2 = -((a * np.exp(-1j * theta)) / z - (rate / z) ** 2).imag
    found = motion.of("wheel.angle")
    np.testing.assert_allclose(found[0], -np.angle(z), rtol=0, atol=1e-10)
    np.testing.assert_allclose(found[1], psi1 * speed, rtol=0, atol=1e-10)
    np.testing.assert_allclose(found[2], psi1 * acceleration + psi2 * speed**2, rtol=0, atol=1e-9)


lengths = st.floats(0.1, 0.4)


@settings(max_examples=25, deadline=None)
@given(lengths, lengths, lengths, lengths, st.floats(-3.0, 3.0), st.booleans())
def test_rates_are_derivatives_and_agree_with_the_rows(d, a, b, c, theta, crossed):
    """Of any four-bar away from its limits: central differences; and Phi_q qd = nu, Phi_q qdd = gamma."""
    reach = abs(d - a * np.exp(1j * theta))
    assume(abs(b - c) + 0.03 < reach < b + c - 0.03)
    values = {"ground_length": d, "crank_length": a, "coupler_length": b, "rocker_length": c, "crossed": crossed}
    mechanism = driven(FOUR_BAR, polynomial_motion(theta, 1.0, 0.5), crank_angle_start=theta, **values)
    h = 1e-4
    motion = analyse(mechanism, [-h, 0.0, h])
    q, qd, qdd = (getattr(motion, name) for name in ("position", "velocity", "acceleration"))
    scale = 1.0 + np.abs(qdd).max() ** 2
    np.testing.assert_allclose((q[2] - q[0]) / (2 * h), qd[1], rtol=0, atol=1e-5 * scale)
    np.testing.assert_allclose((qd[2] - qd[0]) / (2 * h), qdd[1], rtol=0, atol=1e-3 * scale)
    rows = Equations(mechanism, 0.0).at(q[1], 0.0, qd[1])
    size = np.abs(rows.jacobian).max() * np.abs(qdd[1]).max()
    np.testing.assert_allclose(rows.residual, 0.0, atol=1e-13)
    np.testing.assert_allclose(rows.jacobian @ qd[1], rows.nu, rtol=0, atol=1e-12 * (1 + np.abs(qd).max()))
    np.testing.assert_allclose(rows.jacobian @ qdd[1], rows.gamma, rtol=0, atol=1e-12 * (1 + size))
