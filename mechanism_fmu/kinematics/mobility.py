"""Degrees of freedom, and the constraint rows that depend on others."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..model import Mechanism
from .around import moving, rows_around
from .equations import Equations
from .errors import KinematicsError
from .rank import independence

#: A row belongs to a dependency when its share is larger than this part of the largest one.
_SHARE = 1e-6


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

    Raises:
        KinematicsError: it cannot be assembled, or the time is not finite.
        MechanismError: a part of it cannot be right.
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
