"""Constraint rows of higher pairs (cams), with the contact coordinates among the coordinates."""

from __future__ import annotations

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small
from ...profiles.touch import Profile, profile_point
from ...vectors import turned

# Cam and follower: Phi = (r_i^C - r_j^C, (R g_i).g_j) with contact coordinates alpha_i and alpha_j, three rows.


@jit
def cam_follower(
    at: Pose,
    rows: Rows,
    row: int,
    i: int,
    j: int,
    data: Array,
    first: int,
    column: int,
    profile_i: Profile,
    profile_j: Profile,
) -> None:
    """Write the three rows with `data` = (centre_i, centre_j); alpha_i stands at `first`, its column is `column`.

    With p, g, h, k of `profile_point` and v = alpha': p' = phi' R p + v g, g' = phi' R g + v h (without r'), and
    p'' = -phi'^2 p + 2 phi' v R g + v^2 h, g'' = -phi'^2 g + 2 phi' v R h + v^2 k (without accelerations):
    Phi_q = [1, R p_i, -1, -R p_j, g_i, -g_j] and [0, -g_i.g_j, 0, g_i.g_j, (R h_i).g_j, (R g_i).h_j], nu = 0,
    gamma = -(p_i'' - p_j'') and -((R g_i'').g_j + 2 (R g_i').g_j' + (R g_i).g_j'').
    """
    keep_small()
    px, py, gx, gy, hx, hy, kx, ky = profile_point(at, i, data[0], data[1], at.alpha[first], profile_i)
    qx, qy, ex, ey, fx, fy, mx, my = profile_point(at, j, data[2], data[3], at.alpha[first + 1], profile_j)
    ui, uj = at.phi_rate[i], at.phi_rate[j]
    vi, vj = at.alpha_rate[first], at.alpha_rate[first + 1]
    rows.residual[row] = at.x[i] + px - at.x[j] - qx
    rows.residual[row + 1] = at.y[i] + py - at.y[j] - qy
    rows.residual[row + 2] = gx * ey - gy * ex
    gx_rate, gy_rate = vi * hx - ui * gy, vi * hy + ui * gx
    ex_rate, ey_rate = vj * fx - uj * ey, vj * fy + uj * ex
    rows.residual_rate[row] = at.x_rate[i] - ui * py + vi * gx - at.x_rate[j] + uj * qy - vj * ex
    rows.residual_rate[row + 1] = at.y_rate[i] + ui * px + vi * gy - at.y_rate[j] - uj * qx - vj * ey
    rows.residual_rate[row + 2] = gx_rate * ey - gy_rate * ex + gx * ey_rate - gy * ex_rate
    rows.gamma[row] = (ui * ui * px + 2.0 * ui * vi * gy - vi * vi * hx) - (
        uj * uj * qx + 2.0 * uj * vj * ey - vj * vj * fx
    )
    rows.gamma[row + 1] = (ui * ui * py - 2.0 * ui * vi * gx - vi * vi * hy) - (
        uj * uj * qy - 2.0 * uj * vj * ex - vj * vj * fy
    )
    gx_bend = -ui * ui * gx - 2.0 * ui * vi * hy + vi * vi * kx
    gy_bend = -ui * ui * gy + 2.0 * ui * vi * hx + vi * vi * ky
    ex_bend = -uj * uj * ex - 2.0 * uj * vj * fy + vj * vj * mx
    ey_bend = -uj * uj * ey + 2.0 * uj * vj * fx + vj * vj * my
    rows.gamma[row + 2] = -(
        gx_bend * ey - gy_bend * ex + 2.0 * (gx_rate * ey_rate - gy_rate * ex_rate) + gx * ey_bend - gy * ex_bend
    )
    line = rows.jacobian[row]
    line[3 * i] = 1.0
    line[3 * i + 2] = -py
    line[3 * j] = -1.0
    line[3 * j + 2] = qy
    line[column] = gx
    line[column + 1] = -ex
    line = rows.jacobian[row + 1]
    line[3 * i + 1] = 1.0
    line[3 * i + 2] = px
    line[3 * j + 1] = -1.0
    line[3 * j + 2] = -qx
    line[column] = gy
    line[column + 1] = -ey
    line = rows.jacobian[row + 2]
    line[3 * i + 2] = -(gx * ex + gy * ey)
    line[3 * j + 2] = gx * ex + gy * ey
    line[column] = hx * ey - hy * ex
    line[column + 1] = gx * fy - gy * fx


# Cam i, flat-faced follower j: Phi = ((R u_j).(r_i^C - r_j^P), (R u_j).g_i), contact coordinate alpha_i, two rows.


