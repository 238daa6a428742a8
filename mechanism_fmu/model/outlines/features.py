"""Features of outlines as the engine reads them: vertices and elements in turn, with their numbers (`codes`)."""

from __future__ import annotations

from collections.abc import Iterator

from ... import codes
from ..body import Point
from ..findings import length
from ..functions import Number, atan2, cos, maximum, minimum, sin, where_positive
from .element import Element
from .outline import Outline

#: Kind and numbers of a feature, in the order of the columns in `codes`.
Feature = tuple[int, tuple[Number, ...]]


def features(outline: Outline, step: Step | None = None) -> Iterator[Feature]:
    """Vertex, element, vertex, element ...; an open chain ends with a vertex.

    Where the copies of an open chain join, the vertex between two of them is the first one of that which begins there;
    the last one of the other sticks out nowhere.

    Args:
        outline: in the frame of its body.
        step: from one of its copies to the next: an angle [rad], and lengths in x and y [m]; None: it has none.
    """
    elements = outline.elements
    tangents = [element.tangents() for element in elements]
    for k, element in enumerate(elements):
        if k > 0 or outline.closed:
            vertex = _vertex(element.start, tangents[k - 1][1], tangents[k][0])
        else:
            vertex = _first_end(element.start, tangents[0][0], elements[-1].end, tangents[-1][1], step)
        yield codes.VERTEX, vertex
        yield _element(element)
    if not outline.closed:
        yield codes.VERTEX, _last_end(elements[-1].end, tangents[-1][1], elements[0].start, tangents[0][0], step)


def _vertex(at: Point, arrives: Point, leaves: Point) -> tuple[Number, ...]:
    return (*at, *arrives, *leaves, arrives[0] * leaves[1] - arrives[1] * leaves[0])


#: From one copy to the next: an angle [rad], and lengths in x and y [m].
Step = tuple[Number, Number, Number]

#: Ends of copies join that are nearer to each other than this part of how far they are from the origin, and from one
#: end of the chain to the other.
_JOIN_WITHIN = 1e-9


def _first_end(at: Point, leaves: Point, last: Point, arrives: Point, step: Step | None) -> tuple[Number, ...]:
    """The first vertex of an open chain: free, or where the copy before it ends."""
    numbers: tuple[Number, ...] = (*at, 0.0, 0.0, *leaves, codes.FREE_END)
    for way in (1, -1) if step is not None else ():
        turned = _vertex(at, _moved(arrives, step, way, 0.0), leaves)
        numbers = _if_joined(_moved(last, step, way), at, (at[0] - last[0], at[1] - last[1]), turned, numbers)
    return numbers


def _last_end(at: Point, arrives: Point, first: Point, leaves: Point, step: Step | None) -> tuple[Number, ...]:
    """The last vertex of an open chain: free, or where the next copy begins, which has the corner if there is one."""
    numbers: tuple[Number, ...] = (*at, *arrives, 0.0, 0.0, codes.FREE_END)
    for way in (1, -1) if step is not None else ():
        *data, turn = _vertex(at, arrives, _moved(leaves, step, way, 0.0))
        chord = at[0] - first[0], at[1] - first[1]
        numbers = _if_joined(_moved(first, step, way), at, chord, (*data, minimum(turn, 0.0)), numbers)
    return numbers


def _if_joined(
    one: Point, other: Point, chord: Point, then: tuple[Number, ...], otherwise: tuple[Number, ...]
) -> tuple[Number, ...]:
    dx, dy = one[0] - other[0], one[1] - other[1]
    far: Number = sum((u * u + v * v for u, v in (one, other, chord)), 0.0)
    left = _JOIN_WITHIN * _JOIN_WITHIN * far - dx * dx - dy * dy
    return tuple(where_positive(left, a, b) for a, b in zip(then, otherwise, strict=True))


def _moved(point: Point, step: Step | None, way: int, shift: float = 1.0) -> Point:
    """A point of the copy `way` steps further; with `shift` 0, a direction there."""
    assert step is not None
    angle, x, y = step
    c, s = cos(way * angle), sin(way * angle)
    return (c * point[0] - s * point[1] + shift * way * x, s * point[0] + c * point[1] + shift * way * y)


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
