"""Revolute-revolute composite: Phi = d.d - C^2 with d = r_j^P - r_i^P, one row."""

from __future__ import annotations

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small


@jit
def distance(at: Pose, rows: Rows, row: int, i: int, j: int, data: Array) -> None:
    """Write the row of a massless rod with `data` = (point_i, point_j, C)."""
    keep_small()
    distance_squared(at, rows, row, i, j, data)
    rows.residual[row] -= data[4] * data[4]


@jit
def distance_squared(at: Pose, rows: Rows, row: int, i: int, j: int, data: Array) -> None:
    """Write d.d with `data` = (point_i, point_j).

    With a = A_i s_i and b = A_j s_j: d = r_j + b - r_i - a, Phi_q = 2 [-d, -d.R a, d, d.R b], nu = 0,
    gamma = -2 d'.d' - 2 d.(a phi_i'^2 - b phi_j'^2).
    """
    keep_small()
    ax = at.cosine[i] * data[0] - at.sine[i] * data[1]
    ay = at.sine[i] * data[0] + at.cosine[i] * data[1]
    bx = at.cosine[j] * data[2] - at.sine[j] * data[3]
    by = at.sine[j] * data[2] + at.cosine[j] * data[3]
    ui, uj = at.phi_rate[i], at.phi_rate[j]
    dx = at.x[j] + bx - at.x[i] - ax
    dy = at.y[j] + by - at.y[i] - ay
    dx_rate = at.x_rate[j] - by * uj - at.x_rate[i] + ay * ui
    dy_rate = at.y_rate[j] + bx * uj - at.y_rate[i] - ax * ui
    rows.residual[row] = dx * dx + dy * dy
    rows.residual_rate[row] = 2.0 * (dx * dx_rate + dy * dy_rate)
    rows.gamma[row] = -2.0 * (
        dx_rate * dx_rate + dy_rate * dy_rate + (dx * ax + dy * ay) * ui * ui - (dx * bx + dy * by) * uj * uj
    )
    line = rows.jacobian[row]
    line[3 * i] = -2.0 * dx
    line[3 * i + 1] = -2.0 * dy
    line[3 * i + 2] = 2.0 * (dx * ay - dy * ax)
    line[3 * j] = 2.0 * dx
    line[3 * j + 1] = 2.0 * dy
    line[3 * j + 2] = 2.0 * (dy * bx - dx * by)
