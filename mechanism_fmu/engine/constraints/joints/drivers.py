"""Constraint rows of drivers."""

from __future__ import annotations

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small
from ...profiles.shape import along
from .pins_and_slides import distance_squared

# What all drivers share: a quantity follows a motion.


@jit
def follow(rows: Rows, row: int, motion: float, rate: float, bend: float) -> None:
    """Make of the row of a quantity Q(q) that of Q(q) - F(t), given F, F' and F'': nu = F', and gamma grows by F''."""
    keep_small()
    rows.residual[row] -= motion
    rows.residual_rate[row] -= rate
    rows.gamma[row] += bend
    rows.nu[row] = rate


# Driver of x: Phi = x_j^P - x_i^P - C(t), one row.


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


# Driver of y: Phi = y_j^P - y_i^P - C(t), one row.


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


# Driver of an angle: Phi = phi_j - phi_i - C(t), one row.


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


# Driver of a distance: Phi = d.d - C(t)^2 with d = r_j^P - r_i^P, one row.


@jit
def distance_driver(
    at: Pose, rows: Rows, row: int, i: int, j: int, data: Array, c: float, c_rate: float, c_bend: float
) -> None:
    """Write the row with `data` = (point_i, point_j): nu = 2 C C', gamma of the distance plus 2 (C'^2 + C C'')."""
    keep_small()
    distance_squared(at, rows, row, i, j, data)
    follow(rows, row, c * c, 2.0 * c * c_rate, 2.0 * (c_rate * c_rate + c * c_bend))


# Driver along an axis: Phi = u_i.d - C(t) with d = r_j^P - r_i^P, one row.


@jit
def translational_driver(
    at: Pose, rows: Rows, row: int, i: int, j: int, data: Array, c: float, c_rate: float, c_bend: float
) -> None:
    """Write the row with `data` = (point_i, point_j, u_i): nu = C', gamma as of `along` plus C''."""
    keep_small()
    along(at, rows, row, i, j, data[0], data[1], data[2], data[3], data[4], data[5])
    follow(rows, row, c, c_rate, c_bend)
