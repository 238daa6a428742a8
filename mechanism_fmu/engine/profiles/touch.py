"""Contact geometry of two profiles: points of a profile, and a pair of curves, one in each body.

The pair's contact coordinates say which point of each curve is looked at: C_i = r_i + a on body i, C_j = r_j + b on
body j, a = A_i (s_i + rho_i e(alpha_i)) and b likewise. One of the two curves may be a mere point, or curve j a line.
Profiles run counter-clockwise around their body's material, so that with the unit tangent t of curve j the normal
n = -R t points out of it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Pose
from ...tables.parts import Contacts
from ..compiler.subset import jit, keep_small
from ..elementary import sine_cosine
from ..vectors import turned
from .curves import curve

# A point that moves along the profile of a body, in the global frame.

#: rho and its first three derivatives at a contact coordinate.
Profile = tuple[float, float, float, float]


@jit
def profile_point(
    at: Pose, body: int, centre_x: float, centre_y: float, alpha: float, profile: Profile
) -> tuple[float, float, float, float, float, float, float, float]:
    """P = A (s + rho e) from the body's origin, and its derivatives with respect to alpha, as (p, g, h, k).

    With e = (cos alpha, sin alpha): g = A (rho' e + rho R e) along the profile, h = A ((rho'' - rho) e + 2 rho' R e),
    k = A ((rho''' - 3 rho') e + (3 rho'' - rho) R e).
    """
    keep_small()
    c, s = at.cosine[body], at.sine[body]
    ey, ex = sine_cosine(alpha)
    ex, ey = c * ex - s * ey, s * ex + c * ey  # A e
    rho, rho1, rho2, rho3 = profile
    px = c * centre_x - s * centre_y + rho * ex
    py = s * centre_x + c * centre_y + rho * ey
    gx = rho1 * ex - rho * ey
    gy = rho1 * ey + rho * ex
    hx = (rho2 - rho) * ex - 2.0 * rho1 * ey
    hy = (rho2 - rho) * ey + 2.0 * rho1 * ex
    kx = (rho3 - 3.0 * rho1) * ex - (3.0 * rho2 - rho) * ey
    ky = (rho3 - 3.0 * rho1) * ey + (3.0 * rho2 - rho) * ex
    return px, py, gx, gy, hx, hy, kx, ky


# Where two profiles touch: the geometry of a pair of curves, one in each body.
#
# The pair's contact coordinates say which point of each curve is looked at: C_i = r_i + a on body i, C_j = r_j + b on
# body j, a = A_i (s_i + rho_i e(alpha_i)) and b likewise. One of the two curves may be a mere point, or curve j a line.
# Profiles run counter-clockwise around their body's material, so that with the unit tangent t of curve j the normal
# n = -R t points out of it.


class Touch(NamedTuple):
    """The two curve points of a pair, in the global frame.

    a and b [m]; g = dC_i/dalpha_i and h = its derivative [m] (zero for a point); the unit tangent t of curve j; its
    length |g_j| = |dC_j/dalpha_j| [m] (zero for a line); how fast t turns with alpha_j.
    """

    ax: float
    ay: float
    bx: float
    by: float
    gx: float
    gy: float
    hx: float
    hy: float
    tx: float
    ty: float
    stretch: float
    turn: float


@jit
def look(block: Array, at: Pose, contact: int) -> Touch:
    """The curve points of a contact at the present pose and contact coordinates."""
    keep_small()
    table = Contacts(block)
    data, kind = table.data[contact], table.kind[contact]
    i, j = table.body_i[contact], table.body_j[contact]
    first = table.alpha[contact]
    gx, gy, hx, hy, stretch, turn = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    if kind == codes.POINT_FOLLOWER:
        ax, ay = turned(at, i, data[0], data[1])
    else:
        profile = curve(block, table.curve_i[contact], at.alpha[first])
        ax, ay, gx, gy, hx, hy, _, _ = profile_point(at, i, data[0], data[1], at.alpha[first], profile)
    if kind == codes.CAM_FLAT_FOLLOWER:
        bx, by = turned(at, j, data[2], data[3])
        tx, ty = turned(at, j, -data[4], -data[5])
    else:
        last = first + 1 if kind == codes.CAM_FOLLOWER else first
        alpha = at.alpha[last]
        profile = curve(block, table.curve_j[contact], alpha)
        bx, by, tx, ty, kx, ky, _, _ = profile_point(at, j, data[2], data[3], alpha, profile)
        stretch = math.sqrt(tx * tx + ty * ty)
        tx /= stretch
        ty /= stretch
        turn = (tx * ky - ty * kx) / stretch
    return Touch(ax, ay, bx, by, gx, gy, hx, hy, tx, ty, stretch, turn)


@jit
def change(kind: int, touch: Touch, gap: float, first: float, second: float) -> tuple[float, float, float]:
    """The changes of alpha_i and alpha_j that make up for given amounts of T_1 and T_2, and how well the curves fit.

    T_1 = n.g_i and T_2 = t.(C_i - C_j) vanish where the points are nearest to each other. A point has no T_1, a line
    no T_2. The fit is minus the determinant of T by alpha: positive where the curves bend away from each other, as
    they do where their distance is least.
    """
    keep_small()
    t11 = 1.0
    t12 = 0.0
    t21 = 0.0
    t22 = -1.0
    if kind != codes.POINT_FOLLOWER:
        t11 = touch.ty * touch.hx - touch.tx * touch.hy
    else:
        first = 0.0
    if kind != codes.CAM_FLAT_FOLLOWER:
        t22 = -(touch.turn * gap + touch.stretch)
    else:
        second = 0.0
    if kind == codes.CAM_FOLLOWER:
        t21 = touch.tx * touch.gx + touch.ty * touch.gy
        t12 = touch.turn * t21
    fit = t12 * t21 - t11 * t22
    return (first * t22 - second * t12) / fit, (second * t11 - first * t21) / fit, fit
