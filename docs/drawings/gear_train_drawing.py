"""The drawing and the icon of the gear train, made from its shapes.

    python -m docs.drawings.gear_train_drawing      rewrites drawing.svg and model.png beside this file

The icon needs matplotlib (`pip install ".[docs]"`); the drawing needs nothing.
"""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

from models.gear_train.model import ARM, ARMS, ENDS, MODEL, pairing

from .pictures import INK, Point, View, icon_axes, polar, rewrite, sheet

PINION, WHEEL = "#e9c46a", "#c9d2dc"

_EDGE = f'stroke="{INK}" stroke-width="1.6"'
_AXIS = 'fill="none" stroke="#7b8794" stroke-width="1" stroke-dasharray="9 4 2 4"'


def drawing(values: SimpleNamespace) -> str:
    """The pair with its radii and angles, as SVG text."""
    right = pairing(values).centre_distance
    view = View((150, 210), 180 / values.wheel_radius)
    parts = [view.path([(-1.5 * values.pinion_radius, 0.0), (right + 1.2 * values.wheel_radius, 0.0)], _AXIS)]
    for centre, radius, angle, colour in _gears(values):
        parts += [
            view.circle(centre, radius * view.scale, f'fill="#fff" {_EDGE}'),
            view.path(_arms(centre, radius, angle), f'fill="{colour}" {_EDGE}', closed=True),
            view.hinge(centre),
        ]
    (at_1, r_1, phi_1, _), (at_2, r_2, phi_2, _) = _gears(values)
    parts += [
        view.length(at_1, polar(at_1, r_1, math.radians(115)), 0, "R^1"),
        view.length(at_2, polar(at_2, r_2, math.radians(75)), 0, "R^2"),
        view.angle(at_1, 1.25 * r_1, 0.0, phi_1, "φ^1"),
        view.angle(at_2, 1.1 * r_2, 0.0, phi_2, "φ^2"),
    ]
    return sheet(700, 420, "Gear train: pitch radii and angles", parts)


def icon(values: SimpleNamespace, path: Path) -> None:
    """Write the model's icon, 100 x 100 px, with matplotlib."""
    from matplotlib.patches import Circle

    with icon_axes(path) as axes:
        for centre, radius, angle, colour in _gears(values):
            axes.add_patch(Circle(centre, radius, facecolor="white", edgecolor=INK, linewidth=1.2))
            axes.fill(*zip(*_arms(centre, radius, angle), strict=True), facecolor=colour, edgecolor=INK, linewidth=0.8)


def _gears(values: SimpleNamespace) -> list[tuple[Point, float, float, str]]:
    """Of each gear: centre [m], pitch radius [m], angle [rad], colour."""
    pair, angle = pairing(values), values.pinion_angle_start
    return [
        ((0.0, 0.0), values.pinion_radius, angle, PINION),
        ((pair.centre_distance, 0.0), values.wheel_radius, pair.ratio * angle, WHEEL),
    ]


def _arms(centre: Point, radius: float, angle: float) -> list[Point]:
    """The arms' outline [m]."""
    return [
        polar(centre, ENDS[end] * radius, angle + 2 * math.pi * k / ARMS + turn)
        for k in range(ARMS)
        for end, turn in ARM
    ]


if __name__ == "__main__":
    shown = MODEL.values(pinion_angle_start=math.radians(60))
    rewrite("gear_train", drawing(shown), icon, shown)
