"""Initialization: from the start guess to a mechanism that is assembled, checked and ready to move."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Loads, Pose, Rows
from ...tables.parts import Bodies, Contacts, Joints, Options, Ports
from ...tables.sizes import Sizes
from ...tolerances import RATES_WITHIN, STICK_SPEED, TOUCHES_WITHIN
from .. import status
from ..compiler.subset import entry, jit, keep_apart, keep_small
from ..constraints.friction_rows import rubbing_count
from ..constraints.kinematics import place_bodies
from ..constraints.point_line import spare_row
from ..constraints.rows import active_rows
from ..contacts.binding import bind_what_touches, deepest_overlap, is_free
from ..contacts.guards import gap
from ..contacts.impact import clear_impact, clear_records
from ..contacts.participation import find_participants
from ..dynamics.forces import set_time, take_inputs
from ..dynamics.oscillation import begin_oscillations
from ..dynamics.scaling import note_rate, note_sizes
from ..dynamics.thresholds import clear_sides
from ..profiles.curves import shortest_motion
from ..profiles.overlap import overlap
from ..profiles.shape import examine_profiles
from ..scales import contact_speed, contact_unit, largest_off, present_rate
from ..vectors import clear
from .assembly import assemble, find_copies, is_inside, newton_direction, start_guess, start_rates

# The start of the motion: the assembled position is checked, and all that counts begins at zero.

#: Rates of coordinates that are not held give way down to this.
_RATES_CLOSED = 1e-14


@jit
def start(block: Array, time: float) -> int:
    """Make ready to begin at `time` [s] from the assembled position, with all counters at zero; return a status.

    The first `stepper.advance`, to `time` itself, chooses the contacts that push.
    """
    keep_apart()
    _begin_at_zero(block, time)
    note_sizes(block)
    note_rate(block, 1.0 / shortest_motion(block))
    at = place_bodies(block, Course(block).y_end)
    if _profiles_overlap(block, at):
        return status.OVERLAP
    if not _close_rates(block, at):
        return status.START_RATES
    at = place_bodies(block, Course(block).y_end)
    if Sizes(block).outlines > 0:
        contact, depth = deepest_overlap(block, at, 0.0)
        if contact != codes.NONE:
            _blame(block, contact, -depth)
            return status.START_INSIDE
        find_participants(block, at, codes.GUARD_BEGIN, codes.NONE)
        outcome = bind_what_touches(block, at, codes.NONE)
        if outcome != status.OK:
            return outcome
    if not _contacts_begin(block, at):
        return status.START_INSIDE
    return status.OK


@jit
def _begin_at_zero(block: Array, time: float) -> None:
    """The clock stands at `time` [s], nothing has happened, and the inputs are those that are set."""
    keep_small()
    now = Course(block)
    now.clock[codes.TIME] = time
    now.clock[codes.STEP_END] = time
    for b in range(now.accumulation.shape[0]):
        now.accumulation[b, 0] = time
        now.accumulation[b, 1] = 0.0
    now.clock[codes.STEP_START] = time
    now.clock[codes.STEP_SIZE] = 0.0
    now.clock[codes.PASSED_AT] = time
    clear(Ports(block).input_slopes)  # a slope belongs to a step
    take_inputs(block)
    for k in range(codes.COUNTERS_LENGTH):
        now.counters[k] = 0
    now.counters[codes.IMPLICIT] = 1 if Options(block).settings[codes.METHOD] == codes.IMPLICIT_METHOD else 0
    now.counters[codes.COUNT_IN_STEP] = now.impacts.shape[0]  # all that may be there is cleared
    now.counters[codes.EVENTS_IN_STEP] = now.events.shape[0]
    clear_records(block)
    clear_impact(now.last_impact)
    now.counters[codes.RUBBING] = rubbing_count(block)
    now.counters[codes.PENDING_GUARD] = codes.GUARD_BEGIN
    now.counters[codes.PENDING_SUBJECT] = codes.NONE
    now.ledger[codes.LEDGER_LOST] = 0.0
    now.y_end[Sizes(block).y_work] = 0.0
    now.y_end[Sizes(block).y_loss] = 0.0
    for k in range(Sizes(block).y_own, Sizes(block).unknowns):
        now.y_end[k] = 0.0
    begin_oscillations(block)
    clear_sides(block, time)


@jit
def _profiles_overlap(block: Array, at: Pose) -> bool:
    """Whether two profiles that touch cut into each other elsewhere; `_blame` says which."""
    keep_small()
    table = Contacts(block)
    for c in range(table.mode.shape[0]):
        if table.alpha[c] != codes.NONE and table.value[c, codes.ENABLED] > 0.5:
            depth = overlap(block, at, c)
            if depth > 0.0 and table.mode[c] == codes.CLOSED:
                _blame(block, c, -depth)
                return True
    return False


@jit
def _contacts_begin(block: Array, at: Pose) -> bool:
    """Close the contacts that touch and rest; False when one is inside (`_blame` says which)."""
    keep_small()
    table = Contacts(block)
    for c in range(table.mode.shape[0]):
        table.pull_time[c] = math.inf
        table.touching[c] = 0
        if is_free(block, c):
            continue
        exists = table.value[c, codes.ENABLED] > 0.5 and table.function[c] == codes.NONE
        if table.mode[c] == codes.OPEN and exists:
            distance, rate = gap(block, at, c)
            touches_within = TOUCHES_WITHIN * contact_unit(block, c)
            if not distance >= -touches_within:
                _blame(block, c, distance)
                return False
            if distance <= touches_within and abs(rate) < STICK_SPEED * contact_speed(block, c):
                table.mode[c] = codes.CLOSED
            elif distance <= touches_within:
                table.touching[c] = 1
    return True


@jit
def _blame(block: Array, contact: int, distance: float) -> None:
    """Report which contact is inside, and its gap [m or rad]: PENDING_SUBJECT and the spare row's residual."""
    Course(block).counters[codes.PENDING_SUBJECT] = contact
    Rows(block).residual[spare_row(block)] = distance


