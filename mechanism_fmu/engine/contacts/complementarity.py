"""Which of several touching contacts push: p >= 0, d >= target, p (d - target) = 0, beside the rows that are kept.

In an impact p is an impulse, d the change of the gap rate s' and target v of eq (6); at rest p is a force, d the second
derivative of the gap and target 0.

Solved exactly, by principal pivoting: each contact is in (closed, a row like a joint's) or out (open), and as long as
one of them violates its inequality, the first such contact changes sides (least-index rule, Murty 1974). When that does
not end, as it may when rows depend on each other, all combinations of the contacts are tried. The same solution
procedure serves impulses and accelerations; only the two kinds of trial differ.

Dry friction is part of the same problem: whatever touches and may slip either way (at zero slip; in an impact always)
sticks, a row like a joint's within the cone |lambda_T| <= mu lambda_N, or slips, with a friction against the slip that
comes of it (docs/friction.md). What violates its condition sticks instead, or slips to where it is pushed.
"""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Loads, Pose, Rows, Rubs, Strikes
from ...tables.parts import Bodies, Contacts
from ...tables.sizes import Sizes
from ...tolerances import PUSHES_SHARE, PUSHES_WITHIN
from .. import status
from ..compiler.subset import jit, keep_small
from ..constraints.friction_rows import coefficient, friction_row, holding, rubs, touches
from ..constraints.point_line import spare_row
from ..constraints.rows import active_rows, contact_row, row_count
from ..dynamics.acceleration import derivative, scale_rows
from ..dynamics.minimum_norm import minimum_norm
from ..dynamics.sliding import hold, slide
from ..vectors import clear, largest

#: An acceleration [m/s2], or a share of its terms, that may be missing.
_ACCELERATION = 1e-8
#: An impulse may be missing this share of the largest one, a change of gap rate this much [m/s] or share of its terms.
_IMPULSE_SHARE = 1e-11
_SPEED = 1e-11
_SHARE = 1e-12
_MOST_PIVOTS = 64
#: All combinations of more contacts than these, or more combinations than theirs, are not tried.
MOST_COMBINED = 12
_TOO_MANY = (1 << MOST_COMBINED) + 1

# strikes.problem: how many candidates there are, and what is decided. (Not arguments: each literal is compiled anew.)
COUNT = 0
KIND = 1
FORCES = 0
IMPULSES = 1


@jit
def push_impulses(block: Array, at: Pose) -> int:
    """Decide about `strikes.candidates` in an impact at y_end; return a status.

    Afterwards their modes say which push; the linear system holds impulses and the change of rates of that choice.
    """
    Strikes(block).problem[KIND] = IMPULSES
    return _choose(block, at)


@jit
def push_forces(block: Array, at: Pose) -> int:
    """Decide about `strikes.candidates`, all at rest at y_end; return a status.

    Afterwards their modes say which push; dy_end is the derivative of that choice.
    """
    Strikes(block).problem[KIND] = FORCES
    return _choose(block, at)


@jit
def push_ratio(block: Array, contact: int, count: int) -> float:
    """A closed contact's force over the tolerance; it pulls below -1, and opens below -2."""
    keep_small()
    multiplier = LinearSystem(block).multiplier
    ratio: float = multiplier[Contacts(block).row[contact]] / (
        PUSHES_WITHIN + PUSHES_SHARE * largest(multiplier, count)
    )
    return ratio


@jit
def hold_ratio(block: Array, rub: int, count: int) -> float:
    """What friction of what sticks could hold more, over the tolerance; it slips below -2."""
    keep_small()
    ratio: float = hold(block, rub) / (PUSHES_WITHIN + PUSHES_SHARE * largest(LinearSystem(block).multiplier, count))
    return ratio


@jit
def _choose(block: Array, at: Pose) -> int:
    count = Strikes(block).problem[COUNT]
    mode = Contacts(block).mode
    candidates = Strikes(block).candidates
    for _ in range(_MOST_PIVOTS * (1 + count + Sizes(block).rubs)):
        wrong = _first_wrong(block, at)
        if wrong == codes.NONE:
            return status.OK
        if wrong < count:
            mode[candidates[wrong]] = codes.CLOSED - mode[candidates[wrong]]
        else:
            _turn_over(block, wrong - count)
    return _combine(block, at, count)


