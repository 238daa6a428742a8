"""Forces on a part of the way in FMUs: by co-simulation, by an importer's own integrator, and from a saved state."""

import math
import sys
from pathlib import Path

import pytest
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi2 import FMU2Slave
from fmpy.validation import validate_fmu

from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.model import (
    GROUND,
    Mechanism,
    Model,
    NonlinearTorsionSpring,
    Output,
    Revolute,
    SpringDamper,
    characteristic,
    rigid_body,
    settings_parameters,
)
from mechanism_fmu.model.functions import atan2, cos, sin, where

#: A ball that comes back from two bumpers, a press, a shaft with a torque between two angles by a table.
GAP, STIFFNESS = 1.0, 1e4


def press(angle, _):
    distance = atan2(sin(angle - 2.3), cos(angle - 2.3))
    return where(0.3 - abs(distance) > 0.0, 400.0, 0.0)


def mechanism(values):
    ball = rigid_body("ball", (0, 0), mass=1.0, inertia=1.0, velocity=(1.0, 0.0))
    shaft = rigid_body("shaft", (0, 2.0), mass=1.0, inertia=8.5, speed=15.0)
    wheel = rigid_body("wheel", (0, 4.0), mass=1.0, inertia=1.0, speed=2.0)
    wall = {"stiffness": STIFFNESS, "free_length": 0.05, "one_sided": "compressed"}
    hill = characteristic([(0.0, 0.0), (3.0, 0.0), (3.1, 1.0), (3.2, 0.0), (4.0, 0.0)])
    return Mechanism(
        (ball, shaft, wheel),
        (
            Revolute("hinge", shaft.at(0, 0), GROUND.at(0, 2.0)),
            Revolute("axle", wheel.at(0, 0), GROUND.at(0, 4.0)),
        ),
        (
            SpringDamper("right", ball, GROUND.at(GAP, 0), **wall),
            SpringDamper("left", ball, GROUND.at(-GAP, 0), **wall),
            NonlinearTorsionSpring("work", shaft, GROUND, law=press),
            NonlinearTorsionSpring("hill", wheel, GROUND, law=hill),
        ),
        outputs=(
            Output("x", ball.x, "place", "m"),
            Output("speed", shaft.speed, "speed of the press", "rad/s"),
            Output("wheel_angle", wheel.angle, "angle of the wheel", "rad"),
            Output("events", "event.count", "events", type="Integer"),
        ),
    )


MODEL = Model("Bumpers", "Forces on a part of the way", settings_parameters(), mechanism, stop_time=1.9)
#: After 1.9 s: the ball on its way back, the press after three turns, the wheel behind its hill.
X = 2.0 * (GAP - 0.05) - 1.9 + math.pi / math.sqrt(STIFFNESS)
SPEED = math.sqrt(15.0**2 - 2.0 * 720.0 / 8.5)


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_native_fmu(sys.modules[__name__], tmp_path_factory.mktemp("bumpers"))


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
@pytest.mark.parametrize("interval", [0.019, 1.9])
def test_forces_are_met_by_every_integrator(fmu, kind, interval):
    assert validate_fmu(str(fmu)) == []
    solver = {"relative_tolerance": 1e-10} if kind == "ModelExchange" else {}
    found = simulate_fmu(str(fmu), fmi_type=kind, stop_time=1.9, output_interval=interval, **solver)
    assert found["x"][-1] == pytest.approx(X, abs=1e-6)
    assert found["speed"][-1] == pytest.approx(SPEED, abs=1e-5)
    assert found["events"][-1] == 0


def test_a_state_saved_within_a_force_goes_on_with_the_same_bits(fmu):
    ends = {step: [] for step in (0, 1)}
    description = read_model_description(str(fmu))
    references = [v.valueReference for v in description.modelVariables if v.name in ("x", "speed", "wheel_angle")]
    slave = FMU2Slave(
        guid=description.guid,
        unzipDirectory=extract(str(fmu)),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="saved",
    )
    slave.instantiate()
    slave.setupExperiment(startTime=0.0)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    inside = 0.95 + 0.5 * math.pi / math.sqrt(STIFFNESS)  # the bumper is compressed
    slave.doStep(0.0, inside)
    state = slave.getFMUState()
    for again in ends:
        if again:
            slave.setFMUState(state)
        slave.doStep(inside, 1.9 - inside)
        ends[again] = slave.getReal(references)
    slave.freeFMUState(state)
    slave.terminate()
    slave.freeInstance()
    assert ends[0] == ends[1]
    assert ends[0][0] == pytest.approx(X, abs=1e-6)
