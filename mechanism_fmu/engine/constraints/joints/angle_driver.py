"""Driver of an angle: Phi = phi_j - phi_i - C(t), one row."""

from __future__ import annotations

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small
from .follow import follow


@jit
def angle_driver(
    at: Pose, rows: Rows, row: int, i: int, j: int, data: Array, c: float, c_rate: float, c_bend: float
) -> None:
    """Write the row, which has no `data`: Phi_q = [0, 0, -1, 0, 0, 1], nu = C', gamma = C''."""
    keep_small()
    rows.residual[row] = at.phi[j] - at.phi[i]
    rows.residual_rate[row] = at.phi_rate[j] - at.phi_rate[i]
    rows.gamma[row] = 0.0
    rows.jacobian[row, 3 * i + 2] = -1.0
    rows.jacobian[row, 3 * j + 2] = 1.0
    follow(rows, row, c, c_rate, c_bend)
