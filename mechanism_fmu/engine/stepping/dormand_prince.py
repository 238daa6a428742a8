"""The Dormand-Prince 5(4) pair with its dense output (Hairer, Nørsett, Wanner: Solving ODEs I, II.5 and II.6)."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Stages
from ...tables.parts import Contacts, Options
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..constraints.rows import row_count
from ..contacts.complementarity import push_ratio
from ..dynamics.acceleration import derivative
from ..dynamics.inputs import set_time
from .singular import independence

_C2, _C3, _C4, _C5 = 1 / 5, 3 / 10, 4 / 5, 8 / 9
_A21 = 1 / 5
_A31, _A32 = 3 / 40, 9 / 40
_A41, _A42, _A43 = 44 / 45, -56 / 15, 32 / 9
_A51, _A52, _A53, _A54 = 19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729
_A61, _A62, _A63, _A64, _A65 = 9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656
_B1, _B3, _B4, _B5, _B6 = 35 / 384, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84
_E1, _E3, _E4, _E5, _E6, _E7 = 71 / 57600, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40
_D1, _D3, _D4 = -12715105075 / 11282082432, 87487479700 / 32700410799, -10690763975 / 1880347072
_D5, _D6, _D7 = 701980252875 / 199316789632, -1453857185 / 822651844, 69997945 / 29380423

#: Order of the step and of its dense output; measured in tests/convergence.
ORDER = 5
DENSE_ORDER = 4
#: Absolute tolerance as a fraction of the relative one, for every unknown (m, rad, m/s, rad/s, J).
ABSOLUTE_FRACTION = 1e-3


@jit
def try_step(block: Array, start: float, size_: float) -> float:
    """One step of `size_` [s] from y_start at the time `start` [s], with derivatives[0] there; return the error norm.

    The step is accurate enough when that is at most 1.

    Writes y_new, all seven derivatives (the last one belongs to y_new), the dense output, and `contacts.least_push`.
    """
    n = Sizes(block).unknowns
    s = Stages(block)
    k = s.derivatives
    y = s.y_start
    h = size_
    s.tried[0] = start
    s.tried[1] = h
    s.stage[0] = 0
    least = Contacts(block).least_push
    for c in range(least.shape[0]):
        least[c] = 0.0
    for i in range(n):
        s.y_stage[i] = y[i] + h * _A21 * k[0, i]
    _stage(block, start + h * _C2, s.y_stage, k[1])
    for i in range(n):
        s.y_stage[i] = y[i] + h * (_A31 * k[0, i] + _A32 * k[1, i])
    _stage(block, start + h * _C3, s.y_stage, k[2])
    for i in range(n):
        s.y_stage[i] = y[i] + h * (_A41 * k[0, i] + _A42 * k[1, i] + _A43 * k[2, i])
    _stage(block, start + h * _C4, s.y_stage, k[3])
    for i in range(n):
        s.y_stage[i] = y[i] + h * (_A51 * k[0, i] + _A52 * k[1, i] + _A53 * k[2, i] + _A54 * k[3, i])
    _stage(block, start + h * _C5, s.y_stage, k[4])
    for i in range(n):
        slope = _A61 * k[0, i] + _A62 * k[1, i] + _A63 * k[2, i] + _A64 * k[3, i] + _A65 * k[4, i]
        s.y_stage[i] = y[i] + h * slope
    _stage(block, start + h, s.y_stage, k[5])
    for i in range(n):
        slope = _B1 * k[0, i] + _B3 * k[2, i] + _B4 * k[3, i] + _B5 * k[4, i] + _B6 * k[5, i]
        s.y_new[i] = y[i] + h * slope
    _stage(block, start + h, s.y_new, k[6])
    _write_dense(block, h)
    return _error_norm(block, h)


@jit
def _stage(block: Array, time: float, y: Array, dy: Array) -> None:
    """The derivative at one stage, with the inputs' values at its `time` [s]."""
    keep_small()
    set_time(block, time)
    derivative(block, y, dy)
    _note_pushes(block)
    s = Stages(block)
    s.stage[0] += 1
    s.independence[s.stage[0]] = independence(block)


@jit
def _note_pushes(block: Array) -> None:
    """After an acceleration: keep the least force of every closed contact."""
    table = Contacts(block)
    count = row_count(block)
    for c in range(table.mode.shape[0]):
        if table.mode[c] == codes.CLOSED:
            table.least_push[c] = min(table.least_push[c], push_ratio(block, c, count))


@jit
def _error_norm(block: Array, h: float) -> float:
    """Root mean square of the local error over its tolerance."""
    n = Sizes(block).unknowns
    total = 0.0
    for i in range(n):
        error = scaled_error(block, i, h)
        total += error * error
    return math.sqrt(total / n)


@jit
def scaled_error(block: Array, i: int, h: float) -> float:
    """Local error of unknown `i` over its tolerance, in the step of size `h` [s] last tried."""
    s = Stages(block)
    k = s.derivatives
    relative = Options(block).settings[codes.RELATIVE_TOLERANCE]
    error: float = h * (_E1 * k[0, i] + _E3 * k[2, i] + _E4 * k[3, i] + _E5 * k[4, i] + _E6 * k[5, i] + _E7 * k[6, i])
    scale: float = relative * (ABSOLUTE_FRACTION + max(abs(s.y_start[i]), abs(s.y_new[i])))
    return error / scale


@jit
def _write_dense(block: Array, h: float) -> None:
    """Coefficients of the continuous extension of order 4, rows 0..4."""
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
        dense[3, i] = change - h * k[6, i] - bend
        dense[4, i] = h * (
            _D1 * k[0, i] + _D3 * k[2, i] + _D4 * k[3, i] + _D5 * k[4, i] + _D6 * k[5, i] + _D7 * k[6, i]
        )


@jit
def initial_step_size(block: Array) -> float:
    """A first step size from y_end and dy_end [s] (Hairer, Nørsett, Wanner, II.4, algorithm of the starting step)."""
    keep_small()
    n = Sizes(block).unknowns
    now = Course(block)
    s = Stages(block)
    relative = Options(block).settings[codes.RELATIVE_TOLERANCE]
    size_y = 0.0
    size_dy = 0.0
    for i in range(n):
        scale = relative * (ABSOLUTE_FRACTION + abs(now.y_end[i]))
        size_y += (now.y_end[i] / scale) * (now.y_end[i] / scale)
        size_dy += (now.dy_end[i] / scale) * (now.dy_end[i] / scale)
    size_y = math.sqrt(size_y / n)
    size_dy = math.sqrt(size_dy / n)
    first = 1e-6
    if size_y > 1e-5 and size_dy > 1e-5:
        first = 0.01 * size_y / size_dy
    for i in range(n):
        s.y_stage[i] = now.y_end[i] + first * now.dy_end[i]
    set_time(block, now.clock[codes.STEP_END] + first)
    derivative(block, s.y_stage, s.dy_at)
    bend = 0.0
    for i in range(n):
        scale = relative * (ABSOLUTE_FRACTION + abs(now.y_end[i]))
        difference = (s.dy_at[i] - now.dy_end[i]) / scale
        bend += difference * difference
    bend = math.sqrt(bend / n) / first
    steepest = max(size_dy, bend)
    second = max(1e-6, first * 1e-3)
    if steepest > 1e-15:
        second = math.pow(0.01 / steepest, 1.0 / ORDER)
    return min(100.0 * first, second)
