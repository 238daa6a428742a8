"""Which of several touching contacts push: p >= 0, s' >= target, p (s' - target) = 0, beside the rows that are kept.

Solved exactly, by principal pivoting: each contact is in (closed, a row like a joint's) or out (open), and as long as
one of them violates its inequality, the first such contact changes sides (least-index rule, Murty 1974). When that does
not end, as it may when rows depend on each other, all combinations of the contacts are tried. The same solution
procedure serves impulses and accelerations; only the two kinds of trial differ.
"""

from __future__ import annotations

from ... import codes
from ...tolerances import PUSHES_SHARE, PUSHES_WITHIN
from .. import status
from ..block.layout import Array
from ..block.motion import course, linear_system, rows, strikes
from ..block.parts import bodies, contacts, sizes
from ..block.vectors import largest
from ..compiler.subset import jit, keep_small
from ..constraints.rows import active_rows, contact_row, row_count, spare_row
from ..dynamics.acceleration import derivative, scale_rows
from ..dynamics.minimum_norm import minimum_norm

#: An acceleration [m/s2], or a share of its terms, that may be missing.
_ACCELERATION = 1e-8
#: An impulse may be missing this share of the largest one, a separation speed this much [m/s] or share of its terms.
_IMPULSE_SHARE = 1e-11
_SPEED = 1e-11
_SHARE = 1e-12
_MOST_PIVOTS = 64
#: All combinations of more contacts than these are not tried.
MOST_COMBINED = 12

# strikes.problem: how many candidates there are, and what is decided. (Not arguments: each literal is compiled anew.)
COUNT = 0
KIND = 1
FORCES = 0
IMPULSES = 1


@jit
def push_impulses(block: Array) -> int:
    """Decide about `strikes.candidates` in an impact at y_end; return a status.

    Afterwards their modes say which push; the linear system holds impulses and the change of rates of that choice.
    """
    strikes(block).problem[KIND] = IMPULSES
    return _choose(block)


@jit
def push_forces(block: Array) -> int:
    """Decide about `strikes.candidates`, all at rest at y_end; return a status.

    Afterwards their modes say which push; dy_end is the derivative of that choice.
    """
    strikes(block).problem[KIND] = FORCES
    return _choose(block)


@jit
def push_ratio(block: Array, contact: int, count: int) -> float:
    """A closed contact's force over the tolerance; it pulls below -1, and opens below -2."""
    keep_small()
    multiplier = linear_system(block).multiplier
    ratio: float = multiplier[contacts(block).row[contact]] / (
        PUSHES_WITHIN + PUSHES_SHARE * largest(multiplier, count)
    )
    return ratio


@jit
def _choose(block: Array) -> int:
    count = strikes(block).problem[COUNT]
    mode = contacts(block).mode
    candidates = strikes(block).candidates
    for _ in range(_MOST_PIVOTS * (1 + count)):
        wrong = _first_wrong(block)
        if wrong == codes.NONE:
            return status.OK
        mode[candidates[wrong]] = codes.CLOSED - mode[candidates[wrong]]
    if count <= MOST_COMBINED:
        for combination in range(1 << count):
            for k in range(count):
                mode[candidates[k]] = (combination >> k) & 1
            if _first_wrong(block) == codes.NONE:
                return status.OK
    return status.NO_CHOICE


@jit
def _first_wrong(block: Array) -> int:
    """The first candidate that pulls or comes off although closed, or goes in although open; `codes.NONE`: none.

    A closed one comes off when rows that depend on each other contradict each other: the solution is then a compromise.
    """
    keep_small()
    mode = contacts(block).mode
    candidates = strikes(block).candidates
    impulses = strikes(block).problem[KIND] == IMPULSES
    if impulses:
        active = _try_impulses(block)
    else:
        derivative(block, course(block).y_end, course(block).dy_end)
        active = row_count(block)
    for k in range(strikes(block).problem[COUNT]):
        c = candidates[k]
        if mode[c] == codes.CLOSED:
            if impulses:
                multiplier = linear_system(block).multiplier
                pulls = multiplier[contacts(block).row[c]] < -_IMPULSE_SHARE * largest(multiplier, active)
            else:
                pulls = push_ratio(block, c, active) < -1.0
            if pulls or _comes_off(block, c):
                return k
        elif _goes_in(block, c):
            return k
    return codes.NONE


@jit
def _try_impulses(block: Array) -> int:
    """Impulses and change of rates for the present modes, eq (7) with the targets of all closed contacts."""
    keep_small()
    table = contacts(block)
    strike = strikes(block)
    system = linear_system(block)
    count = active_rows(block)
    scale_rows(block, count)
    for r in range(count):
        system.right_side[r] = 0.0
    for c in range(table.mode.shape[0]):
        if table.mode[c] == codes.CLOSED:
            system.right_side[table.row[c]] = strike.target[c]
    minimum_norm(block, count, sizes(block).coordinates)
    return count


@jit
def _comes_off(block: Array, contact: int) -> bool:
    """Whether a closed candidate exceeds its separation speed, or accelerates away from the other body."""
    left, tolerance = _excess(block, contact, contacts(block).row[contact])
    comes_off: bool = left > tolerance
    return comes_off


@jit
def _goes_in(block: Array, contact: int) -> bool:
    """Whether an open candidate misses its separation speed, or accelerates into the other body."""
    contact_row(block, contact, spare_row(block))
    left, tolerance = _excess(block, contact, spare_row(block))
    goes_in: bool = left < -tolerance
    return goes_in


@jit
def _excess(block: Array, contact: int, r: int) -> tuple[float, float]:
    """A candidate's separation speed or acceleration, by row `r`, beyond what it must at least be; and its rounding."""
    keep_small()
    n = sizes(block).coordinates
    impulses = strikes(block).problem[KIND] == IMPULSES
    row = rows(block)
    left = -row.gamma[r]
    tolerance = _ACCELERATION
    if impulses:
        left = -strikes(block).target[contact]
        tolerance = _SPEED
    size = abs(left)
    for k in range(n):
        change = course(block).dy_end[n + k]
        if impulses:
            change = bodies(block).inverse_root_mass[k] * linear_system(block).solution[k]
        left += row.jacobian[r, k] * change
        size += abs(row.jacobian[r, k] * change)
    return left, tolerance + _SHARE * size
