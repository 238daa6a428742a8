"""What the frame feels, the flywheel, and friction in the joints: known answers and second ways."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.integrate import solve_ivp

from benchmarks.path_generator import PathGenerator
from mechanism_fmu.elastodynamics import (
    DRIVE,
    LinkageError,
    configurations,
    crank_hinge,
    flywheel,
    joint_forces,
    linkage,
    momentum_shaking,
    quasi_static,
    resized_members,
    shaking,
    torque_fluctuation,
    turn,
    with_friction,
)
from mechanism_fmu.kinematics import analyse
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    LumpedMass,
    Mechanism,
    Member,
    Revolute,
    Section,
    Translational,
    lumped_body,
    polynomial_motion,
)

SECTION = Section.rectangle(0.004, 0.012)
SPEED = 40.0


def spinning(disk=0.3, friction=0.0, speed=SPEED):
    """One crank with a disk at its end, on a pin of the frame."""
    parts = lumped_body(
        (Member("bar", "crank", (0.0, 0.0), (0.2, 0.0), SECTION, 2e11, 0.0),),
        (LumpedMass("tip", "crank", (0.2, 0.0), disk),),
    )
    bar = parts.members[0]
    return Mechanism(
        bodies=(Body("crank", parts.mass, 1e-3, (0.0, 0.0, 0.1), (0.0, 0.0, speed)),),
        joints=(
            Revolute("pin", "crank", bar.start, GROUND, (0.3, 0.1), friction),
            AngleDriver("motor", "crank", polynomial_motion(0.1, speed)),
        ),
        members=parts.members,
        lumped_masses=parts.lumped_masses,
    )


def slider_crank(friction=0.0):
    """On a guide beside the origin, at an angle to both axes."""
    tilt, offset = 0.4, (0.03, -0.05)
    crank = lumped_body((Member("crank_bar", "crank", (0.0, 0.0), (0.1, 0.0), SECTION, 2e11, 7850.0),))
    rod = lumped_body((Member("rod_bar", "rod", (0.0, 0.0), (0.3, 0.0), SECTION, 2e11, 7850.0),))
    along = (math.cos(tilt), math.sin(tilt))
    return Mechanism(
        bodies=(
            Body("crank", crank.mass, crank.inertia, (0.05, 0.0, 0.2)),
            Body("rod", rod.mass, rod.inertia, (0.25, 0.0, 0.0)),
            Body("slider", 0.5, 1e-3, (0.4, 0.1, tilt)),
        ),
        joints=(
            Revolute("hinge", "crank", crank.members[0].start, GROUND, (0.0, 0.0)),
            Revolute("pin", "rod", rod.members[0].start, "crank", crank.members[0].end),
            Revolute("wrist", "slider", (0.0, 0.0), "rod", rod.members[0].end),
            Translational("guide", GROUND, offset, along, "slider", (0.0, 0.0), (1.0, 0.0), friction),
            AngleDriver("motor", "crank", polynomial_motion(0.2, 60.0)),
        ),
        members=(*crank.members, *rod.members),
    )


def cycle_of(mechanism, samples=72, speed=SPEED):
    return quasi_static(turn(mechanism, speed, samples))


def test_a_disk_on_a_crank_pulls_its_pin_outwards():
    """F = m r w^2 along the crank, and no moment about the pin."""
    cycle = cycle_of(spinning(), 36)
    angle = cycle.configurations.pose.position[:, 0, 2]
    found = shaking(cycle, crank_hinge(spinning()))
    assert found.about == (0.3, 0.1)
    outwards = 0.3 * 0.2 * SPEED**2 * np.column_stack([np.cos(angle), np.sin(angle)])
    np.testing.assert_allclose(found.force, outwards, rtol=0, atol=1e-9 * 96)
    np.testing.assert_allclose(found.moment, 0.0, atol=1e-9)
    # about another point the moment is that of the force at the pin
    elsewhere = shaking(cycle, (0.0, 0.0))
    np.testing.assert_allclose(elsewhere.moment, 0.3 * outwards[:, 1] - 0.1 * outwards[:, 0], atol=1e-9)


@pytest.mark.parametrize("friction", [0.0, 0.1])
@pytest.mark.parametrize("about", [(0.0, 0.0), (0.2, -0.7)])
def test_shaking_is_minus_the_rate_of_momentum_of_masses_looked_at_alone(friction, about):
    """-sum m a and -sum r x m a of the lumps, their places differentiated twice by finite differences in time."""
    mechanism = with_friction(slider_crank(), friction, 0.004)
    times, step = np.linspace(0.01, 0.1, 7), 2e-5

    def motion(shift):
        return analyse(mechanism, times + shift)

    cycle = quasi_static(configurations(linkage(mechanism), motion(0.0)))
    found = shaking(cycle, about)
    force, moment = np.zeros((len(times), 2)), np.zeros(len(times))

    def place(body, point, shift):
        x, y, phi = (motion(shift).of(f"{body}.{c}")[0] for c in ("x", "y", "angle"))
        return np.column_stack(
            [x + np.cos(phi) * point[0] - np.sin(phi) * point[1], y + np.sin(phi) * point[0] + np.cos(phi) * point[1]]
        )

    lumps = [("slider", (0.0, 0.0), 0.5)]
    for member in mechanism.members:
        half = 7850.0 * 0.004 * 0.012 * math.dist(member.start, member.end) / 2
        lumps += [(member.body, member.start, half), (member.body, member.end, half)]
    for body, point, mass in lumps:
        before, now, after = (place(body, point, shift) for shift in (-step, 0.0, step))
        inertia = -mass * (before - 2 * now + after) / step**2
        force += inertia
        arm = now - np.array(about)
        moment += arm[:, 0] * inertia[:, 1] - arm[:, 1] * inertia[:, 0]
    np.testing.assert_allclose(found.force, force, rtol=0, atol=2e-4 * np.abs(force).max())
    np.testing.assert_allclose(found.moment, moment, rtol=0, atol=2e-4 * np.abs(moment).max())


@settings(max_examples=10, deadline=None)
@given(st.floats(0.0, 0.2), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_both_ways_to_the_force_on_the_frame_agree(friction, x, y):
    """Sum of the joints on the ground, and Newton's laws; friction within has no say."""
    for mechanism in (with_friction(slider_crank(), friction, 0.004), with_friction(spinning(), friction, 0.01)):
        cycle = cycle_of(mechanism, 24, 60.0)
        assert shaking(cycle, (x, y)).gap(momentum_shaking(cycle, (x, y))) < 1e-9


