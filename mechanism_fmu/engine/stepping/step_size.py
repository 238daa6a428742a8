"""Step size control: limits of a step, and the control of its error."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.method import METHOD
from ...tables.motion import Course, LinearSystem, Rubs, Stages
from ...tables.parts import Contacts
from ...tables.sizes import Sizes
from .. import status
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.friction_rows import slips
from ..constraints.kinematics import place_bodies
from ..elementary import power
from ..profiles.curves import NEARLY, within_motions
from ..profiles.nearest import least_fit
from ..profiles.shape import passes_join
from ..scales import rate_scale
from .reach import IN_LINE, is_out_of_reach
from .runge_kutta import scaled_error, try_step
from .singular import independence
from .stiffness import is_beyond_explicit, look_stiff

# How far a step may go, however accurate it is: to where slopes of inputs end, and not over what a driver does.
#
# An input is unknown beyond the end of its slope. A mechanism at rest needs no step at all: it would stride over a
# short motion of a driver without noticing, since none of its stages falls into it.


@jit
def within_ramp(block: Array, start: float, step: float) -> float:
    """The step, or what is left until slopes of inputs end."""
    now = Course(block)
    left: float = now.clock[codes.RAMP_END] - start
    if now.counters[codes.RAMPING] != 0 and step > NEARLY * left:
        return left
    return step


# The size of a step: as long as its error allows, and no longer than what may happen within it.

_ERROR_EXPONENT = METHOD.error_exponent
#: Smallest step as a fraction of the mechanism's time, or of the step tried if that is less, or of |t| if that is more.
_SMALLEST_STEP = 1e-15
#: How far a step shrinks that is not accurate, in parts of the one tried first, if that is less.
_SMALLEST_OF_FIRST = 1e-30
#: Where there are guards or thresholds, no body turns further than this in one step [rad]: a step without error may be
#: of any length, and would pass over what a turning point meets in every turn.
MOST_TURN = 1.0
#: Where steps shrink to nothing and profiles fit less well than this, that is why [rad/rad].
_FITS_BARELY = 0.01
#: Where steps shrink to nothing and what a normal force does to its gap is this part of what it does without friction
#: or less, forces grow without limit.
_PARADOX = 1e-6
#: The first step that is tried by the implicit method, as so many times the smallest one, or more.
_FIRST_IMPLICIT = 1e5
_SAFETY = 0.9
_SHRINK_MOST = 0.2
_GROW_MOST = 5.0
#: A mechanism at rest strides ever further; an infinite step, which never gets smaller, would be tried for ever [s].
_LONGEST_STEP = 1e100


@jit
def accurate_step(block: Array, start: float) -> float:
    """Try steps from y_start at `start` [s] until one is accurate enough; return its size [s], 0 when there is none.

    NEXT_STEP, the size that is tried first, becomes that of the step to come.
    """
    keep_small()
    now = Course(block)
    wanted = min(now.clock[codes.NEXT_STEP], _LONGEST_STEP)
    if now.counters[codes.IMPLICIT] == 1:  # what a first step is guessed from may be what is stiff
        wanted = max(wanted, _FIRST_IMPLICIT * _SMALLEST_STEP * max(1.0 / rate_scale(block), abs(start)))
    step = representable(start, within_ramp(block, start, wanted))
    step = representable(start, within_motions(block, start, step))
    first = step
    error = _try(block, start, step)
    grow_most = _GROW_MOST
    while not error <= 1.0:
        now.counters[codes.COUNT_REJECTED] += 1
        tried = step
        step = representable(start, step * scale_of_step(error, 1.0))
        grow_most = 1.0
        least = min(_SMALLEST_STEP / rate_scale(block), _SMALLEST_OF_FIRST * first)
        if not step > max(least, _SMALLEST_STEP * abs(start)):
            joins = error < math.inf and Sizes(block).alphas > 0
            if joins and passes_join(block, Stages(block).y_start, Stages(block).y_new):
                step = tried  # the curvature jumps there, and with it accelerations: rates by no more than rounding
                error = 1.0
                break
            if not is_beyond_explicit(block):
                return 0.0
            step = representable(start, _FIRST_IMPLICIT * _SMALLEST_STEP * max(1.0 / rate_scale(block), abs(start)))
        error = _try(block, start, step)
    look_stiff(block)
    now.clock[codes.NEXT_STEP] = step * scale_of_step(error, grow_most)
    if now.counters[codes.RAMPING] != 0 and grow_most > 1.0 and step < wanted:  # cut short by the slopes' end alone
        now.clock[codes.NEXT_STEP] = max(now.clock[codes.NEXT_STEP], wanted)
    return step


@jit
def smallest_step(block: Array, start: float) -> float:
    """The size that a step from `start` [s] must exceed [s]; what hardly moves yet has a long time, but short steps."""
    return _SMALLEST_STEP * max(min(1.0 / rate_scale(block), float(Stages(block).tried[1])), abs(start))


@jit
def forces_are_unbounded(block: Array) -> bool:
    """Whether forces grow without limit where the last acceleration was taken: friction nearly undoes what they do."""
    keep_small()
    grows = False
    for k in range(Rubs(block).slip.shape[0]):
        grows = grows or (slips(block, k) and abs(Rubs(block).criterion[k]) < _PARADOX)
    return grows


@jit
def why_no_step(block: Array) -> int:
    """What has made the step shrink to nothing."""
    keep_apart()
    s = Stages(block)
    if s.jams[0] == 1:
        return status.JAMMED
    if forces_are_unbounded(block):
        return status.JAMMED
    if LinearSystem(block).rank[0] > Course(block).counters[codes.RANK]:
        return status.SINGULAR
    if Sizes(block).alphas > 0:
        at = place_bodies(block, s.y_start)
        if not least_fit(block, at) > _FITS_BARELY:
            return status.NO_CONTACT_POINT
    total = 0.0
    for k in range(s.y_new.shape[0]):
        total += abs(s.y_new[k])
    least = min(independence(block), Course(block).independence_end[0])  # a step that fails may end anywhere
    if total < math.inf and least < IN_LINE:  # what is no number depends on nothing
        return status.OUT_OF_REACH if is_out_of_reach(block) else status.SINGULAR
    return status.STEP_TOO_SMALL


@jit
def _try(block: Array, start: float, step: float) -> float:
    """Try a step from `start`; return its error, or how much too far a body turns if that shortens the step more."""
    keep_small()
    s = Stages(block)
    error = try_step(block, start, step)
    if Sizes(block).indicators == Sizes(block).rubs + 1:  # none of positions: slip is as smooth as the motion
        return error
    turn = 0.0
    for k in range(2, Sizes(block).coordinates, 3):
        turn = max(turn, abs(s.y_new[k] - s.y_start[k]) / MOST_TURN)
    haste = Contacts(block).alpha_haste
    first = Sizes(block).y_alpha
    for k in range(haste.shape[0]):
        turn = max(turn, abs(s.y_new[first + k] - s.y_start[first + k]) * haste[k])
    too_far = 1.0
    for _ in range(_ERROR_EXPONENT):  # `_scale` takes the root
        too_far *= turn
    if too_far > error:
        return too_far
    return error


@jit
def representable(start: float, step: float) -> float:
    """The step whose end, start + step, is a floating-point number: late on the clock, rounding would add up."""
    return (start + step) - start


@jit
def scale_of_step(error: float, most: float) -> float:
    """Factor for the next step size."""
    if error == 0.0:
        return most
    if not error < math.inf:
        return _SHRINK_MOST
    return min(most, max(_SHRINK_MOST, _SAFETY * power(error, -1.0 / _ERROR_EXPONENT)))


@jit
def note_stiffest(block: Array) -> None:
    """Write into `stages.stiffest` which unknown limits the size of the step last tried, for a message.

    It is the one whose error is largest, measured by its tolerance.
    """
    keep_apart()
    s = Stages(block)
    worst = -1.0
    for i in range(Sizes(block).y_wear):
        if i == Sizes(block).y_work or i == Sizes(block).y_loss:
            continue  # work and loss follow from the motion
        error = abs(scaled_error(block, i, s.tried[1]))
        if not error <= worst:
            worst = error
            s.stiffest[0] = i
