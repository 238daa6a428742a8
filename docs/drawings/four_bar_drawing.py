"""The drawing and the icon of the four-bar linkage, made from the model's own geometry.

    python -m docs.drawings.four_bar_drawing      rewrites drawing.svg and model.png beside this file

The icon needs matplotlib (`pip install ".[docs]"`); the drawing needs nothing.
"""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

from mechanism_fmu.model.four_bar import start
from models.four_bar.model import MODEL

from .pictures import INK, Point, View, icon_axes, polar, rewrite, sheet

CRANK, COUPLER, ROCKER = "#2b7a78", "#d9731a", "#6b46c1"

_EDGE = f'stroke="{INK}" stroke-width="1.6"'
_AXIS = 'fill="none" stroke="#7b8794" stroke-width="1" stroke-dasharray="9 4 2 4"'
_NOTE = 'font-style="normal" font-family="Helvetica, Arial, DejaVu Sans, sans-serif" font-size="14"'

_CRANK_ANGLE = math.radians(60)


def drawing(values: SimpleNamespace) -> str:
    """The linkage open, with its lengths and angles, and crossed, as SVG text."""
    crossed = SimpleNamespace(**{**vars(values), "crossed": 1.0})
    scale = 300 / values.ground_length
    left, right = View((100, 270), scale), View((660, 270), scale)
    d, a = values.ground_length, values.crank_length
    pin, _ = _points(values)
    at = start(values)
    parts = [
        left.path([(-0.2 * d, 0.0), (1.35 * d, 0.0)], _AXIS),
        left.path([pin, (pin[0] + 1.1 * a, pin[1])], _AXIS),
        *_links(left, values),
        left.length((0.0, 0.0), (d, 0.0), -75, "d"),
        *(
            left.length(begin, end, offset, name)
            for (begin, end, _), offset, name in zip(_bars(values), (30, 30, -30), "abc", strict=True)
        ),
        left.angle((0.0, 0.0), 0.6 * a, 0.0, values.crank_angle_start, "θ"),
        left.angle(pin, 0.9 * a, 0.0, at.coupler_angle, "φ"),
        left.angle((d, 0.0), 0.6 * a, 0.0, at.rocker_angle, "ψ"),
        left.label((d / 2, 0.0), "open", _NOTE, dy=205),
        *_links(right, crossed),
        right.label((d / 2, 0.0), "crossed", _NOTE, dy=205),
    ]
    return sheet(1050, 500, "Four-bar linkage: open and crossed", parts)


def icon(values: SimpleNamespace, path: Path) -> None:
    """Write the model's icon, 100 x 100 px, with matplotlib."""
    with icon_axes(path, 0.1) as axes:
        for begin, end, colour in _bars(values):
            axes.plot(*zip(begin, end, strict=True), color=colour, linewidth=3.5, solid_capstyle="round")
        places = ((0.0, 0.0), (values.ground_length, 0.0), *_points(values))
        axes.plot(*zip(*places, strict=True), "o", color="white", markeredgecolor=INK, markersize=3.5)


def _points(values: SimpleNamespace) -> tuple[Point, Point]:
    """Crank pin and rocker pin."""
    pin = polar((0.0, 0.0), values.crank_length, values.crank_angle_start)
    return pin, polar((values.ground_length, 0.0), values.rocker_length, start(values).rocker_angle)


def _bars(values: SimpleNamespace) -> list[tuple[Point, Point, str]]:
    """Crank, coupler and rocker: where each begins and ends, and its colour."""
    pin, far = _points(values)
    return [((0.0, 0.0), pin, CRANK), (pin, far, COUPLER), ((values.ground_length, 0.0), far, ROCKER)]


def _links(view: View, values: SimpleNamespace) -> list[str]:
    return [
        *(view.path([begin, end], f'stroke="{colour}" stroke-width="9"') for begin, end, colour in _bars(values)),
        view.hinge((0.0, 0.0)),
        view.hinge((values.ground_length, 0.0)),
        *(view.circle(point, 5, f'fill="#fff" {_EDGE}') for point in _points(values)),
    ]


if __name__ == "__main__":
    shown = MODEL.values(crank_angle_start=_CRANK_ANGLE)
    rewrite("four_bar", drawing(shown), icon, shown)
