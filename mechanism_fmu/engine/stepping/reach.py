"""Drivers that come to the end of their range: what they ask for next is out of the mechanism's reach."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Rows, Stages
from ...tables.parts import Bodies, Joints
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_apart
from ..constraints.point_line import spare_row
from ..constraints.rows import row_count
from ..dynamics.linear_solve import solve_again
from ..profiles.curves import curve
from ..vectors import clear, dot
from .singular import independence

#: Where steps shrink to nothing and rows are less independent than this (a squared sine), links lie in one line.
IN_LINE = 1e-8
#: Of a driver's row that depends on others, no more than this part can be met.
_HALF = 0.5


@jit
def is_out_of_reach(block: Array) -> bool:
    """Whether the rows that depend on each other, where steps have shrunk to nothing, are also those of a driver.

    Then it has come to the end of its range: to move on as it asks, bodies would have to move faster than any limit.
    Where the rows of the other joints depend on each other by themselves, as in a parallelogram that lies flat, what a
    driver asks for is no more than elsewhere. `stages.stiffest` is then the number of the driver, that for which bodies
    move fastest if several do, and the spare row's residual is what it asks for there [m or rad].
    """
    keep_apart()
    table = Joints(block)
    found = codes.NONE
    most = 0.0
    for k in range(table.curve.shape[0]):
        if table.curve[k] == codes.NONE:
            continue
        asked, rate, _, _ = curve(block, table.curve[k], Course(block).clock[codes.STEP_END])
        speed = abs(rate) * _motion_by_row(block, table.row[k])
        if speed > most:
            found = k
            most = speed
            Rows(block).residual[spare_row(block)] = asked
    Stages(block).stiffest[0] = found
    return found != codes.NONE


@jit
def _motion_by_row(block: Array, row: int) -> float:
    """Motion by which the row alone changes by 1, in the metric of the masses; 0 where that is as elsewhere.

    With a share in the rows that depend on each other, it grows as one over their sine.
    """
    keep_apart()
    system = LinearSystem(block)
    entry = Rows(block).jacobian[row]
    n = Sizes(block).coordinates
    clear(system.right_side)
    system.right_side[row] = 1.0
    solve_again(block, row_count(block), n)
    met = size = 0.0
    for k in range(n):
        across = entry[k] * Bodies(block).inverse_root_mass[k]
        met += across * system.solution[k]
        size += across * across
    square = dot(system.solution, system.solution, n)
    if met < _HALF:
        return math.inf
    return math.sqrt(square) if square * size * math.sqrt(independence(block)) > 1.0 else 0.0
