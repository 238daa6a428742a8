"""Points of a sketch in closed form: along a link, where two links meet, a four-bar linkage, open or crossed."""

from __future__ import annotations

from typing import Literal, NamedTuple

from .body import Point
from .errors import MechanismError
from .findings import length, refuse, refuse_unless
from .functions import Number, cos, sin, sqrt, where_positive
from .quantities import pair, quantity


def toward(a: Point, b: Point, distance: Number) -> Point:
    """The point at a distance from `a` on the way to `b`, or behind `a` where it is negative.

    Args:
        a: a point [m].
        b: another one [m].
        distance: [m].

    Raises:
        MechanismError: both points are the same, one is no pair, or a text is no length.

    Source: definition: a + distance (b - a)/|b - a|.
    """
    a, b = pair(a, "m", "toward: a"), pair(b, "m", "toward: b")
    way = (b[0] - a[0], b[1] - a[1])
    whole = length(way)
    refuse(
        refuse_unless(
            whole, "toward: both points are ({:g}, {:g}) m, so that there is no way between them; move one of them.", *a
        )
    )
    part = quantity(distance, "m", "toward: distance") / whole
    return a[0] + part * way[0], a[1] + part * way[1]


def dyad(a: Point, b: Point, *, from_a: Number, from_b: Number, side: Literal["left", "right"] = "left") -> Point:
    """The point at a distance from each of two points: the pin in which two links meet.

    With the distance d of the points and u = (d^2 + from_a^2 - from_b^2)/(2 d^2), it is a + u (b - a) +- h R (b - a),
    h^2 = from_a^2/d^2 - u^2. Links that follow from parameters and do not reach each other are an objection to the
    values of these parameters, in the same words in every FMU.

    Args:
        a: one point [m].
        b: the other point [m]; it must not be the same.
        from_a: distance from a [m].
        from_b: distance from b [m].
        side: on which side of the way from a to b.

    Raises:
        MechanismError: the links do not reach each other or begin at one point, `side` is another word, or a text is no
            length.

    Source: textbook: where two circles intersect, by the law of cosines; R. L. Norton, Design of Machinery, chapter on
        position analysis.
    """
    if side not in ("left", "right"):
        raise MechanismError(f"dyad: side = {side!r} is neither left nor right.")
    a, b = pair(a, "m", "dyad: a"), pair(b, "m", "dyad: b")
    first, second = quantity(from_a, "m", "dyad: from_a"), quantity(from_b, "m", "dyad: from_b")
    x, y = b[0] - a[0], b[1] - a[1]
    square = x * x + y * y
    refuse(
        refuse_unless(
            square,
            "dyad: links of {:g} m and {:g} m have their other ends in one point, so that they can point anywhere; "
            "move one of these ends.",
            *(first, second),
        )
    )
    along = (square + first * first - second * second) / (2 * square)
    across = _across(first * first / square - along * along, first, second, square)
    if side == "right":
        across = -across
    return a[0] + along * x - across * y, a[1] + along * y + across * x


#: Rounding of the square of `across` where the links lie in one line.
_ROUNDING = 1e-12


def _across(square: Number, first: Number, second: Number, between: Number) -> Number:
    """The root of a square that rounding may make negative."""
    refuse(
        refuse_unless(
            square + _ROUNDING,
            "dyad: links of {:g} m and {:g} m do not reach each other over the {:g} m between their other ends; change "
            "one of these lengths.",
            *(first, second, sqrt(between)),
        )
    )
    return sqrt(where_positive(square, square, 0.0))


class FourBarPoints(NamedTuple):
    """The pins of a four-bar linkage [m]: fixed hinge and pin of the crank, pin and fixed hinge of the rocker.

    Attributes:
        crank_hinge: fixed hinge of the crank [m].
        crank_pin: pin between crank and coupler [m].
        rocker_pin: pin between coupler and rocker [m].
        rocker_hinge: fixed hinge of the rocker [m].
    """

    crank_hinge: Point
    crank_pin: Point
    rocker_pin: Point
    rocker_hinge: Point


def four_bar_points(
    crank_hinge: Point,
    rocker_hinge: Point,
    *,
    crank: Number,
    coupler: Number,
    rocker: Number,
    angle: Number,
    branch: Literal["open", "crossed"] = "open",
) -> FourBarPoints:
    """The pins of a four-bar linkage for an angle of its crank.

    Args:
        crank_hinge: the fixed hinge of the crank [m].
        rocker_hinge: the fixed hinge of the rocker [m].
        crank: its length [m].
        coupler: its length [m].
        rocker: its length [m].
        angle: of the crank, from the global x axis [rad].
        branch: "open" where the rocker's pin is to the left of the way from the crank pin to the rocker's hinge, else
            "crossed"; as of the ready-made model.

    Raises:
        MechanismError: they cannot be assembled so, `branch` is another word, or a text is no such quantity.

    Source: textbook: the crank pin on its circle, then `dyad`; R. L. Norton, Design of Machinery, chapter on position
        analysis.
    """
    if branch not in ("open", "crossed"):
        raise MechanismError(f"four_bar_points: branch = {branch!r} is neither open nor crossed.")
    crank_hinge = pair(crank_hinge, "m", "four_bar_points: crank_hinge")
    rocker_hinge = pair(rocker_hinge, "m", "four_bar_points: rocker_hinge")
    turned = quantity(angle, "rad", "four_bar_points: angle")
    long = quantity(crank, "m", "four_bar_points: crank")
    pin = (crank_hinge[0] + long * cos(turned), crank_hinge[1] + long * sin(turned))
    side: Literal["left", "right"] = "left" if branch == "open" else "right"
    return FourBarPoints(
        crank_hinge, pin, dyad(pin, rocker_hinge, from_a=coupler, from_b=rocker, side=side), rocker_hinge
    )
