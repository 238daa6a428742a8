"""A whole turn at constant speed: positions, rates and accelerations against closed forms; maxima between samples."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st

from benchmarks.four_bar import FourBar
from mechanism_fmu.elastodynamics import LinkageError, crank_of, elastic_ports, peak, turn
from mechanism_fmu.elastodynamics.turn import closed_at
from mechanism_fmu.model import AngleDriver, Distance, Revolute, XDriver, polynomial_motion
from models.four_bar.model import MODEL as RIGID
from models.four_bar_path_generator.model import MODEL
from models.slider_crank.model import MODEL as SLIDER_CRANK

SPEED = 7.0


def path_generator(**values):
    return MODEL.build(MODEL.values(**values))


@pytest.mark.parametrize("crossed", [False, True])
@pytest.mark.parametrize("start", [0.0, 0.5, math.radians(30), 4.0])
def test_a_turn_of_a_four_bar_is_that_of_the_closed_form(start, crossed):
    pose = turn(path_generator(crank_angle_start=start, crossed=crossed), SPEED, 360).pose
    crank, coupler, rocker = (pose.bodies.index(name) for name in ("crank", "coupler", "rocker"))
    angles = np.degrees(pose.position[:, crank, 2])
    np.testing.assert_allclose(angles, math.ceil(math.degrees(start) - 1e-6) + np.arange(361), rtol=0, atol=1e-9)
    known = FourBar(0.254, 0.1016, 0.254, 0.2032, crossed)
    for k in (0, 100, 360):
        for body, course in zip((coupler, rocker), known.angles(float(pose.position[k, crank, 2])), strict=True):
            off = pose.position[k, body, 2] - course.value
            assert off == pytest.approx(2 * math.pi * round(off / (2 * math.pi)), abs=1e-12)
            assert pose.velocity[k, body, 2] == pytest.approx(course.rate * SPEED, abs=1e-11)
            assert pose.acceleration[k, body, 2] == pytest.approx(course.curvature * SPEED**2, abs=1e-9)


def test_sliders_close_too():
    """x = a cos + sqrt(b^2 - (a sin - e)^2)."""
    a, b, e = 0.05, 0.2, 0.02
    mechanism = SLIDER_CRANK.build(SLIDER_CRANK.values(crank_length=a, rod_length=b, offset=e))
    joints = (*mechanism.joints, AngleDriver("drive", "crank", polynomial_motion(0.0, 1.0)))
    angles = np.radians(np.arange(0.0, 361.0, 15.0))
    q, rate = closed_at(replace(mechanism, joints=joints, held=()), angles)
    root = np.sqrt(b**2 - (a * np.sin(angles) - e) ** 2)
    np.testing.assert_allclose(q[:, 6], a * np.cos(angles) + root, rtol=0, atol=1e-13)
    expected = -a * np.sin(angles) - (a * np.sin(angles) - e) * a * np.cos(angles) / root
    np.testing.assert_allclose(rate[:, 6], expected, rtol=0, atol=1e-12)


def test_a_crank_that_cannot_turn_is_refused_with_the_angle():
    with pytest.raises(LinkageError, match=r"The crank cannot turn fully: near \d"):
        turn(path_generator(coupler_length=0.15), SPEED, 360)


def test_joints_that_repeat_each_other_are_refused():
    mechanism = path_generator()
    again = Revolute("again", "crank", mechanism.joints[0].point_i, "ground", (0.0, 0.0))
    with pytest.raises(LinkageError, match=r"6 joints, .* give 11 rows, but 3 bodies have 9"):
        turn(replace(mechanism, joints=(*mechanism.joints, again)), SPEED, 360)


def test_the_crank_is_what_is_driven_or_held():
    mechanism = path_generator()
    assert crank_of(mechanism) == "crank"
    driver = AngleDriver("drive", "rocker", polynomial_motion(0.0, 1.0))
    assert crank_of(replace(mechanism, joints=(*mechanism.joints, driver))) == "rocker"
    with pytest.raises(LinkageError, match="what its drivers and held coordinates move is: nothing"):
        crank_of(replace(mechanism, held=()))
    pushed = XDriver("push", "rocker", (0.0, 0.0), polynomial_motion(0.0, 1.0))
    with pytest.raises(LinkageError, match="move is: push"):
        crank_of(replace(mechanism, joints=(*mechanism.joints, pushed)))


def test_ports_of_crank_and_members():
    ports = elastic_ports(path_generator())
    assert (ports.torque, ports.shaft_speed, ports.shaft_angle) == ("drive_torque", "drive_speed", "drive_angle")
    assert ports.places == ("arm.end",)
    assert ports.outputs["arm.end.x_bent"] == "path_x_elastic"
    assert ports.outputs["crank_bar.stress"] == "crank_bar_stress"
    rigid = elastic_ports(RIGID.build(RIGID.values()))
    assert (rigid.torque, rigid.outputs) == ("drive_torque", {})


@given(st.floats(0.0, 2 * math.pi), st.floats(0.1, 3.0), st.integers(8, 40))
def test_a_peak_between_samples_is_found(phase, size, count):
    angles = 2 * math.pi / count * np.arange(count)
    samples = np.column_stack([3 + size * np.cos(angles - phase), np.zeros(count)])
    place, largest = peak(samples)
    assert largest == pytest.approx(3 + size, rel=1e-10)
    assert math.remainder(2 * math.pi * place - phase, 2 * math.pi) == pytest.approx(0.0, abs=2e-5)


def test_rods_close_at_their_length():
    """The coupler's bar as a massless rod between two bodies: crank and rocker turn as with the coupler."""
    whole = path_generator()
    joints = whole.joints
    rod = Distance("rod", "crank", joints[1].point_j, "rocker", joints[2].point_i, 0.254)
    bodies = tuple(body for body in whole.bodies if body.name != "coupler")
    driver = AngleDriver("drive", "crank", polynomial_motion(0.0, 1.0))
    mechanism = replace(
        whole, bodies=bodies, joints=(joints[0], joints[3], rod, driver), members=(), lumped_masses=(), outputs=()
    )
    angles = np.radians(np.arange(30.0, 391.0, 20.0))
    q, rate = closed_at(replace(mechanism, held=()), angles)
    known = [FourBar(0.254, 0.1016, 0.254, 0.2032).angles(angle)[1] for angle in angles]
    np.testing.assert_allclose(np.cos(q[:, 5]), [math.cos(course.value) for course in known], rtol=0, atol=1e-12)
    np.testing.assert_allclose(rate[:, 5], [course.rate for course in known], rtol=0, atol=1e-12)
