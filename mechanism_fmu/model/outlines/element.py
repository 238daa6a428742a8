"""One element of an outline: a straight segment or a circular arc, by its ends and its bulge."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

from ..areas import Area
from ..body import Point
from ..findings import length
from ..functions import Number, atan2, cos, is_plain, sin, where_positive

#: So many straight lines show an arc in a drawing, whatever its sweep, which may follow from parameters.
_DRAWN = 12


class Element(NamedTuple):
    """From one point to another, straight or along a circle.

    Attributes:
        start, end: its ends [m].
        bulge: tan of a quarter of its sweep [1]; 0, a plain number, for a straight segment.
    """

    start: Point
    end: Point
    bulge: Number

    @property
    def is_straight(self) -> bool:
        """Whether it is a segment; which it is belongs to the structure, and follows from no parameter."""
        return is_plain(self.bulge) and self.bulge == 0

    @property
    def chord(self) -> Point:
        """From its start to its end [m]."""
        return self.end[0] - self.start[0], self.end[1] - self.start[1]

    @property
    def sweep(self) -> Number:
        """Angle of the arc [rad], positive counter-clockwise: 4 atan(bulge)."""
        return 4.0 * atan2(self.bulge, 1.0)

    @property
    def radius(self) -> Number:
        """Of the arc [m], with the sign of its bulge: L (1 + b^2) / (4 b)."""
        return length(self.chord) * (1.0 + self.bulge * self.bulge) / (4.0 * self.bulge)

    @property
    def centre(self) -> Point:
        """Of the arc [m]: beside the middle of its chord L by L (1 - b^2) / (4 b), to the left."""
        (x, y), (dx, dy) = self.start, self.chord
        beside = (1.0 - self.bulge * self.bulge) / (4.0 * self.bulge)
        return x + dx / 2 - beside * dy, y + dy / 2 + beside * dx

    def tangents(self) -> tuple[Point, Point]:
        """Unit vectors of travel at its start and at its end."""
        dx, dy = self.chord
        long = length((dx, dy))
        x, y = dx / long, dy / long
        if self.is_straight:
            return (x, y), (x, y)
        # the way turns by the sweep: by half of it on either side of the chord; c, s of half the sweep
        square = self.bulge * self.bulge
        c, s = (1.0 - square) / (1.0 + square), 2.0 * self.bulge / (1.0 + square)
        return (c * x + s * y, c * y - s * x), (c * x - s * y, c * y + s * x)

    def point(self, part: float) -> Point:
        """The point at a part of its way, 0 at its start, 1 at its end [m]."""
        (x, y), (dx, dy) = self.start, self.chord
        if self.is_straight:
            return x + part * dx, y + part * dy
        (cx, cy), angle = self.centre, part * self.sweep
        c, s = cos(angle), sin(angle)
        return cx + c * (x - cx) - s * (y - cy), cy + s * (x - cx) + c * (y - cy)

    def points(self) -> list[Point]:
        """Its start, and of an arc also points between its ends, near enough for a drawing [m]."""
        if self.is_straight:
            return [self.start]
        (x, y), (cx, cy) = self.start, self.centre
        dx, dy = x - cx, y - cy
        turns = _plain_turns(self.bulge) if is_plain(self.bulge) else _turns(self.bulge)
        return [self.start, *((cx + c * dx - s * dy, cy + s * dx + c * dy) for c, s in turns)]

    def area(self) -> Area:
        """What it adds to the area that the outline encloses, seen from the origin.

        The triangle of origin, start and end; and the circular segment beside the chord of length L, with the area
        alpha(b) L^2, the first moment beta(b) L^3 to the right of the chord, and the polar moment pi(b) L^4 about its
        middle (`_moments`).

        Source: textbook: moments of a circular segment.
        """
        (x, y), (u, v) = self.start, self.end
        cross = x * v - u * y
        whole = Area(
            cross / 2,
            (cross * (x + u) / 6, cross * (y + v) / 6),
            cross * (x * x + x * u + u * u + y * y + y * v + v * v) / 12,
        )
        if self.is_straight:
            return whole
        dx, dy = self.chord
        square = dx * dx + dy * dy
        alpha, beta, about = _moments(self.bulge)
        area, mx, my = alpha * square, x + dx / 2, y + dy / 2
        fx, fy = beta * square * dy, -beta * square * dx
        polar = about * square * square + 2.0 * (mx * fx + my * fy) + (mx * mx + my * my) * area
        return whole.with_more(Area(area, (fx + mx * area, fy + my * area), polar))


def _turns(bulge: Number) -> tuple[Point, ...]:
    """Cosine and sine of the angles by which the drawn points of an arc are turned from its start."""
    sweep = 4.0 * atan2(bulge, 1.0)
    angles = [k / _DRAWN * sweep for k in range(1, _DRAWN)]
    return tuple((cos(angle), sin(angle)) for angle in angles)


#: The copies of an outline, such as teeth, have the same arcs.
_plain_turns = lru_cache(maxsize=256)(_turns)


#: Up to this bulge the closed forms of `_moments` lose digits, as 1 / b^4, and their series are exact to rounding.
_FLAT = 0.25
#: Coefficients of b^(2 k + 1), b^(2 k + 2), b^(2 k + 1).
_ALPHA = tuple((-1.0) ** (k + 1) / ((2 * k - 1) * (2 * k + 1) * (2 * k + 3)) for k in range(14))
_BETA = tuple(
    over / under
    for over, under in (
        *((1, 15), (2, 105), (-1, 315), (4, 3465), (-5, 9009), (2, 6435), (-7, 36465)),
        *((8, 62985), (-1, 11305), (10, 156009), (-11, 229425), (4, 108675), (-13, 450225), (14, 606825)),
    )
)
_ABOUT = tuple(
    over / under
    for over, under in (
        *((1, 60), (11, 420), (1, 140), (-17, 13860), (83, 180180), (-41, 180180), (19, 145860)),
        *((-227, 2771340), (97, 1763580), (-121, 3120180), (443, 15600900), (-59, 2753100)),
        *((209, 12606300), (-731, 55827900)),
    )
)


def _moments(b: Number) -> tuple[Number, Number, Number]:
    """Area, first moment and polar moment about the chord's middle of the segment of bulge b beside a chord of 1.

    With a = 2 atan b, r = (1 + b^2) / (4 b), h = (1 - b^2) / (4 b): alpha = r^2 (a - s c), beta = 1/12 - h alpha, and
    pi = r^4 (a/2 - s c^3/2 - s^3 c/6) - h/6 + h^2 alpha; flat arcs by their series.
    """
    square = b * b
    flat = b * _series(_ALPHA, square), square * _series(_BETA, square), b * _series(_ABOUT, square)
    if is_plain(b) and abs(b) <= _FLAT:
        return flat
    a, s, c = 2.0 * atan2(b, 1.0), 2.0 * b / (1.0 + square), (1.0 - square) / (1.0 + square)
    r, h = (1.0 + square) / (4.0 * b), (1.0 - square) / (4.0 * b)
    alpha = r * r * (a - s * c)
    about = r * r * r * r * (a / 2 - s * c * c * c / 2 - s * s * s * c / 6) - h / 6 + h * h * alpha
    curved = alpha, 1.0 / 12 - h * alpha, about
    if is_plain(b):
        return curved
    is_flat = _FLAT * _FLAT - square
    found = tuple(where_positive(is_flat, one, other) for one, other in zip(flat, curved, strict=True))
    return found[0], found[1], found[2]


def _series(coefficients: tuple[float, ...], x: Number) -> Number:
    total: Number = 0.0
    for coefficient in reversed(coefficients):
        total = coefficient + x * total
    return total
