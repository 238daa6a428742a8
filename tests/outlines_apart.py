"""How far two outlines are from each other, independently of the engine: candidates of all pairs of elements.

Points are complex numbers x + i y here. The distance of two elements is that of an end of one from the other, or is
taken where both have the same normal: at the foot of an arc's centre on a segment, or on the line of two centres.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from typing import NamedTuple

from mechanism_fmu.model import Outline


class Pose(NamedTuple):
    """Where the frame of a body stands: its origin [m], and its angle [rad]."""

    x: float = 0.0
    y: float = 0.0
    angle: float = 0.0


@dataclass(frozen=True)
class Nearest:
    """Where two outlines are nearest to each other.

    Attributes:
        distance: between the two points [m]; 0 where the outlines cross.
        points: of the first and of the second outline, in the global frame [m].
        elements: which of theirs these points are on; an end that two share is on either.
    """

    distance: float
    points: tuple[complex, complex]
    elements: tuple[int, int]


class _Placed(NamedTuple):
    """An element in the global frame; a segment has a radius of 0."""

    start: complex
    end: complex
    centre: complex
    radius: float
    middle: float
    half: float

    @property
    def at_middle(self) -> complex:
        """The point of an arc half on its way."""
        return self.centre + cmath.rect(self.radius, self.middle)

    def nearest(self, p: complex) -> complex:
        """The point of the element that is nearest to another one."""
        if self.radius == 0.0:
            way = self.end - self.start
            part = ((p - self.start) * way.conjugate()).real / abs(way) ** 2
            return self.start + min(max(part, 0.0), 1.0) * way
        out = p - self.centre
        if out and self.holds(out):
            return self.centre + self.radius * out / abs(out)
        return min(self.start, self.end, key=lambda end: abs(p - end))

    def holds(self, direction: complex) -> bool:
        """Whether the arc has a point in this direction from its centre."""
        return abs(math.remainder(cmath.phase(direction) - self.middle, math.tau)) <= self.half


@lru_cache(maxsize=64)
def placed(outline: Outline, pose: Pose) -> tuple[_Placed, ...]:
    """The elements of an outline of plain numbers, in the global frame."""
    turn, origin = cmath.rect(1.0, pose.angle), complex(pose.x, pose.y)

    def seen(point: tuple[float, float]) -> complex:
        return origin + turn * complex(*point)

    found = []
    for element in outline.elements:
        start, end = seen(element.start), seen(element.end)
        if element.is_straight:
            found.append(_Placed(start, end, 0j, 0.0, 0.0, 0.0))
            continue
        centre = seen(element.centre)
        middle = cmath.phase(seen(element.point(0.5)) - centre)
        found.append(_Placed(start, end, centre, abs(element.radius), middle, abs(element.sweep) / 2))
    return tuple(found)


def nearest(a: Outline, pose_a: Pose, b: Outline, pose_b: Pose) -> Nearest:
    """The two points, one of each outline, that are nearest to each other.

    Args:
        a, b: outlines of plain numbers.
        pose_a, pose_b: where the bodies that carry them stand.
    """
    least = Nearest(math.inf, (0j, 0j), (0, 0))
    pairs = product(enumerate(placed(a, pose_a)), enumerate(placed(b, pose_b)))
    for (k, first), (m, second) in pairs:
        for p, q in _candidates(first, second):
            if abs(p - q) < least.distance:
                least = Nearest(abs(p - q), (p, q), (k, m))
    return least


def _candidates(first: _Placed, second: _Placed) -> Iterator[tuple[complex, complex]]:
    """Pairs of points, among which are the nearest of two elements."""
    for end in (first.start, first.end):
        yield end, second.nearest(end)
    for end in (second.start, second.end):
        yield first.nearest(end), end
    for p in crossings(first, second):
        yield p, p
    if first.radius > 0.0 and second.radius > 0.0:
        between = second.centre - first.centre
        if between:
            unit = between / abs(between)
            for near, far in product((unit, -unit), repeat=2):
                if first.holds(near) and second.holds(far):
                    yield first.centre + first.radius * near, second.centre + second.radius * far
    elif first.radius > 0.0:
        yield from ((first.nearest(q), q) for q in _feet(first, second))
    elif second.radius > 0.0:
        yield from ((p, second.nearest(p)) for p in _feet(second, first))


def _feet(arc: _Placed, segment: _Placed) -> Iterator[complex]:
    """The foot of an arc's centre on a segment."""
    yield segment.nearest(arc.centre)


