"""Driver of x: Phi = x_j^P - x_i^P - C(t), one row."""

from __future__ import annotations

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small
from .follow import follow


@jit
def x_driver(
    at: Pose, rows: Rows, row: int, i: int, j: int, data: Array, c: float, c_rate: float, c_bend: float
) -> None:
    """Write the row with `data` = (point_i, point_j).

    With a = A_i s_i and b = A_j s_j: Phi_q = [-1, 0, a_y, 1, 0, -b_y], nu = C',
    gamma = -a_x phi_i'^2 + b_x phi_j'^2 + C''.
    """
    keep_small()
    ax = at.cosine[i] * data[0] - at.sine[i] * data[1]
    ay = at.sine[i] * data[0] + at.cosine[i] * data[1]
    bx = at.cosine[j] * data[2] - at.sine[j] * data[3]
    by = at.sine[j] * data[2] + at.cosine[j] * data[3]
    ui, uj = at.phi_rate[i], at.phi_rate[j]
    rows.residual[row] = at.x[j] + bx - at.x[i] - ax
    rows.residual_rate[row] = at.x_rate[j] - by * uj - at.x_rate[i] + ay * ui
    rows.gamma[row] = bx * uj * uj - ax * ui * ui
    line = rows.jacobian[row]
    line[3 * i] = -1.0
    line[3 * i + 2] = ay
    line[3 * j] = 1.0
    line[3 * j + 2] = -by
    follow(rows, row, c, c_rate, c_bend)
