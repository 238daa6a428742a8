"""Sensitivity analysis: Sobol indices, how much each variable matters near the optimum."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from ..fmu.description import Value
from .optimum_file import Optimum, near
from .search import Best, History
from .variation import Axis


@dataclass(frozen=True)
class Sensitivity:
    """Sobol indices of the objective, for variables that are uniform near the optimum.

    Attributes:
        names: of the variables.
        first: part of the objective's variance that each explains by itself, shape (variables,).
        total: part that is gone when each is kept still; more than `first` where variables act together.
        spread: standard deviation of the objective, in its unit.
        mean: of the objective.
        limits: of the neighbourhood, in each variable's unit of the file.
    """

    names: tuple[str, ...]
    first: npt.NDArray[np.float64]
    total: npt.NDArray[np.float64]
    spread: float
    mean: float
    limits: tuple[tuple[float, float], ...]


class NoIndicesError(ValueError):
    """There are no Sobol indices; the message says why."""


def sensitivity(optimum: Optimum, best: Best, history: History) -> Sensitivity | None:
    """The sensitivity of the optimum; None when nothing is asked for.

    By (variables + 2) count designs (A. Saltelli et al., Comput. Phys. Commun. 181 (2010)). Whole numbers are those
    next to the optimum's; variables with a list of values keep theirs.

    Raises:
        NoIndicesError: some neighbour gives no number, or all of them the same.
        InterruptedSearchError: somebody wants it to end.
    """
    around = optimum.around
    free = near(optimum.axes)
    if around is None:
        return None
    from scipy import stats  # takes a second to load

    history.allow(len(history.designs) + around.designs(len(free)))
    vicinity = [_vicinity(axis, best.design.values[axis.name], around.width) for axis in free]
    seen: list[float] = []

    def objective(fractions: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        points = [_design(best, vicinity, point) for point in fractions.T]
        values = [optimum.goal.value(result, optimum.task) for result in history.results_of(points)]
        seen.extend(np.nan if value is None else value for value in values)
        return np.array(seen[-len(values) :])

    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore", RuntimeWarning)
        found = stats.sobol_indices(
            func=objective,
            n=around.count,
            dists=[stats.uniform()] * len(free),
            rng=np.random.default_rng(optimum.seed),
        )
    missing = int(np.sum(~np.isfinite(seen)))
    if missing:
        raise NoIndicesError(f"near the optimum, {missing} of {len(seen)} designs give no number")
    if min(seen) == max(seen):
        value = f"{seen[0]:.9g} {optimum.goal.objective.unit or '1'}"
        raise NoIndicesError(f"near the optimum, the objective is {value} everywhere: no variable matters there")
    return Sensitivity(
        names=tuple(axis.name for axis in free),
        first=np.asarray(found.first_order),
        total=np.asarray(found.total_order),
        spread=float(np.std(seen)),
        mean=float(np.mean(seen)),
        limits=tuple((axis.low, axis.high) for axis in vicinity),
    )


def _vicinity(axis: Axis, value: Value, width: float) -> Axis:
    """The part of an axis that lies around a value, within its limits; of whole numbers at least one on each side."""
    half = 0.5 * width * (axis.high - axis.low)
    if axis.variable.type == "Integer":
        place, half = float(value), float(max(round(half), 1))
    else:
        place = axis.low + axis.fraction(float(value)) * (axis.high - axis.low)
    return replace(axis, low=max(place - half, axis.low), high=min(place + half, axis.high))


def _design(best: Best, vicinity: Sequence[Axis], fractions: npt.NDArray[np.float64]) -> dict[str, Value]:
    moved = {axis.name: axis.at(float(x)) for axis, x in zip(vicinity, fractions, strict=True)}
    return dict(best.design.values) | moved
