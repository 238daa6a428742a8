"""Position, velocity and acceleration of a driven mechanism at given times."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..model import Mechanism
from .equations import Equations, FloatArray
from .errors import KinematicsError
from .follow import follow
from .state import state_at


@dataclass(frozen=True)
class KinematicMotion:
    """What a driven mechanism does.

    Attributes:
        coordinates: names of the columns, "<body>.x|y|angle" and "<contact>.alpha_i|alpha_j".
        time: shape (times,) [s].
        position, velocity, acceleration: q, qd, qdd, shape (times, coordinates) [m, rad and by s, by s2].
    """

    coordinates: tuple[str, ...]
    time: FloatArray
    position: FloatArray
    velocity: FloatArray
    acceleration: FloatArray

    def of(self, coordinate: str) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Position, velocity and acceleration of one coordinate, each of shape (times,).

        Raises:
            KinematicsError: there is no such coordinate.
        """
        if coordinate not in self.coordinates:
            raise KinematicsError(f"There is no coordinate {coordinate!r}; there are: {', '.join(self.coordinates)}.")
        k = self.coordinates.index(coordinate)
        return self.position[:, k], self.velocity[:, k], self.acceleration[:, k]


def analyse(mechanism: Mechanism, times: Sequence[float] | FloatArray) -> KinematicMotion:
    """Position, velocity and acceleration at `times` [s], which increase: Phi = 0, Phi_q qd = nu, Phi_q qdd = gamma.

    The mechanism is assembled from its start guess at the first time, with nothing held but by its drivers; from then
    on the motion is followed, in smaller steps than those of `times` where it needs them. Rows may be redundant.

    Raises:
        KinematicsError: drivers leave something free, contradict each other, or ask for what is out of reach.
        SingularConfigurationError: the motion comes to a configuration where the rank of the rows drops.
        MechanismError: a part of the mechanism cannot be right.
    """
    grid = np.asarray(times, dtype=float)
    if grid.ndim != 1 or len(grid) == 0 or not np.all(np.isfinite(grid)) or np.any(np.diff(grid) <= 0.0):
        raise KinematicsError("The times must be finite and increase; give at least one.")
    equations = Equations(replace(mechanism, held=()), grid[0])
    states = [state_at(equations, equations.start, grid[0])]
    for time in grid[1:]:
        states.append(follow(equations, states[-1], time))
    position, velocity, acceleration = (np.array([state[k] for state in states]) for k in (1, 2, 3))
    return KinematicMotion(equations.coordinates, grid, position, velocity, acceleration)
