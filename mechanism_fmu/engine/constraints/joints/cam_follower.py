"""Cam and follower: Phi = (r_i^C - r_j^C, (R g_i).g_j) with contact coordinates alpha_i and alpha_j, three rows."""

from __future__ import annotations

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small
from ...profiles.profile import Profile, profile_point


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
