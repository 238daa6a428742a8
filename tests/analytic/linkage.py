"""What the tests of linkages with one degree of freedom share."""

from __future__ import annotations

import math

import numpy as np

from mechanism_fmu.simulation import Simulation


def simulation_of(model, **values):
    return Simulation(model.build(model.values(**values)))


def worst_deviation(simulation, exact, times, torque):
    """How far a motion is from its kinematics: positions, rates, accelerations, whatever the crank does.

    `exact` gives, for the crank's angle, the courses of other outputs by name: (position output, rate output). Angles
    may differ by full turns. `torque` drives the crank, as a function of time. Also returns the crank's turns.
    """
    worst = np.zeros(3)
    for time in times:
        simulation.set_input("drive_torque", torque(time))
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
    return worst, found["crank_angle"] / (2 * math.pi)


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


def courses_meet(simulation, curve, atol):
    """Go along a reference curve, a data frame with the time and outputs; angles may differ by full turns."""
    for row in curve.to_dict("records"):
        simulation.advance(row.pop("time"))
        found = simulation.read()
        for name, expected in row.items():
            off = found[name] - expected
            if name.endswith("_angle") and name != "crank_angle":
                off = math.remainder(off, 2 * math.pi)
            assert abs(off) < atol, (name, simulation.time)
