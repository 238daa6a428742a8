"""Constraint rows of gears, and of rack and pinion."""

from __future__ import annotations

import math

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small
from ...elementary import sine_cosine
from ...profiles.shape import along
from ...vectors import turned

# Gears: Phi = d.n, the line of centres d = r_j^P - r_i^P stands at the angle that the gears ask for, one row.


@jit
def gears(at: Pose, rows: Rows, row: int, i: int, j: int, data: Array) -> None:
    """Write the row of two external gears: th = (R_i (phi_i + th_i) + R_j (phi_j + th_j - pi)) / (R_i + R_j)."""
    keep_small()
    _gears(at, rows, row, i, j, data, data[6], math.pi)


@jit
def internal_gears(at: Pose, rows: Rows, row: int, i: int, j: int, data: Array) -> None:
    """Write the row of a ring i and a gear j: th = (R_i (phi_i + th_i) - R_j (phi_j + th_j)) / (R_i - R_j)."""
    keep_small()
    _gears(at, rows, row, i, j, data, -data[6], 0.0)


@jit
def _gears(at: Pose, rows: Rows, row: int, i: int, j: int, data: Array, radius_j: float, behind: float) -> None:
    """Write the row with `data` = (point_i, point_j, R_i, th_i, R_j, th_j) and R_j with its sign.

    With a = A_i s_i, b = A_j s_j, t = (cos th, sin th), n = R t, th' = k_i phi_i' + k_j phi_j':
    Phi_q = [-n, -n.R a - k_i t.d, n, n.R b - k_j t.d], Phi' = n.d' - th' t.d, nu = 0,
    gamma = n.d th'^2 + 2 t.d' th' - n.(a phi_i'^2 - b phi_j'^2).
    """
    keep_small()
    ax, ay = turned(at, i, data[0], data[1])
    bx, by = turned(at, j, data[2], data[3])
    ui, uj = at.phi_rate[i], at.phi_rate[j]
    part_i = data[4] / (data[4] + radius_j)
    part_j = radius_j / (data[4] + radius_j)
    theta = part_i * (at.phi[i] + data[5]) + part_j * (at.phi[j] + data[7] - behind)
    turn = part_i * ui + part_j * uj
    ty, tx = sine_cosine(theta)
    nx, ny = -ty, tx
    dx = at.x[j] + bx - at.x[i] - ax
    dy = at.y[j] + by - at.y[i] - ay
    dx_rate = at.x_rate[j] - by * uj - at.x_rate[i] + ay * ui
    dy_rate = at.y_rate[j] + bx * uj - at.y_rate[i] - ax * ui
    apart = tx * dx + ty * dy
    rows.residual[row] = nx * dx + ny * dy
    rows.residual_rate[row] = nx * dx_rate + ny * dy_rate - turn * apart
    rows.gamma[row] = (
        (nx * dx + ny * dy) * turn * turn
        + 2.0 * (tx * dx_rate + ty * dy_rate) * turn
        - (nx * ax + ny * ay) * ui * ui
        + (nx * bx + ny * by) * uj * uj
    )
    line = rows.jacobian[row]
    line[3 * i] = -nx
    line[3 * i + 1] = -ny
    line[3 * i + 2] = nx * ay - ny * ax - part_i * apart
    line[3 * j] = nx
    line[3 * j + 1] = ny
    line[3 * j + 2] = ny * bx - nx * by - part_j * apart


# Rack i and pinion j: Phi = (n.(r_j^P - r_i^P) - R_j, u.(r_j^P - r_i^Q) + R_j (relative angle)), two rows.


@jit
def rack_and_pinion(at: Pose, rows: Rows, row: int, i: int, j: int, data: Array) -> None:
    """Write the two rows with `data` = (point_i P, origin_i Q, theta_u, point_j, R_j, theta_j).

    With u = A_i (cos theta_u, sin theta_u) along the rack and n = R u towards the pinion, both rows are those of
    `along`; the angle phi_j + theta_j - phi_i - theta_u + pi/2 adds [0, 0, -R_j, 0, 0, R_j] to Phi_q. nu = 0.
    """
    keep_small()
    uy, ux = sine_cosine(data[4])
    radius = data[7]
    along(at, rows, row, i, j, data[0], data[1], data[5], data[6], -uy, ux)
    rows.residual[row] -= radius
    row += 1
    along(at, rows, row, i, j, data[2], data[3], data[5], data[6], ux, uy)
    rows.residual[row] += radius * (at.phi[j] + data[8] - at.phi[i] - data[4] + 0.5 * math.pi)
    rows.residual_rate[row] += radius * (at.phi_rate[j] - at.phi_rate[i])
    rows.jacobian[row, 3 * i + 2] -= radius
    rows.jacobian[row, 3 * j + 2] += radius
