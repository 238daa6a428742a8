"""Records of impacts and events: of the last one, and of all within the communication step."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Strikes
from ...tables.parts import Bodies, Contacts, Patterns
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small


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
    place = now.counters[codes.COUNT_IN_STEP]
    if place == codes.IMPACT_BUFFER_LENGTH:
        now.counters[codes.COUNT_LOST] += 1
        _make_room(now.impacts)
        place -= 1
    else:
        now.counters[codes.COUNT_IN_STEP] = place + 1
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
        _share(block, now.impacts[b])
        now.impacts[b, codes.RECORD_ENERGY] = energy
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
def keep_event(block: Array, guard: int, subject: int, old_mode: float, impulse: float) -> None:
    """Record an event at STEP_END; when the buffer is full, the oldest is lost."""
    keep_small()
    now = Course(block)
    now.counters[codes.COUNT_EVENTS] += 1
    place = now.counters[codes.EVENTS_IN_STEP]
    if place == codes.EVENT_BUFFER_LENGTH:
        _make_room(now.events)
        place -= 1
    else:
        now.counters[codes.EVENTS_IN_STEP] = place + 1
    record = now.events[place]
    record[codes.EVENT_TIME] = now.clock[codes.STEP_END]
    record[codes.EVENT_GUARD] = guard
    record[codes.EVENT_SUBJECT] = subject
    record[codes.EVENT_OLD_MODE] = old_mode
    record[codes.EVENT_NEW_MODE] = mode_number(block)
    record[codes.EVENT_IMPULSE] = impulse


@jit
def mode_number(block: Array) -> float:
    """The mode of the mechanism: the sum of 2^c over its closed contacts c."""
    mode = Contacts(block).mode
    number = 0.0
    bit = 1.0
    for c in range(mode.shape[0]):
        if mode[c] == codes.CLOSED:
            number += bit
        bit *= 2.0
    return number


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
    for b in range(now.counters[codes.EVENTS_IN_STEP]):
        for k in range(now.events.shape[1]):
            now.events[b, k] = 0.0
    now.counters[codes.EVENTS_IN_STEP] = 0


@jit
def _copy(block: Array, contact: int) -> int:
    """The index of the tooth: of the contact's pattern, or the clicks of a stop."""
    table = Contacts(block)
    pattern = table.pattern[contact]
    if pattern == codes.NONE:
        clicks: int = table.clicks[contact]
        return clicks
    index: int = Patterns(block).copy[pattern]
    return index


@jit
def _make_room(buffer: Array) -> None:
    """Drop the first row and move the others up."""
    for b in range(buffer.shape[0] - 1):
        for k in range(buffer.shape[1]):
            buffer[b, k] = buffer[b + 1, k]
