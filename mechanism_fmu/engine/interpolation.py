"""The dense output of a step: its coefficients, and the state at any instant within it.

With t from 0 to 1 over the step and r = 1 - t,

    y = d0 + t (d1 + r (d2 + t (d3 + r (d4 + t (d5 + ...))))),

in which d0 to d3 are the cubic through values and slopes at both ends of the step (Hermite), and each row beyond adds a
degree, by weights of the method: the form of Hairer's CONTD5 and CONTD8 (Solving ODEs I, II.6).
"""

from __future__ import annotations

from ..tables.declare import Array
from ..tables.method import CUBIC_ROWS, METHOD
from ..tables.motion import Stages
from ..tables.sizes import Sizes
from .compiler.subset import jit, keep_apart

_STAGES = METHOD.stages
_LAST = METHOD.last
_ROWS = METHOD.dense_rows
_DENSE = METHOD.dense


@jit
def write_dense(block: Array, h: float) -> None:
    """Coefficients of the step of size `h` [s] from y_start to y_new, whose derivatives are known, into `new_dense`."""
    keep_apart()
    n = Sizes(block).unknowns
    s = Stages(block)
    k = s.derivatives
    dense = s.new_dense
    for i in range(n):
        change = s.y_new[i] - s.y_start[i]
        bend = h * k[0, i] - change
        dense[0, i] = s.y_start[i]
        dense[1, i] = change
        dense[2, i] = bend
        dense[3, i] = change - h * k[_LAST, i] - bend
        for row in range(CUBIC_ROWS, _ROWS):
            total = _DENSE[row - CUBIC_ROWS, 0] * k[0, i]
            for j in range(1, _STAGES):
                if _DENSE[row - CUBIC_ROWS, j] != 0.0:
                    total += _DENSE[row - CUBIC_ROWS, j] * k[j, i]
            dense[row, i] = h * total


@jit
def interpolate(dense: Array, fraction: float, y: Array) -> None:
    """Y at `fraction` (0..1) of the step whose coefficients are `dense`, shape (rows, unknowns)."""
    keep_apart()
    for i in range(y.shape[0]):
        y[i] = dense_value(dense, fraction, i)


@jit
def dense_value(dense: Array, fraction: float, i: int) -> float:
    """Unknown `i` alone of what `interpolate` gives."""
    rest = 1.0 - fraction
    value: float = dense[_ROWS - 1, i]
    for back in range(_ROWS - 1):
        row = _ROWS - 2 - back
        factor = fraction if row % 2 == 0 else rest
        value = dense[row, i] + factor * value
    return value