def test_a_linkage_without_one_hinge_of_its_crank_is_seen_from_the_origin():
    mechanism = spinning()
    assert crank_hinge(replace(mechanism, joints=mechanism.joints[1:])) == (0.0, 0.0)


def test_nothing_shakes_where_nothing_moves_unevenly():
    cycle = cycle_of(replace(spinning(), lumped_masses=()), 12)
    assert shaking(cycle).gap(momentum_shaking(cycle)) == 0.0
    assert not shaking(cycle).force.any()


def test_friction_torque_of_a_pin_by_hand():
    """A disk of 0.3 kg at 0.2 m and 40 rad/s loads its pin with 96 N: 0.1 * 5 mm * 96 N against the turning."""
    cycle = cycle_of(with_friction(spinning(), 0.1, 0.005), 36)
    (pin,) = joint_forces(cycle.configurations, cycle.reactions)
    np.testing.assert_allclose(pin.force, 96.0, rtol=1e-9)
    np.testing.assert_allclose(pin.friction, -0.048, rtol=1e-9)
    np.testing.assert_allclose(pin.lost_power, 0.048 * SPEED, rtol=1e-9)
    np.testing.assert_allclose(cycle.reactions.of(DRIVE)[:, 0], 0.048, rtol=1e-8)
    assert (pin.joint, pin.turning) == ("pin", True)


def test_friction_of_a_slider_is_its_coefficient_times_the_force_across():
    mechanism = with_friction(slider_crank(), 0.15, 0.0)
    cycle = cycle_of(mechanism, 72, 60.0)
    guide = next(j for j in joint_forces(cycle.configurations, cycle.reactions) if j.joint == "guide")
    moving = guide.friction != 0.0
    assert moving.sum() > 60
    np.testing.assert_allclose(np.abs(guide.friction[moving]), 0.15 * guide.force[moving], rtol=1e-9)
    assert not guide.turning
    assert guide.lost_power.min() >= 0.0


def test_what_the_joints_lose_is_what_the_drive_gives_in_a_turn():
    cycle = cycle_of(with_friction(PathGenerator().mechanism(), 0.1, 0.005), 360, 52.36)
    time = cycle.configurations.pose.time
    lost = sum(np.trapezoid(j.lost_power, time) for j in joint_forces(cycle.configurations, cycle.reactions))
    angle = np.linspace(0.0, 2 * math.pi, 361)
    assert lost == pytest.approx(np.trapezoid(cycle.reactions.of(DRIVE)[:, 0], angle), rel=1e-9)


