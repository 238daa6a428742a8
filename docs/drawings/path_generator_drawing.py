"""The drawing and the icon of the path generator, made from the model's own geometry.

    python -m docs.drawings.path_generator_drawing      rewrites drawing.svg and model.png beside this file

The icon needs matplotlib (`pip install ".[docs]"`); the drawing needs nothing.
"""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

from mechanism_fmu.model.four_bar import start
from models.four_bar_path_generator.model import MODEL

from .pictures import INK, Point, View, icon_axes, polar, sheet

CRANK, COUPLER, ARM, ROCKER = "#2b7a78", "#d9731a", "#b83280", "#6b46c1"

_EDGE = f'stroke="{INK}" stroke-width="1.6"'
_AXIS = 'fill="none" stroke="#7b8794" stroke-width="1" stroke-dasharray="9 4 2 4"'
_PATH = 'fill="none" stroke="#52606d" stroke-width="1.4" stroke-dasharray="6 4"'

_CRANK_ANGLE = math.radians(60)
#: Points of the path.
_POINTS = 120


def drawing(values: SimpleNamespace) -> str:
    """The linkage with its lengths, angles and path, as SVG text."""
    view = View((110, 470), 420 / values.ground_length)
    d, a = values.ground_length, values.crank_length
    pin, far, path = _points(values)
    at = start(values)
    parts = [
        view.path([(-0.2 * d, 0.0), (1.3 * d, 0.0)], _AXIS),
        view.path([pin, (pin[0] + 0.7 * a, pin[1])], _AXIS),
        view.path([_points(_at(values, 2 * math.pi * k / _POINTS))[2] for k in range(_POINTS)], _PATH, closed=True),
        *(view.path([begin, end], f'stroke="{colour}" stroke-width="9"') for begin, end, colour in _bars(values)),
        view.hinge((0.0, 0.0)),
        view.hinge((d, 0.0)),
        view.circle(pin, 5, f'fill="#fff" {_EDGE}'),
        view.circle(far, 5, f'fill="#fff" {_EDGE}'),
        view.circle(path, 9, f'fill="{ARM}" {_EDGE}'),
        view.label(path, "P", dx=-22),
        view.length((0.0, 0.0), (d, 0.0), -60, "d"),
        *(
            view.length(begin, end, offset, name)
            for (begin, end, _), offset, name in zip(_bars(values), (30, -34, 34, -34), "abpc", strict=True)
        ),
        view.angle((0.0, 0.0), 0.45 * a, 0.0, values.crank_angle_start, "θ"),
        view.angle(pin, 0.55 * a, 0.0, at.coupler_angle, "φ"),
        view.angle(pin, 0.95 * a, at.coupler_angle, at.coupler_angle + values.arm_angle, "α"),
        view.angle((d, 0.0), 0.4 * a, 0.0, at.rocker_angle, "ψ"),
    ]
    return sheet(760, 600, "Four-bar path generator and its path", parts)


def icon(values: SimpleNamespace, path: Path) -> None:
    """Write the model's icon, 100 x 100 px, with matplotlib."""
    with icon_axes(path, 0.1) as axes:
        for begin, end, colour in _bars(values):
            axes.plot(*zip(begin, end, strict=True), color=colour, linewidth=3.5, solid_capstyle="round")
        places = ((0.0, 0.0), (values.ground_length, 0.0), *_points(values))
        axes.plot(*zip(*places, strict=True), "o", color="white", markeredgecolor=INK, markersize=3.5)


def _at(values: SimpleNamespace, angle: float) -> SimpleNamespace:
    return SimpleNamespace(**{**vars(values), "crank_angle_start": angle})


def _points(values: SimpleNamespace) -> tuple[Point, Point, Point]:
    """Crank pin, rocker pin and path point."""
    pin, at = polar((0.0, 0.0), values.crank_length, values.crank_angle_start), start(values)
    far = polar((values.ground_length, 0.0), values.rocker_length, at.rocker_angle)
    return pin, far, polar(pin, values.arm_length, at.coupler_angle + values.arm_angle)


def _bars(values: SimpleNamespace) -> list[tuple[Point, Point, str]]:
    """Crank, coupler, arm and rocker: where each begins and ends, and its colour."""
    pin, far, path = _points(values)
    hinge = (values.ground_length, 0.0)
    return [((0.0, 0.0), pin, CRANK), (pin, far, COUPLER), (pin, path, ARM), (hinge, far, ROCKER)]


def main() -> None:
    """Rewrite the drawing and the icon."""
    folder = Path(__file__).parents[2] / "models" / "four_bar_path_generator"
    values = MODEL.values(crank_angle_start=_CRANK_ANGLE)
    (folder / "drawing.svg").write_text(drawing(values), encoding="utf-8")
    icon(values, folder / "model.png")


if __name__ == "__main__":
    main()
