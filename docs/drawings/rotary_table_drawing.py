"""The drawing and the icon of the rotary table, made from its shapes.

    python -m docs.drawings.rotary_table_drawing      rewrites drawing.svg and model.png beside this file

The icon needs matplotlib (`pip install ".[docs]"`); the drawing needs nothing.
"""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

from models.rotary_table.model import BRAKE, MODEL, OUTLINE, RIM, STATION, STATIONS

from .pictures import INK, Point, View, icon_axes, polar, rewrite, sheet

TABLE, LINING = "#c9d2dc", "#e76f51"

_EDGE = f'stroke="{INK}" stroke-width="1.6"'


def drawing(values: SimpleNamespace) -> str:
    """The table with its brake, its shaft's driven end and the angles, as SVG text."""
    view, hinge = View((250, 210), 1250.0), (0.0, 0.0)
    turn = values.table_angle_start + math.radians(25)
    driven = turn + math.radians(35)
    parts = [
        view.path(_rim(turn), f'fill="{TABLE}" {_EDGE}', closed=True),
        view.circle(hinge, BRAKE * view.scale, f'fill="#fff" {_EDGE}'),
        *(
            view.path(_shoe(middle), f'fill="{LINING}" {_EDGE}', closed=True)
            for middle in (math.radians(150), math.radians(270))
        ),
        view.path([hinge, polar(hinge, 1.25 * RIM, 0.0)], f'fill="none" stroke="{INK}" stroke-width="0.8"'),
        view.path([hinge, polar(hinge, STATION, turn)], f'fill="none" {_EDGE}'),
        view.path([hinge, polar(hinge, 1.1 * RIM, driven)], f'fill="none" {_EDGE} stroke-dasharray="6 4"'),
        view.hinge(hinge),
        view.angle(hinge, 1.12 * RIM, 0.0, turn, "θ"),
        view.angle(hinge, 1.3 * RIM, 0.0, driven, "α"),
        view.label(polar(hinge, 1.45 * BRAKE, math.radians(150)), "M^b"),
    ]
    return sheet(500, 420, "Rotary table: brake and shaft", parts)


def icon(values: SimpleNamespace, path: Path) -> None:
    """Write the model's icon, 100 x 100 px, with matplotlib."""
    from matplotlib.patches import Circle

    with icon_axes(path) as axes:
        axes.fill(*zip(*_rim(values.table_angle_start), strict=True), facecolor=TABLE, edgecolor=INK, linewidth=0.8)
        axes.add_patch(Circle((0.0, 0.0), BRAKE, facecolor="white", edgecolor=LINING, linewidth=2.0))


def _rim(turn: float) -> list[Point]:
    """The table's outline [m]."""
    return [
        polar((0.0, 0.0), radius, turn + 2 * math.pi * k / STATIONS + angle)
        for k in range(STATIONS)
        for radius, angle in OUTLINE
    ]


def _shoe(middle: float) -> list[Point]:
    """A brake shoe outside the brake's disc [m]."""
    angles = [middle + math.radians(3 * k) for k in range(-7, 8)]
    inner = [polar((0.0, 0.0), BRAKE, angle) for angle in angles]
    return inner + [polar((0.0, 0.0), 1.16 * BRAKE, angle) for angle in reversed(angles)]


if __name__ == "__main__":
    shown = MODEL.values()
    rewrite("rotary_table", drawing(shown), icon, shown)
