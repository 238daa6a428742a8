"""What the pictures of friction share: a plane of two quantities with its axes, and text with subscripts."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

from docs.joints.sketch import THIN, Sketch

from .pictures import DIMENSION, HALO, INK, Point, View

#: Colours of what is compared.
FIRST, SECOND, THIRD = "#2b7a78", "#d9731a", "#6b46c1"
SMALL = 'font-style="normal" font-family="Helvetica, Arial, DejaVu Sans, sans-serif" font-size="13"'
FORMULA = 'font-size="16"'


@dataclass(frozen=True)
class Plane(Sketch):
    """A plane of two quantities: `scale` [px] is of one unit across, `up` [px] of one unit upwards."""

    up: float = 1.0

    def place(self, point: Point) -> Point:
        """The place of a point on the sheet [px]."""
        return self.origin[0] + self.scale * point[0], self.origin[1] - self.up * point[1]

    def curve(self, points: Sequence[Point], colour: str, width: float = 2.0, dash: str = "") -> str:
        """A line through points."""
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        return self.path(points, f'fill="none" stroke="{colour}" stroke-width="{width:g}"{dashes}')

    def region(self, points: Sequence[Point], colour: str, opacity: float) -> str:
        """A shaded part of the plane."""
        return self.path(points, f'fill="{colour}" fill-opacity="{opacity:g}"', closed=True)

    def mark(self, point: Point, colour: str) -> str:
        """A point that is reached."""
        return self.circle(point, 5, f'fill="{colour}" stroke="#fff" stroke-width="1.2"')

    def across(self, start: float, end: float, ticks: Sequence[float], name: str, at: float = 0.0) -> list[str]:
        """The axis to the right at the height `at`, its ticks with numbers below, its name at its end."""
        shaft = self.path([(start, at), (end, at)], f'{THIN} marker-end="url(#arrow{DIMENSION[1:]})"')
        return [
            shaft,
            *(self._tick((tick, at), 0.0, 4.0) for tick in ticks),
            *(words(self, (tick, at), _number(tick), SMALL, dy=18) for tick in ticks),
            words(self, (end, at), name, SMALL, dy=-9, anchor="end"),
        ]

    def upwards(self, start: float, end: float, ticks: Sequence[float], name: str, at: float = 0.0) -> list[str]:
        """The axis upwards at the place `at`, its ticks with numbers to the left, its name at its end."""
        shaft = self.path([(at, start), (at, end)], f'{THIN} marker-end="url(#arrow{DIMENSION[1:]})"')
        return [
            shaft,
            *(self._tick((at, tick), 4.0, 0.0) for tick in ticks),
            *(words(self, (at, tick), _number(tick), SMALL, dx=-8, dy=5, anchor="end") for tick in ticks),
            words(self, (at, end), name, SMALL, dx=8, dy=5, anchor="start"),
        ]

    def _tick(self, point: Point, dx: float, dy: float) -> str:
        x, y = self.place(point)
        return f'<path d="M{x - dx:.2f} {y - dy:.2f} L{x + dx:.2f} {y + dy:.2f}" {THIN}/>'


def _number(tick: float) -> str:
    return f"{tick:g}".replace("-", "−")


def words(
    view: View,
    point: Point,
    text: str,
    style: str = FORMULA,
    dx: float = 0.0,
    dy: float = 0.0,
    anchor: str = "middle",
    colour: str = INK,
    edge: str = HALO,
) -> str:
    """Text with a white edge, (dx, dy) px from a point; one letter behind `_` is a subscript."""
    x, y = view.place(point)
    pieces = re.split(r"_(\w)", escape(text, quote=False))
    shown = pieces[0]
    for index, behind in zip(pieces[1::2], pieces[2::2], strict=True):
        back = f'<tspan dy="-4">{behind}</tspan>' if behind else ""
        shown += f'<tspan dy="4" font-size="70%">{index}</tspan>{back}'
    place = f'x="{x + dx:.2f}" y="{y + dy:.2f}" text-anchor="{anchor}" fill="{colour}"'
    return f"<text {place} {style} {edge}>{shown}</text>"
