"""Transition at an event, and contacts that no longer touch behind a step."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Pose, Rubs, Strikes
from ...tables.parts import Bodies, Contacts, Functions, Options, Patterns
from ...tables.sizes import Sizes
from ...tolerances import CLOSES_WITHIN, GAP_NOISE, RESTS_BELOW, STICK_SPEED, TOUCHES_WITHIN
from .. import status
from ..compiler.subset import jit, keep_small
from ..constraints.friction_rows import rubs, slips, touches
from ..constraints.kinematics import place_bodies
from ..dynamics.acceleration import LEAST_DRIFT, derivative, mend
from ..dynamics.forces import kinetic_energy, set_time
from ..dynamics.sliding import can_move
from ..dynamics.thresholds import decide_sides
from .binding import bind_what_touches, let_loose
from .complementarity import push_forces
from .doubts import record_doubts
from .event_record import EVENT, WITHIN, has_changed, keep_event, note_mode
from .guards import can_open, gap, place_contact, place_pattern
from .handover import hand_over
from .impact import MOST_ROUNDS, complete_impacts, keep_impact, strike
from .impact_laws import shock
from .inside import is_one_inside
from .rubbing import let_slip, look_at_slip, note_sticks, part, set_noted
from .trial import COUNT

# Contacts that no longer touch.


@jit
def release(block: Array, struck: int) -> None:
    """Contacts that touched at the step's start have come off by y_end, but for the one that strikes there.

    One that is open and comes back has been off, however low the hop: it strikes where its gap closes, not before.
    """
    keep_small()
    table = Contacts(block)
    contacts = table.mode.shape[0]
    first = 0
    while first < contacts and not _may_have_come_off(table, first, struck):
        first += 1
    if first == contacts:  # mostly nothing touches
        return
    at = place_bodies(block, Course(block).y_end)
    for c in range(first, contacts):
        if _may_have_come_off(table, c, struck):
            distance, rate = gap(block, at, c)
            if distance > GAP_NOISE or (distance > 0.0 and rate < -RESTS_BELOW):
                table.touching[c] = 0
                let_loose(block, c)


@jit
def _may_have_come_off(table: Contacts, contact: int, struck: int) -> bool:
    touched: bool = table.touching[contact] != 0 and table.mode[contact] == codes.OPEN and contact != struck
    return touched


# What happens at an event: x- becomes x+, and the mechanism's mode changes.
#
# In this order: the guard's own effect (the next tooth, a click, a logical function); impacts, until nothing
# approaches; mending of drift; the choice, among the contacts at rest, of those that push. All of it takes no time.

#: So many events within `PILE_TIME` [s] are no motion any more.
MOST_PILED = 2000
PILE_TIME = 1e-9


@jit
def transit(block: Array, guard: int, subject: int) -> int:
    """Let an event happen at y_end and STEP_END; return a status.

    `guard` is `codes.GUARD_BEGIN` when the motion begins and `codes.GUARD_INPUT` when an input has changed: then only
    the contacts that push are chosen afresh.
    """
    keep_small()
    only_choose = guard == codes.GUARD_INPUT or guard == codes.GUARD_BEGIN
    shocks = guard == codes.GUARD_SHOCK
    n = Sizes(block).coordinates
    now = Course(block)
    rate = now.y_end[n:]
    inverse_mass = Bodies(block).inverse_mass
    note_mode(block, EVENT)
    energy = kinetic_energy(inverse_mass, rate, n)
    work = now.y_end[Sizes(block).y_work]
    if guard == codes.GUARD_INPUT:
        note_sticks(block)
    outcome = _take_effect(block, guard, subject)
    if outcome != status.OK:
        return outcome
    struck = subject if guard == codes.GUARD_GAP else codes.NONE
    impulse = 0.0
    hits = 0
    earlier = now.counters[codes.COUNT_IMPACTS]
    settled = only_choose or shocks
    for round_ in range(MOST_ROUNDS):
        if settled:
            break
        approached, outcome = strike(block, struck, round_)
        if outcome != status.OK:
            return outcome
        settled = not approached
        if approached:
            hits += 1
            impulse += _struck_impulse(block)
        struck = codes.NONE
    outcome = status.CHATTERING
    if Sizes(block).thresholds > 0:
        decide_sides(block)
    if settled:
        outcome = _settle(block, guard, subject, hits > 0)
    lost = energy + (now.y_end[Sizes(block).y_work] - work) - kinetic_energy(inverse_mass, rate, n)
    complete_impacts(block, now.counters[codes.COUNT_IMPACTS] - earlier, lost)
    if outcome != status.OK:
        return outcome
    now.ledger[codes.LEDGER_LOST] += lost
    if not (only_choose or shocks) and _is_change(block, guard, subject):
        keep_event(block, guard, subject, EVENT, impulse)
    if guard == codes.GUARD_INPUT:
        if has_changed(block):
            keep_event(block, guard, subject, EVENT, impulse)
        _record_slips(block)
    if only_choose:
        return status.OK
    return _progress(block)


@jit
def _is_change(block: Array, guard: int, subject: int) -> bool:
    """Whether an event has changed what it is about.

    A contact whose force has come to zero may go on to push by its last digit, and let go in another event right
    behind; and friction at its bound moves nothing while other rows hold the same.
    """
    keep_small()
    if guard == codes.GUARD_PUSH:
        return has_changed(block)
    if guard == codes.GUARD_SLIP:
        derivative(block, Course(block).y_end, Course(block).dy_end)
        return not slips(block, subject) or can_move(block, subject)
    return True


@jit
def _record_slips(block: Array) -> None:
    """Record what stuck before an input changed, and slips now."""
    keep_small()
    rub = Rubs(block)
    for k in range(rub.slip.shape[0]):
        if rub.stuck[k] == 1 and slips(block, k) and _is_change(block, codes.GUARD_SLIP, k):
            keep_event(block, codes.GUARD_SLIP, k, EVENT, 0.0)


@jit
def _struck_impulse(block: Array) -> float:
    """Sum of the impulses' magnitudes over the contacts that have just struck, or been switched on in motion."""
    taking_part = Strikes(block)
    table = Contacts(block)
    total = 0.0
    for c in range(table.mode.shape[0]):
        switched_on = table.function[c] != codes.NONE and abs(taking_part.target[c]) > RESTS_BELOW
        if taking_part.closing[c] > 0.0 or switched_on:
            total += abs(taking_part.impulse[c])
    return total


