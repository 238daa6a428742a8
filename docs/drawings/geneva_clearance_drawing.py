"""The drawing and the icon of the Geneva drive with play, made from the outlines of its contacts.

    python -m docs.drawings.geneva_clearance_drawing      rewrites drawing.svg and model.png beside this file

The icon needs matplotlib (`pip install ".[docs]"`); the drawing needs nothing.
"""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

from mechanism_fmu.model import Outline
from models.geneva_clearance.geometry import (
    SLOT_COUNT,
    arm_outline,
    disc_outline,
    entry,
    lengths,
    pin_outline,
    rest_play,
)
from models.geneva_clearance.model import MODEL

from .pictures import INK, Point, View, icon_axes, polar, rewrite, sheet

WHEEL, DRIVER = "#c9d2dc", "#e9c46a"

_EDGE = f'stroke="{INK}" stroke-width="1.6"'
_AXIS = 'fill="none" stroke="#7b8794" stroke-width="1" stroke-dasharray="9 4 2 4"'
_NOTE = 'font-style="normal" font-family="Helvetica, Arial, DejaVu Sans, sans-serif" font-size="14"'

#: Play as the drawing has it [m]: that of the defaults would not be seen.
_PLAY = {"slot_clearance": 2e-3, "locking_clearance": 1.5e-3}


def drawing(values: SimpleNamespace) -> str:
    """The first blow of the pin, and the resting wheel at the end of its play, as SVG text."""
    coarse = SimpleNamespace(**{**vars(values), **_PLAY})
    c, pitch = coarse.centre_distance, math.pi / SLOT_COUNT
    tau, _, _ = (float(number) for number in entry(coarse))
    left, right = View((190, 270), 230 / c), View((790, 270), 230 / c)
    hinge, strikes = (c, 0.0), math.pi / 2 + pitch + tau
    middle = polar((0.0, 0.0), 1.1 * lengths(coarse).mouth_radius, pitch)
    parts = [
        *_at(left, coarse, strikes, pitch),
        left.path([(0.0, 0.0), middle], _AXIS),
        left.angle(hinge, 0.25 * c, strikes - tau, strikes, "τ"),
        left.label((c / 2, 0.0), "the pin strikes, τ behind its entry", _NOTE, dy=235),
        *_at(right, coarse, 0.0, pitch + float(rest_play(coarse))),
        right.label((c / 2, 0.0), "at rest, an end of the arc is on the disc", _NOTE, dy=235),
    ]
    return sheet(1220, 540, "Geneva drive with play: first blow, and play at rest", parts)


def icon(values: SimpleNamespace, path: Path) -> None:
    """Write the model's icon, 100 x 100 px, with matplotlib."""
    hinge = (values.centre_distance, 0.0)
    with icon_axes(path) as axes:
        for points, colour in (
            (_wheel(values, math.pi / SLOT_COUNT), WHEEL),
            (_placed(disc_outline(values), hinge, 2.4), DRIVER),
            (_placed(pin_outline(values), hinge, 2.4), "white"),
        ):
            axes.fill(*zip(*points, strict=True), facecolor=colour, edgecolor=INK, linewidth=0.8)


def _at(view: View, values: SimpleNamespace, theta: float, psi: float) -> list[str]:
    """The drive at the angles of driver and wheel [rad]."""
    c, origin = values.centre_distance, (0.0, 0.0)
    hinge = (c, 0.0)
    pin = polar(hinge, lengths(values).pin_radius, theta)
    return [
        view.path(_wheel(values, psi), f'fill="{WHEEL}" {_EDGE}', closed=True),
        view.path(_placed(disc_outline(values), hinge, theta), f'fill="{DRIVER}" {_EDGE}', closed=True),
        view.path([(-0.75 * c, 0.0), (1.7 * c, 0.0)], _AXIS),
        view.path([hinge, pin], f'stroke="{INK}" stroke-width="8"'),
        view.path(_placed(pin_outline(values), hinge, theta), f'fill="#fff" {_EDGE}', closed=True),
        view.hinge(origin),
        view.hinge(hinge),
        view.angle(origin, 0.3 * c, 0.0, psi, "ψ"),
    ]


def _wheel(values: SimpleNamespace, psi: float) -> list[Point]:
    """The rim of the wheel at an angle [rad]."""
    arm, pitch = arm_outline(values), 2 * math.pi / SLOT_COUNT
    return [point for k in range(SLOT_COUNT) for point in _placed(arm, (0.0, 0.0), psi + k * pitch)]


def _placed(outline: Outline, at: Point, angle: float) -> list[Point]:
    return outline.moved(*at, angle).drawn()


if __name__ == "__main__":
    shown = MODEL.values()
    rewrite("geneva_clearance", drawing(shown), icon, shown)
