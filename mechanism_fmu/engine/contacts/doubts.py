"""Where the laws leave the motion open: several modes agree, or friction depends on forces that nothing determines.

Both are recorded as events, behind a choice that has been made all the same (docs/explanation/friction.md).
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Loads, Pose, Rubs, Stages, Strikes
from ...tables.parts import Bodies, Contacts
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.friction_rows import coefficient, holding
from ..constraints.rows import row_count
from ..vectors import copy, largest
from .complementarity import agrees, combination_count, combine_modes, push_tolerance
from .event_record import WITHIN, keep_event, note_mode
from .shared_forces import undetermined
from .trial import COUNT

#: Accelerations differ by more than this share of the largest, or of what forces alone would give, beyond what a force
#: may lack: two solutions differ by much of that, the same one by some 1e-9.
_DIFFERS = 1e-6
#: More combinations of modes are not compared, each of which takes a trial: three pins have 27, two feet 36.
_MOST_COMPARED = 36


@jit
def record_doubts(block: Array, at: Pose, compares: bool) -> None:
    """Record that the choice just made does not determine the motion, or is one of several, where it has not before.

    To be called right behind its trial. What is at rest is looked at in other modes only where `compares`.
    """
    keep_small()
    counters = Course(block).counters
    note_mode(block, WITHIN)
    what = undetermined(block, at)
    if what != codes.NONE and counters[codes.UNDETERMINED] != what + 1:
        keep_event(block, codes.GUARD_UNDETERMINED, what, WITHIN, 0.0)
    counters[codes.UNDETERMINED] = what + 1
    other = codes.NONE
    if what == codes.NONE:
        other = _other_choice(block, at, compares)
    if other != codes.NONE and counters[codes.SEVERAL] != other + 1:
        keep_event(block, codes.GUARD_SEVERAL, other, WITHIN, 0.0)
    counters[codes.SEVERAL] = other + 1


@jit
def _other_choice(block: Array, at: Pose, compares: bool) -> int:
    """What may have another mode, with other accelerations that agree, too; `codes.NONE` if there is nothing.

    A candidate that slips may be closed as well as open, by Painlevé's paradox; what is at rest may stick, or slip.
    Rows that depend on each other may be given up without another acceleration. Modes are as before, but what the last
    trial has left is lost.
    """
    keep_apart()
    chosen = Stages(block).dy_at
    copy(Course(block).dy_end, chosen)
    mode = Contacts(block).mode
    rub = Rubs(block)
    for k in range(Strikes(block).problem[COUNT]):
        c = Strikes(block).candidates[k]
        if rub.free[c] != codes.BOUND or rub.slip[c] == codes.APART or not coefficient(block, c) > 0.0:
            continue
        mode[c] = codes.CLOSED - mode[c]
        differs = agrees(block, at) and _differ(block, chosen)
        mode[c] = codes.CLOSED - mode[c]
        if differs:
            return int(c)
    if compares:
        return _other_at_rest(block, at, chosen)
    return codes.NONE


@jit
def _other_at_rest(block: Array, at: Pose, chosen: Array) -> int:
    """The first that is at rest and goes on in another mode where others agree, too; `codes.NONE` if there is none.

    Only where it holds no more than it rubs: the coefficient that decides would else not be the one that acts.
    """
    keep_apart()
    rub = Rubs(block)
    strike = Strikes(block)
    combinations = combination_count(block, strike.problem[COUNT])
    first = codes.NONE
    for k in range(rub.slip.shape[0]):
        rub.least_hold[k] = float(rub.slip[k])
        if rub.free[k] == codes.FREE and coefficient(block, k) > 0.0:
            if first == codes.NONE:
                first = k
            if holding(block, k) > coefficient(block, k):
                return codes.NONE
    if first == codes.NONE or combinations > _MOST_COMPARED:
        return codes.NONE
    mode = Contacts(block).mode
    for c in range(mode.shape[0]):
        strike.closed[c] = mode[c]
    differs = False
    for combination in range(combinations):
        combine_modes(block, strike.problem[COUNT], combination)
        if agrees(block, at) and _differ(block, chosen):
            differs = True
            break
    for c in range(mode.shape[0]):
        mode[c] = strike.closed[c]
    what = codes.NONE
    for k in range(rub.slip.shape[0]):
        if differs and what == codes.NONE and rub.slip[k] != rub.least_hold[k]:
            what = k
        rub.slip[k] = int(rub.least_hold[k])
    return first if differs and what == codes.NONE else what


@jit
def _differ(block: Array, chosen: Array) -> bool:
    """Whether the accelerations of the last trial are others than those chosen, by more than rounding.

    Not where no forces agree with friction: the trial has left it out then, and no power of it.
    """
    keep_small()
    n = Sizes(block).coordinates
    trial = Course(block).dy_end
    if math.isnan(trial[Sizes(block).y_loss]):
        return False
    difference = 0.0
    size = largest(Loads(block).free_acceleration, n)
    for k in range(n, 2 * n):
        difference = max(difference, abs(trial[k] - chosen[k]))
        size = max(size, abs(chosen[k]))
    lacking = push_tolerance(block, row_count(block)) * largest(Bodies(block).inverse_mass, n)
    return difference > _DIFFERS * size + lacking
