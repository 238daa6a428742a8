"""Where forces let go within a step: contacts that would pull, friction beyond its bound; and where slip ends.

Forces are looked at on the dense output. What friction lets go of, and where slip ends, is then found anew with true
Runge-Kutta steps, as gaps are (`events`).
"""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.method import METHOD
from ...tables.motion import Rows, Rubs, Stages
from ...tables.parts import Contacts
from ...tables.sizes import Sizes
from ...tolerances import ROOT_TOLERANCE
from ..compiler.subset import jit, keep_small
from ..constraints.entries import along_row
from ..constraints.friction_rows import friction_row, rubs, sticks
from ..constraints.kinematics import place_bodies
from ..constraints.point_line import spare_row
from ..constraints.rows import row_count
from ..contacts.complementarity import hold_ratio, push_ratio, push_tolerance
from ..contacts.guards import can_open
from ..dynamics.acceleration import LEAST_INDEPENDENCE, close_rows, derivative
from ..dynamics.forces import set_time
from ..interpolation import interpolate
from ..vectors import copy
from .looks import falling
from .runge_kutta import try_step

_LAST = METHOD.last
#: Points of a step at which each force is looked at.
_LOOKS = 8
#: Stages may pass over a dip of a force as deep as this share of its change along them: they leave half of the step
#: out, where a parabola dips by a quarter of that change, and a kink in a force by more.
_DIPS_BELOW = 0.5
#: Parts of a step by which looks are beside its ends, to see how a force goes there.
_BESIDE = 1e-3
#: Golden sections that find the bottom of a dip, to 1e-5 of two looks' distance: the force there is closer by squares.
_GOLDEN = 0.3819660112501051
_SECTIONS = 24
#: How close, in parts of a step, it is found when a force is at its limit: of a contact's, what follows does not depend
#: on the last digits of when.
_CLOSE = 1e-15
_PUSH_CLOSE = 2e-12
_NEWTON_STEPS = 12
#: By this share of a step the dense output may misplace an event, where it is found anew on true steps.
_MISPLACED = 1e-3
#: A closed contact opens, and what sticks slips, when its force is less than this times the tolerance; a contact opens
#: from the second of these on when it is looked at anew.
_LETS_GO = -2.0
_OPENS = -1.0


@jit
def _spare_at(block: Array, guard: int, subject: int, fraction: float) -> float:
    """A contact's force, or what friction could hold more, over its tolerance at `fraction` of the step."""
    s = Stages(block)
    interpolate(s.new_dense, fraction, s.y_at)
    return _spare(block, guard, subject, fraction)


@jit
def _spare_behind(block: Array, guard: int, subject: int) -> float:
    """As `_spare_at`, at the end of the true step last tried."""
    s = Stages(block)
    copy(s.y_new, s.y_at)
    return _spare(block, guard, subject, 1.0)


@jit
def _spare(block: Array, guard: int, subject: int, fraction: float) -> float:
    """As `_spare_at`, at y_at, where the rows are closed first: what they are off would count as a force."""
    keep_small()
    s = Stages(block)
    set_time(block, s.tried[0] + fraction * s.tried[1])
    close_rows(block, s.y_at, 0.0, 0.0, LEAST_INDEPENDENCE)
    derivative(block, s.y_at, s.dy_at)
    if guard == codes.GUARD_PUSH:
        return push_ratio(block, subject, push_tolerance(block, row_count(block)))
    return hold_ratio(block, subject, push_tolerance(block, row_count(block)))


# a force goes on smoothly: no bisection among the false positions
_falls = falling(_spare_at, false_positions=24, then_bisect=1000)


@jit
def first_to_let_go(block: Array, latest: float) -> tuple[int, int, float]:
    """The first contact that opens, or friction that lets go, before the fraction `latest` of the step: guard, subject.

    And the fraction; 2.0 when there is none.
    """
    keep_small()
    guard = codes.GUARD_NONE
    subject = codes.NONE
    fraction = 2.0
    table = Contacts(block)
    for c in range(table.mode.shape[0]):
        if table.mode[c] != codes.CLOSED or not can_open(block, c):
            continue
        least = table.least_push[c]
        if least < _LETS_GO or least < _DIPS_BELOW * (table.most_push[c] - least):
            lets_go = _first_below(block, codes.GUARD_PUSH, c, min(latest, fraction), _LETS_GO, _PUSH_CLOSE)
            if lets_go < min(latest, fraction):
                guard = codes.GUARD_PUSH
                subject = c
                fraction = lets_go
    if not rubs(block):
        return guard, subject, fraction
    rub = Rubs(block)
    for k in range(rub.slip.shape[0]):
        if rub.least_hold[k] < _LETS_GO and sticks(block, k):
            # where it has more than none to spare at first, that is where it has none left
            limit = 0.0 if _spare_at(block, codes.GUARD_SLIP, k, 0.0) > 1.0 else _LETS_GO
            lets_go = _first_below(block, codes.GUARD_SLIP, k, min(latest, fraction), limit, _CLOSE)
            if lets_go < min(latest, fraction):
                guard = codes.GUARD_SLIP
                subject = k
                fraction = lets_go
    return guard, subject, fraction


