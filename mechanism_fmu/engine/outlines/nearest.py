"""How far two outlines are apart, and which of their features are nearest to each other.

Of every disc of one outline (a corner, an arc that bulges), that feature of the other counts that is nearest, on
whichever side of it the disc stands, and over which it stands; of all these the one with the least gap. What is behind
a feature by more than `outlines.depth` does not count: it has come in past an open end, or is the far side of a plate.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Pose
from ...tables.parts import Contacts, Features, Outlines
from ...tolerances import GAP_NOISE, TOUCHES_WITHIN
from ..compiler.subset import jit, keep_apart, keep_small
from ..elementary import atan2
from ..scales import length_scale
from .crossing import crossing
from .features import (
    AT_A_CORNER,
    CORNERS_TOUCH,
    FAR,
    apart,
    corners_face,
    disc_radius,
    faces_corner,
    first_in_row,
    is_at_end,
    is_corner,
    is_hollow_corner,
    is_over,
    is_over_arc,
    last_in_row,
    radius_of,
    turning_of_copy,
    wrapped,
)
from .held import FREE_PAIR, SAME_CORNERS, is_held, is_one_with
from .overlap import shared_depth

# What a search counts (`mode`).
#: As `NEXT`, without the places where an outline goes on smoothly: what it is that comes next.
MEETS = -1
#: Whatever touches nothing yet, as far as two circles around the outlines say that it may matter; and, as what comes
#: next may be as near, places where an outline goes on smoothly.
NEXT = 0
#: The same without those places.
FREE = 1
#: The same, as far as anything may be found.
EXACT = 2
#: Nothing of this, but how deep one outline lies within the other (`outlines.overlap`), whatever is bound.
OVERLAP = 3

#: Of copies, which may be millions: how many times as far is looked where nothing has been found yet, and of how many
#: it is enough to have looked that far.
_FURTHER, _ENOUGH = 4.0, 100


@jit
def nearest(block: Array, at: Pose, contact: int, mode: int) -> float:
    """The least gap of the outlines of a contact [m]; `outlines.found` are the features and the copy, or none.

    Where none was found, the outlines are at least as far from each other; with `OVERLAP`, 0 where nothing is inside.
    """
    keep_apart()
    table = Contacts(block)
    outlines = Outlines(block)
    i, j = table.body_i[contact], table.body_j[contact]
    one, other = table.outline_i[contact], table.outline_j[contact]
    outlines.found[0] = codes.NONE
    outlines.found[1] = codes.NONE
    outlines.found[2] = 0
    c = at.cosine[j] * at.cosine[i] + at.sine[j] * at.sine[i]
    s = at.cosine[j] * at.sine[i] - at.sine[j] * at.cosine[i]
    dx = at.x[i] - at.x[j]
    dy = at.y[i] - at.y[j]
    x = at.cosine[j] * dx + at.sine[j] * dy
    y = at.cosine[j] * dy - at.sine[j] * dx
    data = outlines.data[one]
    mx = x + c * data[codes.OUTLINE_X] - s * data[codes.OUTLINE_Y]
    my = y + s * data[codes.OUTLINE_X] + c * data[codes.OUTLINE_Y]
    radius = data[codes.OUTLINE_RADIUS]
    data = outlines.data[other]
    reach = radius + data[codes.OUTLINE_RADIUS]
    if outlines.copies[other] == 0:
        dx = mx - data[codes.OUTLINE_X]
        dy = my - data[codes.OUTLINE_Y]
        distance = math.sqrt(dx * dx + dy * dy)
        if mode <= FREE and distance > 2.0 * reach:
            return float(distance - reach)
        if mode == OVERLAP and distance > reach:
            return 0.0
        return float(_of_copy(block, contact, mode, 0, c, s, x, y, 0.0 if mode == OVERLAP else FAR))
    margin: float = 0.0 if mode == OVERLAP else reach
    many = min(_ENOUGH, outlines.copies[other] - 1)
    enough = False
    while True:
        first, last = _copies(block, other, mx, my, reach + margin)
        best = margin
        for k in range(first, last + 1):
            if data[codes.OUTLINE_PITCH] == 0.0:
                best = _of_copy(
                    block, contact, mode, k, c, s, x - k * data[codes.OUTLINE_DX], y - k * data[codes.OUTLINE_DY], best
                )
            else:
                copy = wrapped(block, other, k)
                st, ct = turning_of_copy(block, other, copy)
                best = _of_copy(
                    block, contact, mode, copy, ct * c + st * s, ct * s - st * c, ct * x + st * y, ct * y - st * x, best
                )
        if mode != EXACT or best < margin:
            return best
        if enough or margin >= FAR:
            return FAR
        enough = last - first >= many
        margin = min(_FURTHER * margin, FAR)


@jit
def _copies(block: Array, outline: int, x: float, y: float, reach: float) -> tuple[int, int]:
    """The first and the last copy of an outline whose circle comes nearer than `reach` to a point [m]."""
    keep_small()
    data = Outlines(block).data[outline]
    count = Outlines(block).copies[outline]
    ox, oy = data[codes.OUTLINE_X], data[codes.OUTLINE_Y]
    pitch = data[codes.OUTLINE_PITCH]
    if pitch == 0.0:
        px, py = data[codes.OUTLINE_DX], data[codes.OUTLINE_DY]
        square = px * px + py * py
        middle = ((x - ox) * px + (y - oy) * py) / square
        across = ((x - ox) * py - (y - oy) * px) ** 2 / square
        if across > reach * reach:
            return 0, -1
        half = min(math.sqrt((reach * reach - across) / square), 0.5 * count)
        return max(math.ceil(middle - half), first_in_row(count)), min(math.floor(middle + half), last_in_row(count))
    own = math.sqrt(ox * ox + oy * oy)
    far = math.sqrt(x * x + y * y)
    middle = 0.0
    if far > 0.0 and own > 0.0:
        middle = atan2(ox * y - oy * x, ox * x + oy * y) / pitch
    half = 0.5 * count
    if 2.0 * own * far > 0.0:
        cosine = (own * own + far * far - reach * reach) / (2.0 * own * far)
        if cosine > 1.0:
            return 0, -1
        if cosine >= 0.0:  # no angle is less than this, and for few is it a tenth more
            half = min(half, 0.5 * math.pi * math.sqrt(1.0 - cosine) / abs(pitch))
        elif cosine > -1.0:
            half = min(half, atan2(math.sqrt(1.0 - cosine * cosine), cosine) / abs(pitch))
    first = math.ceil(middle - half)
    return first, min(math.floor(middle + half), first + count - 1)


@jit
def _of_copy(
    block: Array, contact: int, mode: int, copy: int, c: float, s: float, x: float, y: float, best: float
) -> float:
    """The least gap to one copy, or `best`; (x, y) and the turning (c, s) take points of body i to the copy's frame."""
    keep_small()
    one, other = Contacts(block).outline_i[contact], Contacts(block).outline_j[contact]
    data = Outlines(block).data
    dx = x + c * data[one, codes.OUTLINE_X] - s * data[one, codes.OUTLINE_Y] - data[other, codes.OUTLINE_X]
    dy = y + s * data[one, codes.OUTLINE_X] + c * data[one, codes.OUTLINE_Y] - data[other, codes.OUTLINE_Y]
    within = best + data[one, codes.OUTLINE_RADIUS] + data[other, codes.OUTLINE_RADIUS]
    if dx * dx + dy * dy > within * within:
        return best
    if mode == OVERLAP:
        return min(best, -shared_depth(block, contact, copy, c, s, x, y))
    best = _of_discs(block, contact, mode, copy, 0, one, other, c, s, x, y, best)
    best = _of_discs(block, contact, mode, copy, 1, other, one, c, -s, -c * x - s * y, s * x - c * y, best)
    if mode == NEXT and Outlines(block).depth[1] > 0.0:
        across = crossing(block, contact, copy, True, c, s, x, y)
        if across > 0.0:
            best = min(best, -across)
    return best


