"""The two pictures of a model: a drawing in SVG, y upwards, and an icon by matplotlib (`pip install ".[docs]"`)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

# A few pieces of SVG in the style of an engineering drawing; y points up.

Point = tuple[float, float]

INK, DIMENSION = "#1f2933", "#52606d"


@dataclass(frozen=True)
class View:
    """Where a drawing in metres goes on the sheet: `origin` [px] is the point (0, 0), `scale` is in px/m."""

    origin: Point
    scale: float

    def place(self, point: Point) -> Point:
        """The place of a point [m] on the sheet [px]."""
        return self.origin[0] + self.scale * point[0], self.origin[1] - self.scale * point[1]

    def path(self, points: Sequence[Point], style: str, closed: bool = False) -> str:
        """A polyline or polygon."""
        corners = " L".join(f"{x:.2f} {y:.2f}" for x, y in map(self.place, points))
        return f'<path d="M{corners}{" Z" if closed else ""}" {style}/>'

    def circle(self, centre: Point, radius: float, style: str) -> str:
        """A circle; `radius` in px, because it marks a point."""
        x, y = self.place(centre)
        return f'<circle cx="{x:.2f}" cy="{y:.2f}" r="{radius:g}" {style}/>'

    def label(self, point: Point, text: str, style: str = "", dx: float = 0.0, dy: float = 0.0) -> str:
        """Text centred at `point`, moved by (dx, dy) px; `^` in it starts a subscript."""
        x, y = self.place(point)
        head, _, index = text.partition("^")
        sub = f'<tspan dy="5" font-size="70%">{index}</tspan>' if index else ""
        return f'<text x="{x + dx:.2f}" y="{y + dy:.2f}" {style}>{head}{sub}</text>'

    def hinge(self, point: Point) -> str:
        """A hinge to the ground: pin, bracket and hatching."""
        x, y = self.place(point)
        hatch = "".join(f"M{x + s:.2f} {y + 22:.2f} l-6 7 " for s in (-10, -2, 6, 14))
        return (
            f'<path d="M{x:.2f} {y:.2f} l-13 22 h26 Z" fill="#fff" stroke="{INK}" stroke-width="1.6"/>'
            f'<path d="M{x - 19:.2f} {y + 22:.2f} h38 {hatch}" fill="none" stroke="{INK}" stroke-width="1.4"/>'
            f'<circle cx="{x:.2f}" cy="{y:.2f}" r="5" fill="#fff" stroke="{INK}" stroke-width="1.8"/>'
        )

    def angle(self, centre: Point, radius: float, start: float, end: float, text: str, out: float = 13.0) -> str:
        """An angle arc from `start` to `end` [rad], arrow at the end, label `out` px outside its middle."""
        steps = max(2, math.ceil(abs(end - start) / 0.05))
        turns = [start + (end - start) * k / steps for k in range(steps + 1)]
        arc = self.path([polar(centre, radius, t) for t in turns], _arrow(INK, "end"))
        middle = polar(centre, radius + out / self.scale, (start + end) / 2)
        return arc + self.label(middle, text, dy=6)

    def length(self, start: Point, end: Point, offset: float, text: str) -> str:
        """A dimension of the distance between two points, drawn `offset` px to the left of start -> end."""
        (x1, y1), (x2, y2) = start, end
        distance = math.hypot(x2 - x1, y2 - y1)
        nx, ny = -(y2 - y1) / distance, (x2 - x1) / distance
        d = offset / self.scale
        over = d + math.copysign(5 / self.scale, offset)
        a, b = (x1 + d * nx, y1 + d * ny), (x2 + d * nx, y2 + d * ny)
        thin = f'stroke="{DIMENSION}" stroke-width="0.8" fill="none"'
        ends = [self.path([p, (p[0] + over * nx, p[1] + over * ny)], thin) for p in (start, end) if offset]
        middle = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
        return "".join([*ends, self.path([a, b], _arrow(DIMENSION, "both")), self.label(middle, text, HALO, dy=6)])


#: Text with a white edge, legible on top of lines.
HALO = 'paint-order="stroke" stroke="#fff" stroke-width="6" stroke-linejoin="round"'


def polar(centre: Point, radius: float, angle: float) -> Point:
    """The point at `radius` and `angle` [rad] from a centre."""
    return centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)


def sheet(width: int, height: int, title: str, parts: Sequence[str]) -> str:
    """The whole SVG text."""
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
        'font-family="Georgia, DejaVu Serif, serif" font-size="19" font-style="italic" text-anchor="middle" '
        f'fill="{INK}" stroke-linejoin="round" stroke-linecap="round">'
    )
    marker = (
        '<marker id="{0}" markerUnits="userSpaceOnUse" markerWidth="12" markerHeight="12" refX="11" refY="5" '
        'orient="auto-start-reverse"><path d="M1 1.6 L11 5 L1 8.4 Z" fill="{1}" stroke="none"/></marker>'
    )
    markers = "".join(marker.format(f"arrow{colour[1:]}", colour) for colour in (INK, DIMENSION))
    background = f'<rect width="{width}" height="{height}" fill="#fff"/>'
    return "\n".join([head, f"<title>{title}</title>", f"<defs>{markers}</defs>", background, *parts, "</svg>", ""])


def _arrow(colour: str, where: str) -> str:
    url = f"url(#arrow{colour[1:]})"
    start = f'marker-start="{url}" ' if where == "both" else ""
    return f'fill="none" stroke="{colour}" stroke-width="1.1" {start}marker-end="{url}"'


# The icon of a model, made with matplotlib (`pip install ".[docs]"`).


@contextmanager
def icon_axes(path: Path, margin: float = 0.05) -> Iterator[Any]:
    """Axes without a frame, 100 x 100 px; at the end, what has been drawn in them is written.

    Args:
        path: of the PNG file.
        margin: around what is drawn, as a fraction of its size.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(1, 1), dpi=100)
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.02, 0.02, 0.96, 0.96))
    yield axes
    axes.set_aspect("equal")
    axes.margins(margin)
    axes.axis("off")
    figure.savefig(path, transparent=True, metadata={"Software": None})


# The two pictures of a model, in its folder.


def rewrite(model: str, drawn: str, icon: Callable[[SimpleNamespace, Path], None], values: SimpleNamespace) -> None:
    """Write drawing.svg and model.png.

    Args:
        model: its folder in `models`.
        drawn: the drawing, as SVG text.
        icon: draws the icon for parameter values, into a file.
        values: for the icon.

    Raises:
        ModuleNotFoundError: matplotlib is missing; the drawing is written before.
    """
    folder = Path(__file__).parents[2] / "models" / model
    (folder / "drawing.svg").write_text(drawn, encoding="utf-8")
    icon(values, folder / "model.png")
