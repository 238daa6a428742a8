"""Records of events within the communication step, with the modes of all contacts before and after each."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Strikes
from ...tables.parts import Contacts
from ..compiler.subset import jit, keep_small
from .impact import next_place

#: Which mode a record calls the old one: that before the event, or before what happens within it, such as a shock.
EVENT = 0
WITHIN = 1

#: What follows the last bit of a number that holds modes.
_FULL = 2.0**codes.MODE_BITS


@jit
def note_mode(block: Array, which: int) -> None:
    """Note the present modes of all contacts, for the record of what happens next."""
    keep_small()
    mode = Contacts(block).mode
    earlier = Strikes(block).earlier
    for c in range(mode.shape[0]):
        earlier[c, which] = mode[c]


@jit
def has_changed(block: Array) -> bool:
    """Whether any contact has another mode than before the event."""
    keep_small()
    mode = Contacts(block).mode
    earlier = Strikes(block).earlier
    changed = False
    for c in range(mode.shape[0]):
        changed = changed or mode[c] != earlier[c, EVENT]
    return changed


@jit
def keep_event(block: Array, guard: int, subject: int, which: int, impulse: float) -> None:
    """Record an event at STEP_END, since the mode noted as `which`; when the buffer is full, the oldest is lost."""
    keep_small()
    now = Course(block)
    now.counters[codes.COUNT_EVENTS] += 1
    place = next_place(now.counters, codes.EVENTS_IN_STEP, codes.FIRST_EVENT, now.events.shape[0])
    record = now.events[place]
    record[codes.EVENT_TIME] = now.clock[codes.STEP_END]
    record[codes.EVENT_GUARD] = guard
    record[codes.EVENT_SUBJECT] = subject
    record[codes.EVENT_IMPULSE] = impulse
    _write_modes(block, record, which)


@jit
def _write_modes(block: Array, record: Array, which: int) -> None:
    """Old and new modes: sums of 2^c over the closed ones of `codes.MODE_BITS` contacts each, by turns."""
    keep_small()
    mode = Contacts(block).mode
    earlier = Strikes(block).earlier
    for k in range(codes.EVENT_OLD_MODE, record.shape[0]):
        record[k] = 0.0
    old = codes.EVENT_OLD_MODE
    new = codes.EVENT_NEW_MODE
    bit = 1.0
    for c in range(mode.shape[0]):
        if earlier[c, which] == codes.CLOSED:
            record[old] += bit
        if mode[c] == codes.CLOSED:
            record[new] += bit
        bit *= 2.0
        if bit == _FULL:
            bit = 1.0
            old += 2
            new += 2
