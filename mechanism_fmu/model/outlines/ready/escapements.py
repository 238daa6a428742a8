"""Pallets and escape-wheel teeth of clocks."""

from __future__ import annotations

import math

from ...body import Point
from ...findings import finite, length, positive
from ...functions import Number, atan2, cos, maximum, minimum, sin, sqrt, tan
from ...quantities import pair, quantity
from ..outline import Outline
from .rounding import angle_between, at_least, polar, positive_length, required, rounded, rounding


def escape_tooth(
    tooth_count: int,
    tip_circle_radius: Number | str,
    root_circle_radius: Number | str,
    front_angle: Number | str,
    back_angle: Number | str,
    *,
    tip_radius: Number | str = 0.0,
    root_fillet: Number | str = 0.0,
) -> Outline:
    """One pointed tooth of an escape wheel about the origin, open, its sharp tip on the x axis; copies make the wheel.

    It is that of a wheel that turns counter-clockwise: its front is ahead of its tip, or undercut. `.mirrored()` is
    that of one that turns clockwise. Copies join in the middle of the straight bottom between two teeth.

    Args:
        tooth_count: of the wheel, at least 3.
        tip_circle_radius: of the circle through the sharp tips [m].
        root_circle_radius: of the circle through the feet of front and back [m].
        front_angle: by which the front leans back behind the radius through the tip [rad], so that only tips touch;
            negative where its foot is ahead of the tip; above -60 and below 60 deg.
        back_angle: of the back, likewise [rad], larger than the front's, below 75 deg.
        tip_radius: of the rounding of the tip [m], which lies within the sharp one; 0 leaves it sharp.
        root_fillet: radius of the fillets at both feet [m]; 0 leaves them sharp.

    Raises:
        MechanismError: a number is impossible, faces do not reach the root circle, neighbouring teeth overlap,
            roundings need more than an edge has, or a text is no such quantity.

    Source: definition: two straight faces from the tip to the root circle.
    """
    said = "escape_tooth: "
    count = at_least(tooth_count, 3, said + "tooth_count")
    outer = positive_length(tip_circle_radius, said + "tip_circle_radius")
    inner = positive_length(root_circle_radius, said + "root_circle_radius")
    text = said + "root_circle_radius = {:g} m, but it must be less than tip_circle_radius = {:g} m."
    required(positive(outer - inner), text, inner, outer)
    front = angle_between(front_angle, -math.pi / 3, math.pi / 3, said + "front_angle")
    back = angle_between(back_angle, -math.pi / 3, math.radians(75), said + "back_angle")
    text = said + "back_angle = {:g} deg, but it must be larger than front_angle = {:g} deg."
    required(positive(back - front), text, back * (180.0 / math.pi), front * (180.0 / math.pi))
    for name, angle in (("front_angle", front), ("back_angle", back)):
        aside = outer * sin(angle)
        text = f"{said}{name} = {{:g}} deg passes the centre at {{:g}} m, outside the root circle of {{:g}} m."
        required(positive(inner * inner - aside * aside), text, angle * (180.0 / math.pi), aside, inner)
    feet = [_foot(outer, inner, angle) for angle in (back, front)]
    places = [atan2(y, x) for x, y in feet]
    pitch = 2.0 * math.pi / count
    room = (pitch - (places[1] - places[0])) / 2  # half the angle of the bottom
    text = said + "a tooth is {:g} rad wide at its foot, but its pitch is {:g} rad; make back_angle smaller."
    required(positive(room), text, places[1] - places[0], pitch)
    low = inner * cos(room)
    tip, fillet = (rounding(tip_radius, said + "tip_radius"), rounding(root_fillet, said + "root_fillet"))
    return rounded(
        said[:-2],
        [
            (polar(low, places[0] - room), "", 0.0),
            (feet[0], "root_fillet", fillet),
            ((outer, 0.0), "tip_radius", tip),
            (feet[1], "root_fillet", fillet),
            (polar(low, places[1] + room), "", 0.0),
        ],
        closed=False,
    )


def _foot(outer: Number, inner: Number, angle: Number) -> Point:
    """Where a face that leans back by an angle [rad] comes from the tip to the root circle [m]."""
    c, s = cos(angle), sin(angle)
    square = inner * inner - outer * outer * s * s
    way = outer * c - sqrt(maximum(square, 0.0))
    return outer - way * c, -way * s


