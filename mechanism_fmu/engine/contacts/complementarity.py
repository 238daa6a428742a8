"""Which of several touching contacts push: p >= 0, d >= target, p (d - target) = 0, beside the rows that are kept.

In an impact p is an impulse, d the change of the gap rate s' and target v of eq (6); at rest p is a force, d the second
derivative of the gap and target 0.

Solved exactly, by principal pivoting: each contact is in (closed, a row like a joint's) or out (open), and as long as
one of them violates its inequality, the first such contact changes sides (least-index rule, Murty 1974). When that does
not end, as it may when rows depend on each other, all combinations of the contacts are tried. The same solution
procedure serves impulses and accelerations; only the two kinds of trial differ.

Dry friction is part of the same problem: whatever touches and may slip either way (at zero slip; in an impact always)
sticks, a row like a joint's within the cone |lambda_T| <= mu lambda_N, or slips, with a friction against the slip that
comes of it (docs/explanation/friction.md). What violates its condition sticks instead, or slips to where it is pushed.
Where that does not end soon, Lemke's algorithm proposes modes of all at once (`proposal`).
"""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Pose, Rubs, Strikes
from ...tables.parts import Contacts
from ...tables.sizes import Sizes
from ...tolerances import PILED, PUSHES_SHARE, PUSHES_WITHIN
from .. import status
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.friction_rows import coefficient, friction_row, holding, rubs, touches
from ..constraints.point_line import spare_row
from ..constraints.rows import contact_row
from ..dynamics.sliding import hold
from ..vectors import largest
from .proposal import CONES, SPLIT, propose
from .trial import COUNT, FORCES, IMPULSES, KIND, SHOCK, excess, slip_change, try_modes

#: An impulse may be missing this share of the largest one.
_IMPULSE_SHARE = 1e-11
#: And stick may lack this share of its own impulse, where no approach but friction calls for an impulse: motions end
#: there where stick is at its bound (a stop is named from 1e-6 of that on, `stepping.step_size`), and drift is mended.
_SHOCK_SHARE = 1e-6
_MOST_PIVOTS = 64
#: Where events pile up, a force that lacks this part of its tolerance pulls.
_HARDLY = 1e-3
#: With friction, before modes of all are proposed at once, and behind it.
_FEW_PIVOTS = 3
#: All combinations of more contacts than these, or more combinations than theirs, are not tried.
MOST_COMBINED = 12
_TOO_MANY = (1 << MOST_COMBINED) + 1


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
def push_tolerance(block: Array, count: int) -> float:
    """What a force may pull before it counts [N], by the forces along all `count` rows."""
    tolerance: float = PUSHES_WITHIN + PUSHES_SHARE * largest(LinearSystem(block).multiplier, count)
    return tolerance


@jit
def push_ratio(block: Array, contact: int, tolerance: float) -> float:
    """A closed contact's force over the tolerance; it pulls below -1, and opens below -2."""
    ratio: float = LinearSystem(block).multiplier[Contacts(block).row[contact]] / tolerance
    return ratio


@jit
def hold_ratio(block: Array, rub: int, tolerance: float) -> float:
    """What friction of what sticks could hold more, over the tolerance; it slips below -2."""
    keep_small()
    ratio: float = hold(block, rub) / tolerance
    return ratio


@jit
def _choose(block: Array, at: Pose) -> int:
    count = Strikes(block).problem[COUNT]
    if not rubs(block):
        return status.OK if _pivot(block, at, _MOST_PIVOTS * (1 + count)) else _combine(block, at, count)
    pivots = _FEW_PIVOTS * (1 + count + Course(block).counters[codes.RUBBING])
    if _pivot(block, at, pivots):
        return status.OK
    for form in (CONES, SPLIT):
        if propose(block, at, form) and _pivot(block, at, pivots):
            return status.OK
    return _combine(block, at, count)


@jit
def _pivot(block: Array, at: Pose, most: int) -> bool:
    """As long as a candidate is wrong, the first one changes sides, up to `most` times; whether none is at last."""
    keep_apart()
    count = Strikes(block).problem[COUNT]
    mode = Contacts(block).mode
    candidates = Strikes(block).candidates
    for _ in range(most):
        wrong = _first_wrong(block, at)
        if wrong == codes.NONE:
            return True
        if wrong < count:
            mode[candidates[wrong]] = codes.CLOSED - mode[candidates[wrong]]
        else:
            _turn_over(block, wrong - count)
    return False


