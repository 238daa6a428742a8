"""Cost of an impact: a light pawl that rattles on its stop, by `solve_ivp` with a terminal event, and by the engine."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from mechanism_fmu import codes
from mechanism_fmu.model import GROUND, Body, Mechanism, PointLineContact, Revolute, Settings, Torque, TorsionSpring
from mechanism_fmu.simulation import Simulation

from .timing import Comparison, batch, in_turns, require_agreement

Vector = NDArray[np.float64]

LENGTH, MASS, INERTIA = 0.02, 1e-3, 1e-6
TORQUE, STIFFNESS = 1e-2, 0.05
SPEED = 0.5
ABOUT_HINGE = INERTIA + MASS * (LENGTH / 2) ** 2
_TOLERANCE = 1e-9
_IMPACTS = 50
_ENGINE_IMPACTS = 2000
_LEAST_RATIO = 20.0


def compare(rounds: int) -> list[Comparison]:
    """Compare over the same hops; the baseline has the advantage of a single coordinate."""
    mechanism = pawl()
    simulation = Simulation(mechanism)
    _until(simulation, _IMPACTS)
    require_agreement("times of impacts", plain(_IMPACTS), [simulation.field("last_impact")[codes.RECORD_TIME]], 1e-8)

    def engine() -> None:
        _until(simulation, int(simulation.counters[codes.COUNT_IMPACTS]) + _ENGINE_IMPACTS)

    slow, fast = in_turns(
        lambda: batch(lambda: plain(_IMPACTS), 1) / _IMPACTS,
        lambda: batch(engine, 1) / _ENGINE_IMPACTS,
        rounds,
    )
    return [Comparison("one impact and the hop to the next", "rattling pawl, e = 1", slow, fast, _LEAST_RATIO)]


def plain(impacts: int) -> list[float]:
    """Time of the last of so many impacts, in the pawl's angle alone."""
    time, state = 0.0, np.array([0.0, SPEED])

    def rates(_time: float, y: Vector) -> list[float]:
        return [y[1], -(TORQUE + STIFFNESS * y[0]) / ABOUT_HINGE]

    def touches(_time: float, y: Vector) -> float:
        return float(y[0])

    touches.terminal = True  # type: ignore[attr-defined]
    touches.direction = -1.0  # type: ignore[attr-defined]
    for _ in range(impacts):
        found = solve_ivp(rates, (time, time + 1.0), state, events=touches, rtol=_TOLERANCE, atol=_TOLERANCE * 1e-6)
        time = float(found.t_events[0][0])
        state = np.array([0.0, -found.y_events[0][0][1]])
    return [time]


def _until(simulation: Simulation, impacts: int) -> None:
    """Advance by steps of about four hops until there have been so many impacts."""
    step = 8 * SPEED * ABOUT_HINGE / TORQUE
    while simulation.counters[codes.COUNT_IMPACTS] < impacts - 4:
        simulation.advance(simulation.time + step)
    while simulation.counters[codes.COUNT_IMPACTS] < impacts:
        simulation.advance(simulation.time + step / 16)


def pawl() -> Mechanism:
    """The pawl, just leaving its stop."""
    half = LENGTH / 2
    return Mechanism(
        bodies=(Body("pawl", MASS, INERTIA, (half, 0.0, 0.0), (0.0, SPEED * half, SPEED)),),
        joints=(Revolute("hinge", "pawl", (-half, 0.0), GROUND, (0.0, 0.0)),),
        forces=(Torque("spring", "pawl", torque=-TORQUE), TorsionSpring("coil", "pawl", stiffness=STIFFNESS)),
        contacts=(PointLineContact("stop", "pawl", (half, 0.0), GROUND, (0.0, 0.0), (0.0, 1.0), restitution=1.0),),
        settings=Settings(relative_tolerance=_TOLERANCE),
    )
