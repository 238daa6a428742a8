"""The drawing and the icon of the motor, made from its shapes.

    python -m docs.drawings.motor_drawing      rewrites drawing.svg and model.png beside this file

The icon needs matplotlib (`pip install ".[docs]"`); the drawing needs nothing.
"""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

from models.motor.model import HOUSING, MODEL, OUTLINE, POLE, POLES

from .pictures import HALO, INK, Point, View, icon_axes, polar, rewrite, sheet

ROTOR = "#e9c46a"

_EDGE = f'stroke="{INK}" stroke-width="1.6"'
_WIRE = f'fill="none" stroke="{INK}" stroke-width="1.6"'
_BOX = f'fill="#fff" stroke="{INK}" stroke-width="1.6"'
_PLUS = f'fill="#fff" stroke="{INK}" stroke-width="1.4"'


def drawing(values: SimpleNamespace) -> str:
    """Controller, armature circuit and rotor with their letters, as SVG text."""
    view = View((600, 160), 1900.0)
    turn = values.rotor_angle_start + math.radians(30)
    parts = [
        _wire([(60, 160), (92, 160)]),
        f'<circle cx="104" cy="160" r="12" {_PLUS}/>',
        _wire([(116, 160), (142, 160)]),
        _box(142, 130, 116, 60, "kp e + ki z"),
        _wire([(258, 160), (275, 160)]),
        _box(275, 130, 60, 60, ""),
        f'<path d="M283 178 h14 l16 -36 h14" {_WIRE}/>',
        _wire([(335, 160), (335, 90), (365, 90)]),
        _box(365, 78, 50, 24, ""),
        _wire([(415, 90), (440, 90)]),
        f'<path d="M440 90 a8 8 0 0 1 16 0 a8 8 0 0 1 16 0 a8 8 0 0 1 16 0" {_WIRE}/>',
        _wire([(488, 90), (530, 90)]),
        _wire([(530, 230), (335, 230), (335, 190)]),
        f'<path d="M600 262 V285 H104 V172" {_WIRE} stroke-dasharray="5 4"/>',
        view.circle((0.0, 0.0), HOUSING * view.scale, f'fill="#fff" {_EDGE}'),
        view.path(_rotor(turn), f'fill="{ROTOR}" {_EDGE}', closed=True),
        view.hinge((0.0, 0.0)),
        view.angle((0.0, 0.0), 1.1 * HOUSING, 0.0, turn, "φ"),
        _text(60, 150, "ω*"),
        _text(129, 150, "e"),
        _text(305, 122, "U"),
        _text(350, 132, "u"),
        _text(390, 70, "R"),
        _text(464, 70, "L"),
        _text(515, 80, "i"),
        _text(350, 305, "ω"),
        view.path([polar((0.0, 0.0), 0.0, 0.0), polar((0.0, 0.0), POLE, turn)], _WIRE),
    ]
    return sheet(740, 320, "Motor: controller, armature and rotor", parts)


def icon(values: SimpleNamespace, path: Path) -> None:
    """Write the model's icon, 100 x 100 px, with matplotlib."""
    from matplotlib.patches import Circle

    with icon_axes(path) as axes:
        axes.add_patch(Circle((0.0, 0.0), HOUSING, facecolor="white", edgecolor=INK, linewidth=1.2))
        axes.fill(
            *zip(*_rotor(values.rotor_angle_start + 0.5), strict=True), facecolor=ROTOR, edgecolor=INK, linewidth=0.8
        )


def _rotor(turn: float) -> list[Point]:
    """The rotor's outline [m]."""
    return [
        polar((0.0, 0.0), radius, turn + 2 * math.pi * k / POLES + angle)
        for k in range(POLES)
        for radius, angle in OUTLINE
    ]


def _wire(points: list[Point]) -> str:
    return f'<path d="M{" L".join(f"{x:g} {y:g}" for x, y in points)}" {_WIRE}/>'


def _box(x: float, y: float, width: float, height: float, text: str) -> str:
    label = _text(x + width / 2, y + height / 2 + 6, text) if text else ""
    return f'<rect x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" {_BOX}/>{label}'


def _text(x: float, y: float, text: str) -> str:
    return f'<text x="{x:g}" y="{y:g}" {HALO}>{text}</text>'


if __name__ == "__main__":
    shown = MODEL.values()
    rewrite("motor", drawing(shown), icon, shown)
