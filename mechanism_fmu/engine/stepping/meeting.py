"""Where two outlines meet in a step (see `outlines.advance`), and where a place of contact leaves its feature."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Pose, Stages, Watch
from ...tables.parts import Contacts, Features, Outlines
from ...tolerances import GAP_NOISE, PASSES_BY
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.kinematics import place_bodies
from ..constraints.outline_row import place_feature
from ..contacts.guards import guard_of
from ..contacts.handover import left_on_side, left_to_go
from ..outlines.advance import against, fastest, finest, turns
from ..outlines.features import CORNERS_TOUCH, radius_of
from ..outlines.nearest import look_across, look_no_deeper
from ..scales import length_scale
from .looks import falls_between, place_at, value_at
from .runge_kutta import try_step

_NEWTON_STEPS = 12
#: Where corners that have passed each other touched is looked for in so many looks, so far apart at least, in parts of
#: where corners touch.
_CORNERS_LOOKS = 64
_CORNERS_PART = 0.2
#: So near to it a place of contact is at the end of a feature, in scale: what follows there goes on smoothly.
_AT_THE_END = 0.1 * PASSES_BY
#: The part of the way to the end of a feature from which on the slope there is measured.
_CLOSE = 0.999


@jit
def cannot_meet(block: Array, at: Pose, number: int) -> bool:
    """Whether two outlines are known to be so far apart that they cannot meet in the step that begins at `at`.

    Else the step is yet to be looked at.
    """
    keep_small()
    look_at = Watch(block)
    contact = guard_of(block, number)[1]
    group = Contacts(block).group[contact]
    apart = Contacts(block).apart
    look_at.reached[number] = 0.0
    look_at.most[number] = fastest(block, at, contact)
    if not apart[group] > look_at.most[number]:
        return False
    apart[group] -= look_at.most[number]
    return True


@jit
def meets_before(block: Array, number: int, after: float) -> float:
    """Where the distance of two outlines comes down to zero before `after`; 2.0 when it does not (see `advance`)."""
    keep_small()
    look_at = Watch(block)
    contact = guard_of(block, number)[1]
    group = Contacts(block).group[contact]
    apart = Contacts(block).apart
    most = look_at.most[number]
    closest = finest(block, contact, most)
    noise = GAP_NOISE * length_scale(block)
    look_no_deeper(block, most * closest)
    found = 2.0
    while look_at.reached[number] <= after:
        now = look_at.reached[number]
        # who has had less to go than to the next look may have passed
        look_across(block, now > 0.0 and look_at.next[number, 0] < most * closest)
        value = value_at(block, number, now)[0] - noise
        if value <= 0.0 and now > 0.0:
            found = _since_last_look(block, number, now, value)
            break
        look_at.next[number, 0] = value
        look_at.next[number, 1] = now
        look_at.reached[number] = 2.0
        apart[group] = max(value - most * (1.0 - now), 0.0)
        if value <= most * (1.0 - now):
            look_at.reached[number] = now + max(value / most, closest)
            if now < 1.0 < look_at.reached[number]:
                look_at.reached[number] = 1.0
    look_no_deeper(block, 0.0)
    look_across(block, False)
    return found


@jit
def meets_since(block: Array, number: int, end: float) -> float:
    """Where the distance of two outlines came down to zero since the last look, if it is below at `end`; 2.0 if not.

    The next look is due later, but something else happens at `end`, and ends the step there.
    """
    keep_small()
    look_at = Watch(block)
    most = look_at.most[number]
    above, before = look_at.next[number, 0], look_at.next[number, 1]
    if not before < end < look_at.reached[number] or above > most * (end - before):
        return 2.0
    closest = finest(block, guard_of(block, number)[1], most)
    look_no_deeper(block, most * closest)
    look_across(block, above < most * closest)
    value = value_at(block, number, end)[0] - GAP_NOISE * length_scale(block)
    found = 2.0
    if value <= 0.0:
        found = _since_last_look(block, number, end, value)
    look_no_deeper(block, 0.0)
    look_across(block, False)
    return found


@jit
def _since_last_look(block: Array, number: int, after: float, value: float) -> float:
    """Where a distance came down to zero between the last look and `after`, where it is `value`."""
    keep_apart()
    look_at = Watch(block)
    noise = GAP_NOISE * length_scale(block)
    close = noise / look_at.most[number]
    above, before = look_at.next[number, 0], look_at.next[number, 1]
    found = falls_between(block, number, before, above, after, value, noise, close)
    return _before_crossing(block, number, found, close)


@jit
def _before_crossing(block: Array, number: int, after: float, close: float) -> float:
    """Where two corners touched, right before elements that cross were all that said so; or `after`."""
    keep_small()
    look_across(block, False)
    noise = GAP_NOISE * length_scale(block)
    if value_at(block, number, after)[0] <= noise:
        return after
    part = _CORNERS_PART * CORNERS_TOUCH / GAP_NOISE * close
    for k in range(1, _CORNERS_LOOKS + 1):
        if after - k * part <= 0.0:
            break
        if value_at(block, number, after - k * part)[0] <= noise:
            return after - k * part
    return after


@jit
def fastest_to_end(block: Array, at: Pose, contact: int) -> float:
    """A bound of how fast `left_to_go` changes over the step that begins at `at` [m per step].

    That of a disc against the material of the body whose segment, corner or arc it is on. On an arc, the place goes as
    the line between the centres turns; the normal of a segment turns with its body.
    """
    keep_apart()
    table = Contacts(block)
    i, j = table.body_i[contact], table.body_j[contact]
    f, g = table.feature_i[contact], table.feature_j[contact]
    one, other = table.outline_i[contact], table.outline_j[contact]
    ax, ay, _, _ = place_feature(block, at, i, one, 0, f)
    bx, by, _, _ = place_feature(block, at, j, other, table.copy[contact], g)
    radius = max(abs(radius_of(block, f)), abs(radius_of(block, g)))
    kind = Features(block).kind
    if kind[f] == codes.SEGMENT or kind[g] == codes.SEGMENT:
        data = Outlines(block).data
        long = min(data[one, codes.OUTLINE_RADIUS], data[other, codes.OUTLINE_RADIUS])
        most = against(block, at, i, j, ax, ay) if kind[g] == codes.SEGMENT else against(block, at, j, i, bx, by)
        return float(max(most, max(long, radius) * turns(block, i, j)))
    most = max(against(block, at, i, j, ax, ay), against(block, at, j, i, bx, by))
    dx = at.x[i] + ax - at.x[j] - bx
    dy = at.y[i] + ay - at.y[j] - by
    distance = math.sqrt(dx * dx + dy * dy)
    if not distance > most:
        return math.inf
    return float(most * max(1.0, radius / (distance - most)))


@jit
def refine_end(block: Array, contact: int, step_size: float) -> float:
    """The step size at which the true step ends with the place of contact right at the end of its feature.

    The guard has fired `PASSES_BY` beyond it, where the feature that follows would have turned the normal already. By
    Newton's method with the slope of the dense output there; that step is the last one tried.
    """
    keep_small()
    s = Stages(block)
    start = s.tried[0]
    fraction = step_size / s.tried[1]
    beyond, side, _ = left_to_go(block, place_at(block, fraction), contact)
    before = left_on_side(block, place_at(block, _CLOSE * fraction), contact, side)
    slope = (before - beyond) / ((1.0 - _CLOSE) * step_size)
    size = step_size
    try_step(block, start, size)
    for _ in range(_NEWTON_STEPS):
        if not slope > 0.0:
            return size
        left = left_on_side(block, place_bodies(block, s.y_new), contact, side)
        move = left / slope
        if abs(left) <= _AT_THE_END * length_scale(block) or not 0.0 < size + move <= step_size:
            return size
        size += move
        try_step(block, start, size)
    return size
