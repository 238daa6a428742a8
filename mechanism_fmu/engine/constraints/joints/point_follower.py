"""Point i on the profile j: Phi = r_i^P - r_j - A_j (s_j + rho_j e), contact coordinate alpha_j, two rows."""

from __future__ import annotations

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small
from ...profiles.profile import Profile, profile_point


@jit
def point_follower(
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
    """Write the two rows with `data` = (point_i, centre_j); alpha_j stands at `first`, its column is `column`.

    With a = A_i s_i, p, g, h of `profile_point` and v = alpha_j': Phi_q = [1, R a, -1, -R p, -g], nu = 0,
    gamma = a phi_i'^2 - p phi_j'^2 + 2 phi_j' v R g + v^2 h.
    """
    keep_small()
    ax = at.cosine[i] * data[0] - at.sine[i] * data[1]
    ay = at.sine[i] * data[0] + at.cosine[i] * data[1]
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