@jit
def _of_discs(
    block: Array,
    contact: int,
    mode: int,
    copy: int,
    side: int,
    one: int,
    other: int,
    c: float,
    s: float,
    x: float,
    y: float,
    best: float,
) -> float:
    """The least gap of the discs of outline `one` from the features of the other, or `best`."""
    keep_apart()
    outlines = Outlines(block)
    features = Features(block)
    around = outlines.data[other]
    for f in range(outlines.first[one], outlines.first[one] + outlines.count[one]):
        if features.kind[f] == codes.SEGMENT:
            continue
        radius = radius_of(block, f)
        if radius < 0.0:
            continue
        u, v = features.data[f, codes.FEATURE_X], features.data[f, codes.FEATURE_Y]
        px = x + c * u - s * v
        py = y + s * u + c * v
        dx = px - around[codes.OUTLINE_X]
        dy = py - around[codes.OUTLINE_Y]
        within = best + radius + around[codes.OUTLINE_RADIUS]
        if dx * dx + dy * dy > within * within:
            continue
        smooth = disc_radius(block, f) < 0.0
        if smooth and mode != NEXT:
            continue
        found, gap = _of_disc(block, contact, mode, copy, side, one, other, f, c, s, px, py, radius, best)
        # where two arcs and the side between them lie flat, all are as near but for rounding: what can touch counts
        if smooth and found != codes.NONE and gap < best - GAP_NOISE * length_scale(block):
            best = max(gap, TOUCHES_WITHIN * length_scale(block))
            outlines.found[0] = codes.NONE
            outlines.found[1] = codes.NONE
        if not smooth and gap < best:
            best = gap
            outlines.found[side] = f if found != codes.NONE else codes.NONE
            outlines.found[1 - side] = found
            outlines.found[2] = copy
    return best


