"""What ready outlines share: numbers that are refused by name, and corners whose roundings fit on their edges."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ...body import Point
from ...errors import MechanismError
from ...findings import finite_not_negative, finite_positive, length, positive, refuse, refuse_unless, size
from ...functions import Number, cos, is_plain, sin
from ...quantities import quantity
from ..outline import Outline

#: A corner: its place [m], and name and radius [m] of its rounding; both ends of an open chain are sharp.
Corner = tuple[Point, str, Number]


def polar(radius: Number, angle: Number) -> Point:
    """A point at a distance [m] and an angle [rad] from the origin."""
    return radius * cos(angle), radius * sin(angle)


def required(condition: Number, text: str, *numbers: Number) -> None:
    """Refuse numbers of which a condition does not hold, plain ones at once.

    Args:
        condition: positive where all is well.
        text: as of `Finding`, with the numbers as its fields.
        *numbers: in the units that the text names.

    Raises:
        MechanismError: it does not hold of plain numbers.
    """
    refuse(refuse_unless(condition, text, *numbers))


def positive_length(value: Number | str, what: str) -> Number:
    """A length [m], which must be positive and finite; `what` is "function: argument"."""
    found = quantity(value, "m", what)
    required(finite_positive(found), f"{what} = {{:g}} m, but it must be positive and finite.", found)
    return found


def rounding(value: Number | str, what: str) -> Number:
    """A radius of corners [m], 0 for sharp ones."""
    found = quantity(value, "m", what)
    text = f"{what} = {{:g}} m, but it must be not negative and finite; 0 leaves the corner sharp."
    required(finite_not_negative(found), text, found)
    return found


def angle_between(value: Number | str, low: float, high: float, what: str) -> Number:
    """An angle [rad], which must lie between two limits [rad], these excluded."""
    found = quantity(value, "rad", what)
    text = f"{what} = {{:g}} deg, but it must lie between {math.degrees(low):g} and {math.degrees(high):g} deg."
    required(positive((found - low) * (high - found)), text, found * (180.0 / math.pi))
    return found


def at_least(count: int, least: int, what: str) -> int:
    """A count, which must be a whole number and large enough."""
    if count != int(count) or count < least:
        raise MechanismError(f"{what} = {count:g}, but it must be a whole number of at least {least}.")
    return int(count)


def rounded(label: str, corners: Sequence[Corner], *, closed: bool) -> Outline:
    """Straight edges through corners that are rounded, where the roundings leave something of each edge.

    Args:
        label: the function that the user called, for messages.
        corners: in the order of the chain, material on its left.
        closed: whether the last is joined to the first.

    Raises:
        MechanismError: roundings need more than an edge has.
    """
    points, names, radii = [c[0] for c in corners], [c[1] for c in corners], [c[2] for c in corners]
    reaches = [_reach(points, k, radii[k], closed) for k in range(len(points))]
    for k in range(len(points) if closed else len(points) - 1):
        m = (k + 1) % len(points)
        if all(is_plain(reach) and reach == 0 for reach in (reaches[k], reaches[m])):
            continue
        long = length((points[m][0] - points[k][0], points[m][1] - points[k][1]))
        need, said = reaches[k] + reaches[m], " and ".join(sorted({names[k], names[m]} - {""}))
        text = f"{label}: {said} need {{:g}} m of an edge, but it is {{:g}} m long; make them smaller."
        required(positive(long - need), text, need, long)
    make = Outline.polygon if closed else Outline.chain
    return make(points, radii)


def _reach(points: Sequence[Point], k: int, radius: Number, closed: bool) -> Number:
    """How much of either edge the rounding of a corner takes [m]: r |tan(tau/2)| where the way turns by tau."""
    if (is_plain(radius) and radius == 0) or (not closed and k in (0, len(points) - 1)):
        return 0.0
    (x, y), (u, v), (p, q) = points[k - 1], points[k], points[(k + 1) % len(points)]
    a, b = (u - x, v - y), (p - u, q - v)
    cross, dot = a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]
    return radius * size(cross) / (length(a) * length(b) + dot)
