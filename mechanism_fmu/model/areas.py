"""Plane areas and their moments, by Green's theorem."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from .body import Point
from .functions import Number, where_positive


class CircularHole(NamedTuple):
    """A round hole of a plate: its centre and radius [m].

    Attributes:
        centre: in the frame of the plate [m].
        radius: [m], > 0.
    """

    centre: Point
    radius: Number


class Area(NamedTuple):
    """Moments of a plane area.

    Attributes:
        area: A [m2].
        first: integrals of x and y over it [m3].
        polar: integral of x^2 + y^2 over it [m4].
    """

    area: Number
    first: Point
    polar: Number

    def without(self, hole: Area) -> Area:
        """What is left when another area is taken out of it."""
        (x, y), (x_hole, y_hole) = self.first, hole.first
        return Area(self.area - hole.area, (x - x_hole, y - y_hole), self.polar - hole.polar)

    def with_more(self, part: Area) -> Area:
        """Both together."""
        (x, y), (x_part, y_part) = self.first, part.first
        return Area(self.area + part.area, (x + x_part, y + y_part), self.polar + part.polar)


def polygon(corners: Sequence[Point]) -> Area:
    """The area inside a polygon whose edges do not cross, with its corners [m] in either sense.

    By Green's theorem, with c = x_k y_k+1 - x_k+1 y_k: A = sum c/2, integral x = sum c (x_k + x_k+1)/6,
    integral x^2 = sum c (x_k^2 + x_k x_k+1 + x_k+1^2)/12.
    """
    area: Number = 0.0
    x_moment: Number = 0.0
    y_moment: Number = 0.0
    polar: Number = 0.0
    for (x, y), (u, v) in pairwise([*corners, corners[0]]):
        cross = x * v - u * y
        area = area + cross / 2
        x_moment = x_moment + cross * (x + u) / 6
        y_moment = y_moment + cross * (y + v) / 6
        polar = polar + cross * (x * x + x * u + u * u + y * y + y * v + v * v) / 12
    side = where_positive(area, 1.0, -1.0)  # the corners may stand clockwise
    return Area(side * area, (side * x_moment, side * y_moment), side * polar)


def circle_area(centre: Point, radius: Number) -> Area:
    """The area inside a circle with its centre and radius [m]."""
    (x, y), square = centre, radius * radius
    area = math.pi * square
    return Area(area, (x * area, y * area), area * (square / 2 + x * x + y * y))
