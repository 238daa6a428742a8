"""What the tests of linkages with one degree of freedom share."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from benchmarks.eksergian import motion, weight
from mechanism_fmu.simulation import Simulation

#: Parameters of a run in which nothing brakes the crank.
FREE = {"drive_damping": 0.0, "relative_tolerance": 1e-13}
#: Parameters and inputs of a run in which everything acts on the crank, but for the load.
DRIVEN = {
    "crank_speed_start": 8.0,
    "crank_damping": 0.004,
    "drive_damping": 0.1,
    "drive_stiffness": 2.0,
    "gravity": 9.81,
    "relative_tolerance": 1e-12,
}
DRIVE = {"drive_torque": 0.05, "drive_speed": 6.0, "drive_angle": 0.5}


def simulation_of(model, **values):
    return Simulation(model.build(model.values(**values)))


def assert_follows(simulation, exact, sense):
    """A linkage follows its crank, which turns by `sense` 1 or -1 under a changing torque, as its kinematics say.

    `exact` gives, for the crank's angle, the courses of other outputs by name: (position output, rate output). Angles
    may differ by full turns.
    """
    worst = np.zeros(3)
    for time in np.arange(1, 201) * 0.0077:
        simulation.set_input("drive_torque", 0.02 * math.cos(5 * time))
        simulation.advance(time)
        found, rates = simulation.read(), simulation.read_rates()
        speed, acceleration = found["crank_speed"], rates["crank_speed"]
        for (position, rate), course in exact(found["crank_angle"]).items():
            off = found[position] - course.value
            if position.endswith("_angle"):
                off = math.remainder(off, 2 * math.pi)
            expected = course.rate * acceleration + course.curvature * speed**2
            now = (off, found[rate] - course.rate * speed, rates[rate] - expected)
            worst = np.maximum(worst, np.abs(now))
    position, rate, acceleration = worst
    assert sense * found["crank_angle"] > 2 * math.pi
    assert position < 1e-10
    assert rate < 1e-10
    # Accelerations reach 1e3 m/s2 and rad/s2.
    assert acceleration < 1e-8


def assert_crank_moves(simulation, links, theta, load, inputs):
    """A linkage with the parameters DRIVEN moves from the crank angle theta on as Eksergian's equation says.

    `load` is what the load of `inputs` and springs are at the crank [N m], as a function of its angle.
    """

    def torque(theta, speed):
        drive = 0.05 - 0.004 * speed + 0.1 * (6.0 - speed) + 2.0 * (0.5 - theta)
        return drive + load(theta) + weight(links(theta), 9.81)

    times = np.linspace(0.0, 2.0, 21)
    angles, speeds = motion(links, torque, theta, 8.0, times.tolist())
    for name, value in (DRIVE | inputs).items():
        simulation.set_input(name, value)
    for time, angle, speed in zip(times, angles, speeds, strict=True):
        simulation.advance(time)
        found = simulation.read()
        assert found["crank_angle"] == pytest.approx(angle, abs=1e-8)
        assert found["crank_speed"] == pytest.approx(speed, abs=1e-8)
        assert found["drive_shaft_torque"] == pytest.approx(0.1 * (6.0 - speed) + 2.0 * (0.5 - angle), abs=1e-7)


def worst_imbalance(simulation, times, set_inputs):
    """Largest of kinetic + spring - work + lost against its start [J], and all that was exchanged [J]."""

    def balance(found):
        return found["kinetic_energy"] + found["spring_energy"] - found["work_done"] + found["energy_lost"]

    found = simulation.read()
    start, worst, exchanged = balance(found), 0.0, found["kinetic_energy"] + found["spring_energy"]
    for time in times:
        before = found["work_done"]
        set_inputs(simulation, time)
        simulation.advance(time)
        found = simulation.read()
        exchanged += abs(found["work_done"] - before)
        worst = max(worst, abs(balance(found) - start))
    return worst, exchanged


def assert_meets_reference(simulation, model, atol):
    """Go along the reference curve of a model, with the time and outputs; angles may differ by full turns."""
    curve = pd.read_csv(Path(__file__).parents[2] / "models" / model / "reference.csv")
    for row in curve.to_dict("records"):
        simulation.advance(row.pop("time"))
        found = simulation.read()
        for name, expected in row.items():
            off = found[name] - expected
            if name.endswith("_angle") and name != "crank_angle":
                off = math.remainder(off, 2 * math.pi)
            assert abs(off) < atol, (name, simulation.time)
