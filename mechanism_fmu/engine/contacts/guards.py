"""Gaps and guards: where the contacts stand now, and what an event is about."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Pose, Rows, Rubs, Strikes
from ...tables.parts import Contacts, Functions, Patterns
from ...tables.sizes import Sizes
from ...tolerances import MARGIN, PASSES_BY, TOUCHES_WITHIN
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.entries import begin_row
from ..constraints.friction_rows import friction_row, slips
from ..constraints.point_line import point_line, spare_row, tangent_row
from ..constraints.rows import contact_row
from ..elementary import sine_cosine
from ..outlines.nearest import EXACT, NEXT, nearest
from ..profiles.nearest import find_nearest, is_searched
from ..scales import guard_unit, length_scale
from .binding import free_place, is_free, is_outline, let_loose, take_found
from .handover import left_to_go

# Where the contacts stand now: the present copy of a pattern, the present angle of a stop or lock.


@jit
def place_contact(block: Array, at: Pose, contact: int) -> None:
    """Write `contacts.line` of one contact for the present index of its pattern, or its present clicks.

    A lock goes to the locked angle that is nearest to the bodies' pose (see `place_bodies`).
    """
    keep_small()
    table = Contacts(block)
    data = table.data[contact]
    line = table.line[contact]
    if table.kind[contact] == codes.POINT_LINE:
        pattern = table.pattern[contact]
        angle = 0.0
        if pattern != codes.NONE:
            angle = Patterns(block).copy[pattern] * Patterns(block).pitch[pattern]
        turn_line(data[2:], angle, line)
    elif table.alpha[contact] == codes.NONE and table.kind[contact] != codes.OUTLINE:
        turns = float(table.clicks[contact])
        pitch = data[codes.STOP_PITCH]
        if table.kind[contact] == codes.ANGLE_LOCK:
            relative = at.phi[table.body_i[contact]] - at.phi[table.body_j[contact]]
            turns = math.floor((relative - data[codes.STOP_ANGLE]) / pitch + 0.5)
        line[0] = data[codes.STOP_ANGLE] + turns * pitch


@jit
def place_pattern(block: Array, at: Pose, pattern: int) -> None:
    """Write the boundaries of a pattern's present copy, to the next and to the previous one, and its contacts."""
    keep_small()
    table = Patterns(block)
    index = table.copy[pattern]
    pitch = table.pitch[pattern]
    boundary = table.data[pattern, 2:]
    turn_line(boundary, index * pitch, table.line[pattern, :4])
    turn_line(boundary, (index - 1) * pitch, table.line[pattern, 4:])
    of = Contacts(block).pattern
    for c in range(of.shape[0]):
        if of[c] == pattern:
            place_contact(block, at, c)


@jit
def turn_line(source: Array, angle: float, target: Array) -> None:
    """A line (point, normal), turned by `angle` [rad] about the origin."""
    keep_small()
    s, c = sine_cosine(angle)
    for k in range(0, 4, 2):
        target[k] = c * source[k] - s * source[k + 1]
        target[k + 1] = s * source[k] + c * source[k + 1]


# Guards: functions of position and rates that are positive until something happens.
#
# In order: the gap of each contact; how far each stop with memory is from its next click, and where outlines touch the
# place of contact from the end of a feature; how far each pattern's point
# is from the boundary to the next copy and to the previous one; how far each logical function is from its change; slip
# speeds. All but gaps and slip speeds are passed by `MARGIN` or `PASSES_BY` before they count, so that what has just
# changed is well inside its new range.


@jit
def gap(block: Array, at: Pose, contact: int) -> tuple[float, float]:
    """Gap s [m or rad] and gap rate s' of a contact at the bodies' pose (see `place_bodies`)."""
    keep_small()
    if Contacts(block).alpha[contact] != codes.NONE and is_searched(block, contact):
        find_nearest(block, at, contact)
    contact_row(block, at, contact, spare_row(block))
    return _spare(block)


@jit
def shown_gap(block: Array, at: Pose, contact: int) -> tuple[float, float]:
    """As `gap`; of outlines, where nothing touches, that of the nearest features."""
    keep_apart()
    if not is_free(block, contact):
        return gap(block, at, contact)
    distance = nearest(block, at, contact, EXACT)
    table = Contacts(block)
    apart = table.apart[table.group[contact]]
    take_found(block, contact)
    rate = gap(block, at, contact)[1]
    let_loose(block, contact)
    table.apart[table.group[contact]] = apart  # who reads outputs changes nothing
    return distance, rate


@jit
def _spare(block: Array) -> tuple[float, float]:
    """Residual and rate of the spare row."""
    spare = spare_row(block)
    return Rows(block).residual[spare], Rows(block).residual_rate[spare]


@jit
def guard_of(block: Array, number: int) -> tuple[int, int]:
    """The guard (`codes.GUARD_GAP` ...) with this number, and its contact, pattern or logical function."""
    keep_small()
    count = Sizes(block).contacts
    if number < count:
        return codes.GUARD_GAP, number
    number -= count
    if number < count:
        if is_outline(block, number):
            return codes.GUARD_HANDOVER, number
        return codes.GUARD_CLICK, number
    number -= count
    count = Sizes(block).patterns
    if number < count:
        return codes.GUARD_NEXT, number
    number -= count
    if number < count:
        return codes.GUARD_PREVIOUS, number
    number -= count
    count = Sizes(block).functions
    if number < count:
        return codes.GUARD_FUNCTION, number
    return codes.GUARD_STICK, number - count


