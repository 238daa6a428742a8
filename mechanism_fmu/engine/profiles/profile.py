"""A point that moves along the profile of a body, in the global frame."""

from __future__ import annotations

import math

from ...tables.motion import Pose
from ..compiler.subset import jit, keep_small

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
    ex, ey = math.cos(alpha), math.sin(alpha)
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