@jit
def cam_flat_follower(
    at: Pose, rows: Rows, row: int, i: int, j: int, data: Array, first: int, column: int, profile: Profile
) -> None:
    """Write the two rows with `data` = (centre_i, point_j, u_j); alpha_i stands at `first`, its column is `column`.

    With p, g, h, k of `profile_point`, their rates as in `cam_follower`, u = A_j u_j, b = A_j s_j,
    d = r_i + p - r_j - b, w = phi_j': Phi_q = [R u, (R u).R p, -R u, -u.d - (R u).R b, (R u).g] and
    [0, u.g, 0, -u.g, (R u).h], nu = 0; gamma = w^2 (R u).d + 2 w u.d' - (R u).(p'' + w^2 b) and
    w^2 (R u).g + 2 w u.g' - (R u).g''.
    """
    keep_small()
    px, py, gx, gy, hx, hy, kx, ky = profile_point(at, i, data[0], data[1], at.alpha[first], profile)
    bx, by = turned(at, j, data[2], data[3])
    ux, uy = turned(at, j, data[4], data[5])
    nx, ny = -uy, ux
    ui, uj = at.phi_rate[i], at.phi_rate[j]
    v = at.alpha_rate[first]
    dx = at.x[i] + px - at.x[j] - bx
    dy = at.y[i] + py - at.y[j] - by
    dx_rate = at.x_rate[i] - ui * py + v * gx - at.x_rate[j] + uj * by
    dy_rate = at.y_rate[i] + ui * px + v * gy - at.y_rate[j] - uj * bx
    gx_rate, gy_rate = v * hx - ui * gy, v * hy + ui * gx
    dx_bend = -ui * ui * px - 2.0 * ui * v * gy + v * v * hx + uj * uj * bx
    dy_bend = -ui * ui * py + 2.0 * ui * v * gx + v * v * hy + uj * uj * by
    gx_bend = -ui * ui * gx - 2.0 * ui * v * hy + v * v * kx
    gy_bend = -ui * ui * gy + 2.0 * ui * v * hx + v * v * ky
    slide = ux * dx + uy * dy
    turn = ux * gx + uy * gy
    rows.residual[row] = nx * dx + ny * dy
    rows.residual[row + 1] = nx * gx + ny * gy
    rows.residual_rate[row] = nx * dx_rate + ny * dy_rate - uj * slide
    rows.residual_rate[row + 1] = nx * gx_rate + ny * gy_rate - uj * turn
    rows.gamma[row] = (
        uj * uj * (nx * dx + ny * dy) + 2.0 * uj * (ux * dx_rate + uy * dy_rate) - (nx * dx_bend + ny * dy_bend)
    )
    rows.gamma[row + 1] = (
        uj * uj * (nx * gx + ny * gy) + 2.0 * uj * (ux * gx_rate + uy * gy_rate) - (nx * gx_bend + ny * gy_bend)
    )
    line = rows.jacobian[row]
    line[3 * i] = nx
    line[3 * i + 1] = ny
    line[3 * i + 2] = ny * px - nx * py
    line[3 * j] = -nx
    line[3 * j + 1] = -ny
    line[3 * j + 2] = nx * by - ny * bx - slide
    line[column] = nx * gx + ny * gy
    line = rows.jacobian[row + 1]
    line[3 * i + 2] = turn
    line[3 * j + 2] = -turn
    line[column] = nx * hx + ny * hy


# Point i on the profile j: Phi = r_i^P - r_j - A_j (s_j + rho_j e), contact coordinate alpha_j, two rows.


@jit
def point_follower(
    at: Pose, rows: Rows, row: int, i: int, j: int, data: Array, first: int, column: int, profile: Profile
) -> None:
    """Write the two rows with `data` = (point_i, centre_j); alpha_j stands at `first`, its column is `column`.

    With a = A_i s_i, p, g, h of `profile_point` and v = alpha_j': Phi_q = [1, R a, -1, -R p, -g], nu = 0,
    gamma = a phi_i'^2 - p phi_j'^2 + 2 phi_j' v R g + v^2 h.
    """
    keep_small()
    ax, ay = turned(at, i, data[0], data[1])
    px, py, gx, gy, hx, hy, _, _ = profile_point(at, j, data[2], data[3], at.alpha[first], profile)
    ui, uj = at.phi_rate[i], at.phi_rate[j]
    v = at.alpha_rate[first]
    rows.residual[row] = at.x[i] + ax - at.x[j] - px
    rows.residual[row + 1] = at.y[i] + ay - at.y[j] - py
    rows.residual_rate[row] = at.x_rate[i] - ay * ui - at.x_rate[j] + py * uj - v * gx
    rows.residual_rate[row + 1] = at.y_rate[i] + ax * ui - at.y_rate[j] - px * uj - v * gy
    rows.gamma[row] = ax * ui * ui - px * uj * uj - 2.0 * uj * v * gy + v * v * hx
    rows.gamma[row + 1] = ay * ui * ui - py * uj * uj + 2.0 * uj * v * gx + v * v * hy
    line = rows.jacobian[row]
    line[3 * i] = 1.0
    line[3 * i + 2] = -ay
    line[3 * j] = -1.0
    line[3 * j + 2] = py
    line[column] = -gx
    line = rows.jacobian[row + 1]
    line[3 * i + 1] = 1.0
    line[3 * i + 2] = ax
    line[3 * j + 1] = -1.0
    line[3 * j + 2] = -px
    line[column] = -gy