@pytest.mark.parametrize(
    ("coefficient", "radius", "said"),
    [
        (-0.1, 0.005, "coefficient of friction is -0.1; give one from 0 on"),
        (0.1, None, r"give the radius of the pins \(pin\), e.g. 5 mm"),
        (0.1, -1.0, "radius of the pins is -1 m; give one from 0 on"),
    ],
)
def test_friction_that_cannot_be_is_refused(coefficient, radius, said):
    with pytest.raises(LinkageError, match=said):
        with_friction(spinning(), coefficient, radius)


@given(st.floats(0.005, 0.5), st.floats(1.0, 200.0), st.floats(0.1, 50.0), st.integers(1, 5))
def test_the_flywheel_of_a_sine_by_hand(coefficient, speed, amplitude, waves):
    """T = a sin(n x) runs ahead of its mean by 2 a / n: J = 2 a / (n c w^2), and the speed swings by just c."""
    angle = np.linspace(0.0, 2 * math.pi, 1441)
    found = flywheel(angle, 3.0 + amplitude * np.sin(waves * angle), speed, coefficient)
    assert found.inertia == pytest.approx(2 * amplitude / (waves * coefficient * speed**2), rel=1e-4)
    assert np.ptp(found.speed) == pytest.approx(coefficient * speed, rel=1e-9)
    assert (found.speed.max() + found.speed.min()) / 2 == pytest.approx(speed, rel=1e-9)


def test_a_crank_with_the_flywheel_of_the_path_generator_swings_as_asked_for():
    """A second way: J dw/dt = mean torque - T(angle), integrated in time over many turns."""
    speed, coefficient = 52.36, 0.02
    cycle = cycle_of(PathGenerator().mechanism(), 360, speed)
    torque, angle = cycle.reactions.of(DRIVE)[:, 0], np.linspace(0.0, 2 * math.pi, 361)
    found = flywheel(angle, torque, speed, coefficient)
    mean = torque_fluctuation(angle, torque).mean

    def rates(_, state):
        return state[1], (mean - np.interp(state[0] % (2 * math.pi), angle, torque)) / found.inertia

    over = solve_ivp(rates, (0.0, 0.4), (0.0, found.speed[0]), rtol=1e-9, atol=1e-9, max_step=2e-4)
    assert np.ptp(over.y[1]) == pytest.approx(coefficient * speed, rel=1e-4)
    assert (over.y[1].max() + over.y[1].min()) / 2 == pytest.approx(speed, rel=1e-5)


def test_an_even_torque_needs_no_flywheel():
    found = flywheel(np.linspace(0.0, 1.0, 5), np.full(5, 2.0), 10.0, 0.01)
    assert found.inertia == 0.0
    np.testing.assert_array_equal(found.speed, 10.0)


@pytest.mark.parametrize(("coefficient", "speed"), [(0.0, 1.0), (2.0, 1.0), (math.nan, 1.0), (0.1, 0.0)])
def test_a_flywheel_that_cannot_be_is_refused(coefficient, speed):
    with pytest.raises(LinkageError, match=r"coefficient of fluctuation is|evens out a positive one"):
        flywheel(np.linspace(0.0, 1.0, 5), np.arange(5.0), speed, coefficient)


def test_members_of_other_sections_are_named():
    mechanism = PathGenerator().mechanism()
    arm, *others = mechanism.members
    deeper = replace(arm, section=Section.rectangle(0.00635, 0.02))
    wider = replace(arm, section=Section.rectangle(0.01, arm.section.depth))
    changed = [replace(mechanism, members=(other, *others)) for other in (arm, deeper, wider)]
    assert [resized_members(mechanism, other) for other in changed] == [((), ()), (("arm",), ("arm",)), (("arm",), ())]


def test_a_linkage_of_other_lengths_or_parts_is_another_one():
    mechanism = PathGenerator().mechanism()
    arm, *others = mechanism.members
    for other in (
        replace(mechanism, members=(replace(arm, end=(0.1, 0.1)), *others)),
        replace(mechanism, members=(replace(arm, density=1.0), *others)),
        replace(mechanism, members=tuple(others)),
        replace(mechanism, lumped_masses=()),
    ):
        assert resized_members(mechanism, other) is None
