"""Periodic steady state of a bending linkage, by Fourier collocation."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .elastic_cycle import ElasticCycle
from .fourier import ComplexArray, FloatArray, coefficients, differentiation, evaluate, even_angles

#: What is left of the equations at all given times, in parts of the largest elastic energy's root.
TOLERANCE = 1e-10
#: A deviation that exceeds the quasi-static one by this is a resonance without damping, cut short by rounding.
_RESONANCE = 1e6
#: Harmonics of the first attempt; they are doubled until little enough is left.
_FIRST_HARMONICS = 16


@dataclass(frozen=True)
class PeriodicResponse:
    """Deviation from the rigid motion that repeats every period.

    Attributes:
        period: [s].
        series: Fourier coefficients, shape (harmonics + 1, n).
        residual: what is left of M u'' + C u' + K u = p at the given times, in parts of the motion, both
            measured by the root of the elastic energy that they have, or would make.
    """

    period: float
    series: ComplexArray
    residual: float

    def at(self, times: npt.ArrayLike, derivative: int = 0) -> FloatArray:
        """u, or its first or second derivative by time, at `times` [s], shape (times, n)."""
        speed = 2.0 * math.pi / self.period
        angles = speed * np.asarray(times, dtype=float)
        return evaluate(self.series, angles, derivative) * speed**derivative

    def samples(self, count: int, derivative: int = 0) -> FloatArray:
        """u, or a derivative by time, at `count` even times of one period, shape (count, n)."""
        return self.at(self.period / count * np.arange(count), derivative)


def periodic_response(cycle: ElasticCycle) -> PeriodicResponse:
    """The periodic solution of M u'' + C u' + K(t) u = p.

    u is a trigonometric series that fulfils the equations at 2 H + 1 even times, where M, C, K and p are read off the
    series through their samples; H grows until they are fulfilled at all T given times, to `TOLERANCE`. With more
    than T / 4 harmonics the samples could no longer tell, so that is where it ends, with a warning.

    Warns:
        UserWarning: T / 4 harmonics are not enough.

    Raises:
        ValueError: without damping a harmonic meets a resonance, so there is no periodic solution.
    """
    most = (cycle.samples - 2) // 4
    harmonics = min(_FIRST_HARMONICS, most)
    while True:
        found = _collocated(cycle, harmonics)
        if found.residual <= TOLERANCE:
            return found
        if harmonics == most:
            break
        harmonics = min(2 * harmonics, most)
    warnings.warn(
        f"{harmonics} harmonics, all that {cycle.samples} samples allow, fulfil the equations of the periodic motion "
        f"to {found.residual:.1g} only, not to {TOLERANCE:g}: give more samples of the cycle, or a smoother load.",
        stacklevel=2,
    )
    return found


def _collocated(cycle: ElasticCycle, harmonics: int) -> PeriodicResponse:
    """The series that fulfils the equations at 2 `harmonics` + 1 times."""
    count = 2 * harmonics + 1
    here = cycle.resampled(count)
    n = here.load.shape[1]
    d = differentiation(count) * (2.0 * math.pi / cycle.period)
    # Row (j, a), column (k, b): equation a at time j, coordinate b at time k.
    matrix = np.einsum("jab,jk->jakb", here.mass, d @ d) + np.einsum("jab,jk->jakb", here.damping, d)
    diagonal = np.arange(count)
    matrix[diagonal, :, diagonal, :] += here.stiffness
    try:
        u = np.linalg.solve(matrix.reshape(count * n, count * n), here.load.reshape(-1)).reshape(count, n)
    except np.linalg.LinAlgError:
        u = np.full((count, n), np.inf)
    if not here.size(u) <= _RESONANCE * here.size(here.static()):
        raise ValueError(
            "there is no periodic motion: undamped, the linkage resonates with a harmonic of its own cycle. Give it "
            "damping, 0.02 for instance, or another speed."
        )
    series = coefficients(u)
    return PeriodicResponse(cycle.period, series, _left_over(cycle, series))


def _left_over(cycle: ElasticCycle, series: ComplexArray) -> float:
    angles, speed = even_angles(cycle.samples), 2.0 * math.pi / cycle.period
    u, v, a = (evaluate(series, angles, k)[..., None] * speed**k for k in range(3))
    rest = cycle.mass @ a + cycle.damping @ v + cycle.stiffness @ u - cycle.load[..., None]
    bent, wrong = cycle.size(u[..., 0]), cycle.size(np.asarray(np.linalg.solve(cycle.stiffness, rest)[..., 0]))
    return wrong / bent if bent > 0.0 else 0.0
