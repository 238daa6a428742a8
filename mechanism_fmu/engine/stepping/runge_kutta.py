"""One step: explicit by the tableau of `METHOD` (Hairer, Nørsett, Wanner: Solving ODEs I, II.4 and II.5), or implicit.

And its error, and the size of a first one.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.method import METHOD
from ...tables.motion import Course, Rubs, Stages
from ...tables.parts import Contacts, Options
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..constraints.friction_rows import rubs
from ..dynamics.acceleration import derivative
from ..dynamics.forces import set_time
from ..dynamics.scaling import moving_rate
from ..elementary import power
from ..interpolation import write_dense
from ..scales import rate_scale, write_scales
from ..vectors import clear
from .rosenbrock import error_of_implicit, implicit_stages, passed_on
from .stage import evaluate_stage, note_drift

_STAGES = METHOD.stages
_LAST = METHOD.last
_C = METHOD.c
_A = METHOD.a
_ERROR = METHOD.error
_ERROR_EXPONENT = METHOD.error_exponent

#: Absolute tolerance as a fraction of the relative one, for every unknown, in its scale.
ABSOLUTE_FRACTION = 1e-3
#: The first step where nothing is known of the motion, in parts of its time.
_FIRST_STEP = 1e-6
#: A guess of a first step is too short where the step before was so many times as long, or accelerations change so
#: much less than places and speeds: by them alone, it would be twice as long.
_OF_SECOND, _OF_STEEPEST = 4.0, 2.0**-5
#: It is then made so many times as long at most.
_BOLDLY = 64.0


@jit
def try_step(block: Array, start: float, size_: float) -> float:
    """One step of `size_` [s] from y_start at the time `start` [s], with derivatives[0] there; return the error norm.

    The step is accurate enough when that is at most 1. It is taken by the tableau of `METHOD`, or linearly implicit.

    Writes y_new, all derivatives (the last one belongs to y_new), the dense output, `contacts.least_push` and
    `most_push`, and by how much active rows are off at its end.
    """
    s = Stages(block)
    h = size_
    s.tried[0] = start
    s.tried[1] = h
    Course(block).counters[codes.COUNT_TRIES] += 1
    s.stage[0] = 0
    s.jams[0] = 0
    table = Contacts(block)
    for c in range(table.least_push.shape[0]):
        table.least_push[c] = math.inf
        table.most_push[c] = -math.inf
    if rubs(block):
        clear(Rubs(block).least_hold)
    implicit = Course(block).counters[codes.IMPLICIT] == 1
    if implicit:
        implicit_stages(block, start, h)
        s.stage[0] = _LAST - 1
    else:
        _explicit_stages(block, start, h)
    evaluate_stage(block, start + h, s.y_new, s.derivatives[_LAST])
    note_drift(block)
    if not implicit:
        write_dense(block, h)
    if not s.drift[0] + s.drift[1] < math.inf:  # of what is no number, nothing would be left
        return math.inf
    write_scales(block, moving_rate(block), h)
    return _error_norm(block, h)


@jit
def _explicit_stages(block: Array, start: float, h: float) -> None:
    """All stages of an explicit step but the last one, which is at y_new."""
    keep_small()
    s = Stages(block)
    k = s.derivatives
    y = s.y_start
    _euler(y, k[0], h * _A[1, 0], s.y_stage)
    evaluate_stage(block, start + h * _C[1], s.y_stage, k[1])
    for r in range(2, _LAST):  # the last one apart: to choose the target in the loop costs 3 % of the whole motion
        _weighted(k, _A[r], y, h, s.y_stage)
        evaluate_stage(block, start + h * _C[r], s.y_stage, k[r])
    _weighted(k, _A[_LAST], y, h, s.y_new)


@jit
def _euler(y: Array, dy: Array, h: float, target: Array) -> None:
    """An Euler step of size `h` [s] from y; all of shape (unknowns,)."""
    for i in range(y.shape[0]):
        target[i] = y[i] + h * dy[i]


@jit
def _weighted(k: Array, weights: Array, y: Array, h: float, target: Array) -> None:
    """Y + h (the sum of the derivatives by their weights, from left to right).

    A derivative without weight is not touched: it may be no number, and adding nothing can change the sign of zero.
    """
    for i in range(y.shape[0]):
        total = weights[0] * k[0, i]
        for j in range(1, _STAGES):
            if weights[j] != 0.0:
                total += weights[j] * k[j, i]
        target[i] = y[i] + h * total


@jit
def _error_norm(block: Array, h: float) -> float:
    """Root mean square of the local error over its tolerance."""
    n = Sizes(block).y_wear
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
    error: float = _ERROR[0] * k[0, i]
    for j in range(1, _STAGES):
        if _ERROR[j] != 0.0:
            error += _ERROR[j] * k[j, i]
    error *= h
    size = ABSOLUTE_FRACTION * s.scale[i] + max(abs(s.y_start[i]), abs(s.y_new[i]))
    if Course(block).counters[codes.IMPLICIT] == 1:
        error = error_of_implicit(block, i)
        size += passed_on(block, i, h)
    scale: float = relative * size
    return error / scale


@jit
def initial_step_size(block: Array, before: float) -> float:
    """A first step size from y_end and dy_end [s] (Hairer, Nørsett, Wanner, II.4, algorithm of the starting step).

    That takes all derivatives for as large as the first two, and so is too short by far for what flies or falls. Where
    the step due `before` [s], 0 at the start, was much longer, or accelerations change slowly, what moves may nearly
    change by its own size: to try again costs less than short steps, in which there are as many looks at outlines.
    """
    keep_small()
    n = Sizes(block).y_wear
    now = Course(block)
    s = Stages(block)
    rate = rate_scale(block)
    write_scales(block, rate, 0.0)
    relative = Options(block).settings[codes.RELATIVE_TOLERANCE]
    size_y = size_dy = 0.0
    for i in range(n):
        scale = relative * (ABSOLUTE_FRACTION * s.scale[i] + abs(now.y_end[i]))
        size_y += (now.y_end[i] / scale) * (now.y_end[i] / scale)
        size_dy += (now.dy_end[i] / scale) * (now.dy_end[i] / scale)
    size_y = math.sqrt(size_y / n)
    size_dy = math.sqrt(size_dy / n)
    least = _FIRST_STEP / rate
    first = least
    # what is no larger than its tolerance says nothing of how fast it may change
    if size_y > 1.0 and size_dy > 1e-5 * rate:
        first = 0.01 * size_y / size_dy
    _euler(now.y_end, now.dy_end, first, s.y_stage)
    set_time(block, now.clock[codes.STEP_END] + first)
    derivative(block, s.y_stage, s.dy_at)
    bend = jerk = 0.0
    coordinates = Sizes(block).coordinates
    for i in range(n):
        scale = relative * (ABSOLUTE_FRACTION * s.scale[i] + abs(now.y_end[i]))
        difference = (s.dy_at[i] - now.dy_end[i]) / scale
        bend += difference * difference
        if coordinates <= i < 2 * coordinates:
            jerk += difference * difference
    bend = math.sqrt(bend / n) / first
    steepest = max(size_dy / rate, bend / (rate * rate))  # in the time of the mechanism
    second = max(least, first * 1e-3)
    if steepest > 1e-15:
        second = power(0.01 / steepest, 1.0 / _ERROR_EXPONENT) / rate
        slow = math.sqrt(jerk / n) / first / (rate * rate) < _OF_STEEPEST * steepest
        if before > 0.0 and (slow or before > _OF_SECOND * second):
            second = min(_BOLDLY * second, 50.0 * first)
    return min(100.0 * first, second)
