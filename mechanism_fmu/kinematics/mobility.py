"""Degrees of freedom, and the constraint rows that depend on others: their rank here and around."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import NamedTuple

import numpy as np

from ..model import Mechanism
from ..tolerances import CLOSED_WITHIN
from .equations import Equations, FloatArray, KinematicsError, newton

# Rank of constraint rows: which of them depend on others, and what they leave free.

#: A row depends on those before it when less than this part of its length is independent of them. Positions are closed
#: to 1e-12 only, and next to a singular one they may be off by the root of that.
DEPENDENT_BELOW = 1e-6


class Independence(NamedTuple):
    """Rows in their order, each against those before it.

    `independent` are the numbers of the rows that add to the rank; `weights` says of each other row how it is combined
    of these, shape (rows that depend, independent rows).
    """

    independent: list[int]
    dependent: list[int]
    weights: FloatArray


def independence(rows: FloatArray) -> Independence:
    """Sort rows of length 1, shape (rows, coordinates), into independent and dependent ones."""
    independent: list[int] = []
    dependent: list[int] = []
    basis = np.zeros((0, rows.shape[1]))
    for k, row in enumerate(rows):
        left = row - basis.T @ (basis @ row)
        left -= basis.T @ (basis @ left)  # once more: the first time leaves rounding of the basis
        size = float(np.linalg.norm(left))
        if size > DEPENDENT_BELOW:
            basis = np.vstack([basis, left / size])
            independent.append(k)
        else:
            dependent.append(k)
    weights = np.linalg.lstsq(rows[independent].T, rows[dependent].T, rcond=None)[0].T
    return Independence(independent, dependent, np.asarray(weights, dtype=np.float64))


def free_directions(rows: FloatArray) -> FloatArray:
    """Orthonormal directions in which no row changes, shape (coordinates, directions)."""
    _, values, directions = np.linalg.svd(rows)
    free: FloatArray = directions[int(np.sum(values > DEPENDENT_BELOW)) :].T
    return free


# The configurations around one: where the rank of the rows is what it usually is.

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

    return newton(equations, rows_at, q + equations.from_lengths(step * way))


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


#: A row belongs to a dependency when its share is larger than this part of the largest one.
_SHARE = 1e-6


@dataclass(frozen=True)
class Dependency:
    """A constraint row that says nothing new: `row` follows from the rows `follows_from` (names as in `Equations`).

    Attributes:
        row: its name, e.g. "hinge[0]".
        follows_from: names of the rows from which it follows.
    """

    row: str
    follows_from: tuple[str, ...]

    def __str__(self) -> str:
        return f"{self.row} follows from {', '.join(self.follows_from)}" if self.follows_from else f"{self.row} is zero"


@dataclass(frozen=True)
class Mobility:
    """What the constraint rows of a mechanism leave free in one configuration.

    Attributes:
        coordinates: how many there are, 3 a body and the contact coordinates.
        rows: how many constraint rows, drivers included.
        rank: how many of them are independent of each other here.
        nearby_rank: the largest rank in the configurations around this one that joints and contacts allow.
        redundant: the rows that depend on others, in every configuration around as well as here.
        moving: coordinates that can move, here or around.
    """

    coordinates: int
    rows: int
    rank: int
    nearby_rank: int
    redundant: tuple[Dependency, ...]
    moving: tuple[str, ...]

    @property
    def degrees_of_freedom(self) -> int:
        """What remains free around this configuration: coordinates minus rank nearby."""
        return self.coordinates - self.nearby_rank

    @property
    def singular(self) -> bool:
        """Whether the rank drops in this very configuration: the motion can branch here."""
        return self.rank < self.nearby_rank

    def __str__(self) -> str:
        """Several lines that say all of it."""
        lines = [
            f"{self.coordinates} coordinates, {self.rows} constraint rows, rank {self.rank}: "
            f"{self.degrees_of_freedom} degree{'' if self.degrees_of_freedom == 1 else 's'} of freedom"
        ]
        lines += [f"redundant: {dependency}" for dependency in self.redundant]
        if self.singular:
            lines.append(
                f"singular configuration: the rank is {self.nearby_rank} around it, so that from here the motion can "
                "go on along more than one branch, or a driver cannot go on; start a little away from it"
            )
        return "\n".join(lines)


def mobility(mechanism: Mechanism, time: float = 0.0) -> Mobility:
    """Degrees of freedom and dependent rows of a mechanism, assembled from its start guess at `time` [s].

    Of rows that depend on each other the last one is reported as redundant.

    Args:
        mechanism: whose values are plain numbers.
        time: at which it is assembled [s].

    Raises:
        KinematicsError: it cannot be assembled, or the time is not finite.
        MechanismError: a part of it cannot be right.

    Source: textbook: coordinates less the rank of Phi_q, after E. J. Haug, Computer Aided Kinematics and Dynamics;
        singular configurations: docs/decisions/010-singular-configurations.md.
    """
    if not math.isfinite(time):
        raise KinematicsError(f"time = {time:g} s is not finite; give one at which the mechanism can be assembled.")
    equations = Equations(mechanism, time)
    here = equations.balanced(equations.at(equations.start, time).jacobian)
    around = [here, *rows_around(equations, equations.start, time)]
    found = [independence(rows) for rows in around]
    best = max(found, key=lambda one: len(one.independent))
    redundant = []
    for row, weights in zip(best.dependent, np.abs(best.weights), strict=True):
        shares = [k for k, w in zip(best.independent, weights, strict=True) if w > _SHARE * weights.max()]
        redundant.append(Dependency(equations.rows[row], tuple(equations.rows[k] for k in shares)))
    regular = [rows for rows, one in zip(around, found, strict=True) if len(one.independent) == len(best.independent)]
    return Mobility(
        coordinates=len(equations.coordinates),
        rows=len(equations.rows),
        rank=len(found[0].independent),
        nearby_rank=len(best.independent),
        redundant=tuple(redundant),
        moving=moving(equations, regular),
    )