@jit
def _combine(block: Array, at: Pose, count: int) -> int:
    """Try all combinations of modes of the candidates, and of stick and slip where that is free; return a status."""
    keep_small()
    mode = Contacts(block).mode
    candidates = Strikes(block).candidates
    rub = Rubs(block)
    combinations = 1
    for _ in range(count):
        combinations = min(2 * combinations, _TOO_MANY)
    for k in range(rub.slip.shape[0]):
        if rub.free[k] == codes.FREE:
            combinations = min(3 * combinations, _TOO_MANY)
    if combinations == _TOO_MANY:
        return status.MANY_TOUCH
    for combination in range(combinations):
        rest = combination
        for k in range(count):
            mode[candidates[k]] = rest & 1
            rest >>= 1
        for k in range(rub.slip.shape[0]):
            if rub.free[k] == codes.FREE:
                rub.slip[k] = codes.STICKS
                if rest % 3 > 0:
                    rub.slip[k] = codes.FORWARDS if rest % 3 == 1 else codes.BACKWARDS
                rest //= 3
        if _first_wrong(block, at) == codes.NONE:
            return status.OK
    return status.NO_CHOICE


@jit
def agrees(block: Array, at: Pose) -> bool:
    """Whether the present modes of all candidates agree with the forces, or impulses, that they give."""
    none: bool = _first_wrong(block, at) == codes.NONE
    return none


@jit
def _turn_over(block: Array, rub: int) -> None:
    """What slips sticks instead; what sticks slips to where it is pushed, for good where it held more while stuck."""
    keep_small()
    table = Rubs(block)
    if table.slip[rub] != codes.STICKS:
        table.slip[rub] = codes.STICKS
        return
    table.slip[rub] = codes.BACKWARDS if table.force[rub] > 0.0 else codes.FORWARDS
    if holding(block, rub) > coefficient(block, rub):
        table.free[rub] = codes.LET_GO


@jit
def _first_wrong(block: Array, at: Pose) -> int:
    """The first candidate that pulls or comes off although closed, or goes in although open; `codes.NONE`: none.

    A closed one comes off when rows that depend on each other contradict each other: the solution is then a compromise.
    """
    keep_small()
    mode = Contacts(block).mode
    candidates = Strikes(block).candidates
    impulses = Strikes(block).problem[KIND] == IMPULSES
    if impulses:
        active = _try_impulses(block, at)
    else:
        derivative(block, Course(block).y_end, Course(block).dy_end)
        active = row_count(block)
    for k in range(Strikes(block).problem[COUNT]):
        c = candidates[k]
        if mode[c] == codes.CLOSED:
            if impulses:
                multiplier = LinearSystem(block).multiplier
                pulls = multiplier[Contacts(block).row[c]] < -_IMPULSE_SHARE * largest(multiplier, active)
            else:
                pulls = push_ratio(block, c, active) < -1.0
            if pulls or _comes_off(block, c):
                return k
        elif _goes_in(block, at, c):
            return k
    if rubs(block):
        wrong = _first_wrong_rub(block, at, active)
        if wrong != codes.NONE:
            count: int = Strikes(block).problem[COUNT]
            return count + wrong
    return codes.NONE


@jit
def _first_wrong_rub(block: Array, at: Pose, active: int) -> int:
    """The first that sticks beyond its cone, or slips against its friction's direction; `codes.NONE`: none."""
    keep_small()
    table = Rubs(block)
    multiplier = LinearSystem(block).multiplier
    spare = spare_row(block)
    tolerance = PUSHES_WITHIN + PUSHES_SHARE * largest(multiplier, active)
    if Strikes(block).problem[KIND] == IMPULSES:
        tolerance = _IMPULSE_SHARE * largest(multiplier, active)
    for k in range(table.slip.shape[0]):
        if table.free[k] != codes.FREE or not touches(block, k):
            continue
        if table.slip[k] == codes.STICKS:
            if not hold(block, k) >= -tolerance:
                return k
            left, rounding = _slip_change(block, table.row[k])
            if abs(left) > rounding:  # rows that depend on each other contradict each other: a compromise
                table.force[k] = -left  # it slips to where it goes, see `_turn_over`
                return k
        else:
            friction_row(block, at, k, spare)
            left, rounding = _slip_change(block, spare)
            if not float(table.slip[k]) * left >= -rounding:
                return k
    return codes.NONE


