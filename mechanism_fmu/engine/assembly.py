"""Assembly of the start position, and the start of the motion."""

from __future__ import annotations

import math

from .. import codes
from . import status
from .dormand_prince import initial_step_size
from .events import gap
from .impact import STICK_SPEED
from .kinematics import place_bodies
from .minimum_norm import minimum_norm
from .ports import clear_impacts, clear_record, write_inputs
from .room import Array
from .rows import active_rows
from .stepper import copy, restart
from .subset import entry, jit, keep_small
from .views import bodies, contacts, course, linear_system, loads, options, ports, rows, sizes, stages

#: Position rows are closed when none is off by more than this [m, rad, m^2].
CLOSED_WITHIN = 1e-12
#: Start rates agree with the joints within this [m/s, rad/s].
RATES_WITHIN = 1e-9
#: A contact point closer to its line than this at the start touches it; farther behind it, it is inside [m]. One that
#: touches and does not move across the line rests on it; one that moves leaves, or strikes at once.
TOUCHES_WITHIN = 1e-9
_NEWTON_STEPS = 50
_HALVINGS = 30


@entry
def begin(block: Array, time: float) -> int:
    """Assemble the mechanism from its start guess and begin the motion at `time` [s]; return a status.

    When the mechanism cannot be assembled, y_end and `rows.residual` hold the closest position and what is left of
    Phi. When it starts inside, PENDING_CONTACT and the last entry of `rows.residual` hold the contact and its gap [m].
    """
    outcome = assemble(block)
    if outcome == status.OK:
        outcome = start(block, time)
    return outcome


@jit
def assemble(block: Array) -> int:
    """Close the position rows from the bodies' start guess by Newton's method with minimum-norm steps.

    Held coordinates do not move. The result, or the closest position found, stands in y_end; `rows.residual` holds
    what is left of Phi, for the joints and the contacts that are closed at the start.
    """
    n = sizes(block).coordinates
    now = course(block)
    s = stages(block)
    _start_guess(block)
    count = active_rows(block)
    worst = _largest(rows(block).residual, count)
    for _ in range(_NEWTON_STEPS):
        if worst == 0.0:
            return status.OK
        _newton_direction(block, count)
        step = 1.0
        improved = False
        for _ in range(_HALVINGS):
            copy(now.y_end, s.y_new)
            for k in range(n):
                s.y_new[k] += step * loads(block).weight[k] * linear_system(block).solution[k]
            place_bodies(block, s.y_new)
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
    """Begin the motion at `time` [s] from the assembled position, with all counters at zero."""
    n = sizes(block).coordinates
    now = course(block)
    table = contacts(block)
    port = ports(block)
    write_inputs(block)
    for k in range(codes.COUNTERS_LENGTH):
        now.counters[k] = codes.IMPACT_BUFFER_LENGTH if k == codes.COUNT_IN_STEP else 0
    clear_impacts(block)
    clear_record(now.last_impact)
    now.ledger[codes.LEDGER_LOST] = 0.0
    now.y_end[2 * n] = 0.0
    place_bodies(block, now.y_end)
    count = active_rows(block)
    if not _largest(rows(block).residual_rate, count) <= RATES_WITHIN:
        return status.START_RATES
    for c in range(table.mode.shape[0]):
        table.pull_time[c] = math.inf
        table.touching[c] = 0
        if table.mode[c] == codes.OPEN:
            distance, rate = gap(block, c, now.y_end)
            if not distance >= -TOUCHES_WITHIN:
                now.counters[codes.PENDING_CONTACT] = c
                return status.START_INSIDE
            if distance <= TOUCHES_WITHIN and abs(rate) < STICK_SPEED:
                table.mode[c] = codes.CLOSED
            elif distance <= TOUCHES_WITHIN:
                table.touching[c] = 1
    for k in range(port.inputs.shape[0]):
        port.held_inputs[k] = port.inputs[k]
    now.clock[codes.TIME] = time
    now.clock[codes.STEP_END] = time
    restart(block)
    now.clock[codes.NEXT_STEP] = initial_step_size(block)
    return status.OK


@jit
def _start_guess(block: Array) -> None:
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
    for c in range(table.mode.shape[0]):
        table.mode[c] = table.start_mode[c]
    place_bodies(block, now.y_end)


@jit
def _newton_direction(block: Array, count: int) -> None:
    """Minimum-norm solution of Phi_q dq = -Phi over the coordinates that are not held."""
    keep_small()
    n = sizes(block).coordinates
    row = rows(block)
    weight = loads(block).weight
    system = linear_system(block)
    for r in range(count):
        system.right_side[r] = -row.residual[r]
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
