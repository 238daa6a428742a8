"""When two outlines may meet within a step: looks as far apart as their distance and speed allow.

The distance of two outlines changes by no more than the fastest of their points moves against the other body. So from a
look at which it is s, nothing happens for s/L, with L a bound of that speed over the whole step, which the coefficients
of the dense output give: no meeting is jumped over (Mirtich, Impulse-based dynamic simulation, 1996). Only where s/L
has become less than `FINEST` of the step, the next look is that far away: who grazes a corner by less than half of what
L covers meanwhile may not be seen.
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
    """A bound of the speed of points of two outlines against each other over the step in `new_dense` [m per step]."""
    keep_apart()
    table = Contacts(block)
    outlines = Outlines(block)
    i, j = table.body_i[contact], table.body_j[contact]
    one, other = table.outline_i[contact], table.outline_j[contact]
    reach_i = _reach(block, one)
    reach_j = _reach(block, other)
    if outlines.copies[other] > 0 and outlines.data[other, codes.OUTLINE_PITCH] == 0.0:
        # of a row of copies, those near the other outline
        reach_j += math.sqrt((at.x[i] - at.x[j]) ** 2 + (at.y[i] - at.y[j]) ** 2) + reach_i + reach_j
    return _speed(block, i, reach_i) + _speed(block, j, reach_j)


@jit
def _reach(block: Array, outline: int) -> float:
    """How far from the origin of its body an outline reaches at most [m]."""
    data = Outlines(block).data[outline]
    x, y = data[codes.OUTLINE_X], data[codes.OUTLINE_Y]
    reach: float = math.sqrt(x * x + y * y) + data[codes.OUTLINE_RADIUS]
    return reach


@jit
def _speed(block: Array, body: int, reach: float) -> float:
    """A bound of the speed of points of a body [m per step]."""
    keep_small()
    if body == Sizes(block).bodies:
        return 0.0
    dx = _slope(block, 3 * body)
    dy = _slope(block, 3 * body + 1)
    return math.sqrt(dx * dx + dy * dy) + reach * _slope(block, 3 * body + 2)


@jit
def _slope(block: Array, unknown: int) -> float:
    """A bound of how fast an unknown changes within the step [per step]."""
    keep_small()
    dense = Stages(block).new_dense
    found: float = abs(dense[1, unknown]) + abs(dense[2, unknown]) + abs(dense[3, unknown])
    for row in range(4, _ROWS):
        found += _SLOPE * abs(dense[row, unknown])
    return found
