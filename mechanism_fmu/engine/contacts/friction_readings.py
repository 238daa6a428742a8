"""What outputs read of friction: slip, force, stick, and accelerations along the normal and the slip of a contact.

Arguments are those of `outputs.Reading.value`.
"""

from __future__ import annotations

from ...tables.declare import Array
from ...tables.motion import Pose, Rows, Rubs, Stages
from ...tables.sizes import Sizes
from ...tolerances import SLIPS_ABOVE
from ..compiler.subset import jit, keep_small
from ..constraints.entries import along_row
from ..constraints.friction_rows import friction_row, meets, sticks, touches
from ..constraints.point_line import spare_row
from ..constraints.rows import contact_row
from ..scales import bodies_of, pair_rate, slip_scale

#: An acceleration below this is none, in the scale of the mechanism.
_AT_REST = 1e-8


@jit
def slip_speed(block: Array, at: Pose, index: int, _slot: int, _value: float) -> float:
    """Slip speed [m/s, rad/s]; 0 while it sticks or is apart."""
    value = 0.0
    if meets(block, index) and not sticks(block, index):
        friction_row(block, at, index, spare_row(block))
        value = Rows(block).residual_rate[spare_row(block)]
    return value


@jit
def friction_force(block: Array, _at: Pose, index: int, _slot: int, _value: float) -> float:
    """Friction along the slip [N, N m]; 0 while it is apart."""
    value = 0.0
    if touches(block, index):
        value = Rubs(block).force[index]
    return value


@jit
def sticks_now(block: Array, at: Pose, index: int, _slot: int, _value: float) -> float:
    """Whether it does not slide; also where friction is at its bound, and others that stick hold it all the same."""
    if sticks(block, index):
        return 1.0
    if not touches(block, index):
        return 0.0
    friction_row(block, at, index, spare_row(block))
    speed = Rows(block).residual_rate[spare_row(block)]
    scale = slip_scale(block, index)
    i, j = bodies_of(block, index)
    rests = abs(speed) <= SLIPS_ABOVE * scale and abs(_along_spare(block)) <= _AT_REST * scale * pair_rate(block, i, j)
    return 1.0 if rests else 0.0


@jit
def _along_spare(block: Array) -> float:
    """The second derivative of the spare row at the accelerations of the last solve."""
    n = Sizes(block).coordinates
    spare = spare_row(block)
    rates = Stages(block).dy_at[n:]
    return float(along_row(Rows(block), spare, rates, Sizes(block).bodies, -Rows(block).gamma[spare]))


@jit
def gap_acceleration(block: Array, at: Pose, index: int, _slot: int, _value: float) -> float:
    """Second derivative of the gap of a contact [m/s2, rad/s2]."""
    keep_small()
    contact_row(block, at, index, spare_row(block))
    return _along_spare(block)


@jit
def slip_acceleration(block: Array, at: Pose, index: int, _slot: int, _value: float) -> float:
    """Derivative of the slip speed [m/s2, rad/s2]."""
    keep_small()
    friction_row(block, at, index, spare_row(block))
    return _along_spare(block)
