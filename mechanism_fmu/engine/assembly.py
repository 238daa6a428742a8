"""Assembly of the start position, and the start of the motion."""

from __future__ import annotations

import math

from .. import codes
from ..tolerances import STICK_SPEED, TOUCHES_WITHIN
from . import status
from .copies import place_contact, place_pattern
from .guards import function_value, gap, guard_value
from .kinematics import place_bodies
from .minimum_norm import minimum_norm
from .nearest import find_contact_points, settle_contact_points
from .overlap import overlap
from .ports import set_time, take_inputs
from .profile_shape import examine_profiles
from .records import clear_impact, clear_records
from .room import Array
from .rows import active_rows
from .subset import entry, jit, keep_small
from .transition import switch_contacts
from .vectors import clear, copy
from .views import (
    bodies,
    contacts,
    course,
    functions,
    linear_system,
    loads,
    options,
    patterns,
    ports,
    rows,
    sizes,
    stages,
)

#: Position rows are closed when none is off by more than this [m, rad, m^2].
CLOSED_WITHIN = 1e-12
#: Start rates agree with the joints within this [m/s, rad/s].
RATES_WITHIN = 1e-9
#: Rates of coordinates that are not held give way down to this.
_RATES_CLOSED = 1e-14
_NEWTON_STEPS = 50
_HALVINGS = 30
#: Copies of a pattern that are passed in search of the one where the point is, and copies that are tried: that one and
#: four on either side.
_MOST_COPIES = 4000
_MOST_ASSEMBLIES = 9


@entry
def begin(block: Array, time: float) -> int:
    """Assemble the mechanism from its start guess and make ready to begin at `time` [s]; return a status.

    When the mechanism cannot be assembled, y_end and `rows.residual` hold the closest position and what is left of
    Phi. When it starts inside, PENDING_SUBJECT and the last entry of `rows.residual` hold the contact and its gap [m].
    """
    outcome = status.NOT_ASSEMBLED
    set_time(block, time)
    seen = examine_profiles(block)
    if seen != status.OK:
        return seen
    for k in range(_MOST_ASSEMBLIES + 1):
        _start_guess(block, _neighbour(k))
        outcome = assemble(block)
        if k == _MOST_ASSEMBLIES:
            break
        if outcome == status.OK and not _find_copies(block) and not _is_inside(block):
            return start(block, time)
    if outcome == status.OK:  # nowhere: say what is wrong with the nearest place
        outcome = start(block, time)
    if outcome == status.OK:
        outcome = status.NO_PLACE
    return outcome


@entry
def assemble_at(block: Array, time: float) -> int:
    """Close the position rows from the start guess at `time` [s], whatever the rates; return a status (see `begin`)."""
    set_time(block, time)
    _start_guess(block, 0)
    return assemble(block)


