"""One step of the engine's own, as far as the first event within it; and guided contacts that pull."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.method import METHOD
from ...tables.motion import Course, Implicit, Stages
from ...tables.parts import Contacts, Options, Thresholds
from ...tables.sizes import Sizes
from ...tolerances import CLOSES_WITHIN
from .. import status
from ..compiler.subset import jit, keep_small
from ..constraints.kinematics import place_bodies
from ..constraints.rows import row_count
from ..contacts.binding import deepest_overlap
from ..contacts.complementarity import push_ratio
from ..contacts.inside import blame, is_one_inside
from ..contacts.transition import release
from ..dynamics.acceleration import MOST_DRIFT, MOST_RATE_DRIFT, derivative, mend
from ..dynamics.forces import set_time
from ..dynamics.rounding import note_level
from ..interpolation import interpolate
from ..profiles.nearest import least_fit
from ..profiles.overlap import bridged
from ..scales import rate_scale
from ..vectors import clear, copy
from .closing import closes_step
from .crossing import first_crossing, refine_crossing
from .events import comes_down_beside, first_event, refine
from .letting_go import refine_hold, refine_push, refine_slip
from .meeting import refine_end
from .passing import NEARER, PASSED, ahead, pass_over, passes
from .runge_kutta import try_step
from .singular import is_singular, keep_independence
from .step_size import accurate_step, forces_are_unbounded, smallest_step, why_no_step
from .stiffness import choose_method

# When a closed contact first pulls: legal in the paper's guided model, impossible in a real one, so worth knowing.

#: A contact pulls where its force is below so many times its rounding.
_PULLS_BELOW = -10.0
_BISECTIONS = 50


@jit
def watch_at(block: Array, time: float) -> None:
    """Note `time` for every contact that pulls for the first time, by the multipliers of the last acceleration."""
    keep_small()
    table = Contacts(block)
    is_noted = False
    for c in range(table.mode.shape[0]):
        held = table.mode[c] == codes.CLOSED and table.value[c, codes.GUIDED] > 0.5
        if not held or table.pull_time[c] != math.inf:
            continue
        if not is_noted:
            note_level(block, row_count(block))
            is_noted = True
        if push_ratio(block, c) < _PULLS_BELOW:
            table.pull_time[c] = time
            Course(block).counters[codes.COUNT_PULLS] += 1


@jit
def watch_step(block: Array) -> None:
    """After a step: note when contacts began to pull, located inside the step by bisection."""
    keep_small()
    table = Contacts(block)
    now = Course(block)
    end = now.clock[codes.STEP_END]
    watch_at(block, end)
    for c in range(table.mode.shape[0]):
        if table.mode[c] == codes.CLOSED and table.pull_time[c] == end:
            table.pull_time[c] = _locate(block, c)


@jit
def _locate(block: Array, contact: int) -> float:
    keep_small()
    now = Course(block)
    s = Stages(block)
    before = 0.0
    after = 1.0
    for _ in range(_BISECTIONS):
        middle = 0.5 * (before + after)
        interpolate(now.dense, middle, s.y_at)
        set_time(block, now.clock[codes.STEP_START] + middle * now.clock[codes.STEP_SIZE])
        derivative(block, s.y_at, s.dy_at)
        note_level(block, row_count(block))
        if push_ratio(block, contact) < _PULLS_BELOW:
            after = middle
        else:
            before = middle
    time: float = now.clock[codes.STEP_START] + after * now.clock[codes.STEP_SIZE]
    return time


_LAST = METHOD.last


@jit
def take_step(block: Array) -> int:
    """Take one step from STEP_END on, cut at the first event, which then waits as PENDING_GUARD; return a status."""
    keep_small()
    now = Course(block)
    s = Stages(block)
    start = now.clock[codes.STEP_END]
    copy(now.y_end, s.y_start)
    copy(now.dy_end, s.derivatives[0])
    Implicit(block).fresh[0] = 0
    wanted = now.clock[codes.NEXT_STEP]
    method = now.counters[codes.IMPLICIT]
    step = accurate_step(block, start)
    singular = False
    if step > 0.0:
        singular = is_singular(block)
        if passes(block):
            singular, step = _lead_through(block, start, step, singular, wanted)
    if step == 0.0:
        _refuse(block, wanted, method)
        return _shock_or_fail(block)
    guard, subject, fraction = first_event(block)
    crossing = codes.NONE
    if Sizes(block).thresholds > 0 and fraction > 0.0:
        crossing, fraction = first_crossing(block, fraction)
        if crossing != codes.NONE:  # no event, but the step ends there
            guard, subject = codes.GUARD_NONE, codes.NONE
    ends = guard != codes.GUARD_NONE or crossing != codes.NONE
    if ends or singular:
        clear(Contacts(block).apart)  # what it says is of the end of a step that does not come to that
    if fraction < 0.0:
        _refuse(block, wanted, method)
        is_one_inside(block)
        return status.PENETRATED
    hops = 0.5 * fraction * step > smallest_step(block, start) and comes_down_beside(block, guard, subject, fraction)
    if hops:  # at the top of its hop it is let loose, and what is below is looked for
        guard = codes.GUARD_NONE
        subject = codes.NONE
        fraction *= 0.5
    if ends or hops:
        step *= fraction
        if step > smallest_step(block, start):
            if crossing != codes.NONE:
                step = refine_crossing(block, crossing, step)
            else:
                step = _end_at_event(block, guard, subject, start, step)
            if math.isnan(s.y_new[Sizes(block).y_loss]):
                _refuse(block, wanted, method)
                return _shock_or_fail(block)
            singular = singular and is_singular(block)  # what the event ends may be what depends on something there
        elif guard == codes.GUARD_PUSH and forces_are_unbounded(block):
            _refuse(block, wanted, method)
            return _shock_or_fail(block)  # the force does not fall to zero here, but grows without limit
        else:
            step = 0.0  # it happens here and now
            singular = False
    if singular:
        _refuse(block, wanted, method)
        return status.SINGULAR
    keep_independence(block)
    now.counters[codes.PENDING_GUARD] = guard
    now.counters[codes.PENDING_SUBJECT] = subject
    if crossing != codes.NONE:
        Thresholds(block).side[crossing] *= codes.CROSSES
    if step == 0.0:
        return status.OK
    _keep(block, start, step)
    watch_step(block)
    release(block, subject if guard == codes.GUARD_GAP else codes.NONE)
    return _mend_and_check(block)


@jit
def _refuse(block: Array, wanted: float, method: int) -> None:
    """A step that is refused changes nothing: neither the size that is tried first nor the method."""
    Course(block).clock[codes.NEXT_STEP] = wanted
    Course(block).counters[codes.IMPLICIT] = method


@jit
def _lead_through(block: Array, start: float, step: float, singular: bool, wanted: float) -> tuple[bool, float]:
    """Make of the step last tried one that passes a singular configuration, or that comes near enough to it, if one is.

    Whether the step leads over one that cannot be passed, and the size of the step [s].
    """
    keep_small()
    clock = Course(block).clock
    apart = ahead(block, singular, wanted)
    if apart == math.inf:
        return singular, step
    next_step = clock[codes.NEXT_STEP]
    outcome, size = pass_over(block, start, apart, singular)
    if outcome == PASSED:
        clock[codes.NEXT_STEP] = next_step
        return False, size
    if outcome == NEARER:
        clock[codes.NEXT_STEP] = apart - size
    elif singular:
        return True, step
    else:
        clock[codes.NEXT_STEP] = step
    copy(Course(block).y_end, Stages(block).y_start)
    copy(Course(block).dy_end, Stages(block).derivatives[0])
    step = accurate_step(block, start)
    clock[codes.NEXT_STEP] = max(clock[codes.NEXT_STEP], next_step)
    return step > 0.0 and is_singular(block), step


@jit
def _shock_or_fail(block: Array) -> int:
    """Why there is no step; where no finite forces agree with friction, an impact without approach may lead on."""
    keep_small()
    outcome = why_no_step(block)
    if outcome == status.JAMMED and Options(block).settings[codes.TANGENTIAL_SHOCK] > 0.5:
        Course(block).counters[codes.PENDING_GUARD] = codes.GUARD_SHOCK
        Course(block).counters[codes.PENDING_SUBJECT] = codes.NONE
        return status.OK
    return outcome


@jit
def _end_at_event(block: Array, guard: int, subject: int, start: float, step: float) -> float:
    """Take a true step to an event that is `step` [s] away on the dense output; return its size [s]."""
    keep_small()
    if guard == codes.GUARD_GAP:
        return refine(block, subject, step)
    if guard == codes.GUARD_HANDOVER:
        return refine_end(block, subject, step)
    if guard == codes.GUARD_STICK:
        return refine_slip(block, subject, step)
    if guard == codes.GUARD_SLIP:
        return refine_hold(block, subject, step)
    if guard == codes.GUARD_PUSH:
        return refine_push(block, subject, step)
    try_step(block, start, step)
    return step


@jit
def _keep(block: Array, start: float, step: float) -> None:
    """The step last tried, from `start` on and of size `step` [s], is where the motion has come to."""
    keep_small()
    now = Course(block)
    s = Stages(block)
    now.counters[codes.COUNT_STEPS] += 1
    now.clock[codes.STEP_START] = start
    now.clock[codes.STEP_SIZE] = step
    now.clock[codes.STEP_END] = start + step
    if now.counters[codes.RAMPING] != 0 and abs(start + step - now.clock[codes.RAMP_END]) <= smallest_step(
        block, start
    ):
        now.clock[codes.STEP_END] = now.clock[codes.RAMP_END]
    copy(s.y_new, now.y_end)
    copy(s.derivatives[_LAST], now.dy_end)
    for r in range(now.dense.shape[0]):
        copy(s.new_dense[r], now.dense[r])
    now.counters[codes.IMPLICIT_STEP] = now.counters[codes.IMPLICIT]
    choose_method(block)


@jit
def _mend_and_check(block: Array) -> int:
    """After a step: bring back what has drifted, and look whether profiles still fit; return a status."""
    keep_small()
    now = Course(block)
    set_time(block, now.clock[codes.STEP_END])
    drift = Stages(block).drift
    # a rate that is off leads farther in a long step
    most_rate = MOST_RATE_DRIFT / max(1.0, now.clock[codes.STEP_SIZE] * rate_scale(block))
    off = min(drift[0], CLOSES_WITHIN)
    drifted = not (drift[0] <= MOST_DRIFT and drift[1] <= most_rate * rate_scale(block))
    mends = not closes_step(block) and (drifted or Sizes(block).alphas > 0)
    if mends and mend(block, MOST_DRIFT, most_rate):
        derivative(block, now.y_end, now.dy_end)
    if Sizes(block).outlines > 0:
        contact, depth = deepest_overlap(block, place_bodies(block, now.y_end), off)
        if contact != codes.NONE:
            blame(block, contact, -depth)
            return status.PENETRATED
    if Sizes(block).alphas > 0:
        at = place_bodies(block, now.y_end)
        if not least_fit(block, at) > 0.0:
            return status.NO_CONTACT_POINT
        if bridged(block, at):
            return status.BRIDGED
    return status.OK
