"""Work of sliding, by which outlines in contact wear: normal force times |slip speed|, added up over time (Archard)."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import LinearSystem, Pose, Rows, Strikes
from ...tables.parts import Contacts
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from .friction_rows import rubs, sticks
from .outline_row import outline_row
from .point_line import spare_row


@jit
def wear_by_sliding(block: Array, at: Pose, dy: Array) -> None:
    """Write the power of sliding of each contact that wears [W], by the forces of the last solve."""
    keep_small()
    table = Contacts(block)
    first = Sizes(block).y_wear
    spare = spare_row(block)
    for c in range(table.mode.shape[0]):
        if table.wear[c] != codes.NONE:
            power = 0.0
            if table.mode[c] == codes.CLOSED and not (rubs(block) and sticks(block, c)):
                outline_row(block, at, c, spare, True)
                power = max(0.0, LinearSystem(block).multiplier[table.row[c]]) * abs(Rows(block).residual_rate[spare])
            dy[first + table.wear[c]] = power


@jit
def wear_by_impact(block: Array, at: Pose, y: Array) -> None:
    """Add the work of sliding of an impact [J] to y: impulse times the mean of |slip speed|, which changes evenly.

    `at` are poses and rates after the impact; those before it are `strikes.rates_of_round`.
    """
    keep_small()
    table = Contacts(block)
    first = Sizes(block).y_wear
    spare = spare_row(block)
    for c in range(table.mode.shape[0]):
        if table.wear[c] != codes.NONE and Strikes(block).impulse[c] > 0.0:
            outline_row(block, at, c, spare, True)
            after: float = Rows(block).residual_rate[spare]
            before = 0.0
            for k in range(Sizes(block).coordinates):
                before += Rows(block).jacobian[spare, k] * Strikes(block).rates_of_round[k]
            y[first + table.wear[c]] += Strikes(block).impulse[c] * _mean_size(before, after)


@jit
def _mean_size(a: float, b: float) -> float:
    """The mean of |x| while x goes evenly from a to b."""
    if a * b >= 0.0:
        return 0.5 * (abs(a) + abs(b))
    return 0.5 * (a * a + b * b) / abs(b - a)
