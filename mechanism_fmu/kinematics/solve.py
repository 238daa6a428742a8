"""Newton's method for the position rows."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..engine.starting.assembly import CLOSED_WITHIN
from .equations import Equations, FloatArray

_STEPS = 40


def close(equations: Equations, q: FloatArray, time: float) -> tuple[FloatArray, float]:
    """Coordinates near q that close all rows at `time` [s], shape (coordinates,), and the largest row left open."""

    def rows_at(q: FloatArray) -> tuple[FloatArray, FloatArray]:
        rows = equations.at(q, time)
        return rows.residual, rows.jacobian

    return newton(rows_at, q)


def newton(rows_at: Callable[[FloatArray], tuple[FloatArray, FloatArray]], q: FloatArray) -> tuple[FloatArray, float]:
    """Where the rows vanish near q, by steps of least length, and the largest magnitude that is left of them.

    `rows_at` gives them, shape (rows,), and their derivatives, shape (rows, coordinates). After they are closed one
    more step is taken: it takes away what rounding allows.
    """
    best, least = q, np.inf
    for _ in range(_STEPS):
        residual, jacobian = rows_at(q)
        left = float(np.abs(residual).max(initial=0.0))
        if not left < np.inf:
            break
        settled = least <= CLOSED_WITHIN
        if left < least:
            best, least = q, left
        if settled or left == 0.0:
            break
        q = q - np.linalg.lstsq(jacobian, residual, rcond=1e-8)[0]
    return best, least
