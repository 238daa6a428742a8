"""What kinematic analysis refuses, and why; what it goes through."""

import math
from dataclasses import replace

import numpy as np
import pytest

from mechanism_fmu.kinematics import KinematicsError, SingularConfigurationError, analyse
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    Mechanism,
    MechanismError,
    Revolute,
    Term,
    XDriver,
    rigid_body,
)
from mechanism_fmu.model.curves.motions import harmonic_motion, polynomial_motion
from mechanism_fmu.model.curves.profiles import piecewise_profile
from models.four_bar.model import MODEL
from tests.parallel_cranks import parallel_cranks, turning
from tests.slide_cam import cam_mechanism

FLAT = math.pi - 0.4  # when cranks that start at 0.4 rad with 1 rad/s lie flat


def driven(mechanism, *drivers):
    return replace(mechanism, joints=(*mechanism.joints, *drivers))


def cranks(count, *, angle=0.4, hinges=None):
    return driven(parallel_cranks(count, angle, hinges), turning("drive", "crank0", angle, 1.0))


def four_bar(body, *coefficients):
    plain = replace(MODEL.build(MODEL.values()), forces=(), inputs=(), outputs=(), calculated=())
    return driven(plain, turning("drive", body, *coefficients))


@pytest.mark.parametrize("count", [2, 3])
@pytest.mark.parametrize(
    "times",
    [np.linspace(0, 4, 41), [0.0, 2.7, 2.8], [0.0, 3.0], [0.0, FLAT], [0.0, FLAT, 4.0], [0.0, 1.0, 6.0]],
    ids=["small steps", "past it", "at one step", "exactly", "exactly and on", "far past it"],
)
def test_equal_cranks_cannot_pass_the_flat_position(count, times):
    with pytest.raises(SingularConfigurationError, match=r"At t = 2\.741.*singular.*branch"):
        analyse(cranks(count), times)


@pytest.mark.parametrize("count", [2, 3])
def test_equal_cranks_cannot_start_in_the_flat_position(count):
    with pytest.raises(SingularConfigurationError, match=r"At t = 0 s the configuration is singular"):
        analyse(cranks(count, angle=0.0), [0.0, 1.0])


@pytest.mark.parametrize("times", [np.linspace(0.0, 7.0, 31), [0.0, FLAT, 7.0]])
def test_a_third_crank_out_of_line_leads_through_the_flat_position(times):
    """There are 13 rows then, and one of them depends on others all the time, but not always the same one."""
    motion = analyse(cranks(3, hinges=[(0.0, 0.0), (1.0, 0.0), (2.0, 0.5)]), times)
    for k in range(3):
        angle, speed, acceleration = motion.of(f"crank{k}.angle")
        np.testing.assert_allclose(angle, 0.4 + motion.time, rtol=0, atol=1e-10)
        np.testing.assert_allclose(speed, 1.0, rtol=0, atol=1e-9)
        np.testing.assert_allclose(acceleration, 0.0, rtol=0, atol=1e-8)


def test_before_the_flat_position_redundant_rows_do_no_harm():
    motion = analyse(cranks(3), np.linspace(0.0, 2.5, 6))
    np.testing.assert_allclose(motion.of("crank2.angle")[0], 0.4 + motion.time, rtol=0, atol=1e-12)


@pytest.mark.parametrize("count", [2, 3])
@pytest.mark.parametrize("angle", [0.4, 0.0], ids=["upright", "flat"])
def test_a_missing_driver_is_asked_for(count, angle):
    with pytest.raises(KinematicsError, match=r"1 degree of freedom is not driven: crank0\..* can move\. Add 1 driver"):
        analyse(parallel_cranks(count, angle), [0.0, 1.0])


def test_two_missing_drivers_are_asked_for():
    arm = Mechanism(bodies=(Body("arm", 1.0, 1.0),))
    with pytest.raises(KinematicsError, match=r"2 degrees of freedom are not driven: arm\.y, arm\.angle can move"):
        analyse(driven(arm, XDriver("drive", "arm", (0.0, 0.0), polynomial_motion(1.0))), [0.0])