@jit
def _close_rates(block: Array, at: Pose) -> bool:
    """Whether the start rates agree with the active rows, after those that may give way have done so.

    Rates of held coordinates stay. Where none are held, nothing says which rates are meant, and all stay as they are
    given, but where there is a driver: bodies that were given none follow. When they do not agree, y_end holds rates
    near them that do: the others of bodies that were given none, if that is enough.
    """
    keep_small()
    rate = present_rate(block)
    worst = largest_off(block, Rows(block).residual_rate, active_rows(block, at))
    held = Options(block).held.shape[0] > 0
    if worst <= _RATES_CLOSED * rate or (worst <= RATES_WITHIN * rate and not held):
        return True
    if not worst < math.inf:
        return False
    if not held:
        _hold_given(block)
    agree = _approach(block) <= RATES_WITHIN * rate
    if agree and (held or _is_driven(block)):
        return True
    if not agree:
        start_rates(block)
        _approach(block)
    return False


@jit
def _approach(block: Array) -> float:
    """Let the rates of coordinates that are not held give way to the active rows; what is left of Phi'."""
    keep_apart()
    n = Sizes(block).coordinates
    y = Course(block).y_end
    count = active_rows(block, place_bodies(block, y))
    for _ in range(2):  # once more, for what rounding has left
        newton_direction(block, count, Rows(block).residual_rate)
        for k in range(n):
            y[n + k] += Loads(block).weight[k] * LinearSystem(block).solution[k]
        active_rows(block, place_bodies(block, y))
    return largest_off(block, Rows(block).residual_rate, count)


@jit
def _hold_given(block: Array) -> None:
    """Hold the rates of the bodies that were given one that is not zero."""
    keep_small()
    rate = Bodies(block).start_rate
    for i in range(rate.shape[0]):
        if rate[i, 0] != 0.0 or rate[i, 1] != 0.0 or rate[i, 2] != 0.0:
            for k in range(3):
                Loads(block).weight[3 * i + k] = 0.0


@jit
def _is_driven(block: Array) -> bool:
    """Whether there is a driver."""
    keep_small()
    driven = False
    for number in Joints(block).curve:
        driven = driven or number != codes.NONE
    return driven


#: Copies of a pattern that are tried: the one where the point is, and four on either side.
_MOST_ASSEMBLIES = 9


@entry
def begin(block: Array, time: float) -> int:
    """Assemble the mechanism from its start guess and make ready to begin at `time` [s]; return a status.

    When the mechanism cannot be assembled, y_end and `rows.residual` hold the closest position and what is left of
    Phi. When its rates do not agree, y_end and `rows.residual_rate` hold rates near them, which do if there are any,
    and what is left of Phi'. When it starts inside, PENDING_SUBJECT and the last entry of `rows.residual` hold the
    contact and its gap [m].
    """
    keep_small()
    outcome = status.NOT_ASSEMBLED
    set_time(block, time)
    seen = examine_profiles(block)
    if seen != status.OK:
        return seen
    _note_first_sizes(block)
    for k in range(_MOST_ASSEMBLIES + 1):
        start_guess(block, _neighbour(k))
        outcome = assemble(block)
        if k == _MOST_ASSEMBLIES:
            break
        if outcome == status.OK and not find_copies(block) and not is_inside(block):
            return start(block, time)
    if outcome == status.OK:  # nowhere: say what is wrong with the nearest place
        outcome = start(block, time)
    if outcome == status.OK:
        outcome = status.NO_PLACE
    return outcome


@entry
def assemble_at(block: Array, time: float) -> int:
    """Close the position rows from the start guess at `time` [s], whatever the rates; return a status (see `begin`)."""
    keep_small()
    set_time(block, time)
    _note_first_sizes(block)
    start_guess(block, 0)
    return assemble(block)


@jit
def _note_first_sizes(block: Array) -> None:
    """The scales of length and mass, as of the start guess."""
    keep_small()
    start_guess(block, 0)
    note_sizes(block)


@jit
def _neighbour(k: int) -> int:
    """0, -1, 1, -2, 2 ... for k = 0, 1, 2 ...: copies near the guess first, and at last the guess once more."""
    if k == _MOST_ASSEMBLIES:
        return 0
    if k % 2 == 1:
        return -((k + 1) // 2)
    return k // 2
