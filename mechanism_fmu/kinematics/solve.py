"""Newton's method for the position rows."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .equations import Equations, FloatArray


class Newton(NamedTuple):
    """Limits of the iteration: most steps, and how far rows may be open [m, rad, m2]."""

    steps: int = 40
    closed_within: float = 1e-12


NEWTON = Newton()


def close(equations: Equations, q: FloatArray, time: float) -> tuple[FloatArray, float]:
    """Coordinates near q that close all rows at `time` [s], by steps of least length, and what is left open.

    After it is closed, one more step is taken: it takes away what rounding allows.
    """
    q = q.copy()
    best, least = q, np.inf
    for _ in range(NEWTON.steps):
        rows = equations.at(q, time)
        left = float(np.abs(rows.residual).max(initial=0.0))
        if not left < np.inf:
            break
        settled = least <= NEWTON.closed_within
        if left < least:
            best, least = q, left
        if settled or left == 0.0:
            break
        q = q - np.linalg.lstsq(rows.jacobian, rows.residual, rcond=1e-10)[0]
    return best, least
