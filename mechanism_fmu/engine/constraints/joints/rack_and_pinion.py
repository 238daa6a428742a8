"""Rack i and pinion j: Phi = (n.(r_j^P - r_i^P) - R_j, u.(r_j^P - r_i^Q) + R_j (relative angle)), two rows."""

from __future__ import annotations

import math

from ....tables.declare import Array
from ....tables.motion import Pose, Rows
from ...compiler.subset import jit, keep_small
from ...profiles.along import along


@jit
def rack_and_pinion(at: Pose, rows: Rows, row: int, i: int, j: int, data: Array) -> None:
    """Write the two rows with `data` = (point_i P, origin_i Q, theta_u, point_j, R_j, theta_j).

    With u = A_i (cos theta_u, sin theta_u) along the rack and n = R u towards the pinion, both rows are those of
    `along`; the angle phi_j + theta_j - phi_i - theta_u + pi/2 adds [0, 0, -R_j, 0, 0, R_j] to Phi_q. nu = 0.
    """
    keep_small()
    ux, uy = math.cos(data[4]), math.sin(data[4])
    radius = data[7]
    along(at, rows, row, i, j, data[0], data[1], data[5], data[6], -uy, ux)
    rows.residual[row] -= radius
    row += 1
    along(at, rows, row, i, j, data[2], data[3], data[5], data[6], ux, uy)
    rows.residual[row] += radius * (at.phi[j] + data[8] - at.phi[i] - data[4] + 0.5 * math.pi)
    rows.residual_rate[row] += radius * (at.phi_rate[j] - at.phi_rate[i])
    rows.jacobian[row, 3 * i + 2] -= radius
    rows.jacobian[row, 3 * j + 2] += radius
