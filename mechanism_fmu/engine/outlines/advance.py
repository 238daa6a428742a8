"""When two outlines may meet within a step: looks as far apart as their distance and speed allow.

The distance of two outlines changes by no more than the fastest of their points moves against the other body. So from a
look at which it is s, nothing happens for s/L, with L a bound of that speed over the whole step, which the coefficients
of the dense output give: no meeting is jumped over (Mirtich, Impulse-based dynamic simulation, 1996). Only where s/L
has become less than `FINEST` of the step, the next look is that far away: who grazes a corner by less than half of what
L covers meanwhile may not be seen.

With P the place of one outline that is nearest to the other, and n the normal there, s' = n.v(P), v the velocity of one
body's material against the other's: that of the place opposite differs by a turn about P, which is across n. So L is
that of the circle around one outline,

    L = max |v(C)| + R max |u_i - u_j|,    v(C) = r_i' + u_i E a - r_j' - u_j E b,

C its centre, R its radius, a and b from the bodies' origins to C, u the angular speeds and E the quarter turn. What
moves along with the other hardly moves against it, however fast both are.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.method import METHOD
from ...tables.motion import Pose, Stages
from ...tables.parts import Contacts, Outlines
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_apart, keep_small

#: Looks are no closer than this, in parts of a step.
FINEST = 1.0 / 512.0
_ROWS = METHOD.dense_rows
#: Largest slope in 0..1 of what the dense output's coefficients beyond the cubic's multiply.
_SLOPE = 0.2


@jit
def fastest(block: Array, at: Pose, contact: int) -> float:
    """A bound of how fast two outlines meet over the step in `new_dense`, which begins at `at` [m per step]."""
    keep_apart()
    table = Contacts(block)
    outlines = Outlines(block)
    i, j = table.body_i[contact], table.body_j[contact]
    one, other = table.outline_i[contact], table.outline_j[contact]
    most = _fastest_of(block, at, i, j, one)
    if outlines.copies[other] == 0:
        most = min(most, _fastest_of(block, at, j, i, other))
    return most


@jit
def _fastest_of(block: Array, at: Pose, i: int, j: int, outline: int) -> float:
    """The bound L that the circle around an outline of body i gives against body j."""
    keep_small()
    data = Outlines(block).data[outline]
    c, s = at.cosine[i], at.sine[i]
    ax = c * data[codes.OUTLINE_X] - s * data[codes.OUTLINE_Y]
    ay = s * data[codes.OUTLINE_X] + c * data[codes.OUTLINE_Y]
    bx = at.x[i] + ax - at.x[j]
    by = at.y[i] + ay - at.y[j]
    own = math.sqrt(ax * ax + ay * ay)
    far = math.sqrt(bx * bx + by * by)
    ui, uj = _begins(block, i, 2), _begins(block, j, 2)
    vx = _begins(block, i, 0) - ui * ay - _begins(block, j, 0) + uj * by
    vy = _begins(block, i, 1) + ui * ax - _begins(block, j, 1) - uj * bx
    # how much of it may change within the step
    moved = speed(block, i, own) + speed(block, j, 0.0)
    bend_i, bend_j = _bends(block, i, 2), _bends(block, j, 2)
    changed = _bends(block, i, 0) + _bends(block, i, 1) + _bends(block, j, 0) + _bends(block, j, 1)
    changed += bend_i * own + turn(block, i) * turn(block, i) * own
    changed += bend_j * (far + moved) + turn(block, j) * moved
    turns = data[codes.OUTLINE_RADIUS] * (abs(ui - uj) + bend_i + bend_j)
    most: float = math.sqrt(vx * vx + vy * vy) + changed + turns
    return most


@jit
def _begins(block: Array, body: int, which: int) -> float:
    """How fast a coordinate of a body changes where the step begins [per step]."""
    if body == Sizes(block).bodies:
        return 0.0
    dense = Stages(block).new_dense
    rate: float = dense[1, 3 * body + which] + dense[2, 3 * body + which]
    return rate


@jit
def _bends(block: Array, body: int, which: int) -> float:
    """A bound of how much that changes within the step [per step]."""
    keep_small()
    if body == Sizes(block).bodies:
        return 0.0
    unknown = 3 * body + which
    dense = Stages(block).new_dense
    found: float = 2.0 * abs(dense[2, unknown]) + abs(dense[3, unknown])
    for row in range(4, _ROWS):
        found += _SLOPE * abs(dense[row, unknown])
    return found


@jit
def speed(block: Array, body: int, reach: float) -> float:
    """A bound of the speed of points of a body that are no farther from its origin than `reach` [m per step]."""
    keep_small()
    if body == Sizes(block).bodies:
        return 0.0
    dx = _slope(block, 3 * body)
    dy = _slope(block, 3 * body + 1)
    return math.sqrt(dx * dx + dy * dy) + reach * _slope(block, 3 * body + 2)


@jit
def turn(block: Array, body: int) -> float:
    """A bound of the angular speed of a body [rad per step]."""
    if body == Sizes(block).bodies:
        return 0.0
    return _slope(block, 3 * body + 2)


@jit
def _slope(block: Array, unknown: int) -> float:
    """A bound of how fast an unknown changes within the step [per step]."""
    keep_small()
    dense = Stages(block).new_dense
    found: float = abs(dense[1, unknown]) + abs(dense[2, unknown]) + abs(dense[3, unknown])
    for row in range(4, _ROWS):
        found += _SLOPE * abs(dense[row, unknown])
    return found
