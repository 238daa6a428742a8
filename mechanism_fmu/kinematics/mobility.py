"""Degrees of freedom, and the constraint rows that depend on others."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..model import Mechanism
from .equations import Equations, FloatArray
from .rank import independence
from .solve import NEWTON, close

#: A row belongs to a dependency when its share is larger than this part of the largest one.
_SHARE = 1e-6
#: How far from a configuration the rank is looked at again, relative to the coordinates' size.
_NEARBY = 0.02


@dataclass(frozen=True)
class Dependency:
    """A constraint row that says nothing new: `row` follows from the rows `follows_from` (names as in `Equations`)."""

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
        nearby_rank: the largest rank in the configurations around this one that the rows allow.
        redundant: the rows that depend on others, in every configuration around as well as here.
        moving: coordinates that can move.
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
            f"{self.degrees_of_freedom} degrees of freedom"
        ]
        lines += [f"redundant: {dependency}" for dependency in self.redundant]
        if self.singular:
            lines.append(
                f"singular configuration: the rank is {self.nearby_rank} everywhere around, so that the motion can go "
                "on along more than one branch from here; start a little away from it"
            )
        return "\n".join(lines)


def mobility(mechanism: Mechanism, time: float = 0.0) -> Mobility:
    """Degrees of freedom and dependent rows of a mechanism, assembled from its start guess at `time` [s].

    Raises:
        KinematicsError: it cannot be assembled.
        MechanismError: a part of it cannot be right.
    """
    equations = Equations(mechanism)
    q = equations.assemble(time)
    here = independence(equations.at(q, time).jacobian)
    jacobian = equations.at(q, time).jacobian
    around = [independence(equations.at(p, time).jacobian) for p in _neighbours(equations, q, time, jacobian)]
    best = max([here, *around], key=lambda found: len(found.independent))
    redundant = []
    for number, row in enumerate(best.dependent):
        weights = np.abs(best.weights[number])
        shares = [k for k, w in zip(best.independent, weights, strict=True) if w > _SHARE * weights.max()]
        redundant.append(Dependency(equations.rows[row], tuple(equations.rows[k] for k in shares)))
    free = _null_space(jacobian)
    moving = np.abs(free).max(axis=1) > _SHARE if free.size else np.zeros(len(q), dtype=bool)
    return Mobility(
        coordinates=len(q),
        rows=len(equations.rows),
        rank=len(here.independent),
        nearby_rank=len(best.independent),
        redundant=tuple(redundant),
        moving=tuple(name for name, moves in zip(equations.coordinates, moving, strict=True) if moves),
    )


def _null_space(jacobian: FloatArray) -> FloatArray:
    """Orthonormal directions in which the rows do not change, shape (coordinates, directions)."""
    _, values, directions = np.linalg.svd(jacobian)
    rank = int(np.sum(values > values.max(initial=0.0) * 1e-9))
    free: FloatArray = directions[rank:].T
    return free


def _neighbours(equations: Equations, q: FloatArray, time: float, jacobian: FloatArray) -> list[FloatArray]:
    """Configurations a little away that close the rows, in all free directions and between them."""
    free = _null_space(jacobian)
    directions = [free @ weights for weights in np.vstack([np.eye(free.shape[1]), np.ones((1, free.shape[1]))])]
    size = _NEARBY * max(1.0, float(np.abs(q).max()))
    found = [close(equations, q + sign * size * direction, time) for direction in directions for sign in (1.0, -1.0)]
    return [p for p, left in found if left <= NEWTON.closed_within]
