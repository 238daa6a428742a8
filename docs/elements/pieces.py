"""Pieces of the drawings of force elements: springs, dampers, the ground."""

from __future__ import annotations

import math

from docs.drawings.pictures import INK, Point, sheet
from docs.joints.sketch import LINE, Sketch, add, along, quarter, scale

HATCH = f'fill="none" stroke="{INK}" stroke-width="1.1"'


class ElementSketch(Sketch):
    """A view with what drawings of force elements need."""

    def spring(self, start: Point, end: Point, coils: int = 6, width: float = 0.12) -> str:
        """A coil spring as a zigzag between straight ends."""
        across = scale(_normal(start, end), width)
        corners = [start, along(start, end, 0.2)]
        for k in range(2 * coils):
            side = scale(across, 1.0 if k % 2 else -1.0)
            corners.append(add(along(start, end, 0.2 + 0.6 * (k + 0.5) / (2 * coils)), side))
        return self.path([*corners, along(start, end, 0.8), end], LINE)

    def damper(self, start: Point, end: Point, width: float = 0.13) -> str:
        """A dashpot: a cylinder, open to the end, and a piston in it."""
        across = scale(_normal(start, end), width)
        back, mouth, piston = along(start, end, 0.35), along(start, end, 0.66), along(start, end, 0.55)
        other = scale(across, -1.0)
        cylinder = [add(mouth, across), add(back, across), add(back, other), add(mouth, other)]
        rod = [add(piston, scale(across, 0.8)), add(piston, scale(other, 0.8))]
        lines = [[start, back], cylinder, rod, [piston, end]]
        return "".join(self.path(line, LINE) for line in lines)

    def ground(self, start: Point, end: Point) -> str:
        """A fixed line with hatching to its right, as seen from start to end."""
        across = scale(_normal(start, end), -0.12)
        size = math.hypot(end[0] - start[0], end[1] - start[1])
        count = max(2, round(size / 0.14))
        back = scale(add(end, scale(start, -1.0)), -0.1 / size)
        strokes = [along(start, end, (k + 0.7) / count) for k in range(count)]
        hatching = "".join(self.path([place, add(place, across, back)], HATCH) for place in strokes)
        return self.path([start, end], LINE) + hatching


def element_sketch() -> ElementSketch:
    """The view of the drawing of an element, 5.2 x 3.4 units from (-0.4, -0.4)."""
    return ElementSketch((40, 300), 100)


def element_sheet(title: str, parts: list[str]) -> str:
    """The SVG text of the drawing of an element."""
    return sheet(520, 340, title, parts)


def _normal(start: Point, end: Point) -> Point:
    x, y = end[0] - start[0], end[1] - start[1]
    return scale(quarter((x, y)), 1 / math.hypot(x, y))
