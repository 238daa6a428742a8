"""The sector of a Geneva wheel: an arm between the halves of two slots."""

from __future__ import annotations

import math

from ...body import Point
from ...findings import positive
from ...functions import Number, is_plain
from ..outline import Outline
from .rounding import at_least, positive_length, required, rounding

#: Bulge of a quarter of a circle.
_QUARTER = math.tan(math.pi / 8)


def geneva_sector(
    slot_count: int,
    centre_distance: Number | str,
    slot_width: Number | str,
    slot_depth: Number | str,
    locking_radius: Number | str,
    *,
    mouth_radius: Number | str = 0.0,
) -> Outline:
    """One arm of an external Geneva wheel about the origin, open, around the x axis; copies make the wheel.

    From the middle of the bottom of one slot to that of the next: round bottom, wall, rounded mouth, then the hollow
    arc in which the driver's locking disc stands; the other half is its mirror image. The pin enters along the slot, on
    a crank of the length a sin(pi/n) with the centre distance a and n slots; the mouth is at a cos(pi/n) from the
    wheel's centre. The pin must not come to the bottom: a slot is deep enough from a (sin + cos - 1) of pi/n, and half
    its width, on.

    Args:
        slot_count: of the wheel, at least 3.
        centre_distance: of driver and wheel [m].
        slot_width: [m].
        slot_depth: from the mouth to the bottom, along the middle of the slot [m].
        locking_radius: of the hollow arc around the driver's centre [m].
        mouth_radius: of the roundings of the mouth [m]; 0 leaves it sharp. A parameter must be greater than 0.

    Raises:
        MechanismError: a number is impossible, neighbouring slots meet, nothing is left between mouth and locking arc,
            or a text is no such quantity.

    Source: textbook: external Geneva drive whose pin enters its slot along it.
    """
    said = "geneva_sector: "
    count = at_least(slot_count, 3, said + "slot_count")
    given = {"centre_distance": centre_distance, "slot_width": slot_width, "slot_depth": slot_depth}
    given["locking_radius"] = locking_radius
    a, width, depth, locking = (positive_length(value, said + name) for name, value in given.items())
    mouth = rounding(mouth_radius, said + "mouth_radius")
    half_pitch = math.pi / count
    c, s = math.cos(half_pitch), math.sin(half_pitch)
    outer, half = a * c, width / 2
    text = said + "slot_depth = {:g} m, but it must lie between {:g} m and {:g} m: half the width and a rounding at "
    text += "least, and no further than where neighbouring slots meet."
    least, most = half + mouth, outer - half * (1.0 / s - 1.0)  # there, round ends touch
    required(positive((depth - least) * (most - depth)), text, depth, least, most)
    # in axes along the slot at -pi/n and across it, towards the arm; the driver's centre is at (a c, a s) there
    text = said + "locking_radius = {:g} m, but it must be less than {:g} m, where the arc comes to the slot's mouth."
    land = a * s - half - mouth
    required(positive(land - locking), text, locking, land)
    bottom = outer - depth
    places: list[tuple[Number, Number, Number]] = [
        (bottom, 0.0, -_QUARTER),
        (bottom + half, half, 0.0),
        *_mouth(outer, half, mouth),
    ]
    turned = [(*_turned((u, v), c, -s), bulge) for u, v, bulge in places]
    # the locking arc, from one arm's end to the other's, through the wheel side of the driver's disc
    start = _turned((outer, a * s - locking), c, -s)
    sweep_half = math.pi / 2 - half_pitch  # of the arc: it begins where the radius from the driver is across the slot
    turned.append((*start, -math.tan(sweep_half / 2)))
    bulges = [bulge for *_, bulge in turned]
    back = [(x, -y, bulge) for (x, y, _), bulge in zip(turned[::-1], [*bulges[-2::-1], 0.0], strict=True)]
    return Outline((*turned, *back), closed=False)


def _mouth(outer: Number, half: Number, radius: Number) -> list[tuple[Number, Number, Number]]:
    """The corner of a slot's wall and the end of its arm, rounded or not."""
    if is_plain(radius) and radius == 0:
        return [(outer, half, 0.0)]
    return [(outer - radius, half, _QUARTER), (outer, half + radius, 0.0)]


def _turned(point: Point, c: float, s: float) -> Point:
    """A point, turned by the angle of cosine c and sine s."""
    return c * point[0] - s * point[1], s * point[0] + c * point[1]
