"""The drawing and the icon of the Geneva drive, made from the shapes and numbers of its FMU.

    python -m docs.drawings.geneva_drawing      rewrites drawing.svg and model.png beside this file

The icon needs matplotlib (`pip install ".[docs]"`); the drawing needs nothing.
"""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

from mechanism_fmu.model import Wheel
from models.geneva.geometry import geneva, wheel_angle
from models.geneva.model import MODEL
from models.geneva.ports import SHAPES

from .pictures import INK, Point, View, icon_axes, polar, rewrite, sheet

WHEEL, DRIVER = "#c9d2dc", "#e9c46a"

_EDGE = f'stroke="{INK}" stroke-width="1.6"'
_AXIS = 'fill="none" stroke="#7b8794" stroke-width="1" stroke-dasharray="9 4 2 4"'
_NOTE = 'font-style="normal" font-family="Helvetica, Arial, DejaVu Sans, sans-serif" font-size="14"'


def drawing(values: SimpleNamespace) -> str:
    """The drive just as the pin enters a slot, and half-way through it, as SVG text."""
    c = values.centre_distance
    left, right = View((190, 270), 230 / c), View((790, 270), 230 / c)
    entry = math.pi - geneva(values).engagement
    parts = [
        *_at(left, values, entry),
        left.label((c / 2, 0.0), "the pin enters: a and R are at a right angle", _NOTE, dy=235),
        *_at(right, values, math.pi - 0.35 * geneva(values).engagement),
        right.label((c / 2, 0.0), "the slot points to the pin", _NOTE, dy=235),
    ]
    return sheet(1220, 540, "Geneva drive: entry of the pin, and on its way in the slot", parts)


def icon(values: SimpleNamespace, path: Path) -> None:
    """Write the model's icon, 100 x 100 px, with matplotlib."""
    theta = math.pi - 0.35 * geneva(values).engagement
    with icon_axes(path) as axes:
        for points, colour in zip(_outlines(values, theta), (WHEEL, DRIVER), strict=True):
            axes.fill(*zip(*points, strict=True), facecolor=colour, edgecolor=INK, linewidth=0.8)
        pin = polar((values.centre_distance, 0.0), geneva(values).pin_radius, theta)
        axes.plot(*zip((values.centre_distance, 0.0), pin, strict=True), color=INK, linewidth=3, solid_capstyle="round")


def _at(view: View, values: SimpleNamespace, theta: float) -> list[str]:
    """The drive at a driver angle theta [rad]."""
    c, geometry = values.centre_distance, geneva(values)
    hinge, origin = (c, 0.0), (0.0, 0.0)
    pin = polar(hinge, geometry.pin_radius, theta)
    psi = wheel_angle(SimpleNamespace(**{**vars(values), "driver_angle_start": theta}))
    wheel, disc = _outlines(values, theta)
    return [
        view.path(wheel, f'fill="{WHEEL}" {_EDGE}', closed=True),
        view.path(disc, f'fill="{DRIVER}" {_EDGE}', closed=True),
        view.path([(-0.75 * c, 0.0), (1.7 * c, 0.0)], _AXIS),
        view.path([origin, polar(origin, geometry.mouth_radius, psi)], _AXIS),
        view.path([hinge, pin], f'stroke="{INK}" stroke-width="8"'),
        view.circle(pin, values.pin_diameter / 2 * view.scale, f'fill="#fff" {_EDGE}'),
        view.hinge(origin),
        view.hinge(hinge),
        view.length(origin, hinge, -205, "c"),
        view.length(hinge, pin, -26, "a"),
        view.length(origin, polar(origin, geometry.mouth_radius, psi), 26, "R"),
        view.angle(origin, 0.38 * c, 0.0, psi, "ψ"),
        view.angle(hinge, 0.3 * c, 0.0, theta, "θ"),
    ]


def _outlines(values: SimpleNamespace, theta: float) -> tuple[list[Point], list[Point]]:
    """Wheel and locking disc [m] at a driver angle."""
    at = SimpleNamespace(**{**vars(values), "driver_angle_start": theta})
    known = {c.name: c.value for c in MODEL.mechanism(at).calculated}

    def number(quantity: float | str) -> float:
        if not isinstance(quantity, str):
            return quantity
        return -known[quantity[1:]] if quantity.startswith("-") else float(known[quantity])

    wheel, disc = (shape for shape in SHAPES if isinstance(shape, Wheel))
    psi, pitch = wheel_angle(at), geneva(values).pitch
    rim = [
        polar((0.0, 0.0), number(radius), psi + k * pitch + number(angle))
        for k in range(int(values.slot_count))
        for radius, angle in wheel.outline
    ]
    return rim, [polar((values.centre_distance, 0.0), number(r), theta + number(t)) for r, t in disc.outline]


if __name__ == "__main__":
    shown = MODEL.values()
    rewrite("geneva", drawing(shown), icon, shown)
