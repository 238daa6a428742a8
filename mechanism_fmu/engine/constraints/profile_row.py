"""The gap between two profiles, one row (docs/decisions/009-contact-coordinates.md).

s(q) = n.(C_i - C_j) at the contact coordinates alpha(q) at which the two curves are nearest to each other. There
ds/dalpha = 0, so that s_q is that of a point against a line, and the massless alpha are eliminated exactly: only their
rates enter gamma. The textbook's rows of the same pairs are in `joints`; both give the same motion.
"""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Pose, Rows
from ...tables.parts import Contacts
from ..compiler.subset import jit, keep_small
from ..profiles.touch import change, look


@jit
def profile_row(block: Array, at: Pose, contact: int, row: int) -> float:
    """Write the gap, its rate, gamma and Jacobian of a contact, and the rates of its contact coordinates.

    With e = r_i + a - r_j, u = phi_j', n = -R t and the rates at fixed alpha T_1' = (u - phi_i') t.g_i and
    T_2' = t.(e' - u R b) - u s: s' = n.e' + u t.e, T_alpha alpha' = -T', and
    gamma = n.a phi_i'^2 + n.e u^2 - 2 u t.e' - T_1' alpha_i' - w T_2' alpha_j', w the turning of t with alpha_j.

    Returns:
        How well the curves fit (see `touch.change`).

    """
    keep_small()
    table = Contacts(block)
    out = Rows(block)
    i, j = table.body_i[contact], table.body_j[contact]
    kind = table.kind[contact]
    touch = look(block, at, contact)
    tx, ty = touch.tx, touch.ty
    nx, ny = ty, -tx
    ui, uj = at.phi_rate[i], at.phi_rate[j]
    ex = at.x[i] + touch.ax - at.x[j]
    ey = at.y[i] + touch.ay - at.y[j]
    ex_rate = at.x_rate[i] - touch.ay * ui - at.x_rate[j]
    ey_rate = at.y_rate[i] + touch.ax * ui - at.y_rate[j]
    gap = nx * (ex - touch.bx) + ny * (ey - touch.by)
    along = tx * ex + ty * ey
    first = (uj - ui) * (tx * touch.gx + ty * touch.gy)
    second = tx * (ex_rate + uj * touch.by) + ty * (ey_rate - uj * touch.bx) - uj * gap
    move_i, move_j, fit = change(kind, touch, gap, first, second)
    alpha = table.alpha[contact]
    at.alpha_rate[alpha] = move_j if kind == codes.POINT_FOLLOWER else move_i
    if kind == codes.CAM_FOLLOWER:
        at.alpha_rate[alpha + 1] = move_j
    out.residual[row] = gap
    out.residual_rate[row] = nx * ex_rate + ny * ey_rate + uj * along
    out.gamma[row] = (
        (nx * touch.ax + ny * touch.ay) * ui * ui
        + (nx * ex + ny * ey) * uj * uj
        - 2.0 * uj * (tx * ex_rate + ty * ey_rate)
        - first * move_i
        - touch.turn * second * move_j
    )
    entry = out.jacobian[row]
    entry[3 * i] = nx
    entry[3 * i + 1] = ny
    entry[3 * i + 2] = ny * touch.ax - nx * touch.ay
    entry[3 * j] = -nx
    entry[3 * j + 1] = -ny
    entry[3 * j + 2] = along
    return fit


@jit
def slip_row(block: Array, at: Pose, contact: int, row: int) -> None:
    """Write the row of the slip of body i along body j where their profiles touch: the difference of their materials.

    Slip counts along t = -R n, the normal turned by -90 deg, as that of a point on a line. With the relative velocity
    w = r_i' + u_i R a - r_j' - u_j R e and the turning of the tangent w_t = u_j + turn alpha_j': s' = t.w,
    s_q = [t, t.R a, -t, -t.R e], gamma = -w_t (R t).w - t.(u_i R a' - u_j R e'), where a' and e' follow the point of
    contact. There is no s: what has rolled off is not counted.
    """
    keep_small()
    profile_row(block, at, contact, row)
    table = Contacts(block)
    out = Rows(block)
    i = table.body_i[contact]
    j = table.body_j[contact]
    touch = look(block, at, contact)
    tx, ty = -touch.tx, -touch.ty
    ui, uj = at.phi_rate[i], at.phi_rate[j]
    alpha = table.alpha[contact]
    move_i = at.alpha_rate[alpha]
    move_j = 0.0
    if table.kind[contact] == codes.POINT_FOLLOWER:
        move_i = 0.0
        move_j = at.alpha_rate[alpha]
    elif table.kind[contact] == codes.CAM_FOLLOWER:
        move_j = at.alpha_rate[alpha + 1]
    ex = at.x[i] + touch.ax - at.x[j]
    ey = at.y[i] + touch.ay - at.y[j]
    ax_rate = touch.gx * move_i - touch.ay * ui
    ay_rate = touch.gy * move_i + touch.ax * ui
    ex_rate = at.x_rate[i] + ax_rate - at.x_rate[j]
    ey_rate = at.y_rate[i] + ay_rate - at.y_rate[j]
    wx = at.x_rate[i] - ui * touch.ay - at.x_rate[j] + uj * ey
    wy = at.y_rate[i] + ui * touch.ax - at.y_rate[j] - uj * ex
    turning = uj + touch.turn * move_j
    out.residual[row] = 0.0
    out.residual_rate[row] = tx * wx + ty * wy
    out.gamma[row] = -turning * (tx * wy - ty * wx)
    out.gamma[row] -= ui * (ty * ax_rate - tx * ay_rate) - uj * (ty * ex_rate - tx * ey_rate)
    entry = out.jacobian[row]
    entry[3 * i] = tx
    entry[3 * i + 1] = ty
    entry[3 * i + 2] = ty * touch.ax - tx * touch.ay
    entry[3 * j] = -tx
    entry[3 * j + 1] = -ty
    entry[3 * j + 2] = tx * ey - ty * ex
