"""Pieces of the drawn figures: lines, bodies, arrows, dimensions, boxes; on an SVG canvas, y up, in metres."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape

Point = tuple[float, float]

INK, SOFT, FILL, GREY, ACCENT = "#1f2933", "#52606d", "#dbe4ec", "#b8c2cc", "#b23a48"
_FONT = "Arial, Helvetica, 'DejaVu Sans', sans-serif"
#: Length and half width of an arrow's head, and how far a dimension's label stands from its line [px].
_HEAD, _HALF, _OFF = 9.0, 3.2, 11.0


@dataclass(frozen=True)
class View:
    """Where a drawing goes on its sheet: `origin` [px] is (0, 0), `scale` in px for a unit of the drawing."""

    origin: Point
    scale: float

    def at(self, point: Point) -> Point:
        """Place on the sheet [px]."""
        return self.origin[0] + self.scale * point[0], self.origin[1] - self.scale * point[1]

    def line(self, points: Sequence[Point], colour: str = INK, width: float = 1.6, dash: str = "") -> str:
        """Straight lines from point to point."""
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        return (
            f'<polyline points="{_places(map(self.at, points))}" stroke="{colour}" stroke-width="{width:g}"{dashes}/>'
        )

    def area(self, points: Sequence[Point], colour: str = FILL, edge: str = INK) -> str:
        """A polygon."""
        return f'<polygon points="{_places(map(self.at, points))}" fill="{colour}" stroke="{edge}" stroke-width="1.4"/>'

    def arrow(self, start: Point, end: Point, colour: str = INK, both: bool = False) -> str:
        """A line with a head at its end, or at both ends."""
        a, b = self.at(start), self.at(end)
        heads = _head(a, b, colour) + (_head(b, a, colour) if both else "")
        return f'<polyline points="{_places((a, b))}" stroke="{colour}" stroke-width="1.2"/>{heads}'

    def arc(self, centre: Point, radius: float, start: float, end: float, text: str = "", out: float = 13.0) -> str:
        """An angle from `start` to `end` [rad], with an arrow's head at its end and a label outside its middle."""
        steps = max(4, math.ceil(abs(end - start) / 0.06))
        points = [polar(centre, radius, start + (end - start) * k / steps) for k in range(steps + 1)]
        places = [self.at(point) for point in points]
        beside = polar(centre, radius + out / self.scale, (start + end) / 2)
        drawn = f'<polyline points="{_places(places)}" stroke="{SOFT}" stroke-width="1.1"/>'
        return drawn + _head(places[-2], places[-1], SOFT) + (self.text(beside, text) if text else "")

    def size(self, start: Point, end: Point, text: str, offset: float = 0.0) -> str:
        """A dimension `offset` px to the left of start -> end."""
        across = direction(start, end) + math.pi / 2
        a, b = (polar(point, offset / self.scale, across) for point in (start, end))
        thin = [self.line([p, q], SOFT, 0.7) for p, q in ((start, a), (end, b)) if offset]
        # a long name stands farther from an upright line
        side = math.copysign(_OFF + 3.2 * (len(text) - 1) * abs(math.cos(across)), offset or 1.0)
        place = polar(middle(a, b), side / self.scale, across)
        return "".join([*thin, self.arrow(a, b, SOFT, both=True), self.text(place, text)])

    def dot(self, point: Point, radius: float = 3.5, colour: str = INK) -> str:
        """A point."""
        x, y = self.at(point)
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:g}" fill="{colour}"/>'

    def pin(self, point: Point) -> str:
        """A revolute joint."""
        x, y = self.at(point)
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="#ffffff" stroke="{INK}" stroke-width="1.6"/>'

    def hinge(self, point: Point) -> str:
        """A revolute joint on the ground."""
        x, y = self.at(point)
        hatch = "".join(f"M{x + k:.1f} {y + 18:.1f}l-5 6" for k in (-9, -3, 3, 9, 15))
        return (
            f'<path d="M{x:.1f} {y:.1f}l-10 18h20Z" fill="#ffffff" stroke="{INK}" stroke-width="1.4"/>'
            f'<path d="M{x - 15:.1f} {y + 18:.1f}h30{hatch}" stroke="{INK}" stroke-width="1.1"/>{self.pin(point)}'
        )

    def wall(self, start: Point, end: Point) -> str:
        """A clamp along start -> end, hatched to its left."""
        a, b = self.at(start), self.at(end)
        ex, ey = polar((0.0, 0.0), 1.0, direction(a, b))
        hatch = "".join(
            f"M{a[0] + k * ex:.1f} {a[1] + k * ey:.1f}l{7 * (ey - ex):.1f} {7 * (-ex - ey):.1f}"
            for k in range(4, int(math.dist(a, b)) + 1, 8)
        )
        return f'<path d="M{a[0]:.1f} {a[1]:.1f}L{b[0]:.1f} {b[1]:.1f}{hatch}" stroke="{INK}" stroke-width="1.5"/>'

    def text(self, point: Point, text: str, dx: float = 0.0, dy: float = 0.0, size: float = 14.0) -> str:
        """A label centred at a point, moved by px, with a white edge."""
        x, y = self.at(point)
        return label((x + dx, y + dy), text, size)


