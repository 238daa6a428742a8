"""The rows of the guided ratchet at its impact, written down by hand, and differentiated by differences."""

from __future__ import annotations

import math

import numpy as np

from .bench import CRANK, HINGES, PAWL, RADIUS, FloatArray, tooth

_STEP = 1e-4


def distance_to_face(q: FloatArray) -> float:
    """Of the tip of the pawl from the face of the base case's tooth [m], positive outside; q of shape (9,).

    The face is the line from the root P0 to the apex of the tooth that follows, whose slope begins one pitch behind.
    """
    return _distance(q, *_face(float(q[8])))


def rows_by_hand(q: FloatArray) -> FloatArray:
    """Derivatives of hinges, slope and face in x, y and angle of crank, pawl and wheel, shape (8, 9)."""
    columns = []
    for k in range(9):
        step = _STEP * np.eye(9)[k]
        near = _conditions(q + step) - _conditions(q - step)
        far = _conditions(q + 2 * step) - _conditions(q - 2 * step)
        columns.append((8 * near - far) / (12 * _STEP))
    return np.transpose(columns)


def _conditions(q: FloatArray) -> FloatArray:
    """Zero at the impact, shape (8,)."""
    xc, yc, phi, xp, yp, gamma, xw, yw, _ = (float(value) for value in q)
    half = CRANK / 2
    return np.array(
        [
            xc - half * math.cos(phi) - HINGES,
            yc - half * math.sin(phi),
            xp - PAWL / 2 * math.cos(gamma) - xc - half * math.cos(phi),
            yp - PAWL / 2 * math.sin(gamma) - yc - half * math.sin(phi),
            xw,
            yw,
            _distance(q, *_slope(float(q[8]))),
            _distance(q, *_face(float(q[8]))),
        ]
    )


def _slope(psi: float) -> tuple[float, float]:
    """Direction from P0 along the slope [rad], and the side that is outside."""
    shape = tooth(10, 90)
    x, y = float(shape.apex[0]) - RADIUS, float(shape.apex[1])
    return psi + math.atan2(y, x), 1.0


def _face(psi: float) -> tuple[float, float]:
    """Direction from P0 along the face of the tooth ahead [rad], and the side that is outside."""
    shape = tooth(10, 90)
    pitch = float(shape.pitch)
    x, y = float(shape.apex[0]), float(shape.apex[1])
    # the apex of the tooth ahead, turned forward by a pitch
    ahead = math.cos(pitch) * x - math.sin(pitch) * y - RADIUS, math.sin(pitch) * x + math.cos(pitch) * y
    return psi + math.atan2(ahead[1], ahead[0]), -1.0


def _distance(q: FloatArray, direction: float, side: float) -> float:
    tip = q[3] + PAWL / 2 * math.cos(q[5]), q[4] + PAWL / 2 * math.sin(q[5])
    root = q[6] + RADIUS * math.cos(q[8]), q[7] + RADIUS * math.sin(q[8])
    return float(side * (-math.sin(direction) * (tip[0] - root[0]) + math.cos(direction) * (tip[1] - root[1])))
