"""A row that several joints share: the distance of two points along a vector fixed in a body."""

from __future__ import annotations

from ...tables.motion import Pose, Rows
from ..compiler.subset import jit, keep_small


@jit
def along(
    at: Pose,
    rows: Rows,
    row: int,
    i: int,
    j: int,
    si_x: float,
    si_y: float,
    sj_x: float,
    sj_y: float,
    axis_x: float,
    axis_y: float,
) -> None:
    """Write w.d, with w = A_i axis and d = r_j + b - r_i - a from point s_i of body i to point s_j of body j.

    With a = A_i s_i, b = A_j s_j, u = phi_i': Phi_q = [-w, (R w).d - w.R a, w, w.R b],
    Phi' = w.d' + u (R w).d, gamma = w.d u^2 - 2 u (R w).d' - w.(a u^2 - b phi_j'^2).
    """
    keep_small()
    ci, si, cj, sj = at.cosine[i], at.sine[i], at.cosine[j], at.sine[j]
    ax, ay = ci * si_x - si * si_y, si * si_x + ci * si_y
    bx, by = cj * sj_x - sj * sj_y, sj * sj_x + cj * sj_y
    wx, wy = ci * axis_x - si * axis_y, si * axis_x + ci * axis_y
    ui, uj = at.phi_rate[i], at.phi_rate[j]
    dx = at.x[j] + bx - at.x[i] - ax
    dy = at.y[j] + by - at.y[i] - ay
    dx_rate = at.x_rate[j] - by * uj - at.x_rate[i] + ay * ui
    dy_rate = at.y_rate[j] + bx * uj - at.y_rate[i] - ax * ui
    distance = wx * dx + wy * dy
    across = wx * dy - wy * dx
    rows.residual[row] = distance
    rows.residual_rate[row] = wx * dx_rate + wy * dy_rate + across * ui
    rows.gamma[row] = (
        distance * ui * ui
        - 2.0 * (wx * dy_rate - wy * dx_rate) * ui
        - (wx * ax + wy * ay) * ui * ui
        + (wx * bx + wy * by) * uj * uj
    )
    line = rows.jacobian[row]
    line[3 * i] = -wx
    line[3 * i + 1] = -wy
    line[3 * i + 2] = across - (wy * ax - wx * ay)
    line[3 * j] = wx
    line[3 * j + 1] = wy
    line[3 * j + 2] = wy * bx - wx * by
