"""The impact law: velocity jump and impulses (Pennestrì et al., eqs (4), (6), (7))."""

from __future__ import annotations

from .. import codes
from .acceleration import scale_rows
from .forces import kinetic_energy
from .kinematics import place_bodies
from .minimum_norm import minimum_norm
from .room import Array
from .rows import active_rows
from .subset import jit, keep_small
from .views import bodies, contacts, course, linear_system, rows, sizes

#: A contact that would come apart more slowly than this stays closed [m/s]: it ends the bouncing of e > 0.
STICK_SPEED = 1e-6


@jit
def strike(block: Array, contact: int) -> None:
    """Let `contact` impact at the end of the engine's step: y_end = x- becomes x+, and a record is kept.

    The kept rows get v = 0 and the struck one -(1 + e) s' (eq (6)); dqd = M^-1/2 D_1^+ v (eq (7)). The contact then
    stays closed when e times its closing speed is below `STICK_SPEED` (e = 0 always), and is open with zero gap
    otherwise.
    """
    keep_small()
    n = sizes(block).coordinates
    table = contacts(block)
    now = course(block)
    rate = now.y_end[n:]
    place_bodies(block, now.y_end)
    table.mode[contact] = codes.CLOSED
    count = active_rows(block)
    struck = table.row[contact]
    closing_speed = -rows(block).residual_rate[struck]
    restitution = table.restitution[contact]
    sticks = restitution * closing_speed < STICK_SPEED
    if sticks:
        restitution = 0.0

    system = linear_system(block)
    scale_rows(block, count)
    for r in range(count):
        system.right_side[r] = 0.0
    system.right_side[struck] = (1.0 + restitution) * closing_speed
    minimum_norm(block, count, n)

    record = now.last_impact
    record[codes.RECORD_TIME] = now.clock[codes.STEP_END]
    record[codes.RECORD_CONTACT] = contact
    record[codes.RECORD_TOOTH] = table.tooth[contact]
    record[codes.RECORD_CLOSING_SPEED] = closing_speed
    record[codes.RECORD_IMPULSE] = system.multiplier[struck]
    first = codes.RECORD_CONTACT_IMPULSES
    for c in range(table.mode.shape[0]):
        record[first + c] = 0.0
        if table.mode[c] == codes.CLOSED:
            record[first + c] = system.multiplier[table.row[c]]
    first += table.mode.shape[0]

    mass = bodies(block)
    now.ledger[codes.LEDGER_LOST] += kinetic_energy(mass.inverse_mass, rate, n)
    for k in range(n):
        record[first + k] = rate[k]
        rate[k] += mass.inverse_root_mass[k] * system.solution[k]
        record[first + n + k] = rate[k]
    now.ledger[codes.LEDGER_LOST] -= kinetic_energy(mass.inverse_mass, rate, n)

    record[codes.RECORD_VELOCITY] = 0.0
    struck_body = table.body_j[contact]
    if 3 * struck_body < n:
        record[codes.RECORD_VELOCITY] = table.beam_length[contact] * rate[3 * struck_body + 2]
    if not sticks:
        table.mode[contact] = codes.OPEN
    table.touching[contact] = 1
    keep_record(block)


@jit
def keep_record(block: Array) -> None:
    """Append the last impact to the buffer of this communication step; when it is full, the oldest is lost."""
    now = course(block)
    now.counters[codes.COUNT_IMPACTS] += 1
    place = now.counters[codes.COUNT_IN_STEP]
    if place == codes.IMPACT_BUFFER_LENGTH:
        now.counters[codes.COUNT_LOST] += 1
        place -= 1
        for b in range(place):
            for k in range(now.impacts.shape[1]):
                now.impacts[b, k] = now.impacts[b + 1, k]
    else:
        now.counters[codes.COUNT_IN_STEP] = place + 1
    for k in range(now.impacts.shape[1]):
        now.impacts[place, k] = now.last_impact[k]
