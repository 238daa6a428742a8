"""Steps that do not pass over what a driver does.

A mechanism at rest needs no step at all: it would stride over a short motion without noticing, since none of its stages
falls into it.
"""

from __future__ import annotations

import math

from .. import codes
from .room import Array
from .subset import jit, keep_small
from .views import curves, joints

#: A step that comes so near to the end of a piece goes there.
_NEARLY = 0.99


@jit
def within_motions(block: Array, start: float, step: float) -> float:
    """The step, or what is left of it to the next piece of a driver's motion, or to a quarter of its wave [s]."""
    keep_small()
    table = joints(block)
    for k in range(table.kind.shape[0]):
        if table.curve[k] != codes.NONE:
            step = _within(block, table.curve[k], start, step)
    return step


@jit
def _within(block: Array, number: int, start: float, step: float) -> float:
    keep_small()
    table = curves(block)
    first = table.piece[number]
    after = first + table.pieces[number]
    turns = 0.0
    if table.periodic[number] == 1:
        turns = math.floor((start - table.range[number, 0]) / table.range[number, 1]) * table.range[number, 1]
    for p in range(first, after):
        left = table.piece_start[p] + turns - start
        if left <= 0.0 and table.periodic[number] == 1:
            left += table.range[number, 1]
        if left > 0.0 and _NEARLY * left < step:
            step = left
    here = first
    while here + 1 < after and table.piece_start[here + 1] + turns <= start:
        here += 1
    for t in range(table.piece_term[here], table.piece_term[here] + table.piece_terms[here]):
        frequency = abs(table.term[t, codes.FREQUENCY])
        if table.term[t, codes.AMPLITUDE] != 0.0 and frequency > 0.0:
            step = min(step, 0.5 * math.pi / frequency)
    return step
