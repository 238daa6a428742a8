"""Forces and accelerations, or impulses and changes of rates, that modes of contacts and friction give when tried."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Loads, Pose, Rows, Rubs, Strikes
from ...tables.parts import Bodies, Contacts
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.entries import along_row
from ..constraints.friction_rows import rubs
from ..constraints.point_line import spare_row
from ..constraints.rows import active_rows, contact_row, row_count
from ..dynamics.acceleration import derivative, scale_rows
from ..dynamics.linear_solve import solve
from ..dynamics.rounding import acceleration_rounding, speed_rounding
from ..dynamics.sliding import slide
from ..vectors import clear

# strikes.problem: how many candidates there are, what is decided, whether without approach, and for which island alone
# (`codes.NONE`: for all). (Not arguments: each literal is compiled anew.)
COUNT = 0
KIND = 1
SHOCK = 2
ISLAND = 3
FORCES = 0
IMPULSES = 1

# strikes.role
ABSENT = 0
KEPT = 1
DECIDED = 2


@jit
def try_modes(block: Array, at: Pose) -> int:
    """The trial of the present modes; the number of rows."""
    keep_apart()
    if Strikes(block).problem[KIND] == IMPULSES:
        return _try_impulses(block, at)
    derivative(block, Course(block).y_end, Course(block).dy_end)
    return row_count(block)


@jit
def _try_impulses(block: Array, at: Pose) -> int:
    """Impulses and change of rates for the present modes, eq (7) with the targets of all closed contacts."""
    keep_apart()
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
    if not rubs(block):
        solve(block, count, Sizes(block).coordinates)
        return count
    rub = Rubs(block)
    for k in range(rub.slip.shape[0]):
        if rub.row[k] >= 0:
            system.right_side[rub.row[k]] = -Rows(block).residual_rate[rub.row[k]]
    gives = _given_impulses(block, at, count)
    solve(block, count, Sizes(block).coordinates)
    if gives:
        for k in range(Sizes(block).coordinates):
            system.solution[k] += Bodies(block).inverse_root_mass[k] * Loads(block).applied[k]
    slide(block, at, count, Sizes(block).contacts + Sizes(block).joints)
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
        change = Loads(block).weight  # scratch: of the start, which is over
        for k in range(n):
            change[k] = Bodies(block).inverse_mass[k] * impulse[k]
        for r in range(count):
            right = LinearSystem(block).right_side[r]
            LinearSystem(block).right_side[r] = -along_row(row, r, change, Sizes(block).bodies, -right)
    return gives


@jit
def excess(block: Array, contact: int) -> tuple[float, float]:
    """A candidate's change of gap rate or acceleration beyond the least that it must be; its rounding."""
    r = spare_row(block)
    if Contacts(block).mode[contact] == codes.CLOSED:
        r = Contacts(block).row[contact]
    if Strikes(block).problem[KIND] == IMPULSES:
        return _change(block, r, -Strikes(block).target[contact])
    return _change(block, r, -Rows(block).gamma[r])


@jit
def slip_change(block: Array, r: int) -> tuple[float, float]:
    """The slip speed behind an impact, or the slip acceleration, by row `r`; and its rounding."""
    if Strikes(block).problem[KIND] == IMPULSES:
        return _change(block, r, Rows(block).residual_rate[r])
    return _change(block, r, -Rows(block).gamma[r])


@jit
def _change(block: Array, r: int, left: float) -> tuple[float, float]:
    """`left` and what the trial changes along row `r`: of rates in an impact, else accelerations; and its rounding."""
    keep_apart()
    n = Sizes(block).coordinates
    impulses = Strikes(block).problem[KIND] == IMPULSES
    size = abs(left)
    for end in range(2):
        first = 3 * Rows(block).body[r, end]
        for k in range(first, min(first + 3, n)):  # the ground has no rates
            change = Course(block).dy_end[n + k]
            if impulses:
                change = Bodies(block).inverse_root_mass[k] * LinearSystem(block).solution[k]
            left += Rows(block).jacobian[r, k] * change
            size += abs(Rows(block).jacobian[r, k] * change)
    return left, speed_rounding(block, r, size) if impulses else acceleration_rounding(block, r)
