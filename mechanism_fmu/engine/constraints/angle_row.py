"""The relative angle of two bodies against a given one: one row."""

from __future__ import annotations

from ...tables.declare import Array
from ...tables.motion import Pose, Rows
from ..compiler.subset import jit, keep_small


@jit
def angle_row(at: Pose, rows: Rows, row: int, i: int, j: int, angle: Array) -> None:
    """Write the row s = phi_i - phi_j - angle[0]: s_q = [.., 1, .., -1], s' = phi_i' - phi_j', gamma = 0."""
    keep_small()
    rows.residual[row] = at.phi[i] - at.phi[j] - angle[0]
    rows.residual_rate[row] = at.phi_rate[i] - at.phi_rate[j]
    rows.gamma[row] = 0.0
    rows.jacobian[row, 3 * i + 2] = 1.0
    rows.jacobian[row, 3 * j + 2] = -1.0
