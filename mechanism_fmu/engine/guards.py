"""Guards: functions of position and rates that are positive until something happens.

In order: the gap of each contact; how far each stop with memory is from its next click; how far each pattern's point is
from the boundary to the next copy and to the previous one; how far each logical function is from its change. All but
gaps are passed by `MARGIN` before they count, so that what has just changed is well inside its new range.
"""

from __future__ import annotations

from .. import codes
from .point_line import point_line_gap
from .room import Array
from .rows import along_line
from .subset import jit, keep_small
from .views import contacts, functions, patterns, pose, sizes, strikes

#: How far a boundary, a pitch or a limit is passed before it counts [m, rad].
MARGIN = 1e-10
#: A gap less than this touches; one farther below zero at the start is inside [m, rad].
TOUCHES_WITHIN = 1e-9


@jit
def gap(block: Array, contact: int) -> tuple[float, float]:
    """Gap s [m or rad] and gap rate s' of a contact at the bodies' pose (see `place_bodies`)."""
    keep_small()
    table = contacts(block)
    at = pose(block)
    i = table.body_i[contact]
    j = table.body_j[contact]
    line = table.line[contact]
    if table.kind[contact] == codes.POINT_LINE:
        return point_line_gap(at, i, j, table.data[contact], line)
    return at.phi[i] - at.phi[j] - line[0], at.phi_rate[i] - at.phi_rate[j]


@jit
def guard_of(block: Array, number: int) -> tuple[int, int]:
    """The guard (`codes.GUARD_GAP` ...) with this number, and its contact, pattern or logical function."""
    keep_small()
    count = sizes(block).contacts
    if number < count:
        return codes.GUARD_GAP, number
    number -= count
    if number < count:
        return codes.GUARD_CLICK, number
    number -= count
    count = sizes(block).patterns
    if number < count:
        return codes.GUARD_NEXT, number
    number -= count
    if number < count:
        return codes.GUARD_PREVIOUS, number
    return codes.GUARD_FUNCTION, number - count


@jit
def is_watched(block: Array, number: int) -> bool:
    """Whether this guard can do anything in the present mode."""
    keep_small()
    guard, subject = guard_of(block, number)
    table = contacts(block)
    if guard == codes.GUARD_FUNCTION:
        return True
    if guard == codes.GUARD_NEXT or guard == codes.GUARD_PREVIOUS:
        repeats: bool = patterns(block).enabled[subject] > 0.5
        return repeats
    exists = table.value[subject, codes.ENABLED] > 0.5
    if guard == codes.GUARD_CLICK:
        clicks: bool = exists and table.kind[subject] == codes.ANGLE_STOP
        return clicks and table.data[subject, codes.STOP_PITCH] > 0.0
    opened: bool = exists and table.mode[subject] == codes.OPEN and table.function[subject] == codes.NONE
    return opened


@jit
def guard_value(block: Array, number: int) -> tuple[float, float]:
    """Value and rate of a guard at the bodies' pose."""
    keep_small()
    guard, subject = guard_of(block, number)
    if guard == codes.GUARD_GAP:
        return gap(block, subject)
    if guard == codes.GUARD_CLICK:
        value, rate = gap(block, subject)
        return contacts(block).data[subject, codes.STOP_PITCH] + MARGIN - value, -rate
    if guard == codes.GUARD_FUNCTION:
        value, rate = function_value(block, subject)
        if functions(block).true[subject] == 1:
            return MARGIN - value, -rate
        return value + MARGIN, rate
    table = patterns(block)
    i = table.body_i[subject]
    j = table.body_j[subject]
    if guard == codes.GUARD_NEXT:
        value, rate = point_line_gap(pose(block), i, j, table.data[subject], table.line[subject, :4])
        return MARGIN - value, -rate
    value, rate = point_line_gap(pose(block), i, j, table.data[subject], table.line[subject, 4:])
    return value + MARGIN, rate


@jit
def function_value(block: Array, function: int) -> tuple[float, float]:
    """What a logical function looks at minus its limit (below zero: 1), and its rate."""
    keep_small()
    table = functions(block)
    at = pose(block)
    index = table.subject[function]
    limit = table.limit[function]
    if table.kind[function] == codes.ANGLE:
        return at.phi[index] - limit, at.phi_rate[index]
    contact = contacts(block)
    line = strikes(block).line
    along_line(block, index, line)
    value, rate = point_line_gap(at, contact.body_i[index], contact.body_j[index], contact.data[index], line)
    return value - limit, rate
