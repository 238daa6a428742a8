"""The dense output of a step: its coefficients, and the state at any instant within it.

With t from 0 to 1 over the step and r = 1 - t,

    y = d0 + t (d1 + r (d2 + t (d3 + r (d4 + t (d5 + ...))))),

in which d0 to d3 are the cubic through values and slopes at both ends of the step (Hermite), and each row beyond adds a
degree, by weights of the method: the form of Hairer's CONTD5 and CONTD8 (Solving ODEs I, II.6).

Coordinates have accelerations at both ends, too. The quintic through places, rates and accelerations is closer where
steps are of order 5, by ten times and more. Where Baumgarte's gains bring drift back, as in the paper's models, the
method's own weights are kept.
"""

from __future__ import annotations

from .. import codes
from ..tables.declare import Array
from ..tables.method import CUBIC_ROWS, METHOD, QUINTIC_ROWS
from ..tables.motion import Loads, Stages
from ..tables.parts import Options
from ..tables.sizes import Sizes
from .compiler.subset import jit, keep_apart

_STAGES = METHOD.stages
_LAST = METHOD.last
_ROWS = METHOD.dense_rows
_DENSE = METHOD.dense
_OWN_ROWS = CUBIC_ROWS + len(_DENSE)
#: Whether coordinates are on quintics.
QUINTIC = _ROWS >= QUINTIC_ROWS
#: What has come by no more than this part of the way that forces alone would have taken a body stands.
_STANDS = 4e-15


@jit
def has_gains(block: Array) -> bool:
    """Whether Baumgarte's gains bring back what has drifted off the rows."""
    settings = Options(block).settings
    return bool(settings[codes.BAUMGARTE_ALPHA] != 0.0 or settings[codes.BAUMGARTE_BETA] != 0.0)


@jit
def write_dense(block: Array, h: float) -> None:
    """Coefficients of the step of size `h` [s] from y_start to y_new, whose derivatives are known, into `new_dense`."""
    keep_apart()
    n = Sizes(block).unknowns
    s = Stages(block)
    k = s.derivatives
    dense = s.new_dense
    first = 0
    if QUINTIC and not has_gains(block):
        first = Sizes(block).coordinates
        write_motion(block, h, s.y_new, dense)
    for i in range(first, n):
        change = s.y_new[i] - s.y_start[i]
        bend = h * k[0, i] - change
        dense[0, i] = s.y_start[i]
        dense[1, i] = change
        dense[2, i] = bend
        dense[3, i] = change - h * k[_LAST, i] - bend
        for row in range(CUBIC_ROWS, _OWN_ROWS):
            total = _DENSE[row - CUBIC_ROWS, 0] * k[0, i]
            for j in range(1, _STAGES):
                if _DENSE[row - CUBIC_ROWS, j] != 0.0:
                    total += _DENSE[row - CUBIC_ROWS, j] * k[j, i]
            dense[row, i] = h * total
        for row in range(_OWN_ROWS, _ROWS):
            dense[row, i] = 0.0


@jit
def write_motion(block: Array, h: float, y: Array, dense: Array) -> None:
    """Coefficients of the coordinates in the step of size `h` [s] from y_start to `y`, near y_new, in `dense`."""
    keep_apart()
    n = Sizes(block).coordinates
    s = Stages(block)
    k = s.derivatives
    free = Loads(block).free_acceleration
    along = turning = 0.0
    for i in range(0, n, 3):
        along = max(along, abs(free[i]), abs(free[i + 1]))
        turning = max(turning, abs(free[i + 2]))
    for i in range(n):
        change = y[i] - s.y_start[i]
        begins = h * s.y_start[n + i]
        ends = h * y[n + i]
        bends = 0.5 * h * h * k[0, n + i]
        bend = begins - change
        last = change - ends - bend
        dense[0, i] = s.y_start[i]
        dense[1, i] = change
        dense[2, i] = bend
        dense[3, i] = last
        dense[4, i] = bends + bend - last
        dense[5, i] = 0.5 * h * h * k[_LAST, n + i] + bend + 2.0 * last - dense[4, i]
        least = _STANDS * h * h * (turning if i % 3 == 2 else along)
        if abs(change) <= least and abs(begins) <= least and abs(ends) <= least:  # what holds it leaves rounding
            for row in range(2, _ROWS):
                dense[row, i] = 0.0


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
