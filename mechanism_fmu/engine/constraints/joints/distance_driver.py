"""Driver of a distance: Phi = d.d - C(t)^2 with d = r_j^P - r_i^P, one row."""

from __future__ import annotations

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small
from .distance import distance_squared
from .follow import follow


@jit
def distance_driver(
    at: Pose, rows: Rows, row: int, i: int, j: int, data: Array, c: float, c_rate: float, c_bend: float
) -> None:
    """Write the row with `data` = (point_i, point_j): nu = 2 C C', gamma of the distance plus 2 (C'^2 + C C'')."""
    keep_small()
    distance_squared(at, rows, row, i, j, data)
    follow(rows, row, c * c, 2.0 * c * c_rate, 2.0 * (c_rate * c_rate + c * c_bend))
