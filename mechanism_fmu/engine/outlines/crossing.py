"""Elements of two outlines that cross each other, though no corner of one is inside the other: asked at the start.

In a motion, none can come to do so without a corner or a bulging arc having gone in before.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.parts import Features, Outlines
from ...tolerances import TOUCHES_WITHIN
from ..compiler.subset import jit, keep_apart, keep_small
from ..elementary import atan2


@jit
def crossing(block: Array, one: int, other: int, c: float, s: float, x: float, y: float) -> float:
    """How far elements of two outlines reach across each other [m]; 0 where none does.

    (x, y) and the turning (c, s) take points of the frame of outline `one` to that of the other.
    """
    keep_apart()
    table = Outlines(block)
    kind = Features(block).kind
    deepest = 0.0
    for f in range(table.first[one], table.first[one] + table.count[one]):
        if kind[f] == codes.VERTEX:
            continue
        own = Features(block).data[f]
        px = x + c * own[codes.FEATURE_X] - s * own[codes.FEATURE_Y]
        py = y + s * own[codes.FEATURE_X] + c * own[codes.FEATURE_Y]
        dx = c * own[codes.FEATURE_DX] - s * own[codes.FEATURE_DY]
        dy = s * own[codes.FEATURE_DX] + c * own[codes.FEATURE_DY]
        for g in range(table.first[other], table.first[other] + table.count[other]):
            its = Features(block).data[g]
            qx, qy = its[codes.FEATURE_X], its[codes.FEATURE_Y]
            ex, ey = its[codes.FEATURE_DX], its[codes.FEATURE_DY]
            depth = 0.0
            if kind[g] == codes.SEGMENT and kind[f] == codes.SEGMENT:
                depth = _lines(px, py, dx, dy, own, qx, qy, ex, ey, its)
            elif kind[g] == codes.ARC and kind[f] == codes.SEGMENT:
                depth = _line_and_arc(px, py, dx, dy, own, qx, qy, ex, ey, its)
            elif kind[g] == codes.SEGMENT and kind[f] == codes.ARC:
                depth = _line_and_arc(qx, qy, ex, ey, its, px, py, dx, dy, own)
            elif kind[g] == codes.ARC:
                depth = _arcs(px, py, dx, dy, own, qx, qy, ex, ey, its)
            deepest = max(deepest, depth)
    return deepest


@jit
def _lines(
    px: float, py: float, dx: float, dy: float, own: Array, qx: float, qy: float, ex: float, ey: float, its: Array
) -> float:
    """How far the nearest end of two segments that cross is beyond the other one."""
    keep_small()
    first, second = own[codes.FEATURE_LENGTH], its[codes.FEATURE_LENGTH]
    wx, wy = qx - px, qy - py
    turn = dx * ey - dy * ex
    start = ex * wy - ey * wx  # of the first, from the line of the second
    end = start + first * turn
    begin = dx * wy - dy * wx  # of the second, from the line of the first
    last = begin + second * turn
    if not (start * end < 0.0 and begin * last < 0.0):
        return 0.0
    depth = min(min(abs(start), abs(end)), min(abs(begin), abs(last)))
    return depth if depth > TOUCHES_WITHIN else 0.0


@jit
def _line_and_arc(
    px: float, py: float, dx: float, dy: float, line: Array, cx: float, cy: float, mx: float, my: float, arc: Array
) -> float:
    """How far a segment reaches into the circle of an arc that it crosses, or how far its end is beyond."""
    keep_small()
    radius = abs(arc[codes.FEATURE_RADIUS])
    along = dx * (cx - px) + dy * (cy - py)
    across = dx * (cy - py) - dy * (cx - px)
    if not radius - abs(across) > TOUCHES_WITHIN:
        return 0.0
    half = math.sqrt(radius * radius - across * across)
    deepest = 0.0
    for side in range(-1, 2, 2):
        place = along + side * half
        rest = min(place, line[codes.FEATURE_LENGTH] - place)
        left = _left_on_arc(px + place * dx - cx, py + place * dy - cy, mx, my, arc)
        depth = min(min(rest, left), radius - abs(across))
        deepest = max(deepest, depth)
    return deepest if deepest > TOUCHES_WITHIN else 0.0


@jit
def _arcs(
    px: float, py: float, dx: float, dy: float, own: Array, qx: float, qy: float, ex: float, ey: float, its: Array
) -> float:
    """How far the circles of two arcs that cross reach into each other, or how far an end is beyond."""
    keep_small()
    one, two = abs(own[codes.FEATURE_RADIUS]), abs(its[codes.FEATURE_RADIUS])
    wx, wy = qx - px, qy - py
    apart = math.sqrt(wx * wx + wy * wy)
    inner = min(one + two - apart, apart - abs(one - two))
    if not inner > TOUCHES_WITHIN:
        return 0.0
    along = (apart * apart + one * one - two * two) / (2.0 * apart)
    aside = math.sqrt(max(one * one - along * along, 0.0))
    deepest = 0.0
    for side in range(-1, 2, 2):
        ux = (along * wx - side * aside * wy) / apart
        uy = (along * wy + side * aside * wx) / apart
        left = min(_left_on_arc(ux, uy, dx, dy, own), _left_on_arc(ux - wx, uy - wy, ex, ey, its))
        deepest = max(deepest, min(left, inner))
    return deepest if deepest > TOUCHES_WITHIN else 0.0


@jit
def _left_on_arc(ux: float, uy: float, mx: float, my: float, arc: Array) -> float:
    """How far a direction from the centre of an arc is from the nearer end of that arc [m]; negative beyond it."""
    keep_small()
    angle = atan2(mx * uy - my * ux, mx * ux + my * uy)
    left: float = abs(arc[codes.FEATURE_RADIUS]) * (arc[codes.FEATURE_HALF] - abs(angle))
    return left
