"""How far numbers are off each other, and Phi_q, nu and gamma off differences of Phi along a motion."""

from __future__ import annotations

from typing import Any

import numpy as np

from mechanism_fmu.kinematics.equations import Equations

from .bench import FloatArray

#: Central differences of eighth order: weights at +-1, ... +-4 steps, of the first and of the second derivative.
_FIRST = (4 / 5, -1 / 5, 4 / 105, -1 / 280)
_SECOND = (-205 / 72, 8 / 5, -1 / 5, 8 / 315, -1 / 560)
_STEP = 0.02


def off_by(found: Any, wanted: Any) -> float:
    """The largest deviation [1], relative to the largest number wanted; arrays of one shape."""
    return float(np.abs(np.asarray(found) - np.asarray(wanted)).max() / np.abs(np.asarray(wanted)).max())


def joint_deviations(
    equations: Equations, q: FloatArray, rate: FloatArray, acceleration: FloatArray, time: float = 0.4
) -> tuple[float, float, float]:
    """How far Phi_q, nu and gamma are off the derivatives of Phi, in parts of the largest entry (1 at least).

    Along q(t) = q + q' t + q'' t^2 / 2: d Phi / dt = Phi_q q' - nu and d2 Phi / dt2 = Phi_q q'' - gamma.

    Args:
        equations: rows at any coordinates, whether they close or not.
        q: coordinates of the motion at the instant, shape (coordinates,).
        rate: their rates there, shape (coordinates,).
        acceleration: held during the motion, shape (coordinates,).
        time: of the drivers [s].
    """
    rows = equations.at(q, time, rate)

    def phi(place: FloatArray, when: float) -> FloatArray:
        return np.array(equations.at(place, when).residual)

    def along(t: float) -> FloatArray:
        return phi(q + rate * t + acceleration * t * t / 2, time + t)

    columns = [_first(lambda t, k=k: phi(q + t * np.eye(len(q))[k], time)) for k in range(len(q))]
    jacobian = _relative(np.transpose(columns), rows.jacobian)
    velocity = _relative(_first(along), rows.jacobian @ rate - rows.nu)
    second = _relative(_second(along), rows.jacobian @ acceleration - rows.gamma)
    return jacobian, velocity, second


def _first(function: object) -> FloatArray:
    f = function
    return np.asarray(
        sum(w * (f(k * _STEP) - f(-k * _STEP)) for k, w in enumerate(_FIRST, start=1)) / _STEP  # type: ignore[operator]
    )


def _second(function: object) -> FloatArray:
    f = function
    around = sum(w * (f(k * _STEP) + f(-k * _STEP)) for k, w in enumerate(_SECOND[1:], start=1))  # type: ignore[operator]
    return np.asarray((_SECOND[0] * f(0.0) + around) / _STEP**2)  # type: ignore[operator]


def _relative(found: FloatArray, wanted: FloatArray) -> float:
    return float(np.abs(found - wanted).max() / max(1.0, np.abs(wanted).max()))
