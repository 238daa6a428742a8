"""One element of an outline: a straight segment or a circular arc, by its ends and its bulge."""

from __future__ import annotations

from typing import NamedTuple

from ..areas import Area
from ..body import Point
from ..findings import length
from ..functions import Number, atan2, cos, is_plain, sin

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
        return [self.start, *(self.point(k / _DRAWN) for k in range(1, _DRAWN))]

    def area(self) -> Area:
        """What it adds to the area that the outline encloses, seen from the origin.

        The triangle of origin, start and end; and the circular segment beside the chord, with half the sweep a and
        the radius R, both with the sign of the bulge: A = R^2 (2 a - sin 2a) / 2, first moment about the centre of the
        circle 2/3 R^3 sin(a)^3, polar moment there R^4 (a/2 - (s c^3)/2 - (s^3 c)/6).

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
        square = self.bulge * self.bulge
        s, c, a = 2.0 * self.bulge / (1.0 + square), (1.0 - square) / (1.0 + square), self.sweep / 2
        r, (cx, cy), (dx, dy) = self.radius, self.centre, self.chord
        long = length((dx, dy))
        area = r * r * (a - s * c)
        towards = 2.0 / 3.0 * r * r * r * s * s * s  # to the right of the chord
        fx, fy = towards * dy / long, -towards * dx / long
        about = r * r * r * r * (a / 2 - s * c * c * c / 2 - s * s * s * c / 6)
        polar = about + 2.0 * (cx * fx + cy * fy) + (cx * cx + cy * cy) * area
        return whole.with_more(Area(area, (fx + cx * area, fy + cy * area), polar))
