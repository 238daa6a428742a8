"""No step passes over what a driver does, however long the mechanism has been at rest before."""

import math
from dataclasses import replace

import pytest

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    Mechanism,
    MechanismError,
    Move,
    Output,
    PointFollower,
    Revolute,
    Translational,
    dwell,
    motion_profile,
    polynomial_motion,
    table_motion,
)
from mechanism_fmu.model.curves import Curve, Piece, Term, constant, sine
from mechanism_fmu.simulation import Simulation


def driven(motion):
    return Mechanism(
        bodies=(Body("arm", 1.0, 1.0),),
        joints=(
            Revolute("hinge", "arm", (0.0, 0.0), GROUND, (0.0, 0.0)),
            AngleDriver("motor", "arm", motion),
        ),
        outputs=(Output("angle", "arm.angle", "", "rad"),),
    )


def highest(mechanism, times, name):
    simulation = Simulation(mechanism)
    found = []
    for time in times:
        simulation.advance(time)
        found.append(simulation.read()[name])
    return max(found)


def test_a_short_pulse_after_a_long_rest():
    motion = table_motion(((5.0, 0.0), (5.05, 0.5), (5.1, 0.0)))
    assert highest(driven(motion), (5.05, 6.0), "angle") == pytest.approx(0.5, abs=1e-8)


def test_waves_after_a_long_rest():
    """Half a (1 - cos(2 pi t)) of one period, with rest before and after."""
    wave = Piece(50.0, (constant(0.5), sine(0.5, 2 * math.pi, -math.pi / 2)))
    motion = Curve((Piece(0.0, (constant(0.0),)), wave, Piece(51.0, (constant(0.0),))))
    simulation = Simulation(driven(motion))
    for time, angle in ((50.5, 1.0), (50.75, 0.5), (60.0, 0.0)):
        simulation.advance(time)
        assert simulation.read()["angle"] == pytest.approx(angle, abs=1e-8)


@pytest.mark.parametrize("width", [0.005, 0.02, 0.1])
def test_a_narrow_bump_of_a_cam_after_a_long_dwell(width):
    lift = 1e-3 * width
    cam = Mechanism(
        bodies=(Body("cam", 1.0, 1.0, (0.0, 0.0, math.pi / 2)), Body("follower", 1.0, 1.0, (0.0, 0.05, 0.0))),
        joints=(
            Revolute("shaft", "cam", (0.0, 0.0), GROUND, (0.0, 0.0)),
            Translational("guide", "follower", (0.0, 0.0), (0.0, 1.0), GROUND, (0.0, 0.0), (0.0, 1.0)),
            AngleDriver("motor", "cam", polynomial_motion(math.pi / 2, -1.0)),
        ),
        contacts=(
            PointFollower(
                "pair",
                "follower",
                (0.0, 0.0),
                "cam",
                motion_profile(0.05, (Move(0.0, 3.7, dwell), Move(lift, width), Move(0.0, width))),
            ),
        ),
        outputs=(Output("height", "follower.y", "", "m"),),
        held=("cam.angle",),
    )
    # start_rate is left out: the driver turns the cam, whose angle is held, at -1 rad/s
    with pytest.raises(MechanismError, match=r"body 'cam' \(0, 0, -1\), not \(0, 0, 0\).* follow without held\.$"):
        Simulation(cam)
    assert Simulation(replace(cam, held=())).field("y_end")[8] == pytest.approx(-1.0, rel=1e-15)
    bodies = (Body("cam", 1.0, 1.0, (0.0, 0.0, math.pi / 2), (0.0, 0.0, -1.0)), cam.bodies[1])
    moving = Mechanism(bodies, cam.joints, contacts=cam.contacts, outputs=cam.outputs)
    assert highest(moving, (3.7 + width, 5.0), "height") == pytest.approx(0.05 + lift, abs=1e-9)


def test_a_motion_with_an_edge_is_refused():
    motion = Curve((Piece(0.0, (constant(0.0),)), Piece(1.0, (Term((0.0, 1.0)),))))
    with pytest.raises(MechanismError, match=r"curve of 'motor' has an edge at 1: its slope jumps from 0 to 1"):
        Simulation(driven(motion))
