"""Depth of the material that two outlines share, by points and crossings alone: nothing here knows what is bound.

Two closed outlines overlap where elements cross, or where a vertex, the middle of an element or the deepest point of an
arc of one lies within the other. Middles are needed where sides lie exactly on each other: two equal boxes that have
gone into each other share material, and yet no side crosses another and no corner lies inside.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.parts import Contacts, Features, Outlines
from ..compiler.subset import jit, keep_apart, keep_small
from .crossing import crossing
from .features import FAR, apart, is_over, is_over_arc


@jit
def shared_depth(block: Array, contact: int, copy: int, c: float, s: float, x: float, y: float) -> float:
    """Depth by which the outlines of a contact lie within each other [m]; 0 where they do not.

    (x, y) and the turning (c, s) take points of the frame of outline i to that of the copy of the other.
    """
    keep_apart()
    one, other = Contacts(block).outline_i[contact], Contacts(block).outline_j[contact]
    deepest: float = crossing(block, contact, copy, False, c, s, x, y)
    deepest = _deepest_within(block, one, other, c, s, x, y, deepest)
    deepest = _deepest_within(block, other, one, c, -s, -c * x - s * y, s * x - c * y, deepest)
    if deepest == 0.0 and Outlines(block).closed[one] != 0 and Outlines(block).closed[other] != 0:  # all sides on sides
        u, v = Outlines(block).data[one, codes.OUTLINE_X], Outlines(block).data[one, codes.OUTLINE_Y]
        depth = depth_of(block, one, u, v, 0.0)
        deepest = min(depth, depth_of(block, other, x + c * u - s * v, y + s * u + c * v, 0.0))
    return deepest


@jit
def _deepest_within(
    block: Array, one: int, other: int, c: float, s: float, x: float, y: float, deepest: float
) -> float:
    """Depth of the deepest point of outline `one` within the material of the other, or `deepest` if that is more [m].

    An open chain has no inside.
    """
    keep_apart()
    table = Outlines(block)
    if table.closed[other] == 0:
        return deepest
    around = table.data[other]
    within = around[codes.OUTLINE_RADIUS]
    for f in range(table.first[one], table.first[one] + table.count[one]):
        kind, own = Features(block).kind[f], Features(block).data[f]
        along = radius = 0.0
        if kind == codes.SEGMENT:
            along = 0.5 * own[codes.FEATURE_LENGTH]
        elif kind == codes.ARC:
            radius = own[codes.FEATURE_RADIUS]
            along = abs(radius)
        u, v = own[codes.FEATURE_X], own[codes.FEATURE_Y]
        cx, cy = x + c * u - s * v, y + s * u + c * v
        if along > 0.0:
            u += along * own[codes.FEATURE_DX]
            v += along * own[codes.FEATURE_DY]
        px, py = x + c * u - s * v, y + s * u + c * v
        dx, dy = px - around[codes.OUTLINE_X], py - around[codes.OUTLINE_Y]
        if dx * dx + dy * dy < within * within:
            deepest = max(deepest, depth_of(block, other, px, py, deepest))
        if radius > 0.0:
            for g in range(table.first[other], table.first[other] + table.count[other]):
                gap, nx, ny = apart(block, g, cx, cy, radius)
                if not (gap < -deepest and is_over(block, g, cx, cy)):
                    continue
                if is_over_arc(block, f, -c * nx - s * ny, s * nx - c * ny):
                    px, py = cx - radius * nx, cy - radius * ny
                    deepest = max(deepest, depth_of(block, other, px, py, deepest))
    return deepest


@jit
def depth_of(block: Array, outline: int, px: float, py: float, least: float) -> float:
    """Depth of a point within the material of a closed outline [m]; 0 where it is outside, or no deeper than `least`.

    A ray from the point crosses the chords of the outline; each arc whose segment holds the point turns that around.
    For both, a point on a chord lies infinitesimally above it.
    """
    keep_small()
    table = Outlines(block)
    first = table.first[outline]
    last = first + table.count[outline] - 1
    inside = table.closed[outline] == codes.HOLE
    square = FAR
    for f in range(first, last, 2):  # a vertex, and the element that begins there
        data, own = Features(block).data[f], Features(block).data[f + 1]
        end = Features(block).data[f + 2 if f + 1 < last else first]
        wx, wy = px - data[codes.FEATURE_X], py - data[codes.FEATURE_Y]
        ex, ey = end[codes.FEATURE_X] - data[codes.FEATURE_X], end[codes.FEATURE_Y] - data[codes.FEATURE_Y]
        turn = ex * wy - ey * wx
        is_left = turn > 0.0 or (turn == 0.0 and ey == 0.0 and ex > 0.0)
        is_below = data[codes.FEATURE_Y] > py
        if is_below != (end[codes.FEATURE_Y] > py) and is_left != is_below:
            inside = not inside
        square = min(square, wx * wx + wy * wy)
        if Features(block).kind[f + 1] == codes.SEGMENT:
            along = wx * own[codes.FEATURE_DX] + wy * own[codes.FEATURE_DY]
            if 0.0 < along < own[codes.FEATURE_LENGTH]:
                across = wx * own[codes.FEATURE_DY] - wy * own[codes.FEATURE_DX]
                square = min(square, across * across)
        else:
            ux, uy = px - own[codes.FEATURE_X], py - own[codes.FEATURE_Y]
            radius = own[codes.FEATURE_RADIUS]
            if ux * ux + uy * uy < radius * radius and is_left == (radius < 0.0):
                inside = not inside
            if is_over_arc(block, f + 1, ux, uy):
                across = math.sqrt(ux * ux + uy * uy) - abs(radius)
                square = min(square, across * across)
        if square <= least * least:
            return 0.0
    return math.sqrt(square) if inside else 0.0
