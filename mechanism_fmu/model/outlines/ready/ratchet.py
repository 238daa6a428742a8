"""The tooth of a ratchet wheel with sawteeth."""

from __future__ import annotations

import math

from ...findings import finite_positive, positive
from ...functions import Number, is_plain, sqrt
from ...quantities import quantity
from ...sawtooth import sawtooth
from ..element import Element
from ..outline import Outline
from .rounding import at_least, polar, positive_length, required, rounded, rounding


def ratchet_tooth(
    tooth_count: int,
    slope_angle: Number | str,
    inner_radius: Number | str,
    slope_ratio: Number,
    *,
    tip_radius: Number | str = 0.0,
    root_fillet: Number | str = 0.0,
) -> Outline:
    """One sawtooth of a ratchet wheel about the origin, open; `CircularCopies(tooth_count)` make the wheel.

    Counter-clockwise, the steep face comes first, then the tip, then the slope down to the root at (inner_radius, 0): a
    pawl on the face holds the wheel against turning clockwise. `.mirrored()` holds it the other way round.

    Copies join in the middle of the fillet. A pawl whose tip has a larger radius than the fillet never gets there.

    Args:
        tooth_count: of the wheel, at least 3.
        slope_angle: between the slope and the radius at its root [rad], above pi/2 - pi/tooth_count.
        inner_radius: of the roots [m], where face and slope meet, rounded or not.
        slope_ratio: length of the slope over the distance of two roots [1].
        tip_radius: of the rounding of the tip [m], which lies within the sharp tip; 0 leaves it sharp.
        root_fillet: radius of the fillet at the root [m]; 0 leaves it sharp.

    Raises:
        MechanismError: a number is impossible, roundings need more than slope or face has, or a text is no such
            quantity.

    Source: Pennestrì, Valentini, Vita, eqs (1): the geometry of Fig. 4 (`sawtooth`), with rounded corners.
    """
    said = "ratchet_tooth: "
    count = at_least(tooth_count, 3, said + "tooth_count")
    r = positive_length(inner_radius, said + "inner_radius")
    text = said + "slope_ratio = {:g}, but it must be positive and finite."
    required(finite_positive(slope_ratio), text, slope_ratio)
    slope, least = quantity(slope_angle, "rad", said + "slope_angle"), math.pi / 2 - math.pi / count
    text = said + f"slope_angle = {{:g}} deg, but it must lie between {math.degrees(least):g} and 180 deg."
    required(positive((slope - least) * (math.pi - slope)), text, slope * (180.0 / math.pi))
    tip, fillet = (rounding(tip_radius, said + "tip_radius"), rounding(root_fillet, said + "root_fillet"))
    tooth = sawtooth(count, slope, r, slope_ratio)
    pitch = 2.0 * math.pi / count
    sharp = [polar(r, -pitch), tooth.apex, (r, 0.0)]
    # roundings of the roots need the neighbours' edges, too
    (x, y), c, s = tooth.apex, math.cos(pitch), math.sin(pitch)
    before, after = (c * x + s * y, c * y - s * x), (c * x - s * y, c * y + s * x)
    names = "", "root_fillet", "tip_radius", "root_fillet", ""
    radii = 0.0, fillet, tip, fillet, 0.0
    corners = zip((before, *sharp, after), names, radii, strict=True)
    vertices = rounded(said[:-2], [*corners], closed=False).vertices[1:-1]
    if is_plain(fillet) and fillet == 0:
        return Outline(vertices, closed=False)
    return Outline((*_halves(vertices[:2])[1:], *vertices[2:-2], *_halves(vertices[-2:])[:2]), closed=False)


def _halves(arc: tuple[tuple[Number, Number, Number], ...]) -> tuple[tuple[Number, Number, Number], ...]:
    """An arc from the first of two vertices to the second as two arcs: start, middle, end."""
    (x, y, bulge), (u, v, behind) = arc
    half = bulge / (1.0 + sqrt(1.0 + bulge * bulge))  # tan(a/2) by tan(a)
    return (x, y, half), (*Element((x, y), (u, v), bulge).point(0.5), half), (u, v, behind)
