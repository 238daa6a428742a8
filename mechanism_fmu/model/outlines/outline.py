"""Outlines: chains of straight segments and circular arcs that bound a body where others may touch it.

An element is told by its two ends and its bulge b = tan(sweep/4), as in drawing files: 0 is a straight segment, 1 half
a circle, positive where the arc lies to the right of the way from its start to its end. The material lies on the left.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from ..areas import Area
from ..body import Point
from ..errors import MechanismError
from ..findings import Finding, length, literal, positive, refuse, refuse_unless
from ..functions import Number, cos, is_plain, sin, sqrt, where_positive
from ..quantities import pair, quantity
from .element import Element

#: No element may be shorter than this part of all elements together.
SHORTEST = 1e-9


@dataclass(frozen=True)
class Outline:
    """A closed or open chain of straight segments and circular arcs in the frame of a body, material on its left.

    A closed one runs counter-clockwise around the material, or, as a hole, clockwise, with the material outside. An
    open one has material on its left and free space on its right.

    Attributes:
        vertices: (x, y, bulge) [m, m, 1]; an element goes from each to the next, with the bulge of the one it leaves.
            Of an open chain the last bulge is not used.
        closed: whether the last vertex is joined to the first.
        hole: whether it is the edge of a hole, which runs clockwise.

    Raises:
        MechanismError: there are too few vertices, or a hole is open.

    Source: definition: bulge, tan of a quarter of the arc's sweep, as in DXF polylines.
    """

    vertices: tuple[tuple[Number, Number, Number], ...]
    closed: bool = True
    hole: bool = False

    def __post_init__(self) -> None:
        least = 2 if self.closed else 1
        if len(self.elements) < least:
            kind = "a closed" if self.closed else "an open"
            raise MechanismError(f"Outline: {kind} one needs at least {least} elements, this has {len(self.elements)}.")
        if self.hole and not self.closed:
            raise MechanismError("Outline: a hole is closed; leave out closed=False.")

    @property
    def elements(self) -> tuple[Element, ...]:
        """Its segments and arcs, in order."""
        ring = (*self.vertices, self.vertices[0]) if self.closed else self.vertices
        return tuple(Element((x, y), (u, v), bulge) for (x, y, bulge), (u, v, _) in pairwise(ring))

    @property
    def points(self) -> tuple[Point, ...]:
        """Its vertices without their bulges."""
        return tuple((x, y) for x, y, _ in self.vertices)

    @classmethod
    def polygon(
        cls, points: Sequence[Point], corner_radius: Number | Sequence[Number] = 0.0, *, hole: bool = False
    ) -> Outline:
        """Straight edges through points, rounded where a radius says so.

        Args:
            points: counter-clockwise, of a hole clockwise [m].
            corner_radius: of all corners, or one for each point [m]; 0 leaves a corner sharp. Whether one is sharp
                belongs to the structure: a parameter must be greater than 0.
            hole: as of `Outline`.

        Raises:
            MechanismError: fewer than three points, not as many radii as points, or a text is no such quantity.
        """
        given = [pair(point, "m", f"point {k} of an outline") for k, point in enumerate(points)]
        if len(given) < 3:
            raise MechanismError(f"A polygon needs at least 3 points, this has {len(given)}.")
        return cls(_rounded(given, _radii(corner_radius, len(given)), closed=True), hole=hole)

    @classmethod
    def chain(cls, points: Sequence[Point], corner_radius: Number | Sequence[Number] = 0.0) -> Outline:
        """An open chain of straight edges, material on the left; its ends are not rounded.

        Args:
            points: in the order of the chain, at least two [m].
            corner_radius: as of `polygon`; those of the two ends are not used.

        Raises:
            MechanismError: fewer than two points, not as many radii as points, or a text is no such quantity.
        """
        given = [pair(point, "m", f"point {k} of an outline") for k, point in enumerate(points)]
        if len(given) < 2:
            raise MechanismError(f"A chain needs at least 2 points, this has {len(given)}.")
        return cls(_rounded(given, _radii(corner_radius, len(given)), closed=False), closed=False)

    @classmethod
    def circle(cls, radius: Number, centre: Point = (0.0, 0.0), *, hole: bool = False) -> Outline:
        """A full circle: a pin, a roller; as a hole, a bore.

        Args:
            radius: [m], > 0.
            centre: in the frame of the body [m].
            hole: as of `Outline`.

        Raises:
            MechanismError: a text is no such quantity.
        """
        (x, y), r = pair(centre, "m", "centre of a circle"), quantity(radius, "m", "radius of a circle")
        bulge = -1.0 if hole else 1.0
        return cls(((x + r, y, bulge), (x - r, y, bulge)), hole=hole)

    def moved(self, x: Number = 0.0, y: Number = 0.0, angle: Number = 0.0) -> Outline:
        """The same outline elsewhere: turned about the origin of its frame, then displaced.

        Args:
            x: displacement [m].
            y: likewise [m].
            angle: counter-clockwise [rad].
        """
        c, s = cos(angle), sin(angle)
        return replace(self, vertices=tuple((x + c * u - s * v, y + s * u + c * v, b) for u, v, b in self.vertices))

    def mirrored(self) -> Outline:
        """The mirror image about the x axis, traversed so that the material stays on the left."""
        ring = self.vertices
        starts = ring[::-1]
        # the element that arrives at a vertex leaves it now, with the same bulge: mirrored and reversed, twice a change
        bulges = [ring[k - 1][2] for k in range(len(ring) - 1, -1, -1)]
        return replace(self, vertices=tuple((x, -y, b) for (x, y, _), b in zip(starts, bulges, strict=True)))

    def area(self) -> Area:
        """Moments of the area inside; of a hole, that of the hole.

        Raises:
            MechanismError: it is open.

        Source: textbook: Green's theorem for the polygon of its vertices, and circular segments beside it.
        """
        if not self.closed:
            raise MechanismError("An open outline has no area; close it.")
        whole = Area(0.0, (0.0, 0.0), 0.0)
        for element in self.elements:
            whole = whole.with_more(element.area())
        side = -1.0 if self.hole else 1.0
        return Area(side * whole.area, (side * whole.first[0], side * whole.first[1]), side * whole.polar)

    def drawn(self) -> list[Point]:
        """Its vertices, and points on its arcs, near enough for a drawing [m]."""
        return [point for element in self.elements for point in element.points()]

    def seen_from(self, origin: Point, label: str) -> Area:
        """Moments of the area inside about a point, after a look at what can be wrong.

        Args:
            origin: from which they count [m]: far away, differences of large numbers would take their digits.
            label: how messages call it.

        Raises:
            MechanismError: it is open, an element is too short, or it runs the wrong way round.
        """
        for finding in self.findings(label):
            refuse(finding)
        return self.moved(-origin[0], -origin[1]).area()

    def findings(self, label: str) -> Iterator[Finding]:
        """What its numbers can be wrong in, by themselves: short elements, and the wrong way round.

        Args:
            label: how messages call it.
        """
        said = literal(label)
        chords = [length(element.chord) for element in self.elements]
        shortest = SHORTEST * sum(chords, 0.0)
        for k, long in enumerate(chords):
            text = (
                f"{said}: element {k} is {{:g}} m long, but it must be longer than {{:g}} m, {SHORTEST:g} of them all."
            )
            yield refuse_unless(positive(long - shortest), text, long, shortest)
        if self.closed:
            area = self.area().area
            way = "clockwise, as a hole" if self.hole else "counter-clockwise"
            text = f"{said} encloses {{:g}} m2: it runs the wrong way round; give its points {way}."
            yield refuse_unless(positive(area), text, area + 0.0)


def _radii(given: Number | Sequence[Number], count: int) -> list[Number]:
    """One radius for each point."""
    if isinstance(given, (list, tuple)):
        if len(given) != count:
            raise MechanismError(f"corner_radius has {len(given)} radii for {count} points; give one for each.")
        return [quantity(radius, "m", "corner_radius") for radius in given]
    return [quantity(given, "m", "corner_radius")] * count


def _rounded(points: list[Point], radii: list[Number], *, closed: bool) -> tuple[tuple[Number, Number, Number], ...]:
    """Vertices of straight edges through points, with arcs of given radii in place of corners.

    A corner where the way turns by tau has tangents of length r |tan(tau/2)|, and its arc the bulge tan(tau/4).
    """
    found: list[tuple[Number, Number, Number]] = []
    last = len(points) - 1
    for k, ((x, y), radius) in enumerate(zip(points, radii, strict=True)):
        sharp = (is_plain(radius) and radius == 0) or (not closed and k in (0, last))
        if sharp:
            found.append((x, y, 0.0))
            continue
        before, after = _direction(points[k - 1], (x, y)), _direction((x, y), points[(k + 1) % len(points)])
        cross = before[0] * after[1] - before[1] * after[0]
        half = cross / (1.0 + before[0] * after[0] + before[1] * after[1])  # tan(tau/2)
        reach = radius * where_positive(half, half, -half)
        bulge = half / (1.0 + sqrt(1.0 + half * half))
        found.append((x - reach * before[0], y - reach * before[1], bulge))
        found.append((x + reach * after[0], y + reach * after[1], 0.0))
    return tuple(found)


def _direction(a: Point, b: Point) -> Point:
    way = (b[0] - a[0], b[1] - a[1])
    long = length(way)
    if is_plain(long) and not long > 0.0:
        raise MechanismError(f"Two points of an outline are the same, ({a[0]:g}, {a[1]:g}); leave one out.")
    return way[0] / long, way[1] / long
