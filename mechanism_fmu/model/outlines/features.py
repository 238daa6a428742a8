"""Features of outlines as the engine reads them: vertices and elements in turn, with their numbers (`codes`)."""

from __future__ import annotations

from collections.abc import Iterator

from ... import codes
from ..body import Point
from ..findings import length
from ..functions import Number, atan2, maximum, where_positive
from .element import Element
from .outline import Outline

#: Kind and numbers of a feature, in the order of the columns in `codes`.
Feature = tuple[int, tuple[Number, ...]]


def features(outline: Outline) -> Iterator[Feature]:
    """Vertex, element, vertex, element ...; an open chain ends with a vertex.

    Args:
        outline: in the frame of its body.
    """
    elements = outline.elements
    tangents = [element.tangents() for element in elements]
    for k, element in enumerate(elements):
        arrives = tangents[k - 1][1] if k > 0 or outline.closed else None
        yield codes.VERTEX, _vertex(element.start, arrives, tangents[k][0])
        yield _element(element)
    if not outline.closed:
        yield codes.VERTEX, _vertex(elements[-1].end, tangents[-1][1], None)


def _vertex(at: Point, arrives: Point | None, leaves: Point | None) -> tuple[Number, ...]:
    if arrives is None or leaves is None:
        free = (0.0, 0.0)
        return (*at, *(arrives or free), *(leaves or free), codes.FREE_END)
    return (*at, *arrives, *leaves, arrives[0] * leaves[1] - arrives[1] * leaves[0])


def _element(element: Element) -> Feature:
    dx, dy = element.chord
    long = length((dx, dy))
    if element.is_straight:
        return codes.SEGMENT, (*element.start, dx / long, dy / long, long, 0.0, 0.0)
    side = where_positive(element.bulge, 1.0, -1.0)
    to_middle = side * dy / long, -side * dx / long
    half = 2.0 * atan2(side * element.bulge, 1.0)
    return codes.ARC, (*element.centre, *to_middle, element.radius, half, 0.0)


def around(outline: Outline) -> tuple[Number, Number, Number]:
    """Centre and radius of a circle around an outline [m].

    Args:
        outline: in the frame of its body.
    """
    points = outline.points
    x, y = sum(p[0] for p in points) / len(points), sum(p[1] for p in points) / len(points)
    radius: Number = 0.0
    for element in outline.elements:
        (u, v), (p, q) = element.start, element.end
        reach = maximum(length((u - x, v - y)), length((p - x, q - y)))
        if (
            not element.is_straight
        ):  # no point of an arc is farther from one of its ends than its sagitta and half chord
            half = length(element.chord) / 2
            side = where_positive(element.bulge, element.bulge, -1.0 * element.bulge)
            mx, my = (u + p) / 2, (v + q) / 2
            reach = maximum(reach, length((mx - x, my - y)) + half * maximum(side, 1.0))
        radius = maximum(radius, reach)
    return x, y, radius
