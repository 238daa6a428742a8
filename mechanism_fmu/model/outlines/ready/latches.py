"""Hooks, and the holes into which pins go."""

from __future__ import annotations

import math

from ...body import Point
from ...findings import positive
from ...functions import Number, tan
from ...quantities import pair, quantity
from ..outline import Outline
from .rounding import angle_between, positive_length, required, rounded, rounding


def hook(
    length: Number | str,
    width: Number | str,
    nose_height: Number | str,
    nose_length: Number | str,
    *,
    undercut: Number | str = 0.0,
    tip_radius: Number | str = 0.0,
    throat_fillet: Number | str = 0.0,
) -> Outline:
    """A hook, closed: a straight shank along the x axis with a nose upwards at its end, which catches towards x = 0.

    The catching face begins at the throat, (length - nose_length, width/2); with an undercut its upper end leans
    towards x = 0, so that a pull draws what it holds into the throat.

    Args:
        length: from the origin to the end of the nose, along x [m].
        width: of the shank, which reaches from -width/2 to width/2 in y [m].
        nose_height: of the nose above the shank [m].
        nose_length: of the nose at its throat, along x [m], less than the length.
        undercut: between the catching face and the y axis [rad], above -60 and below 60 deg.
        tip_radius: of both upper corners of the nose [m]; 0 leaves them sharp.
        throat_fillet: radius of the fillet at the throat [m]; 0 leaves it sharp.

    Raises:
        MechanismError: a number is impossible, roundings need more than an edge has, or a text is no such quantity.

    Source: definition: a polygon of six corners, three of them rounded.
    """
    said = "hook: "
    given = {"length": length, "width": width, "nose_height": nose_height, "nose_length": nose_length}
    long, wide, high, nose = (positive_length(value, said + name) for name, value in given.items())
    text = said + "nose_length = {:g} m, but it must be less than the length of {:g} m."
    required(positive(long - nose), text, nose, long)
    lean = angle_between(undercut, -math.pi / 3, math.pi / 3, said + "undercut")
    tip, fillet = (rounding(tip_radius, said + "tip_radius"), rounding(throat_fillet, said + "throat_fillet"))
    tip_x = long - nose - high * tan(lean)
    text = said + "undercut = {:g} deg leaves no nose, or none of the shank; give one nearer to 0."
    required(positive((long - tip_x) * tip_x), text, lean * (180.0 / math.pi))
    half, top = wide / 2, wide / 2 + high
    return rounded(
        said[:-2],
        [
            ((0.0, -half), "", 0.0),
            ((long, -half), "", 0.0),
            ((long, top), "tip_radius", tip),
            ((tip_x, top), "tip_radius", tip),
            ((long - nose, half), "throat_fillet", fillet),
            ((0.0, half), "", 0.0),
        ],
        closed=True,
    )


def round_hole(radius: Number | str, centre: Point = (0.0, 0.0)) -> Outline:
    """A round hole, closed, the material outside.

    Args:
        radius: [m].
        centre: in the frame of the body [m].

    Raises:
        MechanismError: the radius is not positive, or a text is no such quantity.

    Source: definition: `Outline.circle` as a hole.
    """
    return Outline.circle(positive_length(radius, "round_hole: radius"), centre, hole=True)


def slot_hole(
    length: Number | str, width: Number | str, centre: Point = (0.0, 0.0), angle: Number | str = 0.0
) -> Outline:
    """A straight slot with round ends (a stadium) as a hole, closed, the material outside.

    Args:
        length: between the centres of its round ends [m]; a pin can go so far.
        width: of the slot, twice the radius of its ends [m].
        centre: of the slot, in the frame of the body [m].
        angle: of the slot, counter-clockwise from the x axis [rad].

    Raises:
        MechanismError: a number is not positive, or a text is no such quantity.

    Source: definition: two straight edges and two half circles.
    """
    said = "slot_hole: "
    x, half = positive_length(length, said + "length") / 2, positive_length(width, said + "width") / 2
    sides = ((-x, half, 0.0), (x, half, -1.0), (x, -half, 0.0), (-x, -half, -1.0))
    u, v = pair(centre, "m", said + "centre")
    return Outline(sides, hole=True).moved(u, v, quantity(angle, "rad", said + "angle"))
