"""Panels of a picture of overlapping bodies: points to pixels, arcs as fine as the magnification asks, clipping."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from itertools import pairwise
from typing import NamedTuple

from .body import Point

#: An element of a chain: its two ends [m], and its bulge.
Element = tuple[Point, Point, float]

#: Size of a panel [px], the margin around it, and the height of the texts above.
_SIZE, _MARGIN, _HEAD = 320, 12, 48
_STYLES = {
    ("i", "body"): 'fill="#1f77b4" fill-opacity="0.45" stroke="#1f77b4" stroke-width="1.5"',
    ("j", "body"): 'fill="#888888" fill-opacity="0.45" stroke="#333333" stroke-width="1.5"',
    ("i", "line"): 'fill="none" stroke="#1f77b4" stroke-width="2.5"',
    ("j", "line"): 'fill="none" stroke="#333333" stroke-width="2.5"',
}
_OVERLAP = 'fill="none" stroke="#b23a48" stroke-width="2.5"'
#: Straight lines that show an arc as a whole; and where it is magnified, so many halvings of the way to the place.
_ARC, _HALVINGS = 24, 48


@dataclass(frozen=True)
class Part:
    """A part of a body: a filled area or a line.

    Attributes:
        chain: points [m], or elements.
        owner: "i" or "j".
        kind: "body" or "line".
        elements: instead of points.
    """

    chain: Sequence[Point]
    owner: str
    kind: str
    elements: Sequence[Element] = ()

    @classmethod
    def of(cls, elements: Sequence[Element], owner: str, kind: str) -> Part:
        """A part that consists of segments and arcs."""
        return cls((), owner, kind, elements)

    def points(self, near: Point | None = None) -> list[Point]:
        """Its points, those of arcs the closer together the nearer they are to a place [m]."""
        if not self.elements:
            return [*self.chain]
        found = [point for element in self.elements for point in _points_of(element, near)]
        return [*found, self.elements[-1][1]]


class Line(NamedTuple):
    """How deep it is: from the deepest point to the surface [m]."""

    ends: tuple[Point, Point]
    label: str


@dataclass(frozen=True)
class Panel:
    """One view.

    Attributes:
        parts: what it shows.
        mark: how deep it is, or None.
        middle: what is in its middle [m]; None: all that there is.
        reach: how far it reaches from there [m].
    """

    parts: Sequence[Part]
    mark: Line | None = None
    middle: Point | None = None
    reach: float = 0.0


def _points_of(element: Element, near: Point | None) -> Iterator[Point]:
    """The start of an element, and points along its arc."""
    (x, y), (u, v), bulge = element
    yield x, y
    if bulge == 0.0:
        return
    beside = (1.0 - bulge * bulge) / (4.0 * bulge)
    cx, cy = (x + u) / 2 - beside * (v - y), (y + v) / 2 + beside * (u - x)
    radius, first, sweep = math.hypot(x - cx, y - cy), math.atan2(y - cy, x - cx), 4.0 * math.atan(bulge)
    places = {k / _ARC for k in range(1, _ARC)}
    if near is not None:
        turn = math.atan2(near[1] - cy, near[0] - cx) - first
        turn = math.remainder(turn - sweep / 2, 2 * math.pi) + sweep / 2
        places |= {turn / sweep + way * 0.5**k for k in range(2, _HALVINGS) for way in (-1.0, 1.0)}
        places |= {turn / sweep}
    for place in sorted(place for place in places if 0.0 < place < 1.0):
        angle = first + place * sweep
        yield cx + radius * math.cos(angle), cy + radius * math.sin(angle)


def sheet(title: str, text: str, panels: Sequence[Panel]) -> str:
    """A whole SVG file of panels side by side, below a title and a line of text.

    Args:
        title: what it is about.
        text: a sentence about it.
        panels: from left to right.
    """
    width = len(panels) * (_SIZE + _MARGIN) + _MARGIN
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{_HEAD + _SIZE + _MARGIN}" '
        'font-family="sans-serif" font-size="12">',
        f"<title>{escape(title)}</title>",
        '<rect width="100%" height="100%" fill="white"/>',
        f'<text x="{_MARGIN}" y="18" font-weight="bold">{escape(title)}</text>',
        f'<text x="{_MARGIN}" y="36">{escape(text)}</text>',
    ]
    for place, panel in enumerate(panels):
        left = _MARGIN + place * (_SIZE + _MARGIN)
        parts += [f'<svg x="{left}" y="{_HEAD}" width="{_SIZE}" height="{_SIZE}">', *_panel(panel), "</svg>"]
    return "\n".join([*parts, "</svg>", ""])


def _panel(panel: Panel) -> Iterator[str]:
    shapes = [(part, part.points(panel.middle)) for part in panel.parts]
    (mx, my), reach = (panel.middle, panel.reach) if panel.middle is not None else _around(shapes)
    scale = _SIZE / 2 / reach

    def pixels(point: Point) -> Point:
        return _SIZE / 2 + scale * (point[0] - mx), _SIZE / 2 - scale * (point[1] - my)

    for part, points in shapes:
        moved = [(x - mx, y - my) for x, y in points]
        pieces = [_clipped(moved, reach)] if part.kind == "body" else _inside(moved, reach)
        for piece in pieces:
            if len(piece) > 1:
                shown = " ".join("{:.2f},{:.2f}".format(*pixels((x + mx, y + my))) for x, y in piece)
                what = "polygon" if part.kind == "body" else "polyline"
                yield f'<{what} points="{shown}" {_STYLES[part.owner, part.kind]}/>'
    if panel.mark is not None:
        (x, y), (u, v) = map(pixels, panel.mark.ends)
        yield f'<circle cx="{x:.2f}" cy="{y:.2f}" r="4" {_OVERLAP}/>'
        if (x, y) != (u, v):
            yield f'<line class="{panel.mark.label}" x1="{x:.2f}" y1="{y:.2f}" x2="{u:.2f}" y2="{v:.2f}" {_OVERLAP}/>'
    yield f'<rect width="{_SIZE}" height="{_SIZE}" fill="none" stroke="#aaaaaa"/>'
    yield f'<text x="6" y="{_SIZE - 6}">{2.0 * reach:.3g} m across</text>'


def _around(shapes: Sequence[tuple[Part, list[Point]]]) -> tuple[Point, float]:
    """The middle of all points, and how far they reach, with some space around [m]."""
    xs = [x for _, points in shapes for x, _ in points]
    ys = [y for _, points in shapes for _, y in points]
    reach = 0.55 * max(max(xs) - min(xs), max(ys) - min(ys))
    return ((min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2), reach or 1.0


#: The four edges of a square: which coordinate they bound, and on which side.
_EDGES = ((0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0))


def _clipped(points: list[Point], reach: float) -> list[Point]:
    """The part of a closed chain within a square about the origin (Sutherland and Hodgman), and a bit around it."""
    limit = 1.1 * reach
    for axis, side in _EDGES:
        kept: list[Point] = []
        for k, point in enumerate(points):
            before = points[k - 1]
            out, was_out = side * point[axis] > limit, side * before[axis] > limit
            if out != was_out:
                kept.append(_cut(before, point, axis, side * limit))
            if not out:
                kept.append(point)
        points = kept
    return points


def _cut(one: Point, other: Point, axis: int, level: float) -> Point:
    part = (level - one[axis]) / (other[axis] - one[axis])
    found = [one[k] + part * (other[k] - one[k]) for k in (0, 1)]
    found[axis] = level
    return found[0], found[1]


def _inside(points: list[Point], reach: float) -> Iterator[list[Point]]:
    """The parts of an open chain within a square about the origin, each piece of the way by itself."""
    limit = 1.1 * reach
    for one, other in pairwise(points):
        ends: list[Point] | None = [one, other]
        for axis, side in _EDGES:
            assert ends is not None
            outside = [side * end[axis] > limit for end in ends]
            if all(outside):
                ends = None
                break
            if any(outside):
                place = outside.index(True)
                ends[place] = _cut(ends[1 - place], ends[place], axis, side * limit)
        if ends is not None:
            yield ends
