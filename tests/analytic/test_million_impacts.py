"""A stiff, light pawl that rattles on its stop: a million impacts in one run."""

import math
import resource
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import pytest

from mechanism_fmu import codes
from mechanism_fmu.model import GROUND, Body, Mechanism, Output, PointLineContact, Revolute, Settings, Torque
from mechanism_fmu.simulation import Simulation

LENGTH, MASS, INERTIA = 0.02, 1e-3, 1e-6
TORQUE = 1e-2
SPEED = 0.5
ABOUT_HINGE = INERTIA + MASS * (LENGTH / 2) ** 2
#: A hop: up with SPEED, back with -SPEED under the spring's constant torque.
PERIOD = 2 * SPEED * ABOUT_HINGE / TORQUE
MILLION = 1_000_000


def rattling_pawl(restitution=1.0):
    half = LENGTH / 2
    return Mechanism(
        bodies=(Body("pawl", MASS, INERTIA, (half, 0.0, 0.0), (0.0, SPEED * half, SPEED)),),
        joints=(Revolute("hinge", "pawl", (-half, 0.0), GROUND, (0.0, 0.0)),),
        forces=(Torque("spring", "pawl", torque=-TORQUE),),
        contacts=(
            PointLineContact("stop", "pawl", (half, 0.0), GROUND, (0.0, 0.0), (0.0, 1.0), restitution=restitution),
        ),
        outputs=(
            Output("kinetic", "energy.kinetic", ""),
            Output("work", "energy.work", ""),
            Output("gap", "stop.gap", ""),
        ),
        settings=Settings(relative_tolerance=1e-11),
    )


def memory():
    """Largest resident size so far [MB]."""
    size = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return size / (2**20 if sys.platform == "darwin" else 2**10)


def run_a_million():
    """Run them, and return by how much the process has grown [MB], and what the motion has come to."""
    simulation = Simulation(rattling_pawl())
    energy = simulation.read()["kinetic"]
    simulation.advance(1000.5 * PERIOD)
    before = memory()
    for k in range(2, 1001):
        simulation.advance((1000 * k + 0.5) * PERIOD)
    grown = memory() - before
    impacts = int(simulation.counters[codes.COUNT_IMPACTS])
    return grown, impacts, simulation.field("y_end")[:3], simulation.read(), simulation.field("last_impact"), energy


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="needs the resource module")
def test_a_million_impacts_neither_drift_nor_grow():
    """In a process of its own: one in which other tests have run grows by what they have left to be collected."""
    with ProcessPoolExecutor(1, get_context("spawn")) as processes:
        grown, impacts, place, found, last, energy = processes.submit(run_a_million).result()
    assert grown < 1.0
    assert impacts == MILLION
    x, y, angle = place
    assert math.hypot(x - LENGTH / 2 * math.cos(angle), y - LENGTH / 2 * math.sin(angle)) < 1e-9
    assert min(found["gap"], 0.0) >= -1e-9
    # with e = 1 nothing damps what each hop adds: 3e-15 of its energy
    assert abs(found["kinetic"] - found["work"] - energy) < 1e-8 * energy
    assert last[codes.RECORD_CLOSING_SPEED] == pytest.approx(SPEED * LENGTH, abs=1e-9)
    assert last[codes.RECORD_TIME] == pytest.approx(MILLION * PERIOD, rel=1e-7)


def test_the_cost_of_an_impact_does_not_grow():
    """Internal steps per impact, as many at the end of a long run as at its beginning."""
    simulation = Simulation(rattling_pawl())
    counts = []
    for k in range(1, 101):
        before = int(simulation.counters[codes.COUNT_STEPS])
        simulation.advance((200 * k + 0.5) * PERIOD)
        counts.append(int(simulation.counters[codes.COUNT_STEPS]) - before)
    assert max(counts[1:]) - min(counts[1:]) <= 4
