"""The configurations around one: where the rank of the rows is what it usually is."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import combinations

import numpy as np

from ..engine.starting.assembly import CLOSED_WITHIN
from .equations import Equations, FloatArray
from .rank import free_directions
from .solve import newton

#: How far away they are, relative to the size of the mechanism.
_STEP = 0.02
#: Between any two free directions, this many are tried: a branch of the motion may leave along any of them.
_BETWEEN = 8
#: A coordinate moves when its part of a free direction of length 1 is larger than this.
_MOVES = 1e-6


def rows_around(equations: Equations, q: FloatArray, time: float) -> list[FloatArray]:
    """Balanced Phi_q in configurations a little away from q that joints and contacts allow, whatever drivers say.

    Each is of shape (rows, coordinates); q has shape (coordinates,), `time` is in s.
    """
    free = free_directions(equations.balanced(equations.at(q, time).jacobian)[~equations.driving])
    found = []
    for direction in _directions(free.shape[1]):
        for sign in (1.0, -1.0):
            p, left = _go(equations, q, time, sign * (free @ direction))
            if left <= CLOSED_WITHIN:
                found.append(equations.balanced(equations.at(p, time).jacobian))
    return found


def _go(equations: Equations, q: FloatArray, time: float, way: FloatArray) -> tuple[FloatArray, float]:
    """One step from q along the unit vector `way` (in lengths), and back to the rows without giving it up."""
    still = ~equations.driving
    step = _STEP * equations.size

    def rows_at(p: FloatArray) -> tuple[FloatArray, FloatArray]:
        rows = equations.at(p, time)
        along = way @ equations.as_lengths(p - q) - step
        return np.append(rows.residual[still], along), np.vstack([rows.jacobian[still], equations.as_lengths(way)])

    return newton(rows_at, q + equations.from_lengths(step * way))


def moving(equations: Equations, configurations: Sequence[FloatArray]) -> tuple[str, ...]:
    """Names of the coordinates that can move in one of the configurations.

    Each is given by its balanced Phi_q, of shape (rows, coordinates).
    """
    moves = np.zeros(len(equations.coordinates), dtype=bool)
    for rows in configurations:
        moves |= np.abs(free_directions(rows)).max(axis=1, initial=0.0) > _MOVES
    return tuple(name for name, one in zip(equations.coordinates, moves, strict=True) if one)


def _directions(count: int) -> list[FloatArray]:
    """Unit vectors in a space of `count` free directions: along each of them, and between any two."""
    axes = np.eye(count)
    if count < 2:
        return list(axes)
    turns = [math.pi * k / _BETWEEN for k in range(_BETWEEN)]
    return [math.cos(t) * axes[a] + math.sin(t) * axes[b] for a, b in combinations(range(count), 2) for t in turns]
