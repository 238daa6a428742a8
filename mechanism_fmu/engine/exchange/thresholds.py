"""Thresholds of forces while an importer integrates: along the cubic through the states and rates of its last step."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Exchange, Pose, Stages
from ...tables.parts import Thresholds
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.kinematics import place_bodies
from ..dynamics.forces import set_time
from ..dynamics.thresholds import beyond, cross, is_watched
from ..stepping.crossing import first_crossing

#: An indicator is above zero where its threshold is at zero: by the least normal number.
_ABOVE_ZERO = 2.0**-1022


@jit
def write_cubic(block: Array, dense: Array) -> float:
    """Write the cubic through unknowns and derivatives at COMPLETED and at TIME (Hermite); return its length [s]."""
    keep_apart()
    now = Course(block)
    table = Exchange(block)
    size: float = now.clock[codes.TIME] - now.clock[codes.COMPLETED]
    for i in range(now.y_end.shape[0]):
        change = now.y_end[i] - table.seen_y[i]
        bend = size * table.seen_rates[i] - change
        for row in range(dense.shape[0]):
            dense[row, i] = 0.0
        dense[0, i] = table.seen_y[i]
        dense[1, i] = change
        dense[2, i] = bend
        dense[3, i] = change - size * now.dy_end[i] - bend
    return size


@jit
def crossed_threshold(block: Array) -> int:
    """The first threshold that has come to zero since the last completed step, or `codes.NONE`."""
    keep_apart()
    now = Course(block)
    s = Stages(block)
    s.tried[0] = now.clock[codes.COMPLETED]
    s.tried[1] = write_cubic(block, s.new_dense)
    which = codes.NONE
    if s.tried[1] > 0.0:
        which = first_crossing(block, 2.0)[0]
    set_time(block, now.clock[codes.TIME])
    return which


@jit
def passed_threshold(block: Array) -> int:
    """A threshold that has come to zero within the last step, and back; or `codes.NONE`."""
    keep_small()
    which = crossed_threshold(block)
    if which != codes.NONE and _spare(block, place_bodies(block, Course(block).y_end), which) > 0.0:
        return which
    return codes.NONE


@jit
def _spare(block: Array, at: Pose, n: int) -> float:
    """Return the distance of a threshold from zero on its side, plus its rounding: positive, also at zero."""
    value = beyond(block, at, n)
    return float(value + Thresholds(block).rounding[n] + _ABOVE_ZERO)


@jit
def write_threshold_indicators(block: Array) -> None:
    """Write the indicators of thresholds, of which the first that has come to zero in this step is not above zero."""
    keep_apart()
    indicator = Exchange(block).indicator
    first = Sizes(block).guards
    crossed = crossed_threshold(block)
    at = place_bodies(block, Course(block).y_end)
    for n in range(Sizes(block).thresholds):
        spare = 1.0
        if is_watched(block, n):
            spare = _spare(block, at, n)
        if not abs(spare) < 1e300:
            spare = 1.0  # a condition without a value
        indicator[first + n] = -abs(spare) if n == crossed else spare


@jit
def cross_what_is_due(block: Array, at: Pose) -> bool:
    """Let each threshold go over that has come to zero; whether there is one."""
    keep_small()
    crossed = False
    for n in range(Sizes(block).thresholds):
        if is_watched(block, n) and _spare(block, at, n) < 0.0:
            cross(block, n)
            crossed = True
    return crossed
