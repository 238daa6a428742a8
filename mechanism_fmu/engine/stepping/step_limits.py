"""How far a step may go, however accurate it is: to where slopes of inputs end, and not over what a driver does.

Nobody knows an input beyond the end of its slope. A mechanism at rest needs no step at all: it would stride over a
short motion of a driver without noticing, since none of its stages falls into it.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course
from ...tables.parts import Curves, Joints
from ..compiler.subset import jit, keep_small
from ..profiles.curves import quarter_wave

#: A step that comes so near to the end of a slope or of a piece goes there.
_NEARLY = 0.99


@jit
def within_ramp(block: Array, start: float, step: float) -> float:
    """The step, or what is left until slopes of inputs end."""
    now = Course(block)
    left: float = now.clock[codes.RAMP_END] - start
    if now.counters[codes.RAMPING] != 0 and step > _NEARLY * left:
        return left
    return step


@jit
def within_motions(block: Array, start: float, step: float) -> float:
    """The step, or what is left of it to the next piece of a driver's motion, or to a quarter of its wave [s]."""
    keep_small()
    table = Joints(block)
    for k in range(table.kind.shape[0]):
        if table.curve[k] != codes.NONE:
            step = _within_motion(block, table.curve[k], start, step)
    return step


@jit
def _within_motion(block: Array, number: int, start: float, step: float) -> float:
    """The step, or what is left of it to the next piece of one curve, or to a quarter of its wave [s]."""
    keep_small()
    table = Curves(block)
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
    return min(step, quarter_wave(block, here))
