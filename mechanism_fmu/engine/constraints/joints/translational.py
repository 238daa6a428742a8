"""Translational joint: Phi = ((R v_i).d, (R v_i).v_j) with d = r_j^P - r_i^P, two rows."""

from __future__ import annotations

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small


@jit
def translational(at: Pose, rows: Rows, row: int, i: int, j: int, data: Array) -> None:
    """Write the two rows of a slider with `data` = (point_i, point_j, axis_i, axis_j).

    With v = A_i v_i, n = R v, w = A_j v_j, a = A_i s_i, b = A_j s_j, d = r_j + b - r_i - a and its rate d', u = phi_i':
    Phi_1 = n.d, Phi_1,q = [-n, -v.d - n.Ra, n, n.Rb], gamma_1 = n.d u^2 + 2 v.d' u - n.(a u^2 - b phi_j'^2);
    Phi_2 = n.w, Phi_2,q = [0, -v.w, 0, n.Rw], gamma_2 = n.w (u - phi_j')^2; nu = 0.
    """
    keep_small()
    ci, si, cj, sj = at.cosine[i], at.sine[i], at.cosine[j], at.sine[j]
    ax, ay = ci * data[0] - si * data[1], si * data[0] + ci * data[1]
    bx, by = cj * data[2] - sj * data[3], sj * data[2] + cj * data[3]
    vx, vy = ci * data[4] - si * data[5], si * data[4] + ci * data[5]
    wx, wy = cj * data[6] - sj * data[7], sj * data[6] + cj * data[7]
    nx, ny = -vy, vx
    ui, uj = at.phi_rate[i], at.phi_rate[j]
    dx = at.x[j] + bx - at.x[i] - ax
    dy = at.y[j] + by - at.y[i] - ay
    dx_rate = at.x_rate[j] - by * uj - at.x_rate[i] + ay * ui
    dy_rate = at.y_rate[j] + bx * uj - at.y_rate[i] - ax * ui
    slide = vx * dx + vy * dy
    turn = vx * wx + vy * wy
    rows.residual[row] = nx * dx + ny * dy
    rows.residual[row + 1] = nx * wx + ny * wy
    rows.residual_rate[row] = nx * dx_rate + ny * dy_rate - slide * ui
    rows.residual_rate[row + 1] = turn * (uj - ui)
    rows.gamma[row] = (
        (nx * dx + ny * dy) * ui * ui
        + 2.0 * (vx * dx_rate + vy * dy_rate) * ui
        - (nx * ax + ny * ay) * ui * ui
        + (nx * bx + ny * by) * uj * uj
    )
    rows.gamma[row + 1] = (nx * wx + ny * wy) * (ui - uj) * (ui - uj)
    first = rows.jacobian[row]
    first[3 * i] = -nx
    first[3 * i + 1] = -ny
    first[3 * i + 2] = -slide - (ny * ax - nx * ay)
    first[3 * j] = nx
    first[3 * j + 1] = ny
    first[3 * j + 2] = ny * bx - nx * by
    second = rows.jacobian[row + 1]
    second[3 * i + 2] = -turn
    second[3 * j + 2] = turn
