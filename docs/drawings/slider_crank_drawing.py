"""The drawing and the icon of the slider-crank, made from the model's own geometry.

    python -m docs.drawings.slider_crank_drawing      rewrites drawing.svg and model.png beside this file

The icon needs matplotlib (`pip install ".[docs]"`); the drawing needs nothing.
"""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

from models.slider_crank.model import MODEL
from models.slider_crank.ports import HALF_HEIGHT, HALF_LENGTH, start

from .pictures import INK, Point, View, icon_axes, polar, rewrite, sheet

CRANK, ROD, SLIDER = "#2b7a78", "#d9731a", "#c9d2dc"

_EDGE = f'stroke="{INK}" stroke-width="1.6"'
_AXIS = 'fill="none" stroke="#7b8794" stroke-width="1" stroke-dasharray="9 4 2 4"'

#: What is drawn: a short rod, an offset that can be seen, and the crank on its way up.
_SHOWN = {"rod_length": 0.13, "offset": 0.015, "crank_angle_start": math.radians(65)}


def drawing(values: SimpleNamespace) -> str:
    """The mechanism with its lengths and angles, as SVG text."""
    pin, slider = _points(values)
    hinge, e = (0.0, 0.0), values.offset
    view = View((130, 200), 560 / (values.crank_length + values.rod_length))
    right = slider[0] + 1.3 * values.crank_length
    parts = [
        view.path([(-0.08 * right, 0.0), (0.62 * right, 0.0)], _AXIS),
        view.path([(-0.08 * right, e), (right, e)], _AXIS),
        view.path([pin, (pin[0] + 1.3 * values.crank_length, pin[1])], _AXIS),
        view.path(_slider(values, slider), f'fill="{SLIDER}" {_EDGE}', closed=True),
        *_guides(view, values, slider),
        view.path([hinge, pin], f'stroke="{CRANK}" stroke-width="9"'),
        view.path([pin, slider], f'stroke="{ROD}" stroke-width="9"'),
        view.hinge(hinge),
        *(view.circle(p, 5, f'fill="#fff" {_EDGE}') for p in (pin, slider)),
        view.length(hinge, pin, 30, "r"),
        view.length(pin, slider, 30, "l"),
        view.length((0.55 * right, 0.0), (0.55 * right, e), 0, "e"),
        view.length(hinge, (slider[0], 0.0), -75, "x"),
        view.path([slider, (slider[0], -82 / view.scale)], 'fill="none" stroke="#52606d" stroke-width="0.8"'),
        view.angle(hinge, 0.5 * values.crank_length, 0.0, values.crank_angle_start, "θ"),
        view.angle(pin, 0.95 * values.crank_length, 0.0, start(values).rod_angle, "φ"),
    ]
    return sheet(760, 310, "Slider-crank: lengths and angles", parts)


def icon(values: SimpleNamespace, path: Path) -> None:
    """Write the model's icon, 100 x 100 px, with matplotlib."""
    pin, slider = _points(values)
    with icon_axes(path, 0.1) as axes:
        axes.fill(*zip(*_slider(values, slider), strict=True), facecolor="#9aa5b1", edgecolor=INK, linewidth=0.8)
        for begin, end, colour in (((0.0, 0.0), pin, CRANK), (pin, slider, ROD)):
            axes.plot(*zip(begin, end, strict=True), color=colour, linewidth=3.5, solid_capstyle="round")
        axes.plot(*zip((0.0, 0.0), pin, slider, strict=True), "o", color="white", markeredgecolor=INK, markersize=3.5)


def _points(values: SimpleNamespace) -> tuple[Point, Point]:
    """Crank pin and slider pin."""
    pin = polar((0.0, 0.0), values.crank_length, values.crank_angle_start)
    return pin, (start(values).slider_position, values.offset)


def _slider(values: SimpleNamespace, at: Point) -> list[Point]:
    half, high = HALF_LENGTH * values.crank_length, HALF_HEIGHT * values.crank_length
    return [(at[0] + x, at[1] + y) for x, y in ((half, high), (-half, high), (-half, -high), (half, -high))]


def _guides(view: View, values: SimpleNamespace, at: Point) -> list[str]:
    """The two walls between which the slider runs, hatched outside."""
    r = values.crank_length
    begin, end = at[0] - 1.1 * r, at[0] + 1.1 * r
    parts = []
    for side in (1, -1):
        y = at[1] + side * HALF_HEIGHT * r
        parts.append(view.path([(begin, y), (end, y)], f'fill="none" {_EDGE}'))
        for k in range(12):
            x = begin + (end - begin) * (k + 0.5) / 12
            parts.append(view.path([(x, y), (x + 0.06 * r, y + side * 0.09 * r)], f'fill="none" {_EDGE}'))
    return parts


if __name__ == "__main__":
    at = MODEL.values(rod_length=0.11, crank_angle_start=math.radians(60))
    rewrite("slider_crank", drawing(MODEL.values(**_SHOWN)), icon, at)
