"""Constraint rows of pins (revolute), slides (translational), rods between two pins, and pins in guides."""

from __future__ import annotations

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small
from ...profiles.shape import along

# Revolute joint: Phi = r_i^P - r_j^P, two rows.


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


# Translational joint: Phi = ((R v_i).d, (R v_i).v_j) with d = r_j^P - r_i^P, two rows.


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


# Revolute-revolute composite: Phi = d.d - C^2 with d = r_j^P - r_i^P, one row.


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


# Revolute-translational composite: Phi = (R u_i).d - c with d = r_j^P - r_i^P, one row.


@jit
def revolute_translational(at: Pose, rows: Rows, row: int, i: int, j: int, data: Array) -> None:
    """Write the row of a pin beside a line, with `data` = (point_i, point_j, R u_i, c); nu = 0, gamma as of `along`."""
    keep_small()
    along(at, rows, row, i, j, data[0], data[1], data[2], data[3], data[4], data[5])
    rows.residual[row] -= data[6]
