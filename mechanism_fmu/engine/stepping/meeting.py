"""Where two outlines meet in a step (see `outlines.advance`), and where a place of contact leaves its feature."""

from __future__ import annotations

from ...tables.declare import Array
from ...tables.motion import Stages, Watch
from ...tables.parts import Contacts
from ...tolerances import GAP_NOISE, MARGIN
from ..compiler.subset import jit, keep_small
from ..constraints.kinematics import place_bodies
from ..contacts.guards import guard_of
from ..contacts.handover import left_to_go
from ..outlines.advance import FINEST, fastest
from ..outlines.features import CORNERS_TOUCH
from ..outlines.nearest import look_across, look_no_deeper
from .looks import BISECTIONS, place_at, value_at
from .runge_kutta import try_step

#: After so many false positions, bisections.
_FALSE_POSITIONS = 16
_NEWTON_STEPS = 12
#: Where corners that have passed each other touched is looked for in so many looks, so far apart at least, in parts of
#: where corners touch.
_CORNERS_LOOKS = 64
_CORNERS_PART = 0.2
#: So near to it a place of contact is at the end of a feature [m]: what follows there goes on smoothly.
_AT_THE_END = 0.1 * MARGIN
#: The part of the way to the end of a feature from which on the slope there is measured.
_CLOSE = 0.999


@jit
def meets_before(block: Array, number: int, after: float) -> float:
    """Where the distance of two outlines comes down to zero before `after`; 2.0 when it does not (see `advance`)."""
    keep_small()
    look_at = Watch(block)
    contact = guard_of(block, number)[1]
    group = Contacts(block).group[contact]
    apart = Contacts(block).apart
    speed = fastest(block, place_at(block, look_at.reached[number]), contact)
    if look_at.reached[number] == 0.0 and apart[group] > speed:
        apart[group] -= speed
        look_at.reached[number] = 2.0
        return 2.0
    look_no_deeper(block, speed * FINEST)
    found = 2.0
    while look_at.reached[number] <= after:
        now = look_at.reached[number]
        # who has had less to go than to the next look may have passed
        look_across(block, now > 0.0 and look_at.next[number, 0] < speed * FINEST)
        value = value_at(block, number, now)[0] - GAP_NOISE
        if value <= 0.0 and now > 0.0:
            before = look_at.next[number, 1]
            found = _meeting(block, number, before, look_at.next[number, 0], now, value, GAP_NOISE / speed)
            break
        look_at.next[number, 0] = value
        look_at.next[number, 1] = now
        look_at.reached[number] = 2.0
        apart[group] = max(value - speed * (1.0 - now), 0.0)
        if value <= speed * (1.0 - now):
            look_at.reached[number] = now + max(value / speed, FINEST)
            if now < 1.0 < look_at.reached[number]:
                look_at.reached[number] = 1.0
    look_no_deeper(block, 0.0)
    look_across(block, False)
    return found


@jit
def _meeting(block: Array, number: int, before: float, above: float, after: float, below: float, close: float) -> float:
    """Where two outlines that were apart at `before`, by `above` [m], have met: just before `after`, where `below` is.

    The end of an interval shorter than `close`. By false position, where the value at an end that stays counts half
    (Illinois); where the distance jumps, as behind two corners that meet, false positions lead nowhere: by bisection.
    """
    keep_small()
    stayed = 0
    for look in range(2 * BISECTIONS):
        middle = 0.5 * (before + after)
        if above > 0.0 and look < _FALSE_POSITIONS and look % 4 < 3:
            middle = (before * below - after * above) / (below - above)
            middle = max(min(middle, after - 0.5 * close), before + 0.5 * close)
        if after - before <= close or not before < middle < after:
            break
        value = value_at(block, number, middle)[0] - GAP_NOISE
        if value > 0.0:
            before = middle
            above = value
            if stayed > 0:
                below *= 0.5
            stayed = 1
        else:
            after = middle
            below = value
            if stayed < 0:
                above *= 0.5
            stayed = -1
    return _before_crossing(block, number, after, close)


@jit
def _before_crossing(block: Array, number: int, after: float, close: float) -> float:
    """Where two corners touched, right before elements that cross were all that said so; or `after`."""
    keep_small()
    look_across(block, False)
    if value_at(block, number, after)[0] <= GAP_NOISE:
        return after
    part = _CORNERS_PART * CORNERS_TOUCH / GAP_NOISE * close
    for k in range(1, _CORNERS_LOOKS + 1):
        if after - k * part <= 0.0:
            break
        if value_at(block, number, after - k * part)[0] <= GAP_NOISE:
            return after - k * part
    return after


@jit
def refine_end(block: Array, contact: int, step_size: float) -> float:
    """The step size at which the true step ends with the place of contact right at the end of its feature.

    The guard has fired `MARGIN` beyond it, where the feature that follows would have turned the normal already. By
    Newton's method with the slope of the dense output there; that step is the last one tried.
    """
    keep_small()
    s = Stages(block)
    start = s.tried[0]
    fraction = step_size / s.tried[1]
    before = left_to_go(block, place_at(block, _CLOSE * fraction), contact)[0]
    slope = (before - left_to_go(block, place_at(block, fraction), contact)[0]) / ((1.0 - _CLOSE) * step_size)
    size = step_size
    try_step(block, start, size)
    for _ in range(_NEWTON_STEPS):
        if not slope > 0.0:
            return size
        left = left_to_go(block, place_bodies(block, s.y_new), contact)[0]
        move = left / slope
        if abs(left) <= _AT_THE_END or not 0.0 < size + move <= step_size:
            return size
        size += move
        try_step(block, start, size)
    return size
