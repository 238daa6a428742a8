"""Impacts by eq (7) with inequalities, their friction, and the records of them."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Pose, Rows, Strikes
from ...tables.parts import Bodies, Contacts, Patterns
from ...tables.sizes import Sizes
from ...tolerances import PILED, RESTS_BELOW, RESTS_WHERE_PILED, STICK_SPEED, TOUCHES_WITHIN
from .. import status
from ..compiler.subset import jit, keep_small
from ..constraints.friction_rows import rubs
from ..constraints.kinematics import place_bodies
from ..constraints.point_line import spare_row
from ..constraints.rows import contact_row
from ..constraints.wear import wear_by_impact
from ..dynamics.acceleration import LEAST_DRIFT, mend
from ..scales import contact_speed, contact_unit
from .guards import gap
from .impact_laws import exchange
from .participation import island_of
from .rubbing import note_sticks, set_noted
from .trial import ABSENT, COUNT, DECIDED, KEPT

# The impact law: velocity jump and impulses (Pennestrì et al., eqs (4), (6), (7)), for all touching contacts together.
#
# Joints and closed guided contacts keep their rows, v = 0. Every touching contact that approaches must separate with e
# times its closing speed (with 0 when that is below `STICK_SPEED`), every one at rest must not approach, and impulses
# only push: p >= 0, s'+ >= e |s'-|, p (s'+ - e |s'-|) = 0. One contact alone gives eq (7). Contacts that already
# separate take no part, so that the energy cannot grow (dT = -1/2 sum p (1 - e) |s'-|); when the impact turns one of
# them round, it strikes in the next round, at the same instant.

#: From this round at the same instant on, all impacts are plastic and all touching contacts take part: that ends it.
_PLASTIC_FROM = 32
MOST_ROUNDS = 40


@jit
def strike(block: Array, struck: int, round_: int) -> tuple[bool, int]:
    """One round of impacts at y_end: x- becomes x+, and a record is kept of each contact that strikes.

    `struck` is the contact whose gap has just become zero, or `codes.NONE`. Return whether any contact approached (else
    nothing is changed, but that joints' rates may have been mended), and a status.
    """
    keep_small()
    n = Sizes(block).coordinates
    table = Contacts(block)
    taking_part = Strikes(block)
    rate = Course(block).y_end[n:]
    at = place_bodies(block, Course(block).y_end)
    if not _cast(block, at, struck, round_):
        return False, status.OK
    if round_ == 0 and rubs(block):
        _mend_rates(block)
        at = place_bodies(block, Course(block).y_end)
        if not _cast(block, at, struck, round_):
            return False, status.OK
    count = 0
    for c in range(table.mode.shape[0]):
        if taking_part.role[c] == DECIDED:
            taking_part.candidates[count] = c
            count += 1
        if taking_part.role[c] != ABSENT:
            table.mode[c] = codes.CLOSED
    taking_part.problem[COUNT] = count
    for k in range(n):
        if round_ == 0:
            taking_part.rates_before[k] = rate[k]
    outcome = exchange(block, at)
    if outcome != status.OK:
        return False, outcome
    if Sizes(block).wears > 0:
        wear_by_impact(block, place_bodies(block, Course(block).y_end), Course(block).y_end)
    _keep_impacts(block)
    _open_what_leaves(block)
    return True, outcome


@jit
def _mend_rates(block: Array) -> None:
    """Bring joints' rates back to zero before an impact with friction.

    What may drift else is more than the rounding within which slip that stops is told from slip that goes on.
    """
    keep_small()
    note_sticks(block)
    set_noted(block, codes.APART)
    mend(block, math.inf, LEAST_DRIFT)
    set_noted(block, codes.STICKS)


@jit
def _cast(block: Array, at: Pose, struck: int, round_: int) -> bool:
    """Give every contact its role, closing speed and target; whether any of them approaches.

    Where none of an island does, none of it takes part.
    """
    keep_small()
    table = Contacts(block)
    taking_part = Strikes(block)
    plastic = round_ >= _PLASTIC_FROM
    some = False
    piled = Course(block).counters[codes.PILE] >= PILED
    for c in range(table.mode.shape[0]):
        taking_part.role[c] = ABSENT
        taking_part.closing[c] = 0.0
        taking_part.target[c] = 0.0
        island = island_of(block, c)
        if island == codes.NONE or table.value[c, codes.ENABLED] < 0.5:
            continue
        closed = table.mode[c] == codes.CLOSED
        guided = table.value[c, codes.GUIDED] > 0.5
        switched = table.function[c] != codes.NONE
        if closed and guided:
            taking_part.role[c] = KEPT
            continue
        distance, rate = gap(block, at, c)
        unit = contact_unit(block, c)
        rests_below = RESTS_BELOW * contact_speed(block, c)
        sticks_below = STICK_SPEED * contact_speed(block, c)
        if switched:
            if closed:
                taking_part.role[c] = KEPT
                taking_part.target[c] = -rate
                if abs(rate) > rests_below:
                    taking_part.approached[island] = round_ + 1
                    some = True
                if abs(rate) >= sticks_below:  # switched on in motion, from either side; below, drift and rounding
                    taking_part.closing[c] = abs(rate)
            continue
        touches = closed or c == struck or distance <= TOUCHES_WITHIN * unit
        approaches = not closed and (rate < -rests_below or (c == struck and guided and rate < 0.0))
        if not touches or not (closed or plastic or approaches or rate <= rests_below):
            continue
        taking_part.role[c] = KEPT if guided else DECIDED
        if guided and not approaches:
            taking_part.role[c] = ABSENT
        taking_part.target[c] = -rate
        if rate > 0.0 and not plastic:
            # At rest but for a leftover of less than `STICK_SPEED`: it may turn round, as an elastic contact would.
            # That keeps the problem solvable (by reversing all rates) and the energy from growing.
            taking_part.target[c] = -2.0 * rate
        if approaches:
            taking_part.approached[island] = round_ + 1
            some = True
            taking_part.closing[c] = -rate
            restitution = table.value[c, codes.RESTITUTION]
            if piled:
                sticks_below *= RESTS_WHERE_PILED / STICK_SPEED
            if not plastic and restitution * -rate >= sticks_below:
                taking_part.target[c] = (1.0 + restitution) * -rate
    for c in range(table.mode.shape[0]):
        if taking_part.role[c] == DECIDED and taking_part.approached[island_of(block, c)] != round_ + 1:
            taking_part.role[c] = ABSENT
            taking_part.target[c] = 0.0
    return some


@jit
def _open_what_leaves(block: Array) -> None:
    """After the impact: what comes apart faster than `STICK_SPEED` is open, what rests is closed for the time being."""
    keep_small()
    table = Contacts(block)
    taking_part = Strikes(block)
    at = place_bodies(block, Course(block).y_end)
    for c in range(table.mode.shape[0]):
        if taking_part.role[c] == ABSENT or table.function[c] != codes.NONE:
            continue
        if taking_part.role[c] == KEPT and taking_part.closing[c] == 0.0:
            continue
        contact_row(block, at, c, spare_row(block))
        if Rows(block).residual_rate[spare_row(block)] < STICK_SPEED * contact_speed(block, c):
            table.mode[c] = codes.CLOSED
        else:
            table.mode[c] = codes.OPEN
            table.touching[c] = 1


# Records of impacts: of the last one, and of all within the communication step.


@jit
def _keep_impacts(block: Array) -> None:
    """Record the impacts of all contacts that strike, in their order.

    Of more than the buffer holds, as where hundreds land at once, the first ones are only counted.
    """
    keep_small()
    now = Course(block)
    taking_part = Strikes(block)
    strikes = 0
    for c in range(taking_part.role.shape[0]):
        if taking_part.role[c] != ABSENT and taking_part.closing[c] > 0.0:
            strikes += 1
    passed = max(0, strikes - now.impacts.shape[0])
    now.counters[codes.COUNT_IMPACTS] += passed
    now.counters[codes.COUNT_LOST] += passed
    for c in range(taking_part.role.shape[0]):
        if taking_part.role[c] != ABSENT and taking_part.closing[c] > 0.0:
            if passed > 0:
                passed -= 1
            else:
                keep_impact(block, c)


@jit
def keep_impact(block: Array, contact: int) -> None:
    """Record the impact of one contact from `strikes`; when the buffer is full, the oldest is lost.

    What all impacts of an instant share is known, and written, when they are over (`complete_impacts`).
    """
    keep_small()
    table = Contacts(block)
    now = Course(block)
    taking_part = Strikes(block)
    record = now.last_impact
    record[codes.RECORD_TIME] = now.clock[codes.STEP_END]
    record[codes.RECORD_CONTACT] = contact
    record[codes.RECORD_TOOTH] = _copy(block, contact)
    record[codes.RECORD_CLOSING_SPEED] = taking_part.closing[contact]
    record[codes.RECORD_IMPULSE] = taking_part.impulse[contact]
    record[codes.RECORD_INSTANT] = now.counters[codes.COUNT_INSTANTS] + 1.0
    record[codes.RECORD_ENERGY] = 0.0
    first = codes.RECORD_CONTACT_IMPULSES
    for c in range(table.mode.shape[0]):
        record[first + c] = taking_part.impulse[c]
    _share(block, record)

    now.counters[codes.COUNT_IMPACTS] += 1
    if now.counters[codes.COUNT_IN_STEP] == now.impacts.shape[0]:
        now.counters[codes.COUNT_LOST] += 1
    place = next_place(now.counters, codes.COUNT_IN_STEP, codes.FIRST_IMPACT, now.impacts.shape[0])
    for k in range(now.impacts.shape[1]):
        now.impacts[place, k] = record[k]


@jit
def complete_impacts(block: Array, made: int, energy: float) -> None:
    """Write what all impacts of an instant share into each of its records, which are the last `made` ones.

    These are the rates before its first round and after it has settled, v_I, and the `energy` [J] lost from then to
    then.
    """
    keep_small()
    now = Course(block)
    if made == 0:
        return
    now.counters[codes.COUNT_INSTANTS] += 1
    kept: int = now.counters[codes.COUNT_IN_STEP]
    for b in range(max(0, kept - made), kept):
        record = now.impacts[(now.counters[codes.FIRST_IMPACT] + b) % now.impacts.shape[0]]
        _share(block, record)
        record[codes.RECORD_ENERGY] = energy
    _share(block, now.last_impact)
    now.last_impact[codes.RECORD_ENERGY] = energy


@jit
def _share(block: Array, record: Array) -> None:
    """Write rates before the instant, those at y_end, and v_I = l (rate after - rate before) of the body with teeth.

    Other bodies have l = 0; there is one with teeth at the most (`model.sources`).
    """
    keep_small()
    n = Sizes(block).coordinates
    tooth_length = Bodies(block).tooth_length
    rate = Course(block).y_end[n:]
    before = Strikes(block).rates_before
    first = codes.RECORD_CONTACT_IMPULSES + Contacts(block).mode.shape[0]
    for k in range(n):
        record[first + k] = before[k]
        record[first + n + k] = rate[k]
    velocity = 0.0
    for b in range(tooth_length.shape[0]):
        velocity += tooth_length[b] * (rate[3 * b + 2] - before[3 * b + 2])
    record[codes.RECORD_VELOCITY] = velocity


@jit
def clear_impact(record: Array) -> None:
    """Make an impact record say that there was none: time, contact and tooth -1, all else 0."""
    for k in range(record.shape[0]):
        record[k] = 0.0
    record[codes.RECORD_TIME] = -1.0
    record[codes.RECORD_CONTACT] = -1.0
    record[codes.RECORD_TOOTH] = -1.0


@jit
def clear_records(block: Array) -> None:
    """Begin a communication step: empty the buffers."""
    now = Course(block)
    for b in range(now.counters[codes.COUNT_IN_STEP]):
        clear_impact(now.impacts[b])
    now.counters[codes.COUNT_IN_STEP] = 0
    now.counters[codes.FIRST_IMPACT] = 0
    for b in range(now.counters[codes.EVENTS_IN_STEP]):
        for k in range(now.events.shape[1]):
            now.events[b, k] = 0.0
    now.counters[codes.EVENTS_IN_STEP] = 0
    now.counters[codes.FIRST_EVENT] = 0


@jit
def _copy(block: Array, contact: int) -> int:
    """The index of the tooth: of the contact's pattern, or the clicks of a stop."""
    table = Contacts(block)
    pattern = table.pattern[contact]
    if table.kind[contact] == codes.OUTLINE:
        copy: int = table.copy[contact]
        return copy
    if pattern == codes.NONE:
        clicks: int = table.clicks[contact]
        return clicks
    index: int = Patterns(block).copy[pattern]
    return index


@jit
def next_place(counters: Array, kept: int, first: int, places: int) -> int:
    """The place of the next record in a buffer that goes round; where it is full, the oldest record is lost.

    The counters `kept` and `first` say how many records there are, and where the oldest one is.
    """
    keep_small()
    place: int = (counters[first] + counters[kept]) % places
    if counters[kept] == places:
        counters[first] = (place + 1) % places
    else:
        counters[kept] += 1
    return place