def test_a_redundant_driver_does_no_harm():
    motion = analyse(driven(cranks(2), turning("second", "crank1", 0.4, 1.0)), [0.0, 1.0])
    np.testing.assert_allclose(motion.of("crank1.angle")[0], [0.4, 1.4], rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("coefficients", "what"),
    [
        ((0.5, 1.0), "cannot be assembled at t = 0 s"),
        ((0.4, 1.1), "At t = 0 s no velocity agrees with all rows"),
        ((0.4, 1.0, 0.1), "At t = 0 s no acceleration agrees with all rows"),
        ((0.4, 1.0, 0.0, 0.1), r"no acceleration agrees with all rows"),
    ],
)
def test_drivers_that_contradict_each_other_are_named(coefficients, what):
    with pytest.raises(KinematicsError, match=what) as refusal:
        analyse(driven(cranks(2), turning("second", "crank0", *coefficients)), [0.0, 1.0])
    for fragment in ("drive", "second", "contradict"):
        assert fragment in str(refusal.value)


@pytest.mark.parametrize("times", [np.linspace(0.0, 6.0, 61), [0.0, 6.0], [0.0, 2 * math.pi]])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_rocker_is_not_driven_beyond_its_reach(sense, times):
    """Its last position is where crank and coupler stand in line."""
    linkage = four_bar("rocker", 0.0)
    start = float(linkage.bodies[2].start[2])
    with pytest.raises(KinematicsError, match=r"a driver \(drive\) comes to the end of its range") as refusal:
        analyse(four_bar("rocker", start + 0.05, sense), times)
    d, a, b, c = 0.2, 0.05, 0.18, 0.12
    reached = start + 0.05 + sense * float(str(refusal.value).split("t = ")[1].split(" s")[0])
    limits = [math.pi - math.acos((d * d + c * c - r * r) / (2 * d * c)) for r in (b + a, b - a)]
    assert min(abs(reached - limit) for limit in limits) < 1e-3
    assert not isinstance(refusal.value, SingularConfigurationError)


def test_held_coordinates_give_way_to_drivers():
    linkage = four_bar("crank", 0.7, 1.0)
    assert linkage.held == ("crank.angle",)
    assert analyse(linkage, [0.0]).of("crank.angle")[0] == pytest.approx([0.7], abs=1e-12)


def test_whole_turns_are_counted_however_few_times_are_asked_for():
    motion = analyse(four_bar("crank", 0.0, 1.0), [0.0, 4 * math.pi])
    for body in ("coupler", "rocker"):
        before, behind = motion.of(f"{body}.angle")[0]
        assert behind == pytest.approx(before, abs=1e-10)
    assert motion.of("crank.angle")[0][1] == pytest.approx(4 * math.pi)


def test_an_uneven_motion_that_rests_at_times():
    disc = Mechanism(
        bodies=(Body("disc", 1.0, 1.0),),
        joints=(
            Revolute("pin", "disc", (0.0, 0.0), GROUND, (0.0, 0.0)),
            AngleDriver("drive", "disc", harmonic_motion(0.0, 3.0, 2.0)),
        ),
    )
    angle, speed, acceleration = analyse(disc, np.linspace(0.0, 3.0, 4)).of("disc.angle")
    t = np.linspace(0.0, 3.0, 4)
    np.testing.assert_allclose(angle, 3 * np.sin(2 * t), atol=1e-12)
    np.testing.assert_allclose(speed, 6 * np.cos(2 * t), atol=1e-12)
    np.testing.assert_allclose(acceleration, -12 * np.sin(2 * t), atol=1e-12)


def test_an_edge_of_a_profile_is_refused():
    """While a roller goes round an edge there is no common tangent."""
    roof = (0.0, (Term((1.0, 0.1)),)), (math.pi, (Term((1.0 + 0.1 * math.pi, -0.1)),))
    mechanism = cam_mechanism("roller", piecewise_profile(*roof), angle=math.pi / 2 - 3.0)
    drive = turning("drive", "cam", math.pi / 2 - 3.0, -1.0)
    plain = replace(mechanism, forces=(), outputs=(), joints=(*mechanism.joints, drive))
    with pytest.raises(MechanismError, match=r"'pair' has an edge at 3.14159265: its slope jumps from 0.1 to -0.1"):
        analyse(plain, [0.0, 0.14])


