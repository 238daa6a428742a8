"""Drivers that come to the end of their range: what they ask for next is out of the mechanism's reach."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Rows, Stages
from ...tables.parts import Joints
from ..compiler.subset import jit, keep_apart
from ..constraints.point_line import spare_row
from ..profiles.curves import curve
from .singular import independence

#: Where steps shrink to nothing and rows are less independent than this (a squared sine), links lie in one line.
_IN_LINE = 1e-8


@jit
def is_out_of_reach(block: Array) -> bool:
    """Whether steps have shrunk to nothing because a driver has come to the end of its range.

    There the rows depend on each other, and the force along the row of a driver that does not stop grows without limit.
    `stages.stiffest` is then the number of the driver, that of the greatest power if several move, and the spare row's
    residual is what it asks for there [m or rad].
    """
    keep_apart()
    if independence(block) > _IN_LINE:
        return False
    table = Joints(block)
    found = codes.NONE
    most = 0.0
    for k in range(table.curve.shape[0]):
        if table.curve[k] == codes.NONE:
            continue
        asked, rate, _, _ = curve(block, table.curve[k], Course(block).clock[codes.STEP_END])
        power = abs(rate * LinearSystem(block).multiplier[table.row[k]])
        if rate != 0.0 and (found == codes.NONE or power > most):
            found = k
            most = power
            Rows(block).residual[spare_row(block)] = asked
    if found == codes.NONE:
        return False
    Stages(block).stiffest[0] = found
    return True
