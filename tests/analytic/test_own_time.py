"""A mechanism's own time: what turns slowly takes as many steps a turn as what turns fast, and stays as true."""

import math

import numpy as np
import pytest

from mechanism_fmu import codes
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    Mechanism,
    Output,
    Revolute,
    Translational,
    bar,
    four_bar_points,
    polynomial_motion,
)
from mechanism_fmu.simulation import Simulation

_TURNS = 3
#: Below, the absolute part of the error's tolerance, 1e-12 rad/s, lets steps grow.
_SPEEDS = [1.0, 10.0, 1e3]


def crank_rocker(speed, gravity, driven=True):
    points = four_bar_points((0, 0), (1.0, 0), crank=0.5, coupler=1.2, rocker=0.8, angle=1.0)
    crank = bar("crank", (0, 0), points.crank_pin, mass=1.0, speed=speed)
    coupler = bar("coupler", points.crank_pin, points.rocker_pin, mass=1.0)
    rocker = bar("rocker", (1.0, 0), points.rocker_pin, mass=1.0)
    joints = [
        Revolute("A", crank.a, GROUND.at(0, 0)),
        Revolute("B", crank.b, coupler.a),
        Revolute("C", coupler.b, rocker.b),
        Revolute("D", rocker.a, GROUND.at(1.0, 0)),
    ]
    return _mechanism((crank, coupler, rocker), joints, speed, gravity, driven)


def slider_crank(speed, gravity, driven=True):
    pin, end = (
        (0.1 * math.cos(1.0), 0.1 * math.sin(1.0)),
        0.1 * math.cos(1.0) + math.sqrt(0.09 - 0.01 * math.sin(1.0) ** 2),
    )
    crank = bar("crank", (0, 0), pin, mass=0.2, speed=speed)
    rod = bar("rod", pin, (end, 0), mass=0.3)
    slider = Body("slider", 0.5, 1e-3, (end, 0.0, 0.0))
    joints = [
        Revolute("A", crank.a, GROUND.at(0, 0)),
        Revolute("B", crank.b, rod.a),
        Revolute("C", rod.b, slider.at(0, 0)),
        Translational("guide", slider.line((0, 0), (1.0, 0)), GROUND.line((0, 0), (1.0, 0))),
    ]
    return _mechanism((crank, rod, slider), joints, speed, gravity, driven)


def _mechanism(bodies, joints, speed, gravity, driven):
    drivers = [AngleDriver("drive", bodies[0], motion=polynomial_motion(1.0, speed))] if driven else []
    return Mechanism(
        bodies,
        (*joints, *drivers),
        held=() if driven else (bodies[0].angle,),
        gravity=(0.0, -gravity * speed**2) if gravity else None,
        outputs=(Output("kinetic", "energy.kinetic", "energy", "J"), Output("work", "energy.work", "work", "J")),
    )


@pytest.mark.parametrize("gravity", [0.0, 0.3])
@pytest.mark.parametrize("build", [crank_rocker, slider_crank])
def test_steps_a_turn_do_not_depend_on_speed(build, gravity):
    steps = []
    for speed in _SPEEDS:
        simulation = Simulation(build(speed, gravity))
        simulation.advance(_TURNS * 2 * math.pi / speed)
        steps.append(simulation.counters.item(codes.COUNT_STEPS) / _TURNS)
    assert max(steps) <= 1.2 * min(steps), steps


@pytest.mark.parametrize("speed", [0.1, 10.0])
@pytest.mark.parametrize("build", [crank_rocker, slider_crank])
def test_a_hundred_free_turns_keep_joints_and_energy(build, speed):
    """Within a step, joints are off by no more than its dense output is."""
    simulation = Simulation(build(speed, 0.0, driven=False))
    residual = simulation.field("residual")
    start = simulation.read()["kinetic"]
    for time in np.linspace(0.0, 100 * 2 * math.pi / speed, 201)[1:]:
        simulation.advance(float(time))
        assert simulation.read()["kinetic"] == pytest.approx(start, rel=1e-6)
        assert np.abs(residual[:8]).max() < 1e-8
