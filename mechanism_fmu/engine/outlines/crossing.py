"""Elements of two outlines that cross each other, though no corner of one may be inside the other.

Corners that have passed each other leave elements crossed, and nothing else. Asked at the start, after every step of
what is near, and in looks that may have come too late (`stepping.meeting`). An open chain has no inside, but crosses.
Depths are bounds from below of how far one would have to move to be across no more.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.parts import Contacts, Features, Outlines
from ...tolerances import TOUCHES_WITHIN
from ..compiler.subset import jit, keep_apart, keep_small
from ..elementary import atan2
from ..scales import length_scale
from .held import touches_there


@jit
def crossing(block: Array, contact: int, copy: int, comes_next: bool, c: float, s: float, x: float, y: float) -> float:
    """How far elements of the outlines of a contact reach across each other [m]; 0 where none does.

    More than what touches counts; where it `comes_next`, anything, but not of elements at what touches already.
    (x, y) and the turning (c, s) take points of the frame of outline i to that of the copy of the other.
    """
    keep_apart()
    one, other = Contacts(block).outline_i[contact], Contacts(block).outline_j[contact]
    table = Outlines(block)
    kind = Features(block).kind
    around = table.data[other]
    deepest = 0.0
    for f in range(table.first[one], table.first[one] + table.count[one]):
        if kind[f] == codes.VERTEX:
            continue
        own = Features(block).data[f]
        px = x + c * own[codes.FEATURE_X] - s * own[codes.FEATURE_Y]
        py = y + s * own[codes.FEATURE_X] + c * own[codes.FEATURE_Y]
        dx = c * own[codes.FEATURE_DX] - s * own[codes.FEATURE_DY]
        dy = s * own[codes.FEATURE_DX] + c * own[codes.FEATURE_DY]
        if not _may_reach(kind[f] == codes.ARC, px, py, dx, dy, own, around):
            continue
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
            if comes_next and depth > deepest and touches_there(block, contact, copy, f, g):
                continue
            deepest = max(deepest, depth)
    if comes_next or deepest > TOUCHES_WITHIN * length_scale(block):
        return deepest
    return 0.0


@jit
def _may_reach(is_arc: bool, px: float, py: float, dx: float, dy: float, own: Array, around: Array) -> bool:
    """Whether the line of a segment, or the circle of an arc, crosses the circle around another outline."""
    keep_small()
    wx, wy = around[codes.OUTLINE_X] - px, around[codes.OUTLINE_Y] - py
    reach = around[codes.OUTLINE_RADIUS]
    square = wx * wx + wy * wy
    if is_arc:
        radius = abs(own[codes.FEATURE_RADIUS])
        inner = max(radius - reach, 0.0)
        crosses: bool = inner * inner <= square <= (radius + reach) ** 2
        return crosses
    along = dx * wx + dy * wy
    beyond = max(max(-along, along - own[codes.FEATURE_LENGTH]), 0.0)
    across = dx * wy - dy * wx
    near: bool = beyond * beyond + across * across <= reach * reach
    return near


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
    depth: float = min(min(abs(start), abs(end)), min(abs(begin), abs(last)))
    return depth


@jit
def _line_and_arc(
    px: float, py: float, dx: float, dy: float, line: Array, cx: float, cy: float, mx: float, my: float, arc: Array
) -> float:
    """How far a segment and an arc that cross reach across each other.

    Where they cross, at an angle with the sine h/R, h half the chord, an end that is a beyond is off the other one by
    at least a (h - a/2)/R, as long as a < h.
    """
    keep_small()
    radius = abs(arc[codes.FEATURE_RADIUS])
    along = dx * (cx - px) + dy * (cy - py)
    across = dx * (cy - py) - dy * (cx - px)
    if not radius - abs(across) > 0.0:
        return 0.0
    half = math.sqrt(radius * radius - across * across)
    deepest = 0.0
    for side in range(-1, 2, 2):
        place = along + side * half
        rest = min(place, line[codes.FEATURE_LENGTH] - place)
        if not rest > 0.0:
            continue
        left = _left_on_arc(px + place * dx - cx, py + place * dy - cy, mx, my, arc)
        beyond = min(min(rest, left), half)
        deepest = max(deepest, beyond * (half - 0.5 * beyond) / radius)
    return deepest


@jit
def _arcs(
    px: float, py: float, dx: float, dy: float, own: Array, qx: float, qy: float, ex: float, ey: float, its: Array
) -> float:
    """How far two arcs that cross reach across each other: as of a segment, with both curvatures."""
    keep_small()
    one, two = abs(own[codes.FEATURE_RADIUS]), abs(its[codes.FEATURE_RADIUS])
    wx, wy = qx - px, qy - py
    apart = math.sqrt(wx * wx + wy * wy)
    inner = min(one + two - apart, apart - abs(one - two))
    if not inner > 0.0:
        return 0.0
    along = (apart * apart + one * one - two * two) / (2.0 * apart)
    aside = math.sqrt(max(one * one - along * along, 0.0))
    sine = aside * apart / (one * two)
    bend = 1.0 / one + 1.0 / two
    deepest = 0.0
    for side in range(-1, 2, 2):
        ux = (along * wx - side * aside * wy) / apart
        uy = (along * wy + side * aside * wx) / apart
        left = min(_left_on_arc(ux, uy, dx, dy, own), _left_on_arc(ux - wx, uy - wy, ex, ey, its))
        beyond = min(left, sine / bend)
        deepest = max(deepest, beyond * (sine - 0.5 * bend * beyond))
    return deepest


@jit
def _left_on_arc(ux: float, uy: float, mx: float, my: float, arc: Array) -> float:
    """How far a direction from the centre of an arc is from the nearer end of that arc [m]; negative beyond it."""
    keep_small()
    along = mx * ux + my * uy
    if along < 0.0 and arc[codes.FEATURE_HALF] <= 0.5 * math.pi:
        return along
    angle = atan2(mx * uy - my * ux, along)
    left: float = abs(arc[codes.FEATURE_RADIUS]) * (arc[codes.FEATURE_HALF] - abs(angle))
    return left