@jit
def _take_effect(block: Array, guard: int, subject: int) -> int:
    """What the guard itself changes; return a status."""
    keep_small()
    table = Contacts(block)
    at = place_bodies(block, Course(block).y_end)
    if guard == codes.GUARD_HANDOVER:
        hand_over(block, at, subject)
    if Sizes(block).outlines > 0:
        outcome = bind_what_touches(block, at, subject if guard == codes.GUARD_GAP else codes.NONE)
        if outcome != status.OK:
            return outcome
    if guard == codes.GUARD_NEXT or guard == codes.GUARD_PREVIOUS:
        Patterns(block).copy[subject] += -1 if guard == codes.GUARD_PREVIOUS else 1
        place_pattern(block, at, subject)
        for c in range(table.mode.shape[0]):
            if table.pattern[c] == subject and table.function[c] == codes.NONE:
                table.mode[c] = codes.OPEN
                table.touching[c] = 0
        if is_one_inside(block):
            return status.PENETRATED
    elif guard == codes.GUARD_CLICK:
        table.clicks[subject] += 1
        place_contact(block, at, subject)
    elif guard == codes.GUARD_SLIP:
        set_time(block, Course(block).clock[codes.STEP_END])
        derivative(block, Course(block).y_end, Course(block).dy_end)
        let_slip(block, subject)
    elif guard == codes.GUARD_FUNCTION:
        Functions(block).true[subject] = 1 - Functions(block).true[subject]
        switch_contacts(block, at)
        for c in range(table.mode.shape[0]):
            if (
                table.function[c] == subject
                and table.mode[c] == codes.CLOSED
                and abs(gap(block, at, c)[0]) > CLOSES_WITHIN
            ):
                return status.ROW_AWAY
    return status.OK


@jit
def switch_contacts(block: Array, at: Pose) -> None:
    """Close and open the contacts that logical functions switch; a lock closes where it is nearest."""
    keep_small()
    table = Contacts(block)
    for c in range(table.mode.shape[0]):
        function = table.function[c]
        if function == codes.NONE:
            continue
        closed = Functions(block).true[function] == table.closes_when[c] and table.value[c, codes.ENABLED] > 0.5
        if closed and table.mode[c] == codes.OPEN:
            place_contact(block, at, c)
            table.mode[c] = codes.CLOSED
        elif not closed:
            table.mode[c] = codes.OPEN


