"""The start guess: where bodies and patterns begin, before assembly."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Loads
from ...tables.parts import Bodies, Contacts, Functions, Options, Patterns
from ...tables.sizes import Sizes
from ...tolerances import TOUCHES_WITHIN
from ..compiler.subset import jit
from ..constraints.kinematics import place_bodies
from ..contacts.copies import place_contact, place_pattern
from ..contacts.guards import function_value, gap, guard_value
from ..contacts.transition import switch_contacts

#: Copies of a pattern that are passed in search of the one where the point is.
_MOST_COPIES = 4000


@jit
def start_guess(block: Array, offset: int) -> None:
    """The bodies' start guess, the contacts that are closed there, and patterns `offset` copies beside where it is."""
    n = Sizes(block).coordinates
    body = Bodies(block)
    now = Course(block)
    table = Contacts(block)
    weight = Loads(block).weight
    for i in range(body.start.shape[0]):
        for k in range(3):
            now.y_end[3 * i + k] = body.start[i, k]
            now.y_end[n + 3 * i + k] = body.start_rate[i, k]
            weight[3 * i + k] = 1.0
    held = Options(block).held
    for k in range(held.shape[0]):
        weight[held[k]] = 0.0
    at = place_bodies(block, now.y_end)
    for p in range(Patterns(block).copy.shape[0]):
        Patterns(block).copy[p] = 0
        place_pattern(block, at, p)
    for c in range(table.mode.shape[0]):
        table.clicks[c] = 0
        table.mode[c] = codes.OPEN
        if table.value[c, codes.STARTS_CLOSED] > 0.5 and table.value[c, codes.ENABLED] > 0.5:
            table.mode[c] = codes.CLOSED
        place_contact(block, at, c)
    find_copies(block)
    for p in range(Patterns(block).copy.shape[0]):
        if Patterns(block).enabled[p] > 0.5:
            Patterns(block).copy[p] += offset
            place_pattern(block, at, p)
    for f in range(Functions(block).true.shape[0]):
        Functions(block).true[f] = 0
        if function_value(block, at, f)[0] < 0.0:
            Functions(block).true[f] = 1
    switch_contacts(block, at)


@jit
def find_copies(block: Array) -> bool:
    """Go to the copy of each pattern where its point is at y_end; whether any was another than before."""
    table = Patterns(block)
    first_next = 2 * Sizes(block).contacts
    count = table.copy.shape[0]
    at = place_bodies(block, Course(block).y_end)
    moved = False
    for p in range(count):
        for _ in range(_MOST_COPIES):
            if table.enabled[p] < 0.5:
                break
            if guard_value(block, at, first_next + p)[0] <= 0.0:
                table.copy[p] += 1
            elif guard_value(block, at, first_next + count + p)[0] <= 0.0:
                table.copy[p] -= 1
            else:
                break
            place_pattern(block, at, p)
            moved = True
    return moved


@jit
def is_inside(block: Array) -> bool:
    """Whether a point of a pattern is behind one of the other lines there, which logical functions do not switch."""
    table = Contacts(block)
    at = place_bodies(block, Course(block).y_end)
    inside = False
    for c in range(table.mode.shape[0]):
        pattern = table.pattern[c]
        if pattern == codes.NONE or table.mode[c] == codes.CLOSED or table.value[c, codes.ENABLED] < 0.5:
            continue
        if table.function[c] == codes.NONE and Patterns(block).enabled[pattern] > 0.5:
            inside = inside or gap(block, at, c)[0] < -TOUCHES_WITHIN
    return inside
