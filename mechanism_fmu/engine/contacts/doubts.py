"""Where the laws leave the motion open: several modes agree, or friction depends on forces that nothing determines.

Both are recorded as events, behind a choice that has been made all the same (docs/explanation/friction.md).
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Loads, Pose, Rubs, Stages, Strikes
from ...tables.parts import Contacts, Joints
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.friction_rows import REVOLUTE, axis_length, coefficient, slips
from ..dynamics.dependent_rows import take_out_range
from ..vectors import copy
from .complementarity import agrees
from .participation import island_of
from .trial import COUNT

#: A row that lies this near to what the others determine is determined by them.
_DETERMINED = 1e-9


@jit
def other_choice(block: Array, at: Pose) -> int:
    """A candidate that slips and may be closed as well as open, by Painlevé's paradox; `codes.NONE` if there is none.

    The other choice has other accelerations; rows that depend on each other may be given up without any. Modes are as
    before, but what the last trial has left is lost.
    """
    keep_apart()
    n = Sizes(block).coordinates
    chosen = Stages(block).dy_at
    copy(Course(block).dy_end, chosen)
    mode = Contacts(block).mode
    rub = Rubs(block)
    for k in range(Strikes(block).problem[COUNT]):
        c = Strikes(block).candidates[k]
        if rub.free[c] != codes.BOUND or rub.slip[c] == codes.APART or not coefficient(block, c) > 0.0:
            continue
        mode[c] = codes.CLOSED - mode[c]
        differs = agrees(block, at) and _differ(Course(block).dy_end[n : 2 * n], chosen[n : 2 * n])
        mode[c] = codes.CLOSED - mode[c]
        if differs:
            return int(c)
    return codes.NONE


@jit
def _differ(first: Array, second: Array) -> bool:
    """Whether two accelerations differ by more than rounding."""
    keep_small()
    difference = 0.0
    size = 1.0
    for k in range(first.shape[0]):
        difference = max(difference, abs(first[k] - second[k]))
        size = max(size, abs(first[k]))
    return difference > _DETERMINED * size


@jit
def undetermined(block: Array, count: int) -> int:
    """What slips by a force that the last solve, of `count` rows, has shared out at will; `codes.NONE` if nothing does.

    Multipliers are determined but for what does nothing to the rates: such changes are what a row leaves outside the
    range of all rows. Where they change friction, and friction the accelerations, the motion is one of many. It is to
    be called right behind a trial.
    """
    keep_apart()
    table = Rubs(block)
    if LinearSystem(block).rank[0] >= count:
        return codes.NONE
    for k in range(table.slip.shape[0]):
        takes_part = slips(block, k) and island_of(block, k) != codes.NONE
        if takes_part and k < Sizes(block).contacts + Sizes(block).joints:
            first = _first_row(block, k)
            if _moves(block, first, count) or (_is_pin(block, k) and _moves(block, first + 1, count)):
                return k
    return codes.NONE


@jit
def _first_row(block: Array, rub: int) -> int:
    contacts = Sizes(block).contacts
    row: int = Contacts(block).row[rub] if rub < contacts else Joints(block).row[rub - contacts]
    return row


@jit
def _is_pin(block: Array, rub: int) -> bool:
    contacts = Sizes(block).contacts
    is_pin: bool = rub >= contacts and Joints(block).kind[rub - contacts] == REVOLUTE
    return is_pin


@jit
def _moves(block: Array, row: int, count: int) -> bool:
    """Whether the share of the multiplier of a row that is free changes accelerations, by friction."""
    keep_apart()
    table = Rubs(block)
    free = Loads(block).last_multiplier
    take_out_range(block, row, count, free)
    if not free[row] > _DETERMINED:
        return False
    largest = 0.0
    for i in range(Sizes(block).coordinates):
        total = 0.0
        size = 0.0
        for k in range(table.slip.shape[0]):
            if slips(block, k):
                change = float(table.slip[k]) * coefficient(block, k) * _normal_change(block, k, free)
                total += change * table.solution[k, i]
                size += abs(change * table.solution[k, i])
        if abs(total) > _DETERMINED * size:
            largest = max(largest, abs(total))
    return largest > _DETERMINED


@jit
def _normal_change(block: Array, rub: int, change: Array) -> float:
    """What a change of the multipliers does to the normal force of a contact or joint."""
    keep_small()
    multiplier = LinearSystem(block).multiplier
    contacts = Sizes(block).contacts
    if rub >= contacts + Sizes(block).joints:
        return 0.0
    row = _first_row(block, rub)
    value: float = change[row]
    if rub < contacts:
        return -value if multiplier[row] < 0.0 else value
    if _is_pin(block, rub):
        force = math.sqrt(multiplier[row] * multiplier[row] + multiplier[row + 1] * multiplier[row + 1])
        both: float = multiplier[row] * value + multiplier[row + 1] * change[row + 1]
        return both / force if force > 0.0 else 0.0
    along: float = axis_length(block, rub - contacts) * value
    return -along if multiplier[row] < 0.0 else along
