"""Where inside a step an open contact's gap becomes zero.

An impact is the first fraction in (0, 1] of the step at which a gap, positive before, reaches zero; a gap that is zero
at the step's start counts only after it has opened. The root is bracketed on the dense output and then refined with
true Runge-Kutta steps, so that its accuracy is the integrator's and not the interpolant's.
"""

from __future__ import annotations

from .. import codes
from .dormand_prince import interpolate, try_step
from .kinematics import place_bodies
from .room import Array
from .rows import contact_row
from .subset import jit, keep_small
from .views import contacts, rows, sizes, stages

#: Points of a step at which each open gap is looked at; between two of them a dip is found by the sign of the gap rate.
_LOOKS = 8
#: Bisections of a bracket: 2^-60 of a step is below rounding.
_BISECTIONS = 60
#: A root is good when one more Newton step would move it by less than this [s].
ROOT_TOLERANCE = 1e-13
_NEWTON_STEPS = 12


@jit
def gap(block: Array, contact: int, y: Array) -> tuple[float, float]:
    """Gap s [m] and gap rate s' [m/s] of an open contact at y."""
    keep_small()
    row = sizes(block).rows - 1
    place_bodies(block, y)
    contact_row(block, contact, row)
    return rows(block).residual[row], rows(block).residual_rate[row]


@jit
def first_impact(block: Array) -> tuple[int, float]:
    """The contact that impacts first within the step in `new_dense`, and the fraction of the step.

    (`codes.NO_CONTACT`, 2.0) when none does.
    """
    keep_small()
    table = contacts(block)
    which = codes.NO_CONTACT
    earliest = 2.0
    for c in range(table.mode.shape[0]):
        if table.mode[c] == codes.OPEN:
            fraction = _first_root(block, c)
            if fraction < earliest:
                earliest = fraction
                which = c
    return which, earliest


@jit
def refine(block: Array, contact: int, step_size: float) -> float:
    """The step size at which the true step, not its interpolant, ends at zero gap; that step is the last one tried."""
    keep_small()
    s = stages(block)
    limit = 2.0 * step_size
    for _ in range(_NEWTON_STEPS):
        try_step(block, step_size)
        distance, rate = gap(block, contact, s.y_new)
        if not rate < 0.0:
            return step_size
        move = -distance / rate
        if abs(move) <= ROOT_TOLERANCE or not 0.0 < step_size + move < limit:
            return step_size
        step_size += move
    try_step(block, step_size)
    return step_size


@jit
def _gap_at(block: Array, contact: int, fraction: float) -> tuple[float, float]:
    keep_small()
    s = stages(block)
    interpolate(s.new_dense, fraction, s.y_at)
    return gap(block, contact, s.y_at)


@jit
def _first_root(block: Array, contact: int) -> float:
    """The first fraction at which this contact's gap reaches zero from above; 2.0 when it does not."""
    keep_small()
    before = 0.0
    distance, rate = _gap_at(block, contact, before)
    is_open = distance > 0.0 and contacts(block).touching[contact] == 0
    if not is_open and not rate > 0.0:
        return 0.0
    for look in range(1, _LOOKS + 1):
        after = look / _LOOKS
        next_distance, next_rate = _gap_at(block, contact, after)
        if next_distance <= 0.0:
            if not is_open:
                before = _after_opening(block, contact, after)
            return _bisect(block, contact, before, after)
        if rate < 0.0 < next_rate:
            bottom = _bottom(block, contact, before, after)
            if _gap_at(block, contact, bottom)[0] <= 0.0:
                return _bisect(block, contact, before, bottom)
        before, rate = after, next_rate
        is_open = True
    return 2.0


@jit
def _after_opening(block: Array, contact: int, after: float) -> float:
    """A fraction before `after` at which a gap that opens from zero is positive; 0.0 when rounding hides it."""
    keep_small()
    fraction = after
    for _ in range(_BISECTIONS):
        fraction *= 0.5
        if _gap_at(block, contact, fraction)[0] > 0.0:
            return fraction
    return 0.0


@jit
def _bisect(block: Array, contact: int, before: float, after: float) -> float:
    """The fraction at which the gap, positive at `before` and not at `after`, becomes zero."""
    keep_small()
    for _ in range(_BISECTIONS):
        middle = 0.5 * (before + after)
        if middle <= before or middle >= after:
            return after
        if _gap_at(block, contact, middle)[0] > 0.0:
            before = middle
        else:
            after = middle
    return after


@jit
def _bottom(block: Array, contact: int, before: float, after: float) -> float:
    """The fraction at which a gap that falls at `before` and rises at `after` is least."""
    keep_small()
    for _ in range(_BISECTIONS):
        middle = 0.5 * (before + after)
        if _gap_at(block, contact, middle)[1] < 0.0:
            before = middle
        else:
            after = middle
    return after