def crossings(first: _Placed, second: _Placed) -> Iterator[complex]:
    """The points that two elements have in common; none for elements that lie along each other."""
    if first.radius == 0.0 and second.radius == 0.0:
        u, v, w = first.end - first.start, second.end - second.start, second.start - first.start
        cross = (u.conjugate() * v).imag
        if cross:
            s, t = (w.conjugate() * v).imag / cross, (w.conjugate() * u).imag / cross
            if 0.0 <= s <= 1.0 and 0.0 <= t <= 1.0:
                yield first.start + s * u
        return
    arc, other = (first, second) if first.radius > 0.0 else (second, first)
    if other.radius == 0.0:
        way = other.end - other.start
        unit = way / abs(way)
        foot = ((arc.centre - other.start) * unit.conjugate()).real
        square = arc.radius**2 - abs(other.start + foot * unit - arc.centre) ** 2
        if square >= 0.0:
            for part in (foot - math.sqrt(square), foot + math.sqrt(square)):
                p = other.start + part * unit
                if 0.0 <= part <= abs(way) and arc.holds(p - arc.centre):
                    yield p
        return
    between = other.centre - arc.centre
    apart = abs(between)
    if apart == 0.0 or not abs(arc.radius - other.radius) <= apart <= arc.radius + other.radius:
        return
    along = (apart**2 + arc.radius**2 - other.radius**2) / (2.0 * apart)
    aside = math.sqrt(max(arc.radius**2 - along**2, 0.0))
    for side in (aside, -aside):
        p = arc.centre + between / apart * complex(along, side)
        if arc.holds(p - arc.centre) and other.holds(p - other.centre):
            yield p


def is_inside(outline: Outline, pose: Pose, point: complex) -> bool:
    """Whether a point lies within the material of a closed outline; of a hole, outside of the hole.

    By how often the outline turns around it: what its chords turn, and once more between a chord and its arc.
    """
    turns = 0.0
    for element in placed(outline, pose):
        if element.start == point or element.end == point:
            return False
        turns += cmath.phase((element.end - point) / (element.start - point))
        if element.radius > 0.0 and abs(point - element.centre) < element.radius:
            chord = element.end - element.start
            side = ((element.at_middle - element.start) / chord).imag  # of the arc, beside its chord
            if ((point - element.start) / chord).imag * side > 0.0:
                turns += math.tau if side < 0.0 else -math.tau
    around = round(turns / math.tau)
    return around == 0 if outline.hole else around > 0


#: So many points of each element are asked whether they lie within another body.
_ASKED = 16


@dataclass(frozen=True)
class Overlap:
    """That two closed outlines have material in common.

    Attributes:
        depth: how deep a point of one lies within the other [m], the deepest of those that were asked.
        point: that point, in the global frame [m].
        element: of which outline (0 or 1) and which element it is a point.
    """

    depth: float
    point: complex
    element: tuple[int, int]


def overlap(a: Outline, pose_a: Pose, b: Outline, pose_b: Pose) -> Overlap | None:
    """Where two closed outlines of plain numbers overlap, None where they do not.

    The ends of elements and points between them are asked, so that what overlaps by less than their spacing shows, may
    be overlooked; `nearest` sees each crossing.

    Args:
        a, b: closed outlines.
        pose_a, pose_b: where the bodies that carry them stand.
    """
    deepest: Overlap | None = None
    for which, (own, pose, other, beside) in enumerate(((a, pose_a, b, pose_b), (b, pose_b, a, pose_a))):
        turn, origin = cmath.rect(1.0, pose.angle), complex(pose.x, pose.y)
        edges = placed(other, beside)
        for k, element in enumerate(own.elements):
            for part in range(_ASKED):
                point = origin + turn * complex(*element.point(part / _ASKED))
                if is_inside(other, beside, point):
                    depth = min(abs(point - edge.nearest(point)) for edge in edges)
                    if deepest is None or depth > deepest.depth:
                        deepest = Overlap(depth, point, (which, k))
    return deepest