@jit
def _combine(block: Array, at: Pose, count: int) -> int:
    """Try all combinations of modes of the candidates, and of stick and slip where that is free; return a status."""
    keep_apart()
    combinations = combination_count(block, count)
    if combinations == _TOO_MANY:
        return status.MANY_TOUCH
    for combination in range(combinations):
        combine_modes(block, count, combination)
        if _first_wrong(block, at) == codes.NONE:
            return status.OK
    return status.NO_CHOICE


@jit
def combination_count(block: Array, count: int) -> int:
    """The number of combinations of modes of the candidates, and of stick and slip where that is free."""
    keep_small()
    combinations = 1
    for _ in range(count):
        combinations = min(2 * combinations, _TOO_MANY)
    for k in range(Sizes(block).rubs):
        if _is_open_to_all(block, k):
            combinations = min(3 * combinations, _TOO_MANY)
    return combinations


@jit
def combine_modes(block: Array, count: int, combination: int) -> None:
    """Set the modes of one of the combinations."""
    keep_small()
    rub = Rubs(block)
    rest = combination
    for k in range(count):
        Contacts(block).mode[Strikes(block).candidates[k]] = rest & 1
        rest >>= 1
    for k in range(rub.slip.shape[0]):
        if _is_open_to_all(block, k):
            rub.slip[k] = codes.STICKS
            if rest % 3 > 0:
                rub.slip[k] = codes.FORWARDS if rest % 3 == 1 else codes.BACKWARDS
            rest //= 3


@jit
def _is_open_to_all(block: Array, rub: int) -> bool:
    """Whether it may stick or slip either way: at rest, and not of a contact that is no candidate and is open."""
    table = Contacts(block)
    if Rubs(block).free[rub] != codes.FREE or rub >= table.mode.shape[0]:
        free: bool = Rubs(block).free[rub] == codes.FREE
        return free
    takes_part: bool = table.mode[rub] == codes.CLOSED or Rubs(block).given[rub] > 0.0
    for k in range(Strikes(block).problem[COUNT]):
        takes_part = takes_part or Strikes(block).candidates[k] == rub
    return takes_part


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
    keep_apart()
    mode = Contacts(block).mode
    candidates = Strikes(block).candidates
    impulses = Strikes(block).problem[KIND] == IMPULSES
    active = try_modes(block, at)
    tolerance = push_tolerance(block, active)
    pulls_below = -1.0
    if Course(block).counters[codes.PILE] >= PILED:  # what hardly pulls at this instant does so more at the same one
        pulls_below = -_HARDLY
    for k in range(Strikes(block).problem[COUNT]):
        c = candidates[k]
        if mode[c] == codes.CLOSED:
            if impulses:
                multiplier = LinearSystem(block).multiplier
                pulls = multiplier[Contacts(block).row[c]] < -_IMPULSE_SHARE * largest(multiplier, active)
            else:
                pulls = push_ratio(block, c, tolerance) < pulls_below
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
    keep_apart()
    table = Rubs(block)
    multiplier = LinearSystem(block).multiplier
    spare = spare_row(block)
    tolerance = PUSHES_WITHIN + PUSHES_SHARE * largest(multiplier, active)
    if Strikes(block).problem[KIND] == IMPULSES:
        tolerance = _IMPULSE_SHARE * largest(multiplier, active)
    shock = Strikes(block).problem[KIND] == IMPULSES and Strikes(block).problem[SHOCK] == 1
    for k in range(table.slip.shape[0]):
        if table.free[k] != codes.FREE or not touches(block, k):
            continue
        if table.slip[k] == codes.STICKS:
            lacks = tolerance
            if shock:
                lacks = max(lacks, _SHOCK_SHARE * abs(multiplier[table.row[k]]))
            if not hold(block, k) >= -lacks:
                return k
            left, rounding = slip_change(block, table.row[k])
            if abs(left) > rounding:  # rows that depend on each other contradict each other: a compromise
                table.force[k] = -left  # it slips to where it goes, see `_turn_over`
                return k
        else:
            friction_row(block, at, k, spare)
            left, rounding = slip_change(block, spare)
            if not float(table.slip[k]) * left >= -rounding:
                return k
    return codes.NONE


@jit
def _comes_off(block: Array, contact: int) -> bool:
    """Whether a closed candidate exceeds its change of gap rate, or accelerates away from the other body."""
    left, rounding = excess(block, contact)
    comes_off: bool = left > rounding
    return comes_off


@jit
def _goes_in(block: Array, at: Pose, contact: int) -> bool:
    """Whether an open candidate misses its change of gap rate, or accelerates into the other body."""
    contact_row(block, at, contact, spare_row(block))
    left, rounding = excess(block, contact)
    goes_in: bool = left < -rounding
    return goes_in
