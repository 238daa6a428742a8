"""Pieces of the drawings of joints: bodies, vectors, points; in the style of the models' drawings."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from docs.drawings.pictures import DIMENSION, HALO, INK, Point, View, polar, sheet

BODY_I, BODY_J = "#c9d2dc", "#e9c46a"
EDGE = f'stroke="{INK}" stroke-width="1.6"'
LINE = f'fill="none" stroke="{INK}" stroke-width="1.6"'
AXIS = 'fill="none" stroke="#7b8794" stroke-width="1" stroke-dasharray="9 4 2 4"'
THIN = f'fill="none" stroke="{DIMENSION}" stroke-width="0.8"'
ACCENT = "#b23a48"
NOTE = 'font-style="normal" font-family="Helvetica, Arial, DejaVu Sans, sans-serif" font-size="14"'

_ARROWS = {INK: f"arrow{INK[1:]}", DIMENSION: f"arrow{DIMENSION[1:]}"}


@dataclass(frozen=True)
class Sketch(View):
    """A view with what drawings of joints need; lengths are in units of the drawing, offsets in px."""

    def blob(self, centre: Point, outline: Sequence[tuple[float, float]], colour: str) -> str:
        """A body: a smooth closed line through points (degrees, radius) around a centre."""
        corners = [self.place(polar(centre, radius, math.radians(angle))) for angle, radius in outline]
        return self._smooth(corners, f'fill="{colour}" fill-opacity="0.75" {EDGE}')

    def box(self, centre: Point, length: float, height: float, angle: float, colour: str) -> str:
        """A body: a rectangle that is turned by an angle [rad]."""
        corners = [(sx * length / 2, sy * height / 2) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        turned = [add(centre, turn(corner, angle)) for corner in corners]
        return self.path(turned, f'fill="{colour}" fill-opacity="0.75" {EDGE}', closed=True)

    def disc(self, centre: Point, radius: float, style: str) -> str:
        """A circle whose radius is in units of the drawing."""
        return self.circle(centre, round(radius * self.scale, 2), style)

    def vector(self, start: Point, end: Point, text: str, dx: float = 0.0, dy: float = 0.0, at: float = 0.5) -> str:
        """An arrow with its label (dx, dy) px from a place along it."""
        shaft = f'fill="none" stroke="{INK}" stroke-width="1.8" marker-end="url(#{_ARROWS[INK]})"'
        return self.path([start, end], shaft) + self.text(along(start, end, at), text, dx, dy)

    def text(self, point: Point, text: str, dx: float = 0.0, dy: float = 0.0) -> str:
        """A label with a white edge, centred (dx, dy) px from a point."""
        return self.label(point, text, HALO, dx, dy + 6)

    def note(self, point: Point, text: str, dy: float = 0.0) -> str:
        """A remark in upright letters."""
        return self.label(point, text, NOTE, dy=dy)

    def centre(self, point: Point, text: str, dx: float = 0.0, dy: float = 0.0) -> str:
        """A centre of mass, marked as usual, with its label."""
        x, y = self.place(point)
        quarters = (
            f'<path d="M{x:.2f} {y:.2f} v-6 a6 6 0 0 1 6 6 Z M{x:.2f} {y:.2f} v6 a6 6 0 0 1 -6 -6 Z" fill="{INK}"/>'
        )
        ring = self.circle(point, 6, f'fill="#fff" stroke="{INK}" stroke-width="1.2"')
        return ring + quarters + self.text(point, text, dx, dy)

    def dot(self, point: Point, text: str = "", dx: float = 0.0, dy: float = 0.0) -> str:
        """A point with its label."""
        mark = self.circle(point, 4, f'fill="{ACCENT}" stroke="#fff" stroke-width="1"')
        return mark + (self.text(point, text, dx, dy) if text else "")

    def pin(self, point: Point, text: str = "", dx: float = 0.0, dy: float = 0.0) -> str:
        """A pin with its label."""
        mark = self.circle(point, 8, f'fill="#fff" {EDGE}') + self.circle(point, 2.5, f'fill="{ACCENT}"')
        return mark + (self.text(point, text, dx, dy) if text else "")

    def outline(self, rho: Callable[[float], float], centre: Point, style: str, first: float, last: float) -> str:
        """A profile rho(alpha) from one angle to another [rad], closed when that is a turn."""
        steps = max(2, round((last - first) / 0.02))
        angles = [first + (last - first) * k / steps for k in range(steps + 1)]
        whole = last - first > 2 * math.pi - 1e-9
        points = [polar(centre, rho(a), a) for a in (angles[:-1] if whole else angles)]
        return self.path(points, style, closed=whole)

    def right_angle(self, corner: Point, along_it: Point, size: float = 0.12) -> str:
        """The mark of a right angle, counter-clockwise of a unit vector."""
        a, b = scale(along_it, size), scale(quarter(along_it), size)
        return self.path([add(corner, a), add(corner, a, b), add(corner, b)], THIN)

    def _smooth(self, corners: Sequence[Point], style: str) -> str:
        """A closed Catmull-Rom curve through places on the sheet."""
        n = len(corners)
        parts = [f"M{corners[0][0]:.2f} {corners[0][1]:.2f}"]
        for k in range(n):
            before, start, end, after = (corners[(k + shift) % n] for shift in (-1, 0, 1, 2))
            first = add(start, scale(minus(end, before), 1 / 6))
            second = add(end, scale(minus(after, start), -1 / 6))
            parts.append("C" + " ".join(f"{x:.2f} {y:.2f}" for x, y in (first, second, end)))
        return f'<path d="{" ".join(parts)} Z" {style}/>'


def add(*points: Point) -> Point:
    """Sum of points."""
    return sum(x for x, _ in points), sum(y for _, y in points)


def minus(a: Point, b: Point) -> Point:
    """A - b."""
    return a[0] - b[0], a[1] - b[1]


def scale(a: Point, factor: float) -> Point:
    """A vector times a factor."""
    return a[0] * factor, a[1] * factor


def turn(a: Point, angle: float) -> Point:
    """A vector, turned counter-clockwise [rad]."""
    c, s = math.cos(angle), math.sin(angle)
    return c * a[0] - s * a[1], s * a[0] + c * a[1]


def quarter(a: Point) -> Point:
    """R a: a vector, turned by 90 degrees."""
    return -a[1], a[0]


def along(start: Point, end: Point, part: float) -> Point:
    """The point at a part of the way."""
    return add(start, scale(minus(end, start), part))


def joint_sketch() -> Sketch:
    """The view of the drawing of a joint."""
    return Sketch((40, 300), 100)


def joint_sheet(title: str, parts: Sequence[str]) -> str:
    """The SVG text of the drawing of a joint."""
    return sheet(520, 340, title, parts)
