"""Cam i, flat-faced follower j: Phi = ((R u_j).(r_i^C - r_j^P), (R u_j).g_i), contact coordinate alpha_i, two rows."""

from __future__ import annotations

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small
from ...profiles.profile import Profile, profile_point


@jit
def cam_flat_follower(
    at: Pose,
    rows: Rows,
    row: int,
    i: int,
    j: int,
    data: Array,
    first: int,
    column: int,
    profile: Profile,
) -> None:
    """Write the two rows with `data` = (centre_i, point_j, u_j); alpha_i stands at `first`, its column is `column`.

    With p, g, h, k of `profile_point`, their rates as in `cam_follower`, u = A_j u_j, b = A_j s_j,
    d = r_i + p - r_j - b, w = phi_j': Phi_q = [R u, (R u).R p, -R u, -u.d - (R u).R b, (R u).g] and
    [0, u.g, 0, -u.g, (R u).h], nu = 0; gamma = w^2 (R u).d + 2 w u.d' - (R u).(p'' + w^2 b) and
    w^2 (R u).g + 2 w u.g' - (R u).g''.
    """
    keep_small()
    px, py, gx, gy, hx, hy, kx, ky = profile_point(at, i, data[0], data[1], at.alpha[first], profile)
    cj, sj = at.cosine[j], at.sine[j]
    bx, by = cj * data[2] - sj * data[3], sj * data[2] + cj * data[3]
    ux, uy = cj * data[4] - sj * data[5], sj * data[4] + cj * data[5]
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
