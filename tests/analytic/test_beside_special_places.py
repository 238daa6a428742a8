"""What stands by a rounding beside a special place, or far from the origin, moves as what stands right there."""

import math

import numpy as np
import pytest

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    AngleStop,
    Brake,
    Distance,
    LinearCopies,
    Mechanism,
    Outline,
    OutlineContact,
    PointLineContact,
    Revolute,
    Settings,
    Torque,
    bar,
    rigid_body,
    table_motion,
)
from mechanism_fmu.simulation import simulate


@pytest.mark.parametrize("off", [0.0, 5e-17, 1e-13, 1e-10])
def test_a_brake_on_a_wheel_pinned_beside_its_middle(off):
    """A wheel with a radius of gyration of 1 um, whose pin is off by rounding, and by more."""
    wheel = rigid_body("wheel", (0, 0), mass=1, inertia=1e-12)
    forces = (Torque("torque", wheel, torque=2e-12), Brake("brake", wheel, limit=1e-12))
    mechanism = Mechanism((wheel,), (Revolute("pin", wheel.at(off, 0), GROUND.at(off, 0)),), forces)
    end = math.sqrt(2)
    assert simulate(mechanism, until=end, step=end / 10)["wheel_angle"][-1] == pytest.approx(1.0, rel=1e-8)


def driven(start):
    """A ball that falls from 0.1 m beside a crank whose driver goes by a table, from a start time on [s]."""
    crank = bar("crank", (0, 0), length=0.1, angle=0.0, mass=1.0)
    table = table_motion([(0.1 * k, 0.2 * k + 0.1 * (k % 2)) for k in range(12)])
    ball = rigid_body("ball", (1, 0.1), mass=1.0, inertia=0.1)
    floor = PointLineContact("floor", ball.at(0, 0), GROUND.line((0, 0), (1, 0)), restitution=0.5)
    joints = (Revolute("pin", crank.a, GROUND.at(0, 0)), AngleDriver("driver", crank, motion=table))
    mechanism = Mechanism((crank, ball), joints, contacts=(floor,), gravity=(0, -9.81))
    result = simulate(mechanism, until=start + 0.6, step=0.1, start=start)
    return [hit.time - start for hit in result.impacts], result["ball_y"][-1]


@pytest.mark.parametrize("boundary", [0.1, 0.30000000000000004])
def test_a_start_at_a_rounding_before_a_boundary(boundary):
    """What is left of a piece of a motion says nothing about the mechanism's time."""
    times, height = driven(boundary)
    for start in (math.nextafter(boundary, 0.0), math.nextafter(boundary, 1.0)):
        beside, high = driven(start)
        np.testing.assert_allclose(beside, times, rtol=0, atol=1e-12)
        assert high == pytest.approx(height, abs=1e-12)


@pytest.mark.parametrize("far", [0.0, 10.0, 1000.0])
def test_a_lever_far_from_the_origin(far):
    """From stop to stop at 1e-9 N m: the place on the ground is no size of the lever's rows."""
    lever = bar("lever", (far, 0), length=5e-3, angle=0.0, mass=1e-6)
    stops = (AngleStop("low", lever, GROUND, angle=0.0), AngleStop("high", GROUND, lever, angle=-1.0))
    pin = Revolute("pin", lever.a, GROUND.at(far, 0))
    mechanism = Mechanism((lever,), (pin,), (Torque("motor", lever, torque=1e-9),), stops)
    once = math.sqrt(2 * 1e-6 * 5e-3**2 / 3 / 1e-9)
    result = simulate(mechanism, until=1.1 * once, step=once / 50)
    # the lever's own length is rounded there
    assert [hit.time for hit in result.impacts][:1] == pytest.approx([once], rel=1e-9 + 1e-15 * far / 5e-3)


def bouncing(crane):
    """Impacts of a disc of 1 mm that falls from 1 mm, beside a pendulum of 10 m or alone."""
    outline = Outline.circle(1e-3)
    ball = rigid_body("ball", (0, 2e-3), mass=1e-6, inertia=1e-13)
    floor = Outline.chain([(0.01, 0.0), (-0.01, 0.0)])
    touch = OutlineContact("touch", ball, GROUND, outline_i=outline, outline_j=floor, restitution=0.4)
    bodies, joints = (ball,), ()
    if crane:
        arm = rigid_body("arm", (0, 1), mass=1e3, inertia=1e4, centre=(10.0, 0.0))
        bodies, joints = (ball, arm), (Revolute("pin", arm.at(0, 0), GROUND.at(0, 1)),)
    result = simulate(Mechanism(bodies, joints, contacts=(touch,), gravity=(0, -9.81)), until=0.05, step=0.01)
    return [(hit.time, hit.closing_speed) for hit in result.impacts]