@jit
def _of_disc(
    block: Array,
    contact: int,
    mode: int,
    copy: int,
    side: int,
    one: int,
    other: int,
    disc: int,
    c: float,
    s: float,
    px: float,
    py: float,
    radius: float,
    best: float,
) -> tuple[int, float]:
    """What a disc about (px, py) touches first of an outline, but for what it touches already; and its gap.

    What is not nearer than `best` need not be found.

    In front of a feature, that with the least gap; behind one, only if it is the nearest of all, or no neighbour of
    that and no deeper than what may have happened since the last look.
    """
    keep_apart()
    outlines = Outlines(block)
    features = Features(block)
    length = length_scale(block)
    deepest = outlines.depth[0]
    # a hollow corner is where the element behind it begins, which is not what the one before touches
    is_end = features.kind[disc] == codes.VERTEX and is_hollow_corner(block, disc)
    # what is farther away cannot be what is found, nor nearer than what is crossed
    farthest = max(best, deepest)
    sticks_out = features.kind[disc] == codes.VERTEX and is_corner(block, disc)
    front, crossed, closest = codes.NONE, codes.NONE, codes.NONE
    gap, depth, least = FAR, 0.0, FAR
    comes_apart = False
    for g in range(outlines.first[other], outlines.first[other] + outlines.count[other]):
        if features.kind[g] == codes.ARC and 0.0 > features.data[g, codes.FEATURE_RADIUS] >= -radius:
            continue  # it does not fit in
        distance, nx, ny = apart(block, g, px, py, radius)
        if mode <= FREE and features.kind[g] == codes.VERTEX and features.kind[disc] == codes.VERTEX:
            distance -= CORNERS_TOUCH * length
            if not (distance > -0.5 * CORNERS_TOUCH * length and corners_face(block, disc, g, c, s, px, py)):
                continue  # a side of one touches the other
        if distance < -deepest or distance >= farthest or (distance >= gap and abs(distance) >= least):
            continue
        if not is_over(block, g, px, py):
            continue
        at_corner = sticks_out and abs(distance) < AT_A_CORNER * length and is_at_end(block, g, px, py)
        if at_corner and not faces_corner(block, disc, c * nx + s * ny, c * ny - s * nx):
            if least > AT_A_CORNER * length:  # what it touches there is nearer, whatever rounding says
                least = AT_A_CORNER * length
                closest = g
            continue
        if not is_end:
            bound = is_held(block, contact, mode <= NEXT, copy, side, one, other, disc, g, c, s, px, py)
            if bound != FREE_PAIR:
                if abs(distance) < least:  # what is in front of it is not behind the next one
                    least = abs(distance)
                    closest = g
                comes_apart = comes_apart or bound == SAME_CORNERS
                continue
        faces = True
        if radius > 0.0:  # the place on the disc, seen from its body
            faces = is_over_arc(block, disc, -c * nx - s * ny, s * nx - c * ny)
            if faces and distance < -TOUCHES_WITHIN * length:  # where it touches, rounding would say
                faces = _is_inside(block, other, px - radius * nx, py - radius * ny)
        if abs(distance) < least:
            least = abs(distance)
            closest = g
            if distance < 0.0 and faces:
                crossed = g
                depth = distance
        if faces and 0.0 <= distance < gap:
            gap = distance
            front = g
        if faces and distance < 0.0 and g != closest and not is_one_with(block, other, g, closest):
            crossed = g
            depth = distance
    if comes_apart and mode == NEXT and crossed == codes.NONE and gap > TOUCHES_WITHIN * length:
        return codes.NONE, TOUCHES_WITHIN * length  # what slides along from there touches at two places
    if crossed == codes.NONE:
        return front, gap
    if crossed != closest and is_one_with(block, other, crossed, closest):
        return front, gap
    return crossed, depth


@jit
def _is_inside(block: Array, outline: int, x: float, y: float) -> bool:
    """Whether a point is behind that feature of an outline that is nearest to it.

    The deepest place of an arc, where the arc as a whole circle reaches into something: that may lie in the circle and
    yet outside of what the arc bounds.
    """
    keep_small()
    outlines = Outlines(block)
    least = FAR
    inside = False
    for g in range(outlines.first[outline], outlines.first[outline] + outlines.count[outline]):
        distance, _, _ = apart(block, g, x, y, 0.0)
        if abs(distance) < least and is_over(block, g, x, y):
            least = abs(distance)
            inside = distance < 0.0
    return inside


@jit
def look_no_deeper(block: Array, depth: float) -> None:
    """From here on, features behind which a disc is deeper than this do not count [m]; at least what touches does."""
    Outlines(block).depth[0] = max(depth, TOUCHES_WITHIN * length_scale(block))


@jit
def look_across(block: Array, yes: bool) -> None:
    """Whether from here on elements that cross each other count as what comes next."""
    Outlines(block).depth[1] = 1.0 if yes else 0.0