@jit
def _neighbour(k: int) -> int:
    """0, -1, 1, -2, 2 ... for k = 0, 1, 2 ...: copies near the guess first, and at last the guess once more."""
    if k == _MOST_ASSEMBLIES:
        return 0
    if k % 2 == 1:
        return -((k + 1) // 2)
    return k // 2


@jit
def _is_inside(block: Array) -> bool:
    """Whether a point of a pattern is behind one of the other lines there, which logical functions do not switch."""
    table = contacts(block)
    inside = False
    for c in range(table.mode.shape[0]):
        pattern = table.pattern[c]
        if pattern == codes.NONE or table.mode[c] == codes.CLOSED or table.value[c, codes.ENABLED] < 0.5:
            continue
        if table.function[c] == codes.NONE and patterns(block).enabled[pattern] > 0.5:
            inside = inside or gap(block, c)[0] < -TOUCHES_WITHIN
    return inside


@jit
def assemble(block: Array) -> int:
    """Close the position rows from the bodies' start guess by Newton's method with minimum-norm steps.

    Held coordinates do not move. The result, or the closest position found, stands in y_end; `rows.residual` holds
    what is left of Phi, for the joints and the contacts that are closed at the start.
    """
    n = sizes(block).coordinates
    now = course(block)
    s = stages(block)
    for i in range(bodies(block).start.shape[0]):
        for k in range(3):
            now.y_end[3 * i + k] = bodies(block).start[i, k]
    place_bodies(block, now.y_end)
    find_contact_points(block, now.y_end)
    count = active_rows(block)
    worst = _largest(rows(block).residual, count)
    for _ in range(_NEWTON_STEPS):
        if worst == 0.0:
            return status.OK
        _newton_direction(block, count, rows(block).residual)
        step = 1.0
        improved = False
        for _ in range(_HALVINGS):
            copy(now.y_end, s.y_new)
            for k in range(n):
                s.y_new[k] += step * loads(block).weight[k] * linear_system(block).solution[k]
            place_bodies(block, s.y_new)
            settle_contact_points(block, s.y_new)
            active_rows(block)
            after = _largest(rows(block).residual, count)
            if after < worst:
                improved = True
                break
            step *= 0.5
        if not improved:
            break
        copy(s.y_new, now.y_end)
        worst = after
    place_bodies(block, now.y_end)
    active_rows(block)
    if worst <= CLOSED_WITHIN:
        return status.OK
    return status.NOT_ASSEMBLED


@jit
def start(block: Array, time: float) -> int:
    """Make ready to begin at `time` [s] from the assembled position, with all counters at zero.

    The first `stepper.advance`, to `time` itself, chooses the contacts that push.
    """
    n = sizes(block).coordinates
    now = course(block)
    table = contacts(block)
    now.clock[codes.TIME] = time
    clear(ports(block).input_slopes)  # a slope belongs to a step
    take_inputs(block)
    for k in range(codes.COUNTERS_LENGTH):
        now.counters[k] = codes.IMPACT_BUFFER_LENGTH if k == codes.COUNT_IN_STEP else 0
    now.counters[codes.EVENTS_IN_STEP] = codes.EVENT_BUFFER_LENGTH
    clear_records(block)
    clear_impact(now.last_impact)
    now.ledger[codes.LEDGER_LOST] = 0.0
    now.y_end[2 * n] = 0.0
    now.y_end[2 * n + 1] = 0.0
    place_bodies(block, now.y_end)
    for c in range(table.mode.shape[0]):
        if table.alpha[c] != codes.NONE and table.value[c, codes.ENABLED] > 0.5:
            depth = overlap(block, c)
            if depth > 0.0 and table.mode[c] == codes.CLOSED:
                now.counters[codes.PENDING_SUBJECT] = c
                rows(block).residual[sizes(block).rows - 1] = -depth
                return status.OVERLAP
    if not _close_rates(block):
        return status.START_RATES
    for c in range(table.mode.shape[0]):
        table.pull_time[c] = math.inf
        table.touching[c] = 0
        exists = table.value[c, codes.ENABLED] > 0.5 and table.function[c] == codes.NONE
        if table.mode[c] == codes.OPEN and exists:
            distance, rate = gap(block, c)
            if not distance >= -TOUCHES_WITHIN:
                now.counters[codes.PENDING_SUBJECT] = c
                rows(block).residual[sizes(block).rows - 1] = distance
                return status.START_INSIDE
            if distance <= TOUCHES_WITHIN and abs(rate) < STICK_SPEED:
                table.mode[c] = codes.CLOSED
            elif distance <= TOUCHES_WITHIN:
                table.touching[c] = 1
    now.clock[codes.STEP_END] = time
    now.clock[codes.LAST_EVENT] = time
    now.clock[codes.STEP_START] = time
    now.clock[codes.STEP_SIZE] = 0.0
    now.counters[codes.PENDING_GUARD] = codes.GUARD_BEGIN
    now.counters[codes.PENDING_SUBJECT] = codes.NONE
    return status.OK


@jit
def _close_rates(block: Array) -> bool:
    """Whether the start rates agree with the active rows, after those of coordinates that are not held have given way.

    Without held coordinates nothing tells which rates are meant, and all stay as they are given.
    """
    keep_small()
    n = sizes(block).coordinates
    y = course(block).y_end
    count = active_rows(block)
    worst = _largest(rows(block).residual_rate, count)
    if options(block).held.shape[0] == 0 or worst <= _RATES_CLOSED:
        return worst <= RATES_WITHIN
    for _ in range(2):  # once more, for what rounding has left
        _newton_direction(block, count, rows(block).residual_rate)
        for k in range(n):
            y[n + k] += loads(block).weight[k] * linear_system(block).solution[k]
        place_bodies(block, y)
        active_rows(block)
    return _largest(rows(block).residual_rate, count) <= RATES_WITHIN


@jit
def _start_guess(block: Array, offset: int) -> None:
    """The bodies' start guess, the contacts that are closed there, and patterns `offset` copies beside where it is."""
    n = sizes(block).coordinates
    body = bodies(block)
    now = course(block)
    table = contacts(block)
    weight = loads(block).weight
    for i in range(body.start.shape[0]):
        for k in range(3):
            now.y_end[3 * i + k] = body.start[i, k]
            now.y_end[n + 3 * i + k] = body.start_rate[i, k]
            weight[3 * i + k] = 1.0
    held = options(block).held
    for k in range(held.shape[0]):
        weight[held[k]] = 0.0
    place_bodies(block, now.y_end)
    for p in range(patterns(block).copy.shape[0]):
        patterns(block).copy[p] = 0
        place_pattern(block, p)
    for c in range(table.mode.shape[0]):
        table.clicks[c] = 0
        table.mode[c] = codes.OPEN
        if table.value[c, codes.STARTS_CLOSED] > 0.5 and table.value[c, codes.ENABLED] > 0.5:
            table.mode[c] = codes.CLOSED
        place_contact(block, c)
    _find_copies(block)
    for p in range(patterns(block).copy.shape[0]):
        if patterns(block).enabled[p] > 0.5:
            patterns(block).copy[p] += offset
            place_pattern(block, p)
    for f in range(functions(block).true.shape[0]):
        functions(block).true[f] = 0
        if function_value(block, f)[0] < 0.0:
            functions(block).true[f] = 1
    switch_contacts(block)


@jit
def _find_copies(block: Array) -> bool:
    """Go to the copy of each pattern where its point is at y_end; whether any was another than before."""
    table = patterns(block)
    first_next = 2 * sizes(block).contacts
    count = table.copy.shape[0]
    place_bodies(block, course(block).y_end)
    moved = False
    for p in range(count):
        for _ in range(_MOST_COPIES):
            if table.enabled[p] < 0.5:
                break
            if guard_value(block, first_next + p)[0] <= 0.0:
                table.copy[p] += 1
            elif guard_value(block, first_next + count + p)[0] <= 0.0:
                table.copy[p] -= 1
            else:
                break
            place_pattern(block, p)
            moved = True
    return moved


@jit
def _newton_direction(block: Array, count: int, left: Array) -> None:
    """Minimum-norm solution of Phi_q dq = -left over the coordinates that are not held; left is Phi, or Phi'."""
    keep_small()
    n = sizes(block).coordinates
    row = rows(block)
    weight = loads(block).weight
    system = linear_system(block)
    for r in range(count):
        system.right_side[r] = -left[r]
        for k in range(n):
            system.scaled[r, k] = row.jacobian[r, k] * weight[k]
    minimum_norm(block, count, n)


@jit
def _largest(values: Array, count: int) -> float:
    """Largest magnitude of the first `count` values; infinite when one is not a number."""
    largest = 0.0
    for k in range(count):
        if not abs(values[k]) <= largest:
            largest = abs(values[k])
        if not largest < math.inf:
            return math.inf
    return largest
