"""The elastic acceleration fed back into the inertia forces, again and again."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass

import numpy as np

from .elastic_cycle import ElasticCycle
from .fourier import FloatArray, coefficients, evaluate, even_angles

#: A change of this part of the deviation ends the iteration.
TOLERANCE = 1e-9
#: Rounds at most; a series that has not settled by then will not.
_MOST_ROUNDS = 100
#: Harmonics below this part of the largest are rounding; fed back, they would grow.
_ROUNDING = 1e-13


@dataclass(frozen=True)
class Feedback:
    """Where the iteration ended.

    Attributes:
        displacement: u with the least change, at the samples of the cycle, shape (T, n).
        changes: of each round, in parts of the quasi-static deviation (roots of elastic energy), shape (rounds,).
        converged: whether the last change is below `TOLERANCE`.
    """

    displacement: FloatArray
    changes: FloatArray
    converged: bool


def fed_back(cycle: ElasticCycle) -> Feedback:
    """u_0 = K^-1 p, then u_(k+1) = K^-1 (p - C u_k' - M u_k''): what the paper's kineto-elastodynamics calls for.

    Each round multiplies harmonic h of a mode of natural frequency omega by (h Omega / omega)^2, so it converges only
    while every harmonic that is there stays below every natural frequency; otherwise the changes shrink at first and
    grow from then on, as those of an asymptotic series. The iteration stops as soon as a change is not less than the
    one before, and gives what had changed least. `periodic_response` solves the same equations at any speed.

    Warns:
        UserWarning: it stopped before it converged.
    """
    speed = 2.0 * math.pi / cycle.period
    static = cycle.static()
    whole = cycle.size(static)
    u = best = static
    changes: list[float] = []
    while len(changes) < _MOST_ROUNDS:
        new = _once_more(cycle, u, speed)
        changes.append(cycle.size(new - u) / whole if whole > 0.0 else 0.0)
        if not (len(changes) == 1 or changes[-1] < changes[-2]):
            break
        u = best = new
        if changes[-1] <= TOLERANCE:
            break
    found = Feedback(best, np.array(changes), changes[-1] <= TOLERANCE)
    if not found.converged:
        warnings.warn(
            f"the elastic acceleration, fed back, settles to {found.changes.min():.1g} of the quasi-static deviation "
            f"after {len(changes)} rounds and no further: harmonics of the cycle reach natural frequencies. Take "
            "periodic_response.",
            stacklevel=2,
        )
    return found


def _once_more(cycle: ElasticCycle, u: FloatArray, speed: float) -> FloatArray:
    series, angles = coefficients(u), even_angles(cycle.samples)
    series = np.where(np.abs(series) > _ROUNDING * np.abs(series).max(axis=0), series, 0.0)
    v, a = (evaluate(series, angles, k)[..., None] * speed**k for k in (1, 2))
    rest = cycle.load[..., None] - cycle.damping @ v - cycle.mass @ a
    return np.asarray(np.linalg.solve(cycle.stiffness, rest)[..., 0])
