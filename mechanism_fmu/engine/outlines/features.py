"""Features of an outline as others see them: how far a disc is from one, and over which part of one it stands.

All in the frame of the outline's body. A point is a disc of radius 0. The material lies to the left of the way along
the chain, so that a segment's normal out of it points to the right; an arc is hollow where its radius is negative.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.parts import Features, Outlines
from ...tolerances import PASSES_BY, TOUCHES_WITHIN
from ..compiler.subset import jit, keep_apart, keep_small
from ..elementary import atan2, sine_cosine
from ..scales import length_scale

#: The gap where there is nothing to touch [m].
FAR = 1e30
#: All lengths here are in the scale of lengths. Two corners touch when they are this near: those of two blocks on one
#: floor would else pass through each other.
CORNERS_TOUCH = 1e-10
#: So far beyond its end something may still be over a feature; less than where a contact hands over, so that what
#: has come to its end is not found there again.
BEYOND = 0.5 * PASSES_BY
#: A corner that is nearer than this to a corner is at that corner.
AT_A_CORNER = 10.0 * TOUCHES_WITHIN
#: What a corner touches may be turned against the elements beside it by this [rad], as what lies flat there is.
_TILT = 1e-6
#: Elements whose directions differ by less than this where they meet go on smoothly: there is no corner [rad].
_SMOOTH = 1e-9
_QUARTER_TURN = 0.5 * math.pi


@jit
def turning_of_copy(block: Array, outline: int, copy: int) -> tuple[float, float]:
    """Sine and cosine of the angle by which a copy of an outline is turned about the origin of its body."""
    keep_small()
    angle = copy * Outlines(block).data[outline, codes.OUTLINE_PITCH]
    if angle == 0.0:
        return 0.0, 1.0
    last = Outlines(block).turning[outline, 3 * (copy % 2) :]
    if last[0] != angle:
        last[0] = angle
        last[1], last[2] = sine_cosine(angle)
    return last[1], last[2]


@jit
def wrapped(block: Array, outline: int, copy: int) -> int:
    """The number under which a copy around the origin is known, of those a whole turn apart; one in a row has its own.

    They stand at the same place, and what is bound to the one touches the other.
    """
    keep_small()
    count = Outlines(block).copies[outline]
    if Outlines(block).data[outline, codes.OUTLINE_PITCH] == 0.0:
        return copy
    if 2 * copy > count:
        return copy - int(count)
    if 2 * copy <= -count:
        return copy + int(count)
    return copy


@jit
def first_in_row(count: int) -> int:
    """The number of the first one of so many copies in a row, of which half stand on either side of copy 0."""
    return -((count - 1) // 2)


@jit
def last_in_row(count: int) -> int:
    """That of the last one."""
    return count // 2


@jit
def is_copy(block: Array, outline: int, copy: int) -> bool:
    """Whether there is a copy of this number: around the origin always."""
    keep_small()
    if Outlines(block).data[outline, codes.OUTLINE_PITCH] != 0.0:
        return True
    count = int(Outlines(block).copies[outline])
    return first_in_row(count) <= copy <= last_in_row(count)


@jit
def beside(block: Array, outline: int, feature: int, way: int) -> int:
    """The feature `way` places further along the chain, or `codes.NONE` beyond the end of an open one."""
    table = Outlines(block)
    place = feature - table.first[outline] + way
    count = table.count[outline]
    if place < 0 or place >= count:
        if table.closed[outline] == 0:
            return codes.NONE
        place = (place + count) % count
    found: int = table.first[outline] + place
    return found


@jit
def over_seam(block: Array, outline: int, feature: int, way: int) -> int:
    """The feature behind the end of an open chain, in the next copy, where copies join there; else `codes.NONE`.

    That is the corner between them, which the first vertex is, or the element. `feature` is an end, or next to it.
    """
    table = Outlines(block)
    first = table.first[outline]
    last = first + table.count[outline] - 1
    if table.closed[outline] != 0 or Features(block).data[first, codes.FEATURE_TURN] == codes.FREE_END:
        return codes.NONE
    if way < 0:
        return int(last) - 1 if feature - first <= 1 else codes.NONE
    if last - feature > 1:
        return codes.NONE
    if is_corner(block, first):
        return int(first)
    return int(first) + 1


@jit
def is_corner(block: Array, feature: int) -> bool:
    """Whether a vertex sticks out: others may touch it."""
    sticks_out: bool = Features(block).data[feature, codes.FEATURE_TURN] > _SMOOTH
    return sticks_out


@jit
def is_hollow_corner(block: Array, feature: int) -> bool:
    """Whether a vertex is one where the chain turns towards its free side."""
    hollow: bool = Features(block).data[feature, codes.FEATURE_TURN] < -_SMOOTH
    return hollow


@jit
def disc_radius(block: Array, feature: int) -> float:
    """The radius of a feature that is a disc for others [m]: 0 of a corner; negative of one that is none.

    Where an element goes over smoothly into another is no corner: what is flat there and reaches beyond has struck the
    hollow side already.
    """
    keep_small()
    table = Features(block)
    if table.kind[feature] == codes.ARC:
        radius: float = table.data[feature, codes.FEATURE_RADIUS]
        return radius
    return 0.0 if is_corner(block, feature) else -1.0


@jit
def radius_of(block: Array, feature: int) -> float:
    """The radius of a disc [m]: 0 of a vertex, negative of a hollow arc."""
    radius = 0.0
    if Features(block).kind[feature] == codes.ARC:
        radius = Features(block).data[feature, codes.FEATURE_RADIUS]
    return radius


@jit
def fits(block: Array, feature: int, other: int) -> bool:
    """Whether two features can touch: not two segments, nor a hollow arc and what is flatter than it."""
    keep_small()
    if Features(block).kind[feature] == codes.SEGMENT and Features(block).kind[other] == codes.SEGMENT:
        return False
    one = radius_of(block, feature)
    two = radius_of(block, other)
    if one < 0.0 or two < 0.0:
        if Features(block).kind[feature] == codes.SEGMENT or Features(block).kind[other] == codes.SEGMENT:
            return False
        return one + two < 0.0 and max(one, two) >= 0.0
    return True


@jit
def apart(block: Array, feature: int, x: float, y: float, radius: float) -> tuple[float, float, float]:
    """How far a disc about (x, y) is from a feature, whatever part of it; and the normal out of the material."""
    keep_small()
    data = Features(block).data[feature]
    kind = Features(block).kind[feature]
    dx = x - data[codes.FEATURE_X]
    dy = y - data[codes.FEATURE_Y]
    if kind == codes.SEGMENT:
        nx, ny = data[codes.FEATURE_DY], -data[codes.FEATURE_DX]
        return nx * dx + ny * dy - radius, nx, ny
    distance = math.sqrt(dx * dx + dy * dy)
    own = 0.0
    if kind == codes.ARC:
        own = data[codes.FEATURE_RADIUS]
    if distance == 0.0:  # right in the middle: any normal will do
        dx, dy = data[codes.FEATURE_DX], data[codes.FEATURE_DY]
        distance = math.sqrt(dx * dx + dy * dy)
        if distance == 0.0:
            dx, distance = 1.0, 1.0
        if own < 0.0:
            return -own - radius, -dx / distance, -dy / distance
        return -own - radius, dx / distance, dy / distance
    if own < 0.0:
        return -own - radius - distance, -dx / distance, -dy / distance
    return distance - own - radius, dx / distance, dy / distance


@jit
def inside_range(block: Array, feature: int, x: float, y: float) -> tuple[float, float]:
    """How far a point over a feature is from the start and from the end of that feature [m]; negative beyond them.

    Of a vertex: from where the elements before and behind it begin.
    """
    keep_apart()
    data = Features(block).data[feature]
    kind = Features(block).kind[feature]
    dx = x - data[codes.FEATURE_X]
    dy = y - data[codes.FEATURE_Y]
    along = data[codes.FEATURE_DX] * dx + data[codes.FEATURE_DY] * dy
    if kind == codes.SEGMENT:
        return along, data[codes.FEATURE_LENGTH] - along
    if kind == codes.VERTEX:
        return along, -(data[codes.FEATURE_LEAVES_X] * dx + data[codes.FEATURE_LEAVES_Y] * dy)
    if dx == 0.0 and dy == 0.0:
        return math.inf, math.inf
    return over_arc(block, feature, dx, dy)


@jit
def over_arc(block: Array, feature: int, dx: float, dy: float) -> tuple[float, float]:
    """As `inside_range`, of what lies in a direction from the centre of an arc."""
    keep_apart()
    data = Features(block).data[feature]
    mx, my = data[codes.FEATURE_DX], data[codes.FEATURE_DY]
    radius = data[codes.FEATURE_RADIUS]
    angle = atan2(mx * dy - my * dx, mx * dx + my * dy)
    half = data[codes.FEATURE_HALF]
    if half > math.pi:
        return math.inf, math.inf
    # a hollow arc runs clockwise, and its radius is negative
    return abs(radius) * half + radius * angle, abs(radius) * half - radius * angle


@jit
def is_at_end(block: Array, feature: int, x: float, y: float) -> bool:
    """Whether a point over an element is right beside an end of it; no point over a vertex is."""
    keep_small()
    if Features(block).kind[feature] == codes.VERTEX:
        return False
    before, behind = inside_range(block, feature, x, y)
    return min(before, behind) < AT_A_CORNER * length_scale(block)


@jit
def faces_corner(block: Array, corner: int, nx: float, ny: float) -> bool:
    """Whether a corner can touch something with a normal (towards the corner): neither element beside it lies deeper.

    Where a corner is at a corner, it is near both sides of that, and touches the one.
    """
    keep_small()
    data = Features(block).data[corner]
    before = data[codes.FEATURE_DX] * nx + data[codes.FEATURE_DY] * ny
    behind = data[codes.FEATURE_LEAVES_X] * nx + data[codes.FEATURE_LEAVES_Y] * ny
    faces: bool = before <= _TILT and behind >= -_TILT
    return faces


@jit
def corners_face(block: Array, corner: int, other: int, c: float, s: float, px: float, py: float) -> bool:
    """Whether a corner about (px, py) is beyond the ends of all elements beside the other one, and that of its own.

    Else the end of an element is over a corner, by rounding or more, and they touch with the normal of that element.
    """
    keep_small()
    data = Features(block).data[other]
    dx, dy = px - data[codes.FEATURE_X], py - data[codes.FEATURE_Y]
    if not _is_beyond(block, other, dx, dy):
        return False
    return not is_corner(block, corner) or _is_beyond(block, corner, -c * dx - s * dy, s * dx - c * dy)


@jit
def _is_beyond(block: Array, corner: int, dx: float, dy: float) -> bool:
    """Whether a point (dx, dy) from a corner is beyond the ends of the elements there, of which a free end has one."""
    keep_small()
    data = Features(block).data[corner]
    before = data[codes.FEATURE_DX] * dx + data[codes.FEATURE_DY] * dy
    behind = -(data[codes.FEATURE_LEAVES_X] * dx + data[codes.FEATURE_LEAVES_Y] * dy)
    least = before + behind if data[codes.FEATURE_TURN] == codes.FREE_END else min(before, behind)
    is_beyond: bool = least > BEYOND * length_scale(block)
    return is_beyond


@jit
def is_over_arc(block: Array, feature: int, dx: float, dy: float) -> bool:
    """Whether a direction from the centre of an arc leads to it, or hardly beyond its ends."""
    keep_small()
    data = Features(block).data[feature]
    along = data[codes.FEATURE_DX] * dx + data[codes.FEATURE_DY] * dy
    half = data[codes.FEATURE_HALF]
    beyond = BEYOND * length_scale(block)
    # of arcs that are half circles or more, or not so much, a sign says it mostly
    if half >= _QUARTER_TURN and along > 0.0:
        return True
    if half <= _QUARTER_TURN and -along * abs(data[codes.FEATURE_RADIUS]) > beyond * math.sqrt(dx * dx + dy * dy):
        return False
    before, behind = over_arc(block, feature, dx, dy)
    return before >= -beyond and behind >= -beyond


@jit
def is_over(block: Array, feature: int, x: float, y: float) -> bool:
    """Whether a point at (x, y) stands over a feature, and may touch it; no point touches a hollow or smooth vertex."""
    keep_small()
    if Features(block).kind[feature] == codes.VERTEX and not is_corner(block, feature):
        return False
    if Features(block).kind[feature] == codes.ARC:
        data = Features(block).data[feature]
        return is_over_arc(block, feature, x - data[codes.FEATURE_X], y - data[codes.FEATURE_Y])
    before, behind = inside_range(block, feature, x, y)
    beyond = BEYOND * length_scale(block)
    return before >= -beyond and behind >= -beyond
