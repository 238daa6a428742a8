"""Event location: where inside a step the first event happens.

The rule. On a step from t0 to t1, a guard w fires at the first t in (t0, t1] at which w <= 0 and before which w > 0.
Open at t0: what has fired at the end of one step does not fire again at the start of the next. Closed at t1: no zero
falls between two steps. Only this way round counts. Of several guards the earliest fires. Exceptions at t0:

- a guard that is no gap and is not positive at t0 fires at t0: an event there has changed what it looks at; but the end
  of a feature in a hollow corner, where nothing takes over, counts when it is passed by another PASSES_BY;
- a gap that is not positive at t0, or whose contact touched there (`contacts.touching`): closing (w' < -RESTS_BELOW),
  it fires at t0; opening (w' > RESTS_BELOW), it counts once it has been positive (`armed`), and until then where it
  comes back to min(w(t0), 0), at the top of its hop where rounding hides that, or below by GAP_NOISE where there is
  none; at rest, it counts below -GAP_NOISE until it has been above GAP_NOISE, and where rows that contradict each other
  by rounding have left it inside (`codes.LEFT_INSIDE`), that much further below;
- a gap that is farther below zero than what touches is a penetration, which no event mends: the step is refused. What
  is open here comes to its end no deeper than it has begun, since a gap that comes down to zero fires; so one look, at
  the start of each step, sees what pins, guides and events have left inside.

Guards of the position are looked at on the dense output, the forces of closed contacts at the step's stages. The root
of a gap is then refined with true Runge-Kutta steps, so that its accuracy is the integrator's and not the
interpolant's. A dip between two looks is found where w' changes from minus to plus; two dips between the same two looks
are not, nor one within the noise of a gap at rest.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.method import METHOD
from ...tables.motion import Pose, Stages, Watch
from ...tables.parts import Contacts
from ...tables.sizes import Sizes
from ...tolerances import GAP_NOISE, PASSES_BY, RESTS_BELOW, ROOT_TOLERANCE, SLIPS_ABOVE, TOUCHES_WITHIN
from ..compiler.subset import jit, keep_small
from ..constraints.friction_rows import rubs
from ..constraints.kinematics import place_bodies
from ..contacts.binding import bind, is_free, is_outline, let_loose
from ..contacts.guards import gap, guard_of, guard_value, is_watched, stands_for_search
from ..contacts.handover import ends_in_hollow, left_to_go
from ..contacts.inside import is_too_deep
from ..scales import contact_speed, contact_unit, guard_unit, length_scale, rate_scale, slip_scale
from .letting_go import first_to_let_go
from .looks import BISECTIONS, bisect, falls_between, place_at, value_at
from .meeting import cannot_meet, fastest_to_end, meets_before, meets_since
from .runge_kutta import try_step
from .step_size import smallest_step

#: Points of a step at which each guard is looked at; between two of them a dip is found by the sign of the gap rate.
_LOOKS = 8
_NEWTON_STEPS = 12
_LAST = METHOD.last
#: Where no more is left of a gap than this part of the length, and of the time, the motion there is straight: no other
#: step is tried.
_CLOSED, _SHIFTS_BY = 5e-15, 1e-11
#: How closely it is found on the dense output where a feature ends, in parts of a step; `refine_end` does the rest.
_HANDS_OVER_WITHIN = 1e-12
#: What a guard does at the start of a step, as the fraction at which it fires: nothing yet; nothing in this step; it
#: stands inside.
_NOT_YET = 2.0
_NOT_WITHIN = 3.0
_INSIDE = -1.0


@jit
def first_event(block: Array) -> tuple[int, int, float]:
    """The first event within the step in `new_dense`: its guard, contact (pattern, function), and fraction of the step.

    (`codes.GUARD_NONE`, `codes.NONE`, 2.0) when there is none; a negative fraction where its contact is inside already.
    """
    keep_small()
    number, fraction = _first_zero(block)
    guard = codes.GUARD_NONE
    subject = codes.NONE
    if fraction <= 1.0:
        guard, subject = guard_of(block, number)
    if fraction < 0.0:
        return guard, subject, fraction
    lets_go, what, when = first_to_let_go(block, fraction)
    if when < fraction:
        guard, subject, fraction = lets_go, what, when
    if 0.0 < fraction <= 1.0:
        return _met_before(block, guard, subject, fraction)
    return guard, subject, fraction


@jit
def _met_before(block: Array, guard: int, subject: int, fraction: float) -> tuple[int, int, float]:
    """The first event, if outlines have not met between their last look and that: looks are not as close as events."""
    keep_small()
    for g in range(Sizes(block).contacts):
        if is_watched(block, g) and stands_for_search(block, g):
            met = meets_since(block, g, fraction)
            if met < fraction:
                guard, subject, fraction = codes.GUARD_GAP, g, met
    return guard, subject, fraction


@jit
def comes_down_beside(block: Array, guard: int, subject: int, fraction: float) -> bool:
    """Whether what has just struck hops, and comes down in this step beside the features that it struck.

    Its gap is that of these features, and goes on behind their ends as if they did: nothing is struck there.
    """
    keep_small()
    table = Contacts(block)
    if guard != codes.GUARD_GAP or not is_outline(block, subject) or is_free(block, subject):
        return False
    hops = table.mode[subject] == codes.OPEN and table.touching[subject] != 0
    beyond = PASSES_BY * length_scale(block)
    return bool(hops and left_to_go(block, place_at(block, fraction), subject)[0] < -beyond)


@jit
def refine(block: Array, contact: int, step_size: float) -> float:
    """The step size at which the true step, not its interpolant, ends at zero gap; that step is the last one tried."""
    keep_small()
    s = Stages(block)
    start = s.tried[0]
    limit = 2.0 * step_size
    if is_free(block, contact):
        at = place_at(block, step_size / s.tried[1])
        _let_loose_what_is_off(block, at, contact)
        bind(block, at, contact)
    unit = contact_unit(block, contact)
    rests_below = RESTS_BELOW * contact_speed(block, contact)
    for _ in range(_NEWTON_STEPS):
        try_step(block, start, step_size)
        at = place_bodies(block, s.y_new)
        distance, rate = gap(block, at, contact)
        if not rate < -rests_below:  # of what slides in front of something flat, rounding has either sign
            return step_size
        move = -distance / rate
        if abs(move) * rate_scale(block) <= ROOT_TOLERANCE or not 0.0 < step_size + move < limit:
            return step_size
        if abs(distance) <= _CLOSED * unit and abs(move) * rate_scale(block) <= _SHIFTS_BY:
            for i in range(s.y_new.shape[0]):
                s.y_new[i] += move * s.derivatives[_LAST, i]
            return step_size + move
        step_size += move
    try_step(block, start, step_size)
    return step_size


@jit
def _let_loose_what_is_off(block: Array, at: Pose, contact: int) -> None:
    """What has come off since the step began, in the group of a contact that strikes now, touches no more."""
    keep_small()
    table = Contacts(block)
    for c in range(table.mode.shape[0]):
        opens = table.group[c] == table.group[contact] and table.mode[c] == codes.OPEN and table.touching[c] != 0
        if opens and gap(block, at, c)[0] > GAP_NOISE * contact_unit(block, c):
            table.touching[c] = 0
            let_loose(block, c)


@jit
def _first_zero(block: Array) -> tuple[int, float]:
    """The first guard that reaches zero, and where; (`codes.NONE`, 2.0) when none does."""
    keep_small()
    look_at = Watch(block)
    at = place_at(block, 0.0)
    count = 0
    guards = Sizes(block).guards
    if not rubs(block):
        guards -= Sizes(block).rubs
    for g in range(guards):
        if is_watched(block, g):
            fraction = _begin(block, at, g)
            if fraction <= 0.0:
                return g, fraction
            if fraction == _NOT_WITHIN:
                continue
            look_at.watched[count] = g
            count += 1
    if count == 0:
        return codes.NONE, 2.0
    before = 0.0
    for look in range(1, _LOOKS + 1):
        after = look / _LOOKS
        is_placed = False
        for k in range(count):
            g = look_at.watched[k]
            if stands_for_search(block, g):
                continue
            if look_at.reached[g] > after:  # an end of a feature that is still too far to be reached by then
                look_at.next[g, 0], look_at.next[g, 1] = math.inf, 0.0
                continue
            if not is_placed:
                at = place_at(block, after)
                is_placed = True
            look_at.next[g, 0], look_at.next[g, 1] = guard_value(block, at, g)
            if look_at.reached[g] > 0.0:
                look_at.reached[g] = after + look_at.next[g, 0] / look_at.most[g]
        which = codes.NONE
        earliest = 2.0
        for k in range(count):
            g = look_at.watched[k]
            if stands_for_search(block, g):
                continue
            fraction = _zero_between(block, g, before, after)
            if fraction < earliest:
                earliest = fraction
                which = g
        for k in range(count):
            g = look_at.watched[k]
            if stands_for_search(block, g) and look_at.reached[g] <= after:
                fraction = meets_before(block, g, after)
                if fraction < earliest:
                    earliest = fraction
                    which = g
        if which != codes.NONE:
            return which, earliest
        before = after
    return codes.NONE, 2.0


@jit
def _begin(block: Array, at: Pose, number: int) -> float:
    """Note a guard's value at the step's start; 0.0 when it fires right there, `_INSIDE` where it is too late."""
    keep_small()
    look_at = Watch(block)
    if stands_for_search(block, number):
        return _NOT_WITHIN if cannot_meet(block, at, number) else _NOT_YET
    value, rate = guard_value(block, at, number)
    look_at.reached[number] = 0.0
    look_at.rate[number] = rate
    look_at.armed[number] = 1
    look_at.floor[number] = 0.0
    guard, subject = guard_of(block, number)
    if guard == codes.GUARD_STICK:
        slips_above = SLIPS_ABOVE * slip_scale(block, subject)
        if value <= slips_above:  # it begins to slip
            look_at.armed[number] = 0
            look_at.floor[number] = min(value, 0.0) - slips_above
        return _NOT_YET
    if guard == codes.GUARD_HANDOVER and value <= 0.0 and ends_in_hollow(block, at, subject):
        look_at.floor[number] = value - PASSES_BY * length_scale(block)  # nothing takes over: what is beyond is known
        return _NOT_YET
    if guard == codes.GUARD_HANDOVER and value > 0.0:
        look_at.most[number] = fastest_to_end(block, at, subject)
        if value > look_at.most[number]:
            return _NOT_WITHIN
        look_at.reached[number] = value / look_at.most[number]
    if guard != codes.GUARD_GAP:
        return 0.0 if value <= 0.0 else _NOT_YET
    if value < 0.0 and not is_outline(block, subject) and is_too_deep(block, at, subject, value, rate):
        return _INSIDE
    if value > 0.0 and Contacts(block).touching[subject] == 0:
        return _NOT_YET
    unit = contact_unit(block, subject)
    rests_below = RESTS_BELOW * contact_speed(block, subject)
    if rate < -rests_below:
        return 0.0
    look_at.floor[number] = -GAP_NOISE * unit
    opens = rate > rests_below
    if opens:
        look_at.armed[number] = 0
    if opens or (Contacts(block).touching[subject] == codes.LEFT_INSIDE and value > -TOUCHES_WITHIN * unit):
        look_at.floor[number] += min(value, 0.0)
    return 0.0 if value <= look_at.floor[number] else _NOT_YET


@jit
def _zero_between(block: Array, number: int, before: float, after: float) -> float:
    """Where between two looks, whose values are in `watch`, a guard reaches zero; 2.0 when it does not."""
    keep_small()
    look_at = Watch(block)
    rate = look_at.rate[number]
    next_value = look_at.next[number, 0]
    next_rate = look_at.next[number, 1]
    floor = look_at.floor[number]
    fraction = 2.0
    guard, subject = guard_of(block, number)
    if look_at.armed[number] == 0 and guard == codes.GUARD_STICK:
        if next_value <= floor:
            fraction = bisect(block, number, before, after, floor)
        # not before: of what rests although it is taken to slip, rounding has either sign
        if next_value > SLIPS_ABOVE * slip_scale(block, subject):
            look_at.armed[number] = 1
            look_at.floor[number] = 0.0
        return fraction
    if look_at.armed[number] == 0:
        if next_value <= 0.0 and (next_rate <= 0.0 or next_value < floor):
            level = 0.0
            if next_rate < 0.0:
                before = _top(block, number, after)
                if not value_at(block, number, before)[0] > 0.0:
                    level = floor + GAP_NOISE * guard_unit(block, guard, subject)  # where it began
                if next_value > level or not before * Stages(block).tried[1] > smallest_step(
                    block, Stages(block).tried[0]
                ):
                    before = 0.0
            else:
                before = _after_opening(block, number, after)
            if before > 0.0:
                fraction = bisect(block, number, before, after, level)
            elif next_value <= floor:
                fraction = bisect(block, number, before, after, floor)
    elif next_value <= floor and guard == codes.GUARD_HANDOVER:
        above = value_at(block, number, before)[0] - floor
        fraction = falls_between(block, number, before, above, after, next_value - floor, floor, _HANDS_OVER_WITHIN)
    elif next_value <= floor:
        fraction = bisect(block, number, before, after, floor)
    elif rate < 0.0 < next_rate and floor == 0.0:
        bottom = _bottom(block, number, before, after)
        if value_at(block, number, bottom)[0] <= 0.0:
            fraction = bisect(block, number, before, bottom, floor)
    if next_value > 0.0 and look_at.armed[number] == 0:
        look_at.armed[number] = 1
        look_at.floor[number] = 0.0
    if look_at.floor[number] != 0.0 and next_value > GAP_NOISE * guard_unit(block, guard, subject):
        look_at.floor[number] = 0.0
    look_at.rate[number] = next_rate
    return fraction


@jit
def _after_opening(block: Array, number: int, after: float) -> float:
    """A fraction before `after` at which a gap that opens from zero is positive; 0.0 when rounding hides it."""
    keep_small()
    fraction = after
    for _ in range(BISECTIONS):
        fraction *= 0.5
        if value_at(block, number, fraction)[0] > 0.0:
            return fraction
    return 0.0


@jit
def _top(block: Array, number: int, after: float) -> float:
    """The fraction up to which a gap that opens at the step's start rises, and that falls at `after`."""
    keep_small()
    before = 0.0
    for _ in range(BISECTIONS):
        middle = 0.5 * (before + after)
        if value_at(block, number, middle)[1] > 0.0:
            before = middle
        else:
            after = middle
    return before


@jit
def _bottom(block: Array, number: int, before: float, after: float) -> float:
    """The fraction at which a guard that falls at `before` and rises at `after` is least."""
    keep_small()
    for _ in range(BISECTIONS):
        middle = 0.5 * (before + after)
        if value_at(block, number, middle)[1] < 0.0:
            before = middle
        else:
            after = middle
    return after
