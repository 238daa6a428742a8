"""Revolute joint: Phi = r_i^P - r_j^P, two rows."""

from __future__ import annotations

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small


@jit
def revolute(at: Pose, rows: Rows, row: int, i: int, j: int, data: Array) -> None:
    """Write the two rows of a pin at `data` = (point_i, point_j).

    With a = A_i s_i and b = A_j s_j: Phi = r_i + a - r_j - b, Phi_q = [1, R a, -1, -R b], nu = 0,
    gamma = a phi_i'^2 - b phi_j'^2.
    """
    keep_small()
    ax = at.cosine[i] * data[0] - at.sine[i] * data[1]
    ay = at.sine[i] * data[0] + at.cosine[i] * data[1]
    bx = at.cosine[j] * data[2] - at.sine[j] * data[3]
    by = at.sine[j] * data[2] + at.cosine[j] * data[3]
    wi = at.phi_rate[i]
    wj = at.phi_rate[j]
    rows.residual[row] = at.x[i] + ax - at.x[j] - bx
    rows.residual[row + 1] = at.y[i] + ay - at.y[j] - by
    rows.residual_rate[row] = at.x_rate[i] - ay * wi - at.x_rate[j] + by * wj
    rows.residual_rate[row + 1] = at.y_rate[i] + ax * wi - at.y_rate[j] - bx * wj
    rows.gamma[row] = ax * wi * wi - bx * wj * wj
    rows.gamma[row + 1] = ay * wi * wi - by * wj * wj
    first = rows.jacobian[row]
    second = rows.jacobian[row + 1]
    first[3 * i] = 1.0
    first[3 * i + 2] = -ay
    second[3 * i + 1] = 1.0
    second[3 * i + 2] = ax
    first[3 * j] = -1.0
    first[3 * j + 2] = by
    second[3 * j + 1] = -1.0
    second[3 * j + 2] = -bx
