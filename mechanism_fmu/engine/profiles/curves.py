"""Evaluation of curves: profiles of cams and slots, motions of drivers (see `mechanism_fmu.model.curves`)."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.parts import Curves, Joints
from ..compiler.subset import jit, keep_small
from ..elementary import sine_cosine

_DEGREE = codes.AMPLITUDE - codes.POLYNOMIAL - 1


@jit
def curve(block: Array, number: int, x: float) -> tuple[float, float, float, float]:
    """Value and first three derivatives of a curve at x."""
    keep_small()
    table = Curves(block)
    start = table.range[number, 0]
    if table.periodic[number] == 1:
        span = table.range[number, 1]
        x -= math.floor((x - start) / span) * span
    return evaluate_piece(block, piece_at(block, number, x), x)


@jit
def piece_at(block: Array, number: int, x: float) -> int:
    """The last piece of a curve that begins at or before x, else the first one."""
    keep_small()
    table = Curves(block)
    first: int = table.piece[number]
    last = first + table.pieces[number] - 1
    while first < last:
        middle = (first + last + 1) // 2
        if table.piece_start[middle] <= x:
            first = middle
        else:
            last = middle - 1
    return first


@jit
def evaluate_piece(block: Array, first: int, x: float) -> tuple[float, float, float, float]:
    """Value and first three derivatives of one piece of a curve, also beyond its ends."""
    keep_small()
    table = Curves(block)
    x -= table.piece_start[first]
    f0 = f1 = f2 = f3 = 0.0
    begin = table.piece_term[first]
    for t in range(begin, begin + table.piece_terms[first]):
        term = table.term_data[t]
        p0 = p1 = p2 = p3 = 0.0
        for back in range(_DEGREE + 1):  # Horner's scheme, with the derivatives over their factorials
            p3 = p3 * x + p2
            p2 = p2 * x + p1
            p1 = p1 * x + p0
            p0 = p0 * x + term[_DEGREE - back]
        f0 += p0
        f1 += p1
        f2 += 2.0 * p2
        f3 += 6.0 * p3
        amplitude = term[codes.AMPLITUDE]
        if amplitude != 0.0:
            w = term[codes.FREQUENCY]
            sine, cosine = sine_cosine(w * x + term[codes.PHASE])
            sine *= amplitude
            cosine *= amplitude
            f0 += sine
            f1 += w * cosine
            f2 -= w * w * sine
            f3 -= w * w * w * cosine
    return f0, f1, f2, f3


@jit
def sample(block: Array, number: int, k: int, count: int) -> float:
    """The k-th of `count` equidistant places in the range of a profile."""
    table = Curves(block)
    value: float = table.range[number, 0] + table.range[number, 1] * k / count
    return value


@jit
def quarter_wave(block: Array, piece: int) -> float:
    """A quarter of the shortest wave within a piece of a curve, in the unit of its variable; infinite without waves."""
    keep_small()
    table = Curves(block)
    shortest = math.inf
    for t in range(table.piece_term[piece], table.piece_term[piece] + table.piece_terms[piece]):
        frequency = abs(table.term_data[t, codes.FREQUENCY])
        if table.term_data[t, codes.AMPLITUDE] != 0.0 and frequency > 0.0:
            shortest = min(shortest, 0.5 * math.pi / frequency)
    return shortest


# Motions of drivers: pieces and waves over time, which a step must not pass over.

#: A step that comes so near to the end of a piece, or of an input's slope, goes there.
NEARLY = 0.99
#: A piece that is narrower than this part of all is rounding between two.
_NARROW = 1e-9


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
    left = left_to_piece(block, number, start)
    if NEARLY * left < step:
        step = left
    table = Curves(block)
    here = table.piece[number]
    after = here + table.pieces[number]
    turns = _periods_before(block, number, start)
    while here + 1 < after and table.piece_start[here + 1] + turns <= start:
        here += 1
    return min(step, quarter_wave(block, here))


@jit
def left_to_piece(block: Array, number: int, start: float) -> float:
    """How far the next piece of a curve over time is from `start` [s]; infinite behind the last one."""
    keep_small()
    table = Curves(block)
    first = table.piece[number]
    turns = _periods_before(block, number, start)
    nearest = math.inf
    for p in range(first, first + table.pieces[number]):
        left = table.piece_start[p] + turns - start
        if left <= 0.0 and table.periodic[number] == 1:
            left += table.range[number, 1]
        if left > 0.0:
            nearest = min(nearest, left)
    return nearest


@jit
def _periods_before(block: Array, number: int, start: float) -> float:
    """Whole periods of a curve before `start` [s]; none where it has no period."""
    keep_small()
    table = Curves(block)
    turns = 0.0
    if table.periodic[number] == 1:
        turns = math.floor((start - table.range[number, 0]) / table.range[number, 1]) * table.range[number, 1]
    return turns


@jit
def shortest_motion(block: Array) -> float:
    """The shortest piece, period or quarter of a wave of all drivers' motions [s]; infinite where none has any."""
    keep_small()
    joints = Joints(block)
    table = Curves(block)
    shortest = math.inf
    for k in range(joints.kind.shape[0]):
        number = joints.curve[k]
        if number == codes.NONE:
            continue
        first = table.piece[number]
        last = first + table.pieces[number] - 1
        least = _NARROW * (table.piece_start[last] - table.piece_start[first])
        if table.periodic[number] == 1:
            shortest = min(shortest, table.range[number, 1])
        for p in range(first, last):
            width = table.piece_start[p + 1] - table.piece_start[p]
            if width > least:
                shortest = min(shortest, width)
        for p in range(first, last + 1):
            shortest = min(shortest, quarter_wave(block, p))
    return shortest
