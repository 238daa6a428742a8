"""Driver of y: Phi = y_j^P - y_i^P - C(t), one row."""

from __future__ import annotations

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small
from .follow import follow


@jit
def y_driver(
    at: Pose, rows: Rows, row: int, i: int, j: int, data: Array, c: float, c_rate: float, c_bend: float
) -> None:
    """Write the row with `data` = (point_i, point_j).

    With a = A_i s_i and b = A_j s_j: Phi_q = [0, -1, -a_x, 0, 1, b_x], nu = C',
    gamma = -a_y phi_i'^2 + b_y phi_j'^2 + C''.
    """
    keep_small()
    ax = at.cosine[i] * data[0] - at.sine[i] * data[1]
    ay = at.sine[i] * data[0] + at.cosine[i] * data[1]
    bx = at.cosine[j] * data[2] - at.sine[j] * data[3]
    by = at.sine[j] * data[2] + at.cosine[j] * data[3]
    ui, uj = at.phi_rate[i], at.phi_rate[j]
    rows.residual[row] = at.y[j] + by - at.y[i] - ay
    rows.residual_rate[row] = at.y_rate[j] + bx * uj - at.y_rate[i] - ax * ui
    rows.gamma[row] = by * uj * uj - ay * ui * ui
    line = rows.jacobian[row]
    line[3 * i + 1] = -1.0
    line[3 * i + 2] = -ax
    line[3 * j + 1] = 1.0
    line[3 * j + 2] = bx
    follow(rows, row, c, c_rate, c_bend)
