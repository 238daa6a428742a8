"""The drawing and the icon of the cam drive, made from the model's own geometry.

    python -m docs.drawings.cam_drive_drawing      rewrites drawing.svg and model.png beside this file

The icon needs matplotlib (`pip install ".[docs]"`); the drawing needs nothing.
"""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

from models.cam_drive.geometry import radius_at, timing
from models.cam_drive.model import MODEL

from .pictures import INK, Point, View, icon_axes, polar, rewrite, sheet

CAM, FOLLOWER = "#e9c46a", "#2b7a78"

_EDGE = f'stroke="{INK}" stroke-width="1.6"'
_THIN = 'fill="none" stroke="#7b8794" stroke-width="1" stroke-dasharray="9 4 2 4"'


def drawing(values: SimpleNamespace) -> str:
    """The cam drive with the roller on the upper dwell, its lengths and angles, as SVG text."""
    at = timing(values)
    theta, psi = (at.rise_end + at.return_start) / 2 - 2 * math.pi, at.high
    d, hinge = values.hinge_distance, (-values.hinge_distance, 0.0)
    roller = polar(hinge, values.follower_length, psi)
    view = View((430, 300), 3400)
    low = polar(hinge, values.follower_length, at.low)
    right = 1.35 * values.base_radius
    parts = [
        view.path([(-1.2 * d, 0.0), (1.7 * right, 0.0)], _THIN),
        view.path([hinge, low], _THIN),
        view.circle((0.0, 0.0), values.base_radius * view.scale, _THIN),
        view.path(_outline(values, theta), f'fill="{CAM}" {_EDGE}', closed=True),
        view.path([(0.0, 0.0), polar((0.0, 0.0), right, theta)], f'fill="none" {_EDGE}'),
        view.path([hinge, roller], f'stroke="{FOLLOWER}" stroke-width="9"'),
        view.circle(roller, values.roller_radius * view.scale, f'fill="#fff" {_EDGE}'),
        view.hinge(hinge),
        view.hinge((0.0, 0.0)),
        view.length(hinge, (0.0, 0.0), -160, "d"),
        view.length(hinge, roller, 26, "l"),
        view.length((0.0, 0.0), polar((0.0, 0.0), values.base_radius, math.radians(-52)), 0, "r^b"),
        view.length(roller, polar(roller, values.roller_radius, math.radians(75)), 0, "r^f"),
        view.angle(hinge, 0.4 * d, 0.0, psi, "ψ"),
        view.angle((0.0, 0.0), 0.85 * right, 0.0, theta, "θ"),
    ]
    return sheet(760, 500, "Cam drive: lengths and angles", parts)


def icon(values: SimpleNamespace, path: Path) -> None:
    """Write the model's icon, 100 x 100 px, with matplotlib."""
    from matplotlib.patches import Circle

    at = timing(values)
    hinge = (-values.hinge_distance, 0.0)
    roller = polar(hinge, values.follower_length, at.high)
    outline = _outline(values, (at.rise_end + at.return_start) / 2)
    with icon_axes(path, 0.08) as axes:
        axes.fill(*zip(*outline, strict=True), facecolor=CAM, edgecolor=INK, linewidth=1.0)
        axes.plot(*zip(hinge, roller, strict=True), color=FOLLOWER, linewidth=4, solid_capstyle="round")
        axes.add_patch(Circle(roller, values.roller_radius, facecolor="white", edgecolor=INK, linewidth=1.0, zorder=3))
        axes.plot(*zip(hinge, (0.0, 0.0), strict=True), "o", color="white", markeredgecolor=INK, markersize=3.5)


def _outline(values: SimpleNamespace, theta: float) -> list[Point]:
    """The cam's outline [m] at an angle of the cam."""
    return [
        polar((0.0, 0.0), float(radius_at(values, math.radians(degrees))), theta + math.radians(degrees))
        for degrees in range(0, 360, 2)
    ]


if __name__ == "__main__":
    shown = MODEL.values()
    rewrite("cam_drive", drawing(shown), icon, shown)