def label(at: Point, text: str, size: float = 14.0, anchor: str = "middle") -> str:
    """A text at a place on the sheet [px], half its height above and below, with a white edge."""
    attributes = f'x="{at[0]:.1f}" y="{at[1]:.1f}" dy="0.35em" font-size="{size:g}" text-anchor="{anchor}"'
    # the white edge is a text of its own: not every viewer knows paint-order
    edge = f'<text {attributes} stroke="#ffffff" stroke-width="4">{escape(text)}</text>'
    return f'{edge}<text {attributes} fill="{INK}">{escape(text)}</text>'


def box(x: float, y: float, width: float, lines: Sequence[str], kind: str = "step") -> str:
    """A box of a flow chart, its upper middle at (x, y) [px]: "step", "choice" or "end"."""
    height = box_height(lines, kind)
    left, half = x - width / 2, y + height / 2
    corners = _places(((x, y), (x + width / 2, half), (x, y + height), (left, half)))
    at = f'x="{left:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}"'
    shape = {
        "choice": f'<polygon points="{corners}" fill="#fff4d6"',
        "end": f'<rect {at} rx="{height / 2:g}" fill="#e3f1e6"',
        "step": f'<rect {at} rx="4" fill="#eef3f7"',
    }[kind]
    texts = "".join(_plain((x, half + 18 * k - 9 * (len(lines) - 1)), line) for k, line in enumerate(lines))
    return f'{shape} stroke="{INK}" stroke-width="1.3"/>{texts}'


def box_height(lines: Sequence[str], kind: str = "step") -> float:
    """Of a box [px]."""
    return 18.0 * len(lines) + (44 if kind == "choice" else 14)


def flow(points: Sequence[Point], text: str = "", at: Point | None = None) -> str:
    """An arrow of a flow chart through places on the sheet [px], with a label."""
    said = label(at, text, 12.5) if at is not None else ""
    line = f'<polyline points="{_places(points)}" stroke="{INK}" stroke-width="1.3"/>'
    return line + _head(points[-2], points[-1], INK) + said


def sheet(width: int, height: int, title: str, *parts: str) -> str:
    """The whole SVG text."""
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
            f'height="{height}" font-family="{_FONT}" fill="none" stroke-linejoin="round" stroke-linecap="round">',
            f"<title>{escape(title)}</title>",
            f'<rect width="{width}" height="{height}" fill="#ffffff"/>',
            *parts,
            "</svg>\n",
        ]
    )


def polar(centre: Point, radius: float, angle: float) -> Point:
    """The point at `radius` and `angle` [rad] from a centre."""
    return centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)


def direction(start: Point, end: Point) -> float:
    """Of a line from start to end [rad]."""
    return math.atan2(end[1] - start[1], end[0] - start[0])


def middle(a: Point, b: Point) -> Point:
    """Halfway between two points."""
    return (a[0] + b[0]) / 2, (a[1] + b[1]) / 2


def _plain(at: Point, text: str) -> str:
    return (
        f'<text x="{at[0]:.1f}" y="{at[1]:.1f}" dy="0.35em" font-size="13" text-anchor="middle" '
        f'fill="{INK}">{escape(text)}</text>'
    )


def _head(start: Point, end: Point, colour: str) -> str:
    """The head of an arrow on the sheet that ends in `end`."""
    back = direction(end, start)
    base = polar(end, _HEAD, back)
    corners = (end, polar(base, _HALF, back - math.pi / 2), polar(base, _HALF, back + math.pi / 2))
    return f'<polygon points="{_places(corners)}" fill="{colour}"/>'


def _places(points: Iterable[Point]) -> str:
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
