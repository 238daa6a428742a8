"""What happens in event mode: all that is due, one after the other, until no indicator is at zero any more.

An importer stops near the zero of an indicator, on either side of it and as near as its integrator is accurate. What is
due is judged by value and rate; before an impact, its gap is brought to zero, with all drift of the rows, by the least
change of the positions in the metric of the masses. Then `transit` makes of it what it makes of the engine's
own events.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Exchange, Pose
from ...tables.parts import Contacts, Joints
from ...tables.sizes import Sizes
from ...tolerances import GAP_NOISE, RESTS_BELOW, TOUCHES_WITHIN
from .. import status
from ..compiler.subset import entry, jit, keep_apart, keep_small
from ..constraints.kinematics import place_bodies
from ..contacts.binding import bind, is_free, let_loose, take_found
from ..contacts.guards import gap, guard_of
from ..contacts.impact import clear_records
from ..contacts.inside import blame
from ..contacts.transition import release, transit
from ..dynamics.acceleration import LEAST_DRIFT, LEAST_INDEPENDENCE, MOST_RATE_DRIFT, close_positions, mend
from ..dynamics.forces import inputs_changed, take_inputs
from ..dynamics.thresholds import change_sides
from ..outlines.nearest import MEETS, look_no_deeper, nearest
from ..stepping.step_size import left_to_piece, smallest_step
from ..stepping.stepper import restart
from ..vectors import clear, copy
from .completed_step import look_through, note, set_clock
from .indicators import (
    DUE,
    can_happen,
    due_below,
    evaluate,
    happens,
    indicator,
    is_leaving,
    length_scale,
    lift,
    unseen,
    what_forbids,
    write_indicators,
)
from .thresholds import cross_what_is_due

#: An importer without a root finder may come no deeper than this part of the mechanism's size, or so many rad.
_DEEPEST_SHARE = 5e-3
#: So many things in turn at one instant, beside one for each guard, are no motion any more.
_MOST_HAPPENINGS = 100


@entry
def exchange(block: Array, what: int, time: float) -> int:
    """What an importer asks for at y_end and `time` [s], by `codes.EXCHANGE_RATES` ...; return a status.

    Rates: dy_end. Indicators: `exchange.indicator`. Events: y_end and all modes are those after what is due, and
    `next_piece` says when the next event by time is; where nothing was due, the records of earlier events are emptied.
    Completed: the step from the last one on is looked through for what the importer has not seen, and `wants_events`
    says whether event mode is to follow.
    """
    keep_small()
    Exchange(block).integrates[0] = 1  # the importer does: from here on, drift of rows dies away in their own time
    set_clock(block, time)
    if what == codes.EXCHANGE_RATES:
        evaluate(block)
        return what_forbids(block)
    if what == codes.EXCHANGE_INDICATORS:
        write_indicators(block)
        return status.OK
    if what == codes.EXCHANGE_COMPLETED:
        return look_through(block)
    outcome = _happen(block, what == codes.EXCHANGE_EVENTS)
    if outcome == status.OK:
        _settle(block)
    return outcome


@jit
def _happen(block: Array, first: bool) -> int:
    """All that is due, changed inputs, and what is due then; return a status.

    For the `first` time in this event mode or not. Inputs come second: a slip that has just come to zero would else
    have a direction, that of its last digits.
    """
    keep_small()
    clear(Contacts(block).apart)
    now = Course(block)
    now.clock[codes.COMPLETED] = now.clock[codes.TIME]  # outlines are looked at from here on
    copy(now.y_end, Exchange(block).seen_y)
    outcome, some = _happen_in_turn(block)
    if outcome == status.OK and inputs_changed(block):
        take_inputs(block)
        outcome = transit(block, codes.GUARD_INPUT, codes.NONE)
        some = True
        if outcome == status.OK:
            outcome, _ = _happen_in_turn(block)
    if outcome == status.OK and first and not some:
        clear_records(block)
    return outcome


@jit
def _happen_in_turn(block: Array) -> tuple[int, bool]:
    """All that is due, one after the other: a status, and whether there was anything."""
    keep_small()
    some = False
    for _ in range(_MOST_HAPPENINGS + Sizes(block).guards):
        at = evaluate(block)
        number = _first_due(block, at)
        if number == codes.NONE:
            if not (Sizes(block).thresholds > 0 and cross_what_is_due(block, at)):
                return status.OK, some
            continue
        some = True
        guard, subject = happens(block, number)
        gap_closes = guard == codes.GUARD_GAP
        outcome = _touch(block, at, number, subject) if gap_closes else transit(block, guard, subject)
        if outcome != status.OK:
            return outcome, some
        if guard != codes.GUARD_GAP and guard != codes.GUARD_PUSH:  # these have changed what is looked at
            lift(block, evaluate(block), number, 2.0 * DUE)
    return status.CHATTERING, some


@jit
def _first_due(block: Array, at: Pose) -> int:
    """The first indicator that is due, or `codes.NONE`."""
    keep_small()
    for g in range(Sizes(block).guards):
        if can_happen(block, g) and _is_due(block, at, g):
            return g
    return codes.NONE


@jit
def _is_due(block: Array, at: Pose, number: int) -> bool:
    """Whether an indicator has come to zero, or a gap is so near to it that it will at once."""
    keep_small()
    if indicator(block, at, number) + Exchange(block).lift[number] < due_below(block, number):
        return True
    guard, subject = guard_of(block, number)
    if guard != codes.GUARD_GAP or Contacts(block).mode[subject] == codes.CLOSED or is_free(block, subject):
        return False
    distance, rate = gap(block, at, subject)
    return distance <= TOUCHES_WITHIN and rate < -RESTS_BELOW and not is_leaving(block, number)


@jit
def _touch(block: Array, at: Pose, number: int, contact: int) -> int:
    """A gap is zero, or the rate of a contact that was leaving; return a status."""
    keep_apart()
    if is_leaving(block, number) and gap(block, at, contact)[0] > TOUCHES_WITHIN:
        Exchange(block).leaves[contact] = 0  # from the top of its hop on, its gap is looked at
        Exchange(block).lift[number] = 0.0
        return status.OK
    release(block, contact)
    if is_free(block, contact):
        look_no_deeper(block, 2.0 * unseen(block, contact))  # as far as an importer without a root finder has come
        rate = _rate_of_nearest(block, contact)
        if rate < RESTS_BELOW:
            bind(block, place_bodies(block, Course(block).y_end), contact)
        look_no_deeper(block, 0.0)
        if math.isnan(rate):
            blame(block, contact, 0.0)
            return status.PASSED_OVER
        if is_free(block, contact):  # beside what has just come off, other features come off with it
            lift(block, evaluate(block), number, 2.0 * DUE)
            return status.OK
    distance = gap(block, place_bodies(block, Course(block).y_end), contact)[0]
    if distance < -_DEEPEST_SHARE * length_scale(block, number):
        blame(block, contact, distance)
        return status.PASSED_OVER
    _bring_together(block, contact)
    at = place_bodies(block, Course(block).y_end)
    rate = gap(block, at, contact)[1]
    Exchange(block).leaves[contact] = 1
    if rate > RESTS_BELOW:  # it has been passed over, and comes off again
        Exchange(block).lift[number] = 0.0
        return status.OK
    outcome = transit(block, codes.GUARD_GAP, contact)
    Exchange(block).lift[number] = 0.0
    return outcome


@jit
def _rate_of_nearest(block: Array, contact: int) -> float:
    """The gap rate of what two outlines touch with next [m/s]; not a number where nothing is that near."""
    keep_small()
    at = place_bodies(block, Course(block).y_end)
    nearest(block, at, contact, MEETS)
    take_found(block, contact)
    rate = math.nan
    if not is_free(block, contact):
        rate = gap(block, at, contact)[1]
    let_loose(block, contact)
    return rate


@jit
def _bring_together(block: Array, contact: int) -> None:
    """Bring a gap that is not zero to zero, and all rows that have drifted; rates stay, but for those of the rows."""
    keep_small()
    now = Course(block)
    if not abs(gap(block, place_bodies(block, now.y_end), contact)[0]) > GAP_NOISE:
        return
    mode = Contacts(block).mode
    mode[contact] = codes.CLOSED
    close_positions(block, now.y_end, LEAST_DRIFT, LEAST_INDEPENDENCE)
    mode[contact] = codes.OPEN
    mend(block, math.inf, MOST_RATE_DRIFT)


@jit
def _settle(block: Array) -> None:
    """After events: what is leaving, indicators above zero, and from where the next step is looked through."""
    keep_small()
    now = Course(block)
    table = Exchange(block)
    if Sizes(block).thresholds > 0:
        change_sides(block)
    restart(block)
    release(block, codes.NONE)
    at = place_bodies(block, now.y_end)
    for c in range(table.leaves.shape[0]):
        table.leaves[c] = 0
        if Contacts(block).mode[c] == codes.OPEN and not is_free(block, c):
            table.leaves[c] = 1 if gap(block, at, c)[0] <= TOUCHES_WITHIN else 0
    at = evaluate(block)
    note(block, at)
    for g in range(Sizes(block).guards):
        lift(block, at, g, 2.0 * DUE)
    _find_next_piece(block)


@jit
def _find_next_piece(block: Array) -> None:
    """How far the next piece of a driver's motion is, where accelerations may jump [s]; infinite without any."""
    keep_small()
    time = Course(block).clock[codes.TIME]
    nearest = math.inf
    for number in Joints(block).curve:
        if number != codes.NONE:
            left = left_to_piece(block, number, time)
            if left > smallest_step(time):
                nearest = min(nearest, left)
    Exchange(block).next_piece[0] = nearest
