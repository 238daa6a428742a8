"""When two outlines may meet within a step: looks as far apart as their distance and speed allow.

The distance of two outlines changes by no more than the fastest of their points moves against the other body. So from a
look at which it is s, nothing happens for s/L, with L a bound of that speed over the whole step, which the coefficients
of the dense output give: no meeting is jumped over (Mirtich, Impulse-based dynamic simulation, 1996). Only where s/L
has become less than `finest`, the next look is that far away: who grazes a corner by less than half of what L covers
meanwhile may not be seen.

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
from ..vectors import turned

#: Looks are no closer than this, in parts of a step; but where the step is long, than what is covered of the smaller
#: circle around an outline meanwhile: what is not thinner than that is not passed through.
_FINEST, _OF_RADIUS = 1.0 / 512.0, 1.0 / 32.0
_ROWS = METHOD.dense_rows
#: Largest slope in 0..1 of what the dense output's coefficients beyond the cubic's multiply.
_SLOPE = 0.2


@jit
def fastest(block: Array, at: Pose, contact: int) -> float:
    """A bound of how fast two outlines meet over the step in `new_dense`, which begins at `at` [m per step]."""
    keep_apart()
    table = Contacts(block)
    i, j = table.body_i[contact], table.body_j[contact]
    one, other = table.outline_i[contact], table.outline_j[contact]
    most: float = _fastest_of(block, at, i, j, one)
    if Outlines(block).copies[other] == 0:
        most = min(most, _fastest_of(block, at, j, i, other))
    return most


@jit
def finest(block: Array, contact: int, most: float) -> float:
    """How close looks at two outlines are at least, in parts of a step in which they move by `most` at most [m]."""
    keep_small()
    table = Contacts(block)
    data = Outlines(block).data
    one: float = data[table.outline_i[contact], codes.OUTLINE_RADIUS]
    other: float = data[table.outline_j[contact], codes.OUTLINE_RADIUS]
    least = _OF_RADIUS * min(one, other)
    if 0.0 < least < _FINEST * most:
        return least / most
    return _FINEST


@jit
def _fastest_of(block: Array, at: Pose, i: int, j: int, outline: int) -> float:
    """The bound L that the circle around an outline of body i gives against body j."""
    keep_small()
    data = Outlines(block).data[outline]
    ax, ay = turned(at, i, data[codes.OUTLINE_X], data[codes.OUTLINE_Y])
    return float(against(block, at, i, j, ax, ay) + data[codes.OUTLINE_RADIUS] * turns(block, i, j))


@jit
def against(block: Array, at: Pose, i: int, j: int, ax: float, ay: float) -> float:
    """A bound, over the step, of the speed of a point of body i against the material of body j [m per step].

    (ax, ay) leads from the origin of body i to the point, in the global frame.
    """
    keep_apart()
    bx = at.x[i] + ax - at.x[j]
    by = at.y[i] + ay - at.y[j]
    own = math.sqrt(ax * ax + ay * ay)
    far = math.sqrt(bx * bx + by * by)
    ui, uj = _begins(block, i, 2), _begins(block, j, 2)
    vx = _begins(block, i, 0) - ui * ay - _begins(block, j, 0) + uj * by
    vy = _begins(block, i, 1) + ui * ax - _begins(block, j, 1) - uj * bx
    # how much of it may change within the step
    moved = _speed(block, i, own) + _speed(block, j, 0.0)
    turn_i, turn_j = _turn(block, i), _turn(block, j)
    changed = _bends(block, i, 0) + _bends(block, i, 1) + _bends(block, j, 0) + _bends(block, j, 1)
    changed += (_bends(block, i, 2) + turn_i * turn_i) * own
    changed += _bends(block, j, 2) * (far + moved) + turn_j * moved
    most: float = math.sqrt(vx * vx + vy * vy) + changed
    return most


@jit
def turns(block: Array, i: int, j: int) -> float:
    """A bound of how fast two bodies turn against each other [rad per step]."""
    keep_small()
    most: float = abs(_begins(block, i, 2) - _begins(block, j, 2)) + _bends(block, i, 2) + _bends(block, j, 2)
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
def _speed(block: Array, body: int, reach: float) -> float:
    """A bound of the speed of points of a body that are no farther from its origin than `reach` [m per step]."""
    keep_small()
    if body == Sizes(block).bodies:
        return 0.0
    dx = _slope(block, 3 * body)
    dy = _slope(block, 3 * body + 1)
    return math.sqrt(dx * dx + dy * dy) + reach * _slope(block, 3 * body + 2)


@jit
def _turn(block: Array, body: int) -> float:
    """A bound of the angular speed of a body [rad per step]."""
    if body == Sizes(block).bodies:
        return 0.0
    return _slope(block, 3 * body + 2)


@jit
def _slope(block: Array, unknown: int) -> float:
    """A bound of how fast an unknown changes within the step [per step]."""
    keep_apart()
    dense = Stages(block).new_dense
    found: float = abs(dense[1, unknown]) + abs(dense[2, unknown]) + abs(dense[3, unknown])
    for row in range(4, _ROWS):
        found += _SLOPE * abs(dense[row, unknown])
    return found


@jit
def come_nearer(block: Array, most: float) -> None:
    """Coordinates of bodies have been changed by `most` at most: what was known to be apart is so by less."""
    keep_small()
    table = Contacts(block)
    data = Outlines(block).data
    for c in range(table.apart.shape[0]):
        if table.apart[c] > 0.0:
            reach = 0.0
            in_a_row = False
            for side in range(2):
                outline = table.outline_i[c] if side == 0 else table.outline_j[c]
                x, y = data[outline, codes.OUTLINE_X], data[outline, codes.OUTLINE_Y]
                in_a_row = in_a_row or data[outline, codes.OUTLINE_DX] != 0.0 or data[outline, codes.OUTLINE_DY] != 0.0
                reach += math.sqrt(x * x + y * y) + data[outline, codes.OUTLINE_RADIUS]
            table.apart[c] = max(table.apart[c] - most * (4.0 + reach), 0.0)
            if in_a_row:  # which has no end
                table.apart[c] = 0.0