@jit
def _settle(block: Array, guard: int, subject: int, hit: bool) -> int:
    """Choose, among the contacts that touch and rest, those that push, and how friction slips; return a status.

    Behind an event of this guard and subject, or `hit`, an impact. An impact without approach comes first where no
    finite forces agree with the motion any more.
    """
    keep_small()
    only_choose = guard == codes.GUARD_INPUT or guard == codes.GUARD_BEGIN
    shocks = guard == codes.GUARD_SHOCK
    fired = subject if guard == codes.GUARD_GAP else codes.NONE
    stopped = subject if guard == codes.GUARD_STICK else codes.NONE
    table = Contacts(block)
    near = GAP_NOISE
    slow = RESTS_BELOW
    if hit:
        near = TOUCHES_WITHIN
        slow = STICK_SPEED
    at = place_bodies(block, Course(block).y_end)
    count = 0
    for c in range(table.mode.shape[0]):
        if table.value[c, codes.ENABLED] < 0.5 or not can_open(block, c):
            continue
        if table.mode[c] == codes.OPEN:
            distance, rate = gap(block, at, c)
            if (distance > near and c != fired) or not abs(rate) < slow:
                continue
            table.mode[c] = codes.CLOSED
        Strikes(block).candidates[count] = c
        count += 1
    if not only_choose:
        # Also of what is about to open: a gap must not be left below zero. But nothing sticks meanwhile, because it may
        # have to slip, as where a row with a tiny lever has closed.
        note_sticks(block)
        set_noted(block, codes.APART)
        mend(block, LEAST_DRIFT, 0.0)
        set_noted(block, codes.STICKS)
    if count == 0 and not rubs(block):
        return status.OK
    Strikes(block).problem[COUNT] = count
    at = place_bodies(block, Course(block).y_end)
    look_at_slip(block, at, True, stopped)
    outcome = status.NO_CHOICE
    if not shocks:
        outcome = push_forces(block, at)
    if outcome == status.NO_CHOICE and Options(block).settings[codes.TANGENTIAL_SHOCK] > 0.5:
        outcome = _shock(block, count)
    if outcome == status.NO_CHOICE and shocks:
        outcome = status.JAMMED
    if outcome == status.OK and rubs(block):
        record_doubts(block, at, guard != codes.GUARD_INPUT)
    part(block)
    if rubs(block) and not only_choose:
        mend(block, LEAST_DRIFT, 0.0)  # what has come to rest
    at = place_bodies(block, Course(block).y_end)
    for k in range(count):
        c = Strikes(block).candidates[k]
        table.touching[c] = 1 - table.mode[c]
        if table.mode[c] == codes.OPEN and -TOUCHES_WITHIN < gap(block, at, c)[0] < -GAP_NOISE:
            table.touching[c] = codes.LEFT_INSIDE
    return outcome


@jit
def _shock(block: Array, count: int) -> int:
    """An impact without approach of `count` candidates, and the choice behind it; return a status."""
    keep_small()
    now = Course(block)
    n = Sizes(block).coordinates
    if not rubs(block):
        return status.NO_CHOICE
    for k in range(n):
        Strikes(block).rates_before[k] = now.y_end[n + k]
    note_mode(block, WITHIN)
    outcome = shock(block, place_bodies(block, now.y_end))
    if outcome != status.OK:
        return outcome
    total = 0.0
    first = codes.NONE
    for k in range(Sizes(block).rubs):
        if k < Sizes(block).contacts and Strikes(block).impulse[k] > 0.0:
            total += Strikes(block).impulse[k]
            keep_impact(block, k)
        if first == codes.NONE and touches(block, k) and abs(Rubs(block).force[k]) > 0.0:
            first = k
    keep_event(block, codes.GUARD_SHOCK, first, WITHIN, total)
    for k in range(count):
        Contacts(block).mode[Strikes(block).candidates[k]] = codes.CLOSED
    Strikes(block).problem[COUNT] = count
    at = place_bodies(block, now.y_end)
    look_at_slip(block, at, True, codes.NONE)
    return push_forces(block, at)


@jit
def _progress(block: Array) -> int:
    """Count events that follow each other without progress in time."""
    keep_small()
    now = Course(block)
    time = now.clock[codes.STEP_END]
    if time - now.clock[codes.LAST_EVENT] > PILE_TIME:
        now.clock[codes.LAST_EVENT] = time
        now.counters[codes.PILE] = 0
    now.counters[codes.PILE] += 1
    if now.counters[codes.PILE] > MOST_PILED:
        return status.CHATTERING
    return status.OK