@jit
def is_watched(block: Array, number: int) -> bool:
    """Whether this guard can do anything in the present mode."""
    keep_small()
    guard, subject = guard_of(block, number)
    table = Contacts(block)
    if guard == codes.GUARD_FUNCTION:
        return True
    if guard == codes.GUARD_STICK:
        return slips(block, subject)
    if guard == codes.GUARD_NEXT or guard == codes.GUARD_PREVIOUS:
        repeats: bool = Patterns(block).enabled[subject] > 0.5
        return repeats
    exists = table.value[subject, codes.ENABLED] > 0.5
    if guard == codes.GUARD_HANDOVER:
        ends: bool = exists and table.mode[subject] == codes.CLOSED
        return ends
    if exists and is_free(block, subject):
        return free_place(block, table.group[subject]) == subject
    if guard == codes.GUARD_CLICK:
        clicks: bool = exists and table.kind[subject] == codes.ANGLE_STOP
        return clicks and table.data[subject, codes.STOP_PITCH] > 0.0
    opened: bool = exists and table.mode[subject] == codes.OPEN and table.function[subject] == codes.NONE
    return opened


@jit
def stands_for_search(block: Array, number: int) -> bool:
    """Whether a guard is the distance of what two outlines touch with next, whichever of their features it is."""
    guard, subject = guard_of(block, number)
    return guard == codes.GUARD_GAP and is_free(block, subject)


@jit
def can_open(block: Array, contact: int) -> bool:
    """Whether a closed contact opens when it would pull."""
    table = Contacts(block)
    opens: bool = table.function[contact] == codes.NONE and table.value[contact, codes.GUIDED] < 0.5
    return opens


@jit
def guard_value(block: Array, at: Pose, number: int) -> tuple[float, float]:
    """Value and rate of a guard at the bodies' pose."""
    keep_small()
    guard, subject = guard_of(block, number)
    if guard == codes.GUARD_GAP:
        if is_free(block, subject):
            return min(nearest(block, at, subject, NEXT), _least_open(block, at, subject)), 0.0
        return gap(block, at, subject)
    if guard == codes.GUARD_HANDOVER:
        return left_to_go(block, at, subject)[0] + PASSES_BY * length_scale(block), 0.0
    if guard == codes.GUARD_CLICK:
        value, rate = gap(block, at, subject)
        return Contacts(block).data[subject, codes.STOP_PITCH] + MARGIN - value, -rate
    if guard == codes.GUARD_STICK:
        return slip_of(block, at, subject), 0.0
    margin = MARGIN * guard_unit(block, guard, subject)
    if guard == codes.GUARD_FUNCTION:
        value, rate = function_value(block, at, subject)
        if Functions(block).true[subject] == 1:
            return margin - value, -rate
        return value + margin, rate
    if guard == codes.GUARD_NEXT:
        value, rate = _beyond(block, at, subject, Patterns(block).line[subject, :4])
        return margin - value, -rate
    value, rate = _beyond(block, at, subject, Patterns(block).line[subject, 4:])
    return value + margin, rate


@jit
def _least_open(block: Array, at: Pose, contact: int) -> float:
    """How far what has come off in a group of contacts is from touching beside where it did, at least [m], above zero.

    It is off by its gap, and what follows there begins at the end of the feature that it touched.
    """
    keep_small()
    table = Contacts(block)
    least = math.inf
    for c in range(table.group[contact], table.mode.shape[0]):
        if table.group[c] != table.group[contact]:
            break
        if table.mode[c] == codes.OPEN and table.feature_i[c] != codes.NONE:
            least = min(least, max(gap(block, at, c)[0], left_to_go(block, at, c)[0]))
    return max(least, TOUCHES_WITHIN * length_scale(block))


@jit
def slip_of(block: Array, at: Pose, rub: int) -> float:
    """Slip speed of a contact or joint that slips, positive where it slips as it is taken to."""
    keep_small()
    friction_row(block, at, rub, spare_row(block))
    slip: float = float(Rubs(block).slip[rub]) * _spare(block)[1]
    return slip


@jit
def _beyond(block: Array, at: Pose, pattern: int, boundary: Array) -> tuple[float, float]:
    """How far a pattern's point is beyond a boundary, and its rate."""
    keep_small()
    table = Patterns(block)
    i, j = table.body_i[pattern], table.body_j[pattern]
    begin_row(Rows(block), spare_row(block), i, j)
    point_line(at, Rows(block), spare_row(block), i, j, table.data[pattern], boundary)
    return _spare(block)


@jit
def function_value(block: Array, at: Pose, function: int) -> tuple[float, float]:
    """What a logical function looks at minus its limit (below zero: 1), and its rate."""
    keep_small()
    table = Functions(block)
    index = table.subject[function]
    limit = table.limit[function]
    if table.kind[function] == codes.ANGLE:
        return at.phi[index] - limit, at.phi_rate[index]
    tangent_row(block, at, index, Strikes(block).tangent_line)
    value, rate = _spare(block)
    return value - limit, rate
