"""Trigonometric series of periodic samples: values anywhere, derivatives, collocation, largest values."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize_scalar

from .elements import FloatArray

ComplexArray = npt.NDArray[np.complex128]


def coefficients(samples: FloatArray) -> ComplexArray:
    """Coefficients c_0 .. c_H, shape (N // 2 + 1, ...), of the series through N samples at angles 2 pi j / N.

    f(theta) = Re(c_0 + 2 sum_h c_h exp(i h theta)). Of the highest harmonic of an even number of samples only the
    cosine is seen; half of it stands for either side, so that the series is the one of least bandwidth.
    """
    series = np.fft.rfft(samples, axis=0) / len(samples)
    if len(samples) % 2 == 0:
        series[-1] *= 0.5
    return np.asarray(series)


def evaluate(series: ComplexArray, angles: FloatArray, derivative: int = 0) -> FloatArray:
    """The series, or its `derivative`-th derivative by the angle, at `angles` [rad], shape (angles, ...)."""
    harmonics = np.arange(len(series))
    weights = np.where(harmonics == 0, 1.0, 2.0) * (1j * harmonics) ** derivative
    waves = np.exp(1j * np.multiply.outer(angles, harmonics)) * weights
    return np.asarray(np.tensordot(waves, series, axes=1).real)


def even_angles(count: int) -> FloatArray:
    """The angles 2 pi j / count [rad], shape (count,)."""
    return np.asarray(2.0 * math.pi / count * np.arange(count))


def resampled(samples: FloatArray, count: int) -> FloatArray:
    """Values of the series through `samples`, shape (N, ...), at `count` even angles, shape (count, ...)."""
    return samples if len(samples) == count else evaluate(coefficients(samples), even_angles(count))


def differentiation(count: int) -> FloatArray:
    """D with D f = df/dtheta at an odd number of even angles, shape (count, count), exact up to (count - 1) / 2 waves.

    Source: L. N. Trefethen, Spectral Methods in MATLAB, SIAM 2000, chapter 3; for odd numbers the cosecant has no
    cotangent beside it, and D D is the second derivative to the last harmonic.
    """
    if count % 2 == 0:
        raise ValueError(f"{count} points are even: the highest harmonic has no derivative there; take an odd number.")
    lag = np.subtract.outer(np.arange(count), np.arange(count))
    off = lag != 0
    entries = np.zeros((count, count))
    entries[off] = 0.5 * (-1.0) ** lag[off] / np.sin(math.pi * lag[off] / count)
    return entries


# The largest value of a periodic vector between its samples.

#: Of the interval between two samples, to which the place of the maximum is found.
_FINENESS = 1e-6


def peak(samples: FloatArray) -> tuple[float, float]:
    """Where a periodic vector is longest, in parts of its period from the first sample on, and how long it is there.

    Args:
        samples: shape (T, k) at T even times of one period; between them it is the trigonometric series through them.

    Source: trigonometric interpolation (L. N. Trefethen, Spectral Methods in MATLAB, SIAM 2000, chapter 3), its norm
        searched from each local maximum of the samples.
    """
    series = coefficients(samples)
    found = []
    norms = np.linalg.norm(samples, axis=1)
    step = 2 * math.pi / len(samples)
    for sample in np.flatnonzero((norms >= np.roll(norms, 1)) & (norms >= np.roll(norms, -1))):
        angle = even_angles(len(samples))[sample]
        best = minimize_scalar(
            lambda at: -_norm(series, at), bounds=(angle - step, angle + step), options={"xatol": _FINENESS * step}
        )
        found.append((-float(best.fun), float(best.x)))
    largest, angle = max(found)
    return angle / (2 * math.pi) % 1.0, largest


def _norm(series: ComplexArray, angle: float) -> float:
    return float(np.linalg.norm(evaluate(series, np.array([angle]))[0]))
