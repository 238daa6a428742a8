"""Communication steps: where integration, contact geometry and the impact law meet.

The engine takes steps of its own, with dense output, and may be ahead of the time that the outside has reached
(TIME <= STEP_END): the trajectory then does not depend on the communication step at all. When an input changes, what
lies ahead is dropped and the motion goes on from TIME. Only a step in which an input has a slope ends at the target,
because the input beyond is unknown.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Implicit, Stages
from ...tables.parts import Contacts, Options, Ports
from ...tables.sizes import Sizes
from .. import status
from ..compiler.subset import entry, jit, keep_small
from ..contacts.impact import clear_records
from ..contacts.inside import is_one_inside
from ..contacts.transition import release, transit
from ..dynamics.acceleration import derivative
from ..dynamics.forces import feed, inputs_changed, set_time, show_reached, take_inputs
from ..dynamics.oscillation import observe
from ..dynamics.scaling import note_slopes
from ..dynamics.thresholds import change_sides
from ..interpolation import interpolate
from ..vectors import clear, copy
from .passing import passed_in_step, read_passed
from .runge_kutta import initial_step_size, try_step
from .singular import keep_independence, note_rank
from .step import take_step, watch_at
from .step_size import note_stiffest

#: When this part of the internal steps is spent, that part of the communication step must be covered.
_LOOK_AFTER = 0.1
_COVERED = 0.01


@entry
def advance(block: Array, target: float) -> int:
    """One communication step: bring TIME to `target` [s]; return a status.

    When a step fails, TIME and all outputs stay at the last good instant. When an event fails, they stay at the event,
    and only a restored state leads on.
    """
    outcome = _begin_step(block)
    if outcome == status.OK:
        outcome = _go_on(block, target, codes.STOP_AT_TARGET)
    return outcome


@entry
def begin_step(block: Array) -> int:
    """Begin a communication step at TIME: empty the records, let inputs and their slopes act; return a status."""
    return _begin_step(block)


@entry
def go_on(block: Array, target: float, rule: int) -> int:
    """Go on within the communication step until `target` [s], or until `rule` stops it earlier; return a status.

    `rule` is `codes.STOP_AT_TARGET`, or a sum of other rules (`STOP_AT_IMPACT` ...); the motion
    is the same with all of them. An event before which it has stopped happens with the next call, whose rule must be
    without the last of them. After any other stop, the step may be continued to the same target (what is set meanwhile
    acts from the next `begin_step` on), or another one be begun. Where it stops, `inputs` are the values reached.
    Failures: as of `advance`.
    """
    return _go_on(block, target, rule)


@jit
def _begin_step(block: Array) -> int:
    outcome = _why_ended(block)
    if outcome != status.OK:
        return outcome
    now = Course(block)
    if now.counters[codes.COUNT_STEPS] > 0:  # what has happened at the start belongs to the first step
        clear_records(block)
    now.counters[codes.STEPS_IN_STEP] = 0
    now.clock[codes.STEP_BEGUN] = now.clock[codes.TIME]
    return resume(block) if inputs_changed(block) else status.OK


@jit
def _go_on(block: Array, target: float, rule: int) -> int:
    now = Course(block)
    if now.clock[codes.TIME] < now.clock[codes.STEP_END] and target < now.clock[codes.STEP_END]:
        now.clock[codes.TIME] = target  # the engine has been there already
        return status.OK
    outcome = _why_ended(block)
    if outcome == status.OK:
        outcome = _move(block, target, rule)
        if outcome == status.TOO_MANY_STEPS or outcome == status.NO_PROGRESS or outcome == status.STEP_TOO_SMALL:
            note_stiffest(block)
        show_reached(block)
    return outcome


@jit
def _why_ended(block: Array) -> int:
    """The status of an event that has failed, or `status.OK`."""
    counters = Course(block).counters
    if counters[codes.PENDING_GUARD] == codes.GUARD_FAILED:
        failed: int = counters[codes.PENDING_SUBJECT]
        if failed == status.PENETRATED:
            is_one_inside(block)  # outputs read meanwhile have overwritten which
        return failed
    return status.OK


@jit
def _move(block: Array, target: float, rule: int) -> int:
    """Step after step, event after event, until there is a reason to stop; return a status."""
    now = Course(block)
    feed(block, Ports(block).held_inputs)  # a restored state brings its own
    if now.counters[codes.RAMPING] != 0:
        now.clock[codes.RAMP_END] = target
        note_slopes(block)
    while True:
        # At the very beginning, and after a stop before an event, there is one to come at TIME.
        waits = now.counters[codes.PENDING_GUARD] != codes.GUARD_NONE
        if now.clock[codes.TIME] >= now.clock[codes.STEP_END] and not waits:
            if now.clock[codes.TIME] >= target:
                return status.OK
            outcome = _spend(block, target)
            if outcome == status.OK:
                outcome = take_step(block)
            if outcome != status.OK:
                return outcome
        if now.clock[codes.STEP_END] > target:
            now.clock[codes.TIME] = target
            return status.OK
        now.clock[codes.TIME] = now.clock[codes.STEP_END]
        observe(block)
        impacts = now.counters[codes.COUNT_IMPACTS]
        guard = now.counters[codes.PENDING_GUARD]
        if guard != codes.GUARD_NONE:
            if rule & codes.STOP_BEFORE_EVENT:
                return status.OK
            set_time(block, now.clock[codes.STEP_END])
            outcome = transit(block, guard, now.counters[codes.PENDING_SUBJECT])
            if outcome != status.OK:
                now.counters[codes.PENDING_GUARD] = codes.GUARD_FAILED
                now.counters[codes.PENDING_SUBJECT] = outcome
                return outcome
            now.counters[codes.FALLING] = 0  # what was before belongs to other rows
            restart(block)
            now.clock[codes.NEXT_STEP] = initial_step_size(block, now.clock[codes.NEXT_STEP])
        elif Sizes(block).thresholds > 0 and change_sides(block):
            restart(block)  # a long step would feel what begins to act in its first stages alone
            now.clock[codes.NEXT_STEP] = min(now.clock[codes.NEXT_STEP], initial_step_size(block, 0.0))
        struck = now.counters[codes.COUNT_IMPACTS] > impacts
        stops = rule & codes.STOP_AT_STEP or (rule & codes.STOP_AT_IMPACT and struck)
        if stops or (rule & codes.STOP_AT_EVENT and guard != codes.GUARD_NONE):
            return status.OK


@jit
def _spend(block: Array, target: float) -> int:
    """Count one more internal step on the way to `target` [s]; return a status: no more, or no progress."""
    now = Course(block)
    most = Options(block).settings[codes.MOST_STEPS]
    spent = now.counters[codes.STEPS_IN_STEP]
    begun = now.clock[codes.STEP_BEGUN]
    if spent == math.ceil(_LOOK_AFTER * most) and now.clock[codes.TIME] - begun < _COVERED * (target - begun):
        return status.NO_PROGRESS
    if spent >= most:
        return status.TOO_MANY_STEPS
    now.counters[codes.STEPS_IN_STEP] = spent + 1
    return status.OK


@jit
def restart(block: Array) -> None:
    """Begin anew from y_end at STEP_END: nothing lies ahead."""
    keep_small()
    now = Course(block)
    now.clock[codes.STEP_START] = now.clock[codes.STEP_END]
    now.clock[codes.STEP_SIZE] = 0.0
    now.counters[codes.PENDING_GUARD] = codes.GUARD_NONE
    now.counters[codes.PENDING_SUBJECT] = codes.NONE
    set_time(block, now.clock[codes.STEP_END])
    derivative(block, now.y_end, now.dy_end)
    note_rank(block)
    watch_at(block, now.clock[codes.STEP_END])


@jit
def resume(block: Array) -> int:
    """Drop what lies ahead of TIME, because the inputs or their slopes have changed; return a status."""
    keep_small()
    now = Course(block)
    table = Contacts(block)
    time = now.clock[codes.TIME]
    observe(block)
    if time < now.clock[codes.STEP_END]:
        _step_back(block)
        release(block, codes.NONE)
        now.clock[codes.STEP_END] = time
    if time < now.clock[codes.PASSED_AT]:
        now.clock[codes.PASSED_AT] = time
        now.counters[codes.COUNT_PASSED] -= 1
    clear(table.apart)  # it is of where the engine has been ahead, and of the motion without this input
    for c in range(table.mode.shape[0]):
        if time < table.pull_time[c] < math.inf:
            table.pull_time[c] = math.inf
            now.counters[codes.COUNT_PULLS] -= 1
    take_inputs(block)
    set_time(block, time)
    outcome = transit(block, codes.GUARD_INPUT, codes.NONE)
    restart(block)
    return outcome


@jit
def _step_back(block: Array) -> None:
    """Bring y_end back to TIME by a true step of its own from STEP_START, with the inputs that were held.

    The dense output is less accurate, which adds up when inputs change at every communication point.
    """
    keep_small()
    now = Course(block)
    s = Stages(block)
    start = now.clock[codes.STEP_START]
    feed(block, Ports(block).held_inputs)
    if passed_in_step(block):
        read_passed(block)
        now.counters[codes.FALLING] = 0
        if now.clock[codes.TIME] < now.clock[codes.PASSED_AT]:
            now.counters[codes.FALLING] = 1
        return
    set_time(block, start)
    copy(now.dense[0], s.y_start)
    derivative(block, s.y_start, s.derivatives[0])
    Implicit(block).fresh[0] = 0
    chosen = now.counters[codes.IMPLICIT]
    now.counters[codes.IMPLICIT] = now.counters[codes.IMPLICIT_STEP]  # a step of another method has another size
    try_step(block, start, now.clock[codes.TIME] - start)
    now.counters[codes.IMPLICIT] = chosen
    keep_independence(block)
    copy(s.y_new, now.y_end)


@jit
def state_at_time(block: Array, y: Array) -> None:
    """Y at TIME, shape (unknowns,); `y` may be `y_end` itself."""
    keep_small()
    now = Course(block)
    if now.clock[codes.TIME] < now.clock[codes.STEP_END]:
        fraction = (now.clock[codes.TIME] - now.clock[codes.STEP_START]) / now.clock[codes.STEP_SIZE]
        interpolate(now.dense, fraction, y)
    else:
        copy(now.y_end, y)
