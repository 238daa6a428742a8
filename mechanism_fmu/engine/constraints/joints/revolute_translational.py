"""Revolute-translational composite: Phi = (R u_i).d - c with d = r_j^P - r_i^P, one row."""

from __future__ import annotations

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small
from ...profiles.along import along


@jit
def revolute_translational(at: Pose, rows: Rows, row: int, i: int, j: int, data: Array) -> None:
    """Write the row of a pin beside a line, with `data` = (point_i, point_j, R u_i, c); nu = 0, gamma as of `along`."""
    keep_small()
    along(at, rows, row, i, j, data[0], data[1], data[2], data[3], data[4], data[5])
    rows.residual[row] -= data[6]