def deadbeat_pallet(
    inner_radius: Number | str,
    outer_radius: Number | str,
    inner_angle: Number | str,
    outer_angle: Number | str,
    back_angle: Number | str,
) -> Outline:
    """A pallet of a dead-beat (Graham) anchor whose arbor is at the origin, closed.

    Two arcs about the arbor, on which a tooth rests without turning the anchor, whatever it presses; and a straight
    impulse face from the one to the other, along which it pushes. A tooth rests on the outer arc of the entry pallet,
    on the inner one of the exit pallet.

    Args:
        inner_radius: of the inner arc [m].
        outer_radius: of the outer arc [m], larger.
        inner_angle: of the corner of impulse face and inner arc, in polar coordinates about the arbor [rad].
        outer_angle: of the corner of impulse face and outer arc [rad].
        back_angle: where the pallet ends on its other side [rad], on either side of both, less than half a turn away.

    Raises:
        MechanismError: a number is impossible, the back is between both corners, or a text is no such quantity.

    Source: definition: a sector of a ring with one slanting end; its dead arcs are those of Graham's escapement.
    """
    said = "deadbeat_pallet: "
    inner, outer = (
        positive_length(inner_radius, said + "inner_radius"),
        positive_length(outer_radius, said + "outer_radius"),
    )
    text = said + "inner_radius = {:g} m, but it must be less than outer_radius = {:g} m."
    required(positive(outer - inner), text, inner, outer)
    given = {"inner_angle": inner_angle, "outer_angle": outer_angle, "back_angle": back_angle}
    at_inner, at_outer, back = (quantity(value, "rad", said + name) for name, value in given.items())
    ends = [at_inner - back, at_outer - back]
    text = said + "back_angle = {:g} deg, but it must be on one side of the corners at {:g} and {:g} deg, less than "
    text += "180 deg away."
    near = [positive(math.pi * math.pi - end * end) for end in ends]
    apart = minimum(minimum(*near), positive(ends[0] * ends[1])) + 0.0 * finite(*ends)
    required(apart, text, *(angle * (180.0 / math.pi) for angle in (back, at_inner, at_outer)))
    first, last = minimum(back, at_outer), maximum(back, at_outer)
    low, high = minimum(back, at_inner), maximum(back, at_inner)
    return Outline(
        (
            (*polar(outer, first), tan((last - first) / 4)),
            (*polar(outer, last), 0.0),
            (*polar(inner, high), tan((low - high) / 4)),
            (*polar(inner, low), 0.0),
        )
    )


def recoil_pallet(
    start: Point,
    end: Point,
    thickness: Number | str,
    *,
    relief_angle: Number | str = 0.0,
    corner_radius: Number | str = 0.0,
) -> Outline:
    """A pallet of a recoil anchor, closed: a straight face on which a tooth rests and pushes, and the material behind.

    The wheel recoils where the anchor swings on while a tooth is on the face: where the common normal passes the
    anchor's arbor at some distance, as it always does but on an arc about the arbor. With a relief angle, the pallet
    leans back from the end of its face, where a tooth that has been let go must not be met again.

    Args:
        start: of the face, in the frame of the anchor [m].
        end: of the face, where a tooth leaves it [m]; the material is on the left of the way from start to end.
        thickness: of the material behind the face [m].
        relief_angle: by which the sides at start and end lean back from the normal of the face [rad], above -75 and
            below 75 deg.
        corner_radius: of all four corners [m]; 0 leaves them sharp.

    Raises:
        MechanismError: start and end are the same, a number is impossible, roundings need more than an edge has, or a
            text is no such quantity.

    Source: definition: a parallelogram on the left of one of its edges.
    """
    said = "recoil_pallet: "
    (x, y), (u, v) = pair(start, "m", said + "start"), pair(end, "m", said + "end")
    thick = positive_length(thickness, said + "thickness")
    relief = angle_between(relief_angle, -math.radians(75), math.radians(75), said + "relief_angle")
    radius = rounding(corner_radius, said + "corner_radius")
    long = length((u - x, v - y))
    required(positive(long), said + "its face is {:g} m long; give an end that differs from the start.", long)
    along, back = ((u - x) / long, (v - y) / long), thick * tan(relief)
    dx, dy = -along[1] * thick - along[0] * back, along[0] * thick - along[1] * back
    points = (x, y), (u, v), (u + dx, v + dy), (x + dx, y + dy)
    return rounded(said[:-2], [(point, "corner_radius", radius) for point in points], closed=True)
