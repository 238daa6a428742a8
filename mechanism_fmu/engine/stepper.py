"""Time stepping: where integration, contact geometry and the impact law meet.

The engine takes steps of its own, with dense output, and may be ahead of the time that the outside has reached
(TIME <= STEP_END): the trajectory then does not depend on the communication step at all. When an input changes, what
lies ahead is dropped and the motion goes on from TIME. Only a step in which an input has a slope ends at the target,
because nobody knows the input beyond.
"""

from __future__ import annotations

import math

from .. import codes
from ..tolerances import GAP_NOISE
from . import status
from .acceleration import derivative
from .dormand_prince import initial_step_size, try_step
from .drift import MOST_DRIFT, MOST_RATE_DRIFT, mend
from .events import first_event, refine
from .guards import gap
from .interpolation import interpolate
from .kinematics import place_bodies
from .motion_steps import within_motions
from .nearest import least_fit
from .overlap import bridged
from .ports import feed, inputs_changed, set_time, show_reached, take_inputs
from .pulling import watch_at, watch_step
from .records import clear_records
from .room import Array
from .singular import is_singular, keep_independence, note_rank
from .subset import entry, jit, keep_small
from .transition import transit
from .vectors import copy
from .views import contacts, course, linear_system, ports, sizes, stages

#: Smallest step as a fraction of max(1 s, |t|).
_SMALLEST_STEP = 1e-15
#: Most internal steps of one communication step.
MOST_STEPS = 200_000
#: Where there are guards, no body turns further than this in one step [rad]: a step without error may be of any length,
#: and would pass over what a turning point meets in every turn.
MOST_TURN = 1.0
#: A step that comes so near to where slopes end goes there.
_NEARLY = 0.99
#: Where steps shrink to nothing and profiles fit less well than this, that is why [rad/rad].
_FITS_BARELY = 0.01
_SAFETY = 0.9
_SHRINK_MOST = 0.2
_GROW_MOST = 5.0


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

    `rule` is `codes.STOP_AT_TARGET`, `STOP_AT_IMPACT` or `STOP_AT_STEP`; the motion is the same with all of them. After
    a stop, the step may be continued to the same target (what is set meanwhile acts from the next `begin_step` on), or
    another one be begun. Where it stops, `inputs` are the values reached. Failures: as of `advance`.
    """
    return _go_on(block, target, rule)


@jit
def _begin_step(block: Array) -> int:
    outcome = _why_ended(block)
    if outcome != status.OK:
        return outcome
    clear_records(block)
    if inputs_changed(block):
        return resume(block)
    return status.OK


@jit
def _go_on(block: Array, target: float, rule: int) -> int:
    now = course(block)
    if now.clock[codes.TIME] < now.clock[codes.STEP_END] and target < now.clock[codes.STEP_END]:
        now.clock[codes.TIME] = target  # the engine has been there already
        return status.OK
    outcome = _why_ended(block)
    if outcome == status.OK:
        outcome = _move(block, target, rule)
        show_reached(block)
    return outcome


@jit
def _why_ended(block: Array) -> int:
    """The status of an event that has failed, or `status.OK`."""
    counters = course(block).counters
    if counters[codes.PENDING_GUARD] == codes.GUARD_FAILED:
        failed: int = counters[codes.PENDING_SUBJECT]
        return failed
    return status.OK


@jit
def _move(block: Array, target: float, rule: int) -> int:
    """Step after step, event after event, until there is a reason to stop; return a status."""
    now = course(block)
    feed(block, ports(block).held_inputs)  # a restored state brings its own
    if now.counters[codes.RAMPING] != 0:
        now.clock[codes.RAMP_END] = target
    for _ in range(MOST_STEPS):
        begins = now.counters[codes.PENDING_GUARD] == codes.GUARD_BEGIN
        if now.clock[codes.TIME] >= now.clock[codes.STEP_END] and not begins:
            if now.clock[codes.TIME] >= target:
                return status.OK
            outcome = take_step(block)
            if outcome != status.OK:
                return outcome
        if now.clock[codes.STEP_END] > target:
            now.clock[codes.TIME] = target
            return status.OK
        now.clock[codes.TIME] = now.clock[codes.STEP_END]
        impacts = now.counters[codes.COUNT_IMPACTS]
        guard = now.counters[codes.PENDING_GUARD]
        if guard != codes.GUARD_NONE:
            set_time(block, now.clock[codes.STEP_END])
            outcome = transit(block, guard, now.counters[codes.PENDING_SUBJECT])
            if outcome != status.OK:
                now.counters[codes.PENDING_GUARD] = codes.GUARD_FAILED
                now.counters[codes.PENDING_SUBJECT] = outcome
                return outcome
            now.counters[codes.FALLING] = 0  # what was before belongs to other rows
            restart(block)
            now.clock[codes.NEXT_STEP] = initial_step_size(block)
        struck = now.counters[codes.COUNT_IMPACTS] > impacts
        if rule == codes.STOP_AT_STEP or (rule == codes.STOP_AT_IMPACT and struck):
            return status.OK
    return status.TOO_MANY_STEPS


@jit
def restart(block: Array) -> None:
    """Begin anew from y_end at STEP_END: nothing lies ahead."""
    keep_small()
    now = course(block)
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
    now = course(block)
    table = contacts(block)
    time = now.clock[codes.TIME]
    if time < now.clock[codes.STEP_END]:
        _step_back(block)
        release(block, codes.NONE)
        now.clock[codes.STEP_END] = time
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
    now = course(block)
    s = stages(block)
    start = now.clock[codes.STEP_START]
    feed(block, ports(block).held_inputs)
    set_time(block, start)
    copy(now.dense[0], s.y_start)
    derivative(block, s.y_start, s.derivatives[0])
    try_step(block, start, now.clock[codes.TIME] - start)
    keep_independence(block)
    copy(s.y_new, now.y_end)


@jit
def state_at_time(block: Array, y: Array) -> None:
    """Y at TIME, shape (unknowns,); `y` may be `y_end` itself."""
    keep_small()
    now = course(block)
    if now.clock[codes.TIME] < now.clock[codes.STEP_END]:
        fraction = (now.clock[codes.TIME] - now.clock[codes.STEP_START]) / now.clock[codes.STEP_SIZE]
        interpolate(now.dense, fraction, y)
    else:
        copy(now.y_end, y)


@jit
def take_step(block: Array) -> int:
    """One accepted step from STEP_END on, cut at the first event, which then waits as PENDING_GUARD."""
    keep_small()
    now = course(block)
    s = stages(block)
    start = now.clock[codes.STEP_END]
    copy(now.y_end, s.y_start)
    copy(now.dy_end, s.derivatives[0])
    wanted = now.clock[codes.NEXT_STEP]
    step = representable(start, _within_ramp(block, start, wanted))
    step = representable(start, within_motions(block, start, step))
    smallest = _SMALLEST_STEP * max(1.0, abs(start))
    error = _try(block, start, step)
    grow_most = _GROW_MOST
    while not error <= 1.0:
        step = representable(start, step * _scale(error, 1.0))
        grow_most = 1.0
        if not step > smallest:
            return _why_no_step(block)
        error = _try(block, start, step)
    if is_singular(block):
        return status.SINGULAR
    keep_independence(block)
    now.clock[codes.NEXT_STEP] = step * _scale(error, grow_most)
    ramping = now.counters[codes.RAMPING] != 0
    if ramping and grow_most > 1.0 and step < wanted:  # cut short by the slopes' end alone
        now.clock[codes.NEXT_STEP] = max(now.clock[codes.NEXT_STEP], wanted)

    guard, subject, fraction = first_event(block)
    if guard != codes.GUARD_NONE:
        step *= fraction
        if not step > smallest:
            now.counters[codes.PENDING_GUARD] = guard
            now.counters[codes.PENDING_SUBJECT] = subject
            return status.OK
        if guard == codes.GUARD_GAP:
            step = refine(block, subject, step)
        else:
            try_step(block, start, step)
        if math.isnan(s.y_new[2 * sizes(block).coordinates + 1]):
            return _why_no_step(block)
    now.counters[codes.PENDING_GUARD] = guard
    now.counters[codes.PENDING_SUBJECT] = subject
    now.counters[codes.COUNT_STEPS] += 1
    now.clock[codes.STEP_START] = start
    now.clock[codes.STEP_SIZE] = step
    now.clock[codes.STEP_END] = start + step
    if ramping and abs(start + step - now.clock[codes.RAMP_END]) <= smallest:
        now.clock[codes.STEP_END] = now.clock[codes.RAMP_END]
    copy(s.y_new, now.y_end)
    copy(s.derivatives[6], now.dy_end)
    for r in range(5):
        copy(s.new_dense[r], now.dense[r])
    watch_step(block)
    struck = codes.NONE
    if guard == codes.GUARD_GAP:
        struck = subject
    release(block, struck)
    set_time(block, now.clock[codes.STEP_END])
    if mend(block, MOST_DRIFT, MOST_RATE_DRIFT):
        derivative(block, now.y_end, now.dy_end)
    if sizes(block).alphas > 0 and not least_fit(block) > 0.0:
        return status.NO_CONTACT_POINT
    if sizes(block).alphas > 0 and bridged(block):
        return status.BRIDGED
    return status.OK


@jit
def _within_ramp(block: Array, start: float, step: float) -> float:
    """The step, or what is left until slopes of inputs end."""
    now = course(block)
    left: float = now.clock[codes.RAMP_END] - start
    if now.counters[codes.RAMPING] != 0 and step > _NEARLY * left:
        return left
    return step


@jit
def _why_no_step(block: Array) -> int:
    """What has made the step shrink to nothing: the power lost is not a number where friction found no agreement."""
    s = stages(block)
    lost = 2 * sizes(block).coordinates + 1
    for k in range(1, s.derivatives.shape[0]):
        if math.isnan(s.derivatives[k, lost]) and not math.isnan(s.derivatives[k, 0]):
            return status.JAMMED
    if linear_system(block).rank[0] > course(block).counters[codes.RANK]:
        return status.SINGULAR
    if sizes(block).alphas > 0:
        place_bodies(block, s.y_start)
        if not least_fit(block) > _FITS_BARELY:
            return status.NO_CONTACT_POINT
    return status.STEP_TOO_SMALL


@jit
def _try(block: Array, start: float, step: float) -> float:
    """Try a step from `start`; return its error, or how much too far a body turns if that shortens the step more."""
    keep_small()
    s = stages(block)
    error = try_step(block, start, step)
    if sizes(block).guards == 0:
        return error
    turn = 0.0
    for k in range(2, sizes(block).coordinates, 3):
        turn = max(turn, abs(s.y_new[k] - s.y_start[k]) / MOST_TURN)
    haste = contacts(block).alpha_haste
    first = 2 * sizes(block).coordinates + 2
    for k in range(haste.shape[0]):
        turn = max(turn, abs(s.y_new[first + k] - s.y_start[first + k]) * haste[k])
    too_far = math.pow(turn, 5.0)  # `_scale` takes the fifth root
    if too_far > error:
        return too_far
    return error


@jit
def release(block: Array, struck: int) -> None:
    """Contacts that touched at the step's start have come off by y_end, but for the one that strikes there."""
    keep_small()
    table = contacts(block)
    place_bodies(block, course(block).y_end)
    for c in range(table.mode.shape[0]):
        if table.touching[c] == 1 and table.mode[c] == codes.OPEN and c != struck:
            distance, _ = gap(block, c)
            if distance > GAP_NOISE:
                table.touching[c] = 0


@jit
def representable(start: float, step: float) -> float:
    """The step whose end, start + step, is a floating-point number: late on the clock, rounding would add up."""
    return (start + step) - start


@jit
def _scale(error: float, most: float) -> float:
    """Factor for the next step size (order 5)."""
    if error == 0.0:
        return most
    if not error < math.inf:
        return _SHRINK_MOST
    return min(most, max(_SHRINK_MOST, _SAFETY * math.pow(error, -0.2)))
