"""Teeth of gears: involute flanks as arcs, and the pins of a lantern wheel."""

from __future__ import annotations

import math

from ...body import Point
from ...findings import finite_positive, length, positive
from ...functions import Number, atan2, cos, maximum, sqrt, tan, where_positive
from ..outline import Outline
from .rounding import Corner, angle_between, at_least, polar, positive_length, required, rounded, rounding


def involute_tooth(
    tooth_count: int,
    module: Number | str,
    *,
    pressure_angle: Number | str = "20 deg",
    addendum: Number = 1.0,
    dedendum: Number = 1.25,
    backlash: Number | str = 0.0,
    root_fillet: Number | str = 0.0,
) -> Outline:
    """One tooth of an external spur gear about the origin, open, around the x axis; copies make the gear.

    Each flank is one arc, through three points of the involute: at the tip, on the pitch circle, and where the flank
    begins, which is the base circle or a fifth of the dedendum above the root, whichever is farther out. From there it
    goes radially to the root circle. At 20 deg, the arc is off the involute by less than 0.02 modules from 12 teeth on,
    0.013 from 20, 0.0025 from 60. The bottom is straight, between two points of the root circle; copies join in its
    middle.

    Args:
        tooth_count: of the gear, at least 5.
        module: pitch circle diameter over tooth count [m].
        pressure_angle: on the pitch circle [rad], 5 to 40 deg.
        addendum: height of the tip above the pitch circle, in modules [1].
        dedendum: depth of the root below the pitch circle, in modules [1].
        backlash: by how much the tooth is thinner than half a pitch, along the pitch circle [m].
        root_fillet: radius of the fillet at the root [m]; 0 leaves it sharp.

    Raises:
        MechanismError: a number is impossible, the flanks meet below the tip circle, the root fillet needs more than
            there is, or a text is no such quantity.

    Source: textbook: involute of a circle, half angle of a tooth at a radius; proportions of ISO 53.
    """
    said = "involute_tooth: "
    count = at_least(tooth_count, 5, said + "tooth_count")
    m = positive_length(module, said + "module")
    angle = angle_between(pressure_angle, math.radians(5), math.radians(40), said + "pressure_angle")
    for name, value in (("addendum", addendum), ("dedendum", dedendum)):
        required(finite_positive(value), f"{said}{name} = {{:g}} modules, but it must be positive and finite.", value)
    play, fillet = rounding(backlash, said + "backlash"), rounding(root_fillet, said + "root_fillet")
    pitch, base = count * m / 2, count * m / 2 * cos(angle)
    tip, root = pitch + addendum * m, pitch - dedendum * m
    text = said + "dedendum = {:g} modules, but it must be less than {:g}, where the pitch circle ends."
    required(positive(root), text, dedendum, count / 2)
    start = maximum(base, root + 0.2 * dedendum * m)
    on_pitch = math.pi / (2 * count) - play / (2 * pitch)
    places = [_on_involute(r, base, on_pitch + tan(angle) - angle) for r in (start, pitch, tip)]
    text = said + "addendum = {:g} modules makes the tooth pointed: its flanks meet below the tip circle; make it less."
    required(positive(places[2][1]), text, addendum)
    (lower, foot), (_, point), (_, top) = places[0], (0.0, polar(*places[1])), places[2]
    room = math.pi / count - foot
    text = said + "its tooth is {:g} rad wide at its foot, but its pitch is {:g} rad; take more backlash or teeth."
    required(positive(room), text, 2.0 * foot, 2.0 * math.pi / count)
    # below the flank: from the middle of the bottom to the foot, where a fillet goes, up to where the flank begins
    middle = polar(root * cos(room), math.pi / count)
    corners: list[Corner] = [
        ((middle[0], -middle[1]), "", 0.0),
        (polar(root, -foot), "root_fillet", fillet),
        (polar(lower, -foot), "", 0.0),
    ]
    rising = rounded(said[:-2], corners, closed=False).vertices
    flank = _bulge(polar(lower, -foot), (point[0], -point[1]), polar(tip, -top))
    x, y, _ = rising[-1]
    half = (*rising[:-1], (x, y, flank), (*polar(tip, -top), tan(top / 2)))
    # the other side is the mirror image, in reverse, where each arc has the bulge it had
    bulges = [bulge for *_, bulge in half]
    back = [(x, -y, bulge) for (x, y, _), bulge in zip(half[::-1], [*bulges[-2::-1], 0.0], strict=True)]
    return Outline((*half, *back), closed=False)


def _on_involute(radius: Number, base: Number, half_at_base: Number) -> Point:
    """Radius [m] and half the angle of the tooth there [rad]: that on the base circle, less the involute function."""
    square = radius * radius - base * base
    tangent = sqrt(where_positive(square, square, 0.0)) / base
    return radius, half_at_base - (tangent - atan2(tangent, 1.0))


def _bulge(start: Point, between: Point, end: Point) -> Number:
    """Of the arc through three points: its way turns by half its sweep from the one chord to the other."""
    a = between[0] - start[0], between[1] - start[1]
    b = end[0] - between[0], end[1] - between[1]
    return (a[0] * b[1] - a[1] * b[0]) / (length(a) * length(b) + a[0] * b[0] + a[1] * b[1])


def pin_tooth(tooth_count: int, pitch_radius: Number | str, pin_radius: Number | str) -> Outline:
    """One pin of a lantern wheel about the origin, closed; `CircularCopies(tooth_count)` make the wheel.

    Args:
        tooth_count: of the wheel, at least 2.
        pitch_radius: of the circle through the middles of the pins [m].
        pin_radius: of a pin [m], less than half the distance of two.

    Raises:
        MechanismError: a number is impossible, pins overlap, or a text is no such quantity.

    Source: definition: a circle, its centre at (pitch_radius, 0).
    """
    said = "pin_tooth: "
    count = at_least(tooth_count, 2, said + "tooth_count")
    pitch, pin = positive_length(pitch_radius, said + "pitch_radius"), positive_length(pin_radius, said + "pin_radius")
    most = pitch * math.sin(math.pi / count)
    text = said + "pin_radius = {:g} m, but it must be less than {:g} m, half the distance of two pins."
    required(positive(most - pin), text, pin, most)
    return Outline.circle(pin, (pitch, 0.0))