@jit
def _try_impulses(block: Array, at: Pose) -> int:
    """Impulses and change of rates for the present modes, eq (7) with the targets of all closed contacts."""
    keep_small()
    table = Contacts(block)
    strike = Strikes(block)
    system = LinearSystem(block)
    count = active_rows(block, at)
    scale_rows(block, count)
    for r in range(count):
        system.right_side[r] = 0.0
    for c in range(table.mode.shape[0]):
        if table.mode[c] == codes.CLOSED:
            system.right_side[table.row[c]] = strike.target[c]
    rub = Rubs(block)
    for k in range(rub.slip.shape[0]):
        if rub.row[k] >= 0:
            system.right_side[rub.row[k]] = -Rows(block).residual_rate[rub.row[k]]
    if not rubs(block):
        minimum_norm(block, count, Sizes(block).coordinates)
        return count
    gives = _given_impulses(block, at, count)
    minimum_norm(block, count, Sizes(block).coordinates)
    if gives:
        for k in range(Sizes(block).coordinates):
            system.solution[k] += Bodies(block).inverse_root_mass[k] * Loads(block).applied[k]
    slide(block, at, count)
    return count


@jit
def _given_impulses(block: Array, at: Pose, count: int) -> bool:
    """Let normal impulses that are given act on the rows, from the right side; whether there are any."""
    keep_small()
    n = Sizes(block).coordinates
    given = Rubs(block).given
    impulse = Loads(block).applied
    row = Rows(block)
    spare = spare_row(block)
    gives = False
    for c in range(Sizes(block).contacts):
        if given[c] > 0.0:
            if not gives:
                clear(impulse)
            gives = True
            contact_row(block, at, c, spare)
            for k in range(n):
                impulse[k] += given[c] * row.jacobian[spare, k]
    if gives:
        for r in range(count):
            for k in range(n):
                change = Bodies(block).inverse_mass[k] * impulse[k]
                LinearSystem(block).right_side[r] -= row.jacobian[r, k] * change
    return gives


@jit
def _comes_off(block: Array, contact: int) -> bool:
    """Whether a closed candidate exceeds its change of gap rate, or accelerates away from the other body."""
    left, rounding = _excess(block, contact)
    comes_off: bool = left > rounding
    return comes_off


@jit
def _goes_in(block: Array, at: Pose, contact: int) -> bool:
    """Whether an open candidate misses its change of gap rate, or accelerates into the other body."""
    contact_row(block, at, contact, spare_row(block))
    left, rounding = _excess(block, contact)
    goes_in: bool = left < -rounding
    return goes_in


@jit
def _excess(block: Array, contact: int) -> tuple[float, float]:
    """A candidate's change of gap rate or acceleration beyond the least that it must be; its rounding."""
    r = spare_row(block)
    if Contacts(block).mode[contact] == codes.CLOSED:
        r = Contacts(block).row[contact]
    if Strikes(block).problem[KIND] == IMPULSES:
        return _change(block, r, -Strikes(block).target[contact])
    return _change(block, r, -Rows(block).gamma[r])


@jit
def _slip_change(block: Array, r: int) -> tuple[float, float]:
    """The slip speed behind an impact, or the slip acceleration, by row `r`; and its rounding."""
    if Strikes(block).problem[KIND] == IMPULSES:
        return _change(block, r, Rows(block).residual_rate[r])
    return _change(block, r, -Rows(block).gamma[r])


@jit
def _change(block: Array, r: int, left: float) -> tuple[float, float]:
    """`left` and what the trial changes along row `r`: of rates in an impact, else accelerations; and its rounding."""
    keep_small()
    n = Sizes(block).coordinates
    impulses = Strikes(block).problem[KIND] == IMPULSES
    tolerance = _SPEED if impulses else _ACCELERATION
    size = abs(left)
    for k in range(n):
        change = Course(block).dy_end[n + k]
        if impulses:
            change = Bodies(block).inverse_root_mass[k] * LinearSystem(block).solution[k]
        left += Rows(block).jacobian[r, k] * change
        size += abs(Rows(block).jacobian[r, k] * change)
    return left, tolerance + _SHARE * size
