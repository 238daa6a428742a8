"""What outputs read of joints with play: where the pin is in its hole, and what its sliding has worn.

Arguments are those of `outputs.Reading.value`.
"""

from __future__ import annotations

import math

from ...tables.declare import Array
from ...tables.motion import Pose, Stages
from ...tables.parts import Contacts
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..elementary import atan2

# contact_data columns
_PIN_X, _PIN_Y, _START_X, _START_Y, _WAY_X, _WAY_Y = range(6)


@jit
def _off_middle(block: Array, at: Pose, index: int) -> tuple[float, float]:
    """From the nearest point of the middle of the hole to the pin's centre, in the frame of body j [m]."""
    keep_small()
    table = Contacts(block)
    i, j = table.body_i[index], table.body_j[index]
    data = table.data[index]
    c, s = at.cosine[i], at.sine[i]
    dx = at.x[i] + c * data[_PIN_X] - s * data[_PIN_Y] - at.x[j]
    dy = at.y[i] + s * data[_PIN_X] + c * data[_PIN_Y] - at.y[j]
    c, s = at.cosine[j], at.sine[j]
    x = c * dx + s * dy - data[_START_X]
    y = c * dy - s * dx - data[_START_Y]
    square = data[_WAY_X] * data[_WAY_X] + data[_WAY_Y] * data[_WAY_Y]
    if square > 0.0:
        part = min(1.0, max(0.0, (x * data[_WAY_X] + y * data[_WAY_Y]) / square))
        x -= part * data[_WAY_X]
        y -= part * data[_WAY_Y]
    return x, y


@jit
def eccentricity(block: Array, at: Pose, index: int, _slot: int, value: float) -> float:
    """Distance from the middle, times `value`, which is 1 over the clearance [1]."""
    x, y = _off_middle(block, at, index)
    return value * math.sqrt(x * x + y * y)


@jit
def contact_angle(block: Array, at: Pose, index: int, _slot: int, _value: float) -> float:
    """Direction of the pin's centre from the middle in the frame of body j [rad], -pi..pi; 0 in the middle."""
    x, y = _off_middle(block, at, index)
    if x == 0.0 and y == 0.0:
        return 0.0
    return float(atan2(y, x))


@jit
def sliding_work(block: Array, _at: Pose, index: int, _slot: int, value: float) -> float:
    """Work of sliding since the start, times `value` [J, or m3 by a coefficient of wear]."""
    return float(value * Stages(block).y_at[Sizes(block).y_wear + Contacts(block).wear[index]])


@jit
def sliding_power(block: Array, _at: Pose, index: int, _slot: int, value: float) -> float:
    """The derivative of `sliding_work`."""
    return float(value * Stages(block).dy_at[Sizes(block).y_wear + Contacts(block).wear[index]])