def test_outlines_beside_a_crane_bounce_as_often_as_alone():
    alone, beside = bouncing(False), bouncing(True)
    assert len(alone) == len(beside) > 5
    np.testing.assert_allclose(beside, alone, rtol=1e-5, atol=0)


@pytest.mark.parametrize("end", [(0.0, 0.0), (0.0, 0.02), (0.05, 0.0)])
@pytest.mark.parametrize("angle", [0.0, math.pi / 2])
def test_copies_that_join_at_the_origin_of_their_body(end, angle):
    """A disc slides over teeth without corners between, wherever on its body the line of copies ends.

    Also on the place where the two arcs of its circle join.
    """
    x, y = end
    floor = Outline.chain([(x, y), (x - 0.1, y)])
    puck = rigid_body("puck", (0.25, y + 0.01), mass=1.0, inertia=1e-4, angle=angle, velocity=(1.0, 0.0))
    copies = LinearCopies((0.1, 0.0))
    touch = OutlineContact("touch", puck, GROUND, outline_i=Outline.circle(0.01), outline_j=floor, copies=copies)
    result = simulate(Mechanism((puck,), contacts=(touch,), gravity=(0, -9.81)), until=0.5, step=0.1)
    assert [event.guard for event in result.events if event.guard != "touch.handover"] == []
    assert result["puck_x"][-1] == pytest.approx(0.75, rel=1e-10)
    assert np.abs(result["puck_y"] - y - 0.01).max() <= 1e-12


def test_a_rounded_pin_goes_round_the_end_of_a_slot_and_comes_back():
    """Where the flat of a slot goes over smoothly into its round end, nothing strikes.

    A pin that lies flat slides there, climbs the round end by its front, and comes back with the energy that it had:
    without friction, the same speed at the same place.
    """
    a, b = 0.0175, 0.025
    quarter = math.tan(math.pi / 8)
    corners = [(b, a), (a, b), (-a, b), (-b, a), (-b, -a), (-a, -b), (a, -b), (b, -a)]
    pin_shape = Outline([(*at, quarter if k % 2 == 0 else 0.0) for k, at in enumerate(corners)])
    slot = Outline([(-0.1, 0.03, 0.0), (0.1, 0.03, -1.0), (0.1, -0.03, 0.0), (-0.1, -0.03, -1.0)], hole=True)
    start = -0.0775
    pin = rigid_body("pin", (start, b - 0.03), mass=0.25, inertia=1e-4)
    touch = OutlineContact("slot", pin, GROUND, outline_i=pin_shape, outline_j=slot)
    mechanism = Mechanism((pin,), contacts=(touch,), gravity=(-2.0, -9.81))
    reached = math.sqrt(2 * (start - a + 0.1) / 2.0)
    result = simulate(mechanism, until=7 * reached, step=reached / 100)
    ends = [event.time for event in result.events]
    assert all(event.guard.endswith("handover") for event in result.events), ends
    assert len(result.impacts) == 0
    assert ends[0] == pytest.approx(reached, rel=1e-9)
    turning = ends[1] - ends[0]
    np.testing.assert_allclose(np.diff(ends), [turning, 2 * reached, turning][: len(ends) - 1], rtol=1e-6)
    assert len(ends) >= 3
    top = np.argmax(result["pin_x"][50:]) + 50  # back where it started, between the second and the third hand-over
    assert result["pin_x"][top] == pytest.approx(start, abs=1e-5)
    assert ends[1] < result["time"][top] < ends[2]


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5, 1e-7])
def test_what_hangs_and_strikes_at_a_loose_tolerance(tolerance):
    """Mending of a thread, which has drifted by more than what touches, moves a ball into what it strikes."""
    balls = tuple(
        rigid_body(name, (x, -0.1), mass=0.1, inertia=5e-6, velocity=(speed, 0.0))
        for name, x, speed in (("one", 0.0, 0.3), ("other", 0.0205, 0.0))
    )
    threads = tuple(
        Distance(f"thread_{ball.name}", GROUND.at(x, 0), ball.at(0, 0), distance=0.1)
        for ball, x in zip(balls, (0.0, 0.0205), strict=True)
    )
    shape = Outline.circle(0.01)
    pair = OutlineContact("pair", balls[0], balls[1], outline_i=shape, outline_j=shape, restitution=1.0)
    mechanism = Mechanism(balls, threads, contacts=(pair,), gravity=(0, -9.81), settings=Settings(tolerance))
    result = simulate(mechanism, until=2.0, step=0.1)
    assert [hit.contact for hit in result.impacts[:4]] == ["pair"] * 4