@pytest.mark.parametrize("times", [[], [0.0, 0.0], [1.0, 0.0], [0.0, math.nan], [[0.0]]])
def test_times_must_increase(times):
    with pytest.raises(KinematicsError, match="times must be finite and increase"):
        analyse(cranks(2), times)


def test_an_unknown_coordinate_is_answered_with_the_known_ones():
    with pytest.raises(KinematicsError, match=r"no coordinate 'crank'; there are: crank0\.x, "):
        analyse(cranks(2), [0.0]).of("crank")


@pytest.mark.parametrize("scale", [1e-3, 1e2])
@pytest.mark.parametrize("speed", [1e-9, 1.0, 1e6])
def test_angles_do_not_know_of_metres_and_seconds(scale, speed):
    """A four-bar linkage of any size at any speed."""
    times = np.linspace(0.0, 6.0, 13)
    known = analyse(four_bar_of(1.0, 1.0), times)
    found = analyse(four_bar_of(scale, speed), times / speed)
    turn = known.of("rocker.angle")
    for order, (one, other) in enumerate(zip(found.of("rocker.angle"), turn, strict=True)):
        np.testing.assert_allclose(one / speed**order, other, rtol=0, atol=1e-11)


def four_bar_of(scale, speed, far=0.0):
    """A crank-rocker whose ground is 0.2 long, times a scale, and so far away [m]; its crank has a speed [rad/s]."""
    crank, coupler, rocker = (
        rigid_body(name, (far + scale * x, scale * y), mass=1, inertia=scale**2, angle=angle)
        for name, x, y, angle in (("crank", 0, 0, 0.5), ("coupler", 0.088, 0.048, 0.9), ("rocker", 0.2, 0, 1.6))
    )
    joints = (
        Revolute("a0", crank.at(0, 0), GROUND.at(far, 0)),
        Revolute("a", crank.at(0.1 * scale, 0), coupler.at(0, 0)),
        Revolute("b", coupler.at(0.25 * scale, 0), rocker.at(0.22 * scale, 0)),
        Revolute("b0", rocker.at(0, 0), GROUND.at(far + 0.2 * scale, 0)),
        AngleDriver("drive", crank, motion=polynomial_motion(0.5, speed)),
    )
    return Mechanism((crank, coupler, rocker), joints)


@pytest.mark.parametrize("far", [1.0, 1e3])
def test_a_linkage_far_from_the_origin_has_the_same_angles(far):
    """As far as places there are rounded."""
    times = np.linspace(0.0, 6.0, 13)
    known = analyse(four_bar_of(1e-3, 1.0), times).of("rocker.angle")[0]
    found = analyse(four_bar_of(1e-3, 1.0, far * 1e-3), times).of("rocker.angle")[0]
    np.testing.assert_allclose(found, known, rtol=0, atol=1e-14 * far + 1e-12)


@pytest.mark.parametrize("times", [[0.0, math.pi / 4], [0.0, 1.0, 2.0]])
def test_drivers_that_agree_do_no_harm_where_they_turn_back(times):
    """Where both stand, their speeds differ by rounding."""
    motions = [harmonic_motion(0.4, 0.5, 2.0, 0.5 * math.pi + turn) for turn in (0.0, math.tau)]
    drivers = [AngleDriver(f"drive{k}", f"crank{k}", motion=motion) for k, motion in enumerate(motions)]
    motion = analyse(driven(parallel_cranks(2, 0.9), *drivers), times)
    np.testing.assert_allclose(motion.of("crank1.angle")[0], 0.4 + 0.5 * np.cos(2.0 * motion.time), rtol=0, atol=1e-12)


@pytest.mark.parametrize("speed", [1e-9, 1.0, 1e6])
def test_slow_drivers_that_contradict_each_other_are_named(speed):
    """By 1e-6 of their speed, whatever that is."""
    two = (turning(name, "crank0", 0.4, rate) for name, rate in (("one", speed), ("other", 1.000001 * speed)))
    mechanism = driven(parallel_cranks(2, 0.4), *two)
    with pytest.raises(KinematicsError, match="no velocity agrees with all rows"):
        analyse(mechanism, [0.0, 1e-6 / speed])
