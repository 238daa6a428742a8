"""The largest value of a periodic vector between its samples."""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import minimize_scalar

from .fourier import ComplexArray, FloatArray, coefficients, evaluate, even_angles

#: Of the interval between two samples, to which the place of the maximum is found.
_FINENESS = 1e-6


def peak(samples: FloatArray) -> tuple[float, float]:
    """Where a periodic vector is longest, in parts of its period from the first sample on, and how long it is there.

    Args:
        samples: shape (T, k) at T even times of one period; between them it is the trigonometric series through them.
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
