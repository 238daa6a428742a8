"""Row of two outlines where two of their features touch: a disc against a disc, outside or in it, or against a line.

Every feature but a segment is a disc: a corner of radius 0, an arc of its own, negative where it is hollow. With
C = r + a the centres of two discs, D = C_i - C_j, d = |D|, and k = -1 where one is hollow, else 1:

    N = k D/d, s = k d - R_i - R_j, s_q = [N, N.Ea, -N, -N.Eb], s' = N.D',
    gamma = N.a u_i^2 - N.b u_j^2 - k (D'^2 - (N.D')^2)/d.

Against a segment of body j through Q = r_j + b with normal N: s = N.(C_i - Q) - R_i, the row of a point against a line.
The contact slides by the difference of the materials' velocities at C_i - R_i N along t = -E N, E the quarter turn.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Pose, Rows
from ...tables.parts import Contacts, Features, Outlines
from ..compiler.subset import jit, keep_apart, keep_small
from ..outlines.features import CORNERS_TOUCH, FAR, radius_of, turning_of_copy
from ..scales import length_scale
from .entries import begin_row


@jit
def turning_of(block: Array, at: Pose, body: int, outline: int, copy: int) -> tuple[float, float]:
    """Cosine and sine of the angle of a copy of an outline."""
    keep_small()
    c, s = at.cosine[body], at.sine[body]
    if copy == 0:
        return c, s
    st, ct = turning_of_copy(block, outline, copy)
    return c * ct - s * st, s * ct + c * st


@jit
def place_feature(
    block: Array, at: Pose, body: int, outline: int, copy: int, feature: int
) -> tuple[float, float, float, float]:
    """A feature's point from the origin of its body [m], and its direction, in the global frame."""
    keep_apart()
    data = Features(block).data[feature]
    of = Outlines(block).data[outline]
    c, s = turning_of(block, at, body, outline, copy)
    x = data[codes.FEATURE_X] + copy * of[codes.OUTLINE_DX]
    y = data[codes.FEATURE_Y] + copy * of[codes.OUTLINE_DY]
    dx, dy = data[codes.FEATURE_DX], data[codes.FEATURE_DY]
    return c * x - s * y, s * x + c * y, c * dx - s * dy, s * dx + c * dy


@jit
def outline_row(block: Array, at: Pose, contact: int, row: int, slides: bool) -> None:
    """Write the row of the gap of a bound contact of outlines, or the one along which it slides."""
    keep_apart()
    table = Contacts(block)
    i, j = table.body_i[contact], table.body_j[contact]
    f, g = table.feature_i[contact], table.feature_j[contact]
    if f == codes.NONE or g == codes.NONE:  # it is bound to nothing
        begin_row(Rows(block), row, i, j)
        Rows(block).residual[row] = FAR
        Rows(block).residual_rate[row] = 0.0
        Rows(block).gamma[row] = 0.0
        return
    ax, ay, tx, ty = place_feature(block, at, i, table.outline_i[contact], 0, f)
    bx, by, vx, vy = place_feature(block, at, j, table.outline_j[contact], table.copy[contact], g)
    begin_row(Rows(block), row, i, j)
    if Features(block).kind[g] == codes.SEGMENT:
        _disc_on_line(block, at, row, slides, i, j, ax, ay, radius_of(block, f), bx, by, vy, -vx)
    elif Features(block).kind[f] == codes.SEGMENT:
        _disc_on_line(block, at, row, slides, j, i, bx, by, radius_of(block, g), ax, ay, ty, -tx)
    else:
        other = radius_of(block, g)
        if Features(block).kind[f] == codes.VERTEX and Features(block).kind[g] == codes.VERTEX:
            other = CORNERS_TOUCH * length_scale(block)
        _disc_on_disc(block, at, row, slides, i, j, ax, ay, radius_of(block, f), bx, by, other)


@jit
def _disc_on_line(
    block: Array,
    at: Pose,
    row: int,
    slides: bool,
    i: int,
    j: int,
    ax: float,
    ay: float,
    radius: float,
    bx: float,
    by: float,
    nx: float,
    ny: float,
) -> None:
    """A disc of body i, centre a, on a line of body j through b with the normal n; see `point_line`."""
    keep_apart()
    out = Rows(block)
    entry = out.jacobian[row]
    ui, uj = at.phi_rate[i], at.phi_rate[j]
    ex = at.x[i] + ax - at.x[j]
    ey = at.y[i] + ay - at.y[j]
    ex_rate = at.x_rate[i] - ay * ui - at.x_rate[j]
    ey_rate = at.y_rate[i] + ax * ui - at.y_rate[j]
    lever = 0.0
    if slides:
        nx, ny = ny, -nx
        lever = radius
    along = nx * ey - ny * ex
    out.residual[row] = 0.0 if slides else nx * (ex - bx) + ny * (ey - by) - radius
    out.residual_rate[row] = nx * ex_rate + ny * ey_rate + uj * along + lever * (ui - uj)
    out.gamma[row] = (
        (nx * ax + ny * ay) * ui * ui + (nx * ex + ny * ey) * uj * uj - 2.0 * uj * (nx * ey_rate - ny * ex_rate)
    )
    entry[3 * i] = nx
    entry[3 * i + 1] = ny
    entry[3 * i + 2] = ny * ax - nx * ay + lever
    entry[3 * j] = -nx
    entry[3 * j + 1] = -ny
    entry[3 * j + 2] = along - lever


@jit
def _disc_on_disc(
    block: Array,
    at: Pose,
    row: int,
    slides: bool,
    i: int,
    j: int,
    ax: float,
    ay: float,
    radius: float,
    bx: float,
    by: float,
    other: float,
) -> None:
    """A disc of body i, centre a, on one of body j, centre b; see the head of this file."""
    keep_apart()
    out = Rows(block)
    entry = out.jacobian[row]
    ui, uj = at.phi_rate[i], at.phi_rate[j]
    dx = at.x[i] + ax - at.x[j] - bx
    dy = at.y[i] + ay - at.y[j] - by
    dx_rate = at.x_rate[i] - ay * ui - at.x_rate[j] + by * uj
    dy_rate = at.y_rate[i] + ax * ui - at.y_rate[j] - bx * uj
    distance = math.sqrt(dx * dx + dy * dy)
    side = 1.0
    if radius < 0.0 or other < 0.0:
        side = -1.0
    nx, ny = side, 0.0
    turning = 0.0  # of N
    if distance > 0.0:
        nx, ny = side * dx / distance, side * dy / distance
        turning = side * (nx * dy_rate - ny * dx_rate) / distance
    out.residual[row] = side * distance - radius - other
    rate = nx * dx_rate + ny * dy_rate
    ri, rj = 0.0, 0.0
    bend = turning * (nx * dy_rate - ny * dx_rate)
    if slides:
        out.residual[row] = 0.0
        bend = turning * rate
        nx, ny = ny, -nx
        ri, rj = radius, other
        rate = nx * dx_rate + ny * dy_rate + ri * ui + rj * uj
    out.residual_rate[row] = rate
    out.gamma[row] = (nx * ax + ny * ay) * ui * ui - (nx * bx + ny * by) * uj * uj - bend
    entry[3 * i] = nx
    entry[3 * i + 1] = ny
    entry[3 * i + 2] = ny * ax - nx * ay + ri
    entry[3 * j] = -nx
    entry[3 * j + 1] = -ny
    entry[3 * j + 2] = nx * by - ny * bx + rj
