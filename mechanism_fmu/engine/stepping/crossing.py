"""Search for zeros of the thresholds of forces within a step: the step ends there, and no force is strided over.

Each threshold is looked at along the dense output of the step. One of three looks that is below both others brackets a
dip, and so does a fall or rise right at an end of the step; a search for its lowest point tells whether it comes to
zero, however narrow it is. The zero is then found anew with true steps.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Pose, Stages
from ...tables.parts import Thresholds
from ...tolerances import ROOT_TOLERANCE
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.kinematics import place_bodies
from ..dynamics.forces import set_time
from ..dynamics.thresholds import beyond, is_watched
from ..scales import rate_scale
from .looks import BISECTIONS, place_at
from .runge_kutta import try_step

#: Looks at each threshold, besides those next to both ends of the step, in parts of a step.
_PARTS = 8
_NEXT_TO_END = 1e-4
#: A golden section, so often: the bracket shrinks to rounding.
_SECTION = 0.5 * (3.0 - math.sqrt(5.0))
_SECTIONS = 75
_NEWTON_STEPS = 12
#: By this share of a step the dense output may misplace a zero, which is found anew on true steps.
_MISPLACED = 1e-3


@jit
def first_crossing(block: Array, latest: float) -> tuple[int, float]:
    """The first threshold that comes to zero before the fraction `latest` of the step, and where.

    (`codes.NONE`, `latest`) when none does.
    """
    keep_apart()
    table = Thresholds(block)
    end = min(latest, 1.0)
    which = codes.NONE
    earliest = latest
    earlier = before = 0.0
    for look in range(_PARTS + 3):
        after = min(_fraction(look), end)
        at = _place_at(block, after)
        for n in range(table.side.shape[0]):
            if is_watched(block, n):
                value = beyond(block, at, n)
                seen = table.looks[n]
                seen[0], seen[1], seen[2] = seen[1], seen[2], value
                if look == 0:
                    table.armed[n] = 1 if value >= -table.rounding[n] else 0
                    seen[0] = seen[1] = value
        if look > 0:
            for n in range(table.side.shape[0]):
                if is_watched(block, n):
                    fraction = _zero_between(block, n, earlier, before, after)
                    if fraction < earliest:
                        which, earliest = n, fraction
        if which != codes.NONE or after >= end:
            break
        earlier, before = before, after
    return which, earliest


@jit
def _fraction(look: int) -> float:
    """Return the fraction of a step at which a look is: at its ends, next to them, and in equal parts."""
    if look == 0:
        return 0.0
    if look == 1:
        return _NEXT_TO_END
    if look == _PARTS + 1:
        return 1.0 - _NEXT_TO_END
    return min((look - 1) / _PARTS, 1.0)


@jit
def _place_at(block: Array, fraction: float) -> Pose:
    s = Stages(block)
    set_time(block, s.tried[0] + fraction * s.tried[1])
    return place_at(block, fraction)


@jit
def _zero_between(block: Array, n: int, earlier: float, before: float, after: float) -> float:
    """Return where a threshold comes to zero between the last three looks; 2.0 when it does not."""
    keep_small()
    table = Thresholds(block)
    first, last, value = table.looks[n, 0], table.looks[n, 1], table.looks[n, 2]
    noise = table.rounding[n]
    if math.isnan(value):
        return 2.0
    if table.armed[n] == 0:  # it has just come over to this side
        if value >= -noise:
            table.armed[n] = 1
            return 2.0
        return before if value < last else 2.0  # and goes back
    if value < -noise:
        return _bisect(block, n, before, after)
    if first > last and last <= value:
        lowest = _lowest(block, n, earlier, after, first, value)
        if lowest <= 1.0:
            return _bisect(block, n, earlier, lowest)
    return 2.0


@jit
def _look(block: Array, n: int, fraction: float) -> float:
    """Return the distance of a threshold from zero on its side at a fraction of the step, less its rounding."""
    value = beyond(block, _place_at(block, fraction), n)
    return float(value + Thresholds(block).rounding[n])


@jit
def _bisect(block: Array, n: int, before: float, after: float) -> float:
    """The fraction at which a threshold comes over, which it has at `after`, but not at `before`."""
    keep_small()
    for _ in range(BISECTIONS):
        middle = 0.5 * (before + after)
        if not before < middle < after:
            break
        if _look(block, n, middle) < 0.0:
            after = middle
        else:
            before = middle
    return after


@jit
def _lowest(block: Array, n: int, before: float, after: float, first: float, last: float) -> float:
    """A fraction of a dip at which a threshold has come over; 2.0 where its lowest point has not.

    `first` and `last` are its values at both ends of the bracket.
    """
    keep_small()
    left = before + _SECTION * (after - before)
    right = after - _SECTION * (after - before)
    low, high = _look(block, n, left), _look(block, n, right)
    for _ in range(_SECTIONS):
        if low < 0.0:
            return left
        if high < 0.0:
            return right
        steepest = max((first - low) / (left - before), (last - high) / (after - right))
        if not before < left < right < after or steepest * (after - before) < min(low, high):
            break  # by its slopes it stays above zero, if it is convex here
        if low < high:
            after, last, right, high = right, high, left, low
            left = before + _SECTION * (after - before)
            low = _look(block, n, left)
        else:
            before, first, left, low = left, low, right, high
            right = after - _SECTION * (after - before)
            high = _look(block, n, right)
    return 2.0


@jit
def refine_crossing(block: Array, n: int, step_size: float) -> float:
    """The step size at which the true step ends with a threshold at zero; that step is the last one tried."""
    keep_small()
    s = Stages(block)
    start = s.tried[0]
    fraction = step_size / s.tried[1]
    size = step_size
    value = _look(block, n, fraction)
    slope = (value - _look(block, n, (1.0 - _NEXT_TO_END) * fraction)) / (_NEXT_TO_END * step_size)
    for _ in range(_NEWTON_STEPS):
        try_step(block, start, size)
        move = -beyond(block, place_bodies(block, s.y_new), n) / slope
        if (
            abs(move) * rate_scale(block) <= ROOT_TOLERANCE
            or not abs(size + move - step_size) <= _MISPLACED * step_size
        ):
            return size
        size += move
    try_step(block, start, size)
    return size