@jit
def _first_below(block: Array, guard: int, subject: int, latest: float, limit: float, close: float) -> float:
    """Where before `latest` a force falls to its limit, also between two looks; 2.0 when it does not."""
    keep_small()
    s = Stages(block)
    last = min(latest, 1.0)
    before = here = 0.0
    above = push = _spare_at(block, guard, subject, here)
    for look in range(_LOOKS + 2):
        after = min(look / _LOOKS, 1.0) * last
        if look == 0:
            after = _BESIDE * last
        elif look == _LOOKS:
            after -= _BESIDE * last
        spare = _spare_at(block, guard, subject, after)
        low, lowest = after, spare
        if spare >= _LETS_GO and push <= min(above, spare) and push < above + spare - 2.0 * push:
            low = _bottom(block, guard, subject, before, after)
            lowest = _spare_at(block, guard, subject, low)
            here, push = before, above
        if lowest < _LETS_GO:
            found: float = _falls(block, guard, subject, here, push - limit, low, lowest - limit, limit, close)
            return found
        before, here, above, push = here, after, push, spare
    set_time(block, s.tried[0] + s.tried[1])
    derivative(block, s.y_new, s.dy_at)  # what reads multipliers behind a step finds those of its end
    return 2.0


@jit
def _bottom(block: Array, guard: int, subject: int, before: float, after: float) -> float:
    """Where between two looks a force is below its limit, or else least."""
    keep_small()
    for _ in range(_SECTIONS):
        low = before + _GOLDEN * (after - before)
        high = after - _GOLDEN * (after - before)
        push = _spare_at(block, guard, subject, low)
        if push < _LETS_GO:
            return low
        if push < _spare_at(block, guard, subject, high):
            after = high
        else:
            before = low
    return 0.5 * (before + after)


@jit
def refine_push(block: Array, contact: int, step_size: float) -> float:
    """The step size at which the true step ends where a contact pulls, as it does on the dense output.

    By secants, until it is seen to pull: one that hardly pushes yet would stay closed there, and let go in a further
    event right behind. That step is the last one tried.
    """
    keep_small()
    s = Stages(block)
    start = s.tried[0]
    fraction = step_size / s.tried[1]
    before = (1.0 - _MISPLACED) * step_size
    pushed = _spare_at(block, codes.GUARD_PUSH, contact, (1.0 - _MISPLACED) * fraction)
    size = step_size
    for _ in range(_NEWTON_STEPS):
        try_step(block, start, size)
        value = _spare_behind(block, codes.GUARD_PUSH, contact)
        if not _OPENS < value < pushed:
            return size
        move = (value - _LETS_GO) * (size - before) / (pushed - value)
        if not abs(size + move - step_size) <= _MISPLACED * step_size:
            return size
        before = size
        pushed = value
        size += move
    return float(s.tried[1])


@jit
def refine_slip(block: Array, rub: int, step_size: float) -> float:
    """The step size at which the true step ends at zero slip speed; that step is the last one tried."""
    keep_small()
    n = Sizes(block).coordinates
    s = Stages(block)
    start = s.tried[0]
    limit = 2.0 * step_size
    row = Rows(block)
    spare = spare_row(block)
    for _ in range(_NEWTON_STEPS):
        try_step(block, start, step_size)
        at = place_bodies(block, s.y_new)
        friction_row(block, at, rub, spare)
        rate = along_row(row, spare, s.derivatives[_LAST, n:], Sizes(block).bodies, -row.gamma[spare])
        if rate == 0.0:
            return step_size
        move = -row.residual_rate[spare] / rate
        if not abs(move) > ROOT_TOLERANCE or not 0.0 < step_size + move < limit:
            return step_size
        step_size += move
    try_step(block, start, step_size)
    return step_size


@jit
def refine_hold(block: Array, rub: int, step_size: float) -> float:
    """The step size at which the true step ends where friction of what sticks has none left; it is the last one tried.

    By secants. The dense output of a long step places it worse.
    """
    keep_small()
    s = Stages(block)
    start = s.tried[0]
    size = step_size
    if not _spare_at(block, codes.GUARD_SLIP, rub, 0.0) > 1.0:  # it lets go where the bound is passed
        try_step(block, start, size)
        return size
    before = (1.0 - _MISPLACED) * step_size
    try_step(block, start, before)
    held = _spare_behind(block, codes.GUARD_SLIP, rub)
    try_step(block, start, size)
    for _ in range(_NEWTON_STEPS):
        value = _spare_behind(block, codes.GUARD_SLIP, rub)
        if not value < held:
            return size
        move = value * (size - before) / (held - value)
        if not abs(size + move - step_size) <= _MISPLACED * step_size:
            break
        if abs(move) <= ROOT_TOLERANCE:
            return size
        before = size
        held = value
        size += move
        try_step(block, start, size)
    try_step(block, start, step_size)
    return step_size
