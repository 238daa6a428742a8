"""What all drivers share: a quantity follows a motion."""

from __future__ import annotations

from ....tables.motion import Rows
from ...compiler.subset import jit, keep_small


@jit
def follow(rows: Rows, row: int, motion: float, rate: float, bend: float) -> None:
    """Make of the row of a quantity Q(q) that of Q(q) - F(t), given F, F' and F'': nu = F', and gamma grows by F''."""
    keep_small()
    rows.residual[row] -= motion
    rows.residual_rate[row] -= rate
    rows.gamma[row] += bend
    rows.nu[row] = rate
