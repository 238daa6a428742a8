"""The engine's own motion: what a simulated mechanism does, driven or not."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..kinematics import KinematicMotion
from ..model import Mechanism
from ..simulation import Simulation
from .elements import FloatArray


def simulated_motion(
    mechanism: Mechanism, simulation: Simulation, times: Sequence[float] | FloatArray
) -> KinematicMotion:
    """Positions, velocities and accelerations of a simulation of a mechanism at `times` [s], which increase.

    The simulation goes on to the last of them, with its inputs held; in an impact, velocities are those behind it.

    Raises:
        SimulationError: the motion cannot go on, or the first of the times has passed.
    """
    count = 3 * len(mechanism.bodies)
    rows = []
    for time in times:
        simulation.advance(float(time))
        simulation.read_rates()  # leaves the state and its derivative in the work fields
        state, rates = simulation.field("y_at"), simulation.field("dy_at")
        rows.append(np.concatenate([state[: 2 * count], rates[count : 2 * count]]))
    table = np.array(rows).reshape(-1, 3, count)
    names = tuple(f"{body.name}.{c}" for body in mechanism.bodies for c in ("x", "y", "angle"))
    return KinematicMotion(names, np.asarray(times, dtype=float), table[:, 0], table[:, 1], table[:, 2])
