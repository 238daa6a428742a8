"""Driver along an axis: Phi = u_i.d - C(t) with d = r_j^P - r_i^P, one row."""

from __future__ import annotations

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small
from ...profiles.along import along
from .follow import follow


@jit
def translational_driver(
    at: Pose, rows: Rows, row: int, i: int, j: int, data: Array, c: float, c_rate: float, c_bend: float
) -> None:
    """Write the row with `data` = (point_i, point_j, u_i): nu = C', gamma as of `along` plus C''."""
    keep_small()
    along(at, rows, row, i, j, data[0], data[1], data[2], data[3], data[4], data[5])
    follow(rows, row, c, c_rate, c_bend)
