"""The drawing and the icon of the free ratchet, made from the outlines of its contact.

    python -m docs.drawings.ratchet_free_drawing      rewrites drawing.svg and model.png beside this file

The icon needs matplotlib (`pip install ".[docs]"`); the drawing needs nothing.
"""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

from models.ratchet.start import crank_pin
from models.ratchet_free.model import MODEL, tooth_outline
from models.ratchet_free.start import TOOTH_COUNT, pawl_angle, sharp_tooth

from .pictures import INK, Point, View, icon_axes, polar, rewrite, sheet

WHEEL, CRANK, PAWL = "#e4e9ef", "#2b7a78", "#d9731a"

_EDGE = f'stroke="{INK}" stroke-width="1.6"'
_NOTE = 'font-style="normal" font-family="Helvetica, Arial, DejaVu Sans, sans-serif" font-size="14"'

#: Roundings as the enlarged notch has them [m]: those of the defaults would be too small to be seen.
_NOSE, _TIP = 3e-3, 1.5e-3


def drawing(values: SimpleNamespace) -> str:
    """The mechanism at the start, and the nose in a notch, enlarged, as SVG text."""
    radius = max(math.hypot(*p) for p in _wheel(values))
    pin = crank_pin(values)
    left, right = -radius, max(radius, values.hinge_distance, pin.x) + 0.2 * values.wheel_inner_radius
    scale = 740 / (right - left)
    height = round(2 * radius * scale) + 90
    whole = View((30 - left * scale, radius * scale + 40), scale)
    at = polar((0.0, 0.0), values.wheel_inner_radius, math.pi / 2)
    close = 190 / sharp_tooth(values).chord
    enlarged = View((985, 0.42 * height + at[1] * close), close)
    coarse = SimpleNamespace(**{**vars(values), "nose_radius": _NOSE, "tooth_tip_radius": _TIP})
    return sheet(
        1220,
        height,
        "Free ratchet: mechanism at the start, and the nose in a notch",
        [
            *_mechanism(whole, values),
            *_notch(enlarged, coarse),
            whole.label((0.0, -radius), "at the start: the nose rests on a slope", _NOTE, dy=32),
            enlarged.label(at, "in the notch it touches twice", _NOTE, dy=height * 0.58 - 18),
        ],
    )


def icon(values: SimpleNamespace, path: Path) -> None:
    """Write the model's icon, 100 x 100 px, with matplotlib."""
    hinge, pin, nose = _points(values)
    with icon_axes(path) as axes:
        axes.fill(*zip(*_wheel(values), strict=True), facecolor="#9aa5b1", edgecolor=INK, linewidth=0.8)
        for start, end, colour in ((hinge, pin, CRANK), (pin, nose, PAWL)):
            axes.plot(*zip(start, end, strict=True), color=colour, linewidth=3.5, solid_capstyle="round")
        axes.plot(*zip((0.0, 0.0), hinge, pin, strict=True), "o", color="white", markeredgecolor=INK, markersize=3.5)
        axes.plot(*nose, "o", color=PAWL, markeredgecolor=INK, markersize=6)


def _points(values: SimpleNamespace) -> tuple[Point, Point, Point]:
    """Crank hinge, crank pin, and the middle of the nose."""
    pin = crank_pin(values)
    return (values.hinge_distance, 0.0), (pin.x, pin.y), polar((pin.x, pin.y), values.pawl_length, pawl_angle(values))


def _wheel(values: SimpleNamespace, turn: float | None = None) -> list[Point]:
    """The rim, turned by an angle [rad], that of the start if none is given."""
    angle = values.wheel_angle_start if turn is None else turn
    tooth = tooth_outline(values)
    pitch = 2 * math.pi / TOOTH_COUNT
    turned = (tooth.moved(angle=angle + k * pitch) for k in range(TOOTH_COUNT))
    return [point for one in turned for point in one.drawn()]


def _mechanism(view: View, values: SimpleNamespace) -> list[str]:
    hinge, pin, nose = _points(values)
    psi, r = values.wheel_angle_start, values.wheel_inner_radius
    return [
        view.path(_wheel(values), f'fill="{WHEEL}" {_EDGE}', closed=True),
        _bar(view, hinge, pin, CRANK),
        _bar(view, pin, nose, PAWL),
        view.circle(nose, max(values.nose_radius * view.scale, 6.0), f'fill="{PAWL}" {_EDGE}'),
        view.hinge((0.0, 0.0)),
        view.hinge(hinge),
        view.length((0.0, 0.0), hinge, -78, "d"),
        view.length(hinge, pin, -30, "a"),
        view.length(pin, nose, -30, "b"),
        view.length((0.0, 0.0), polar((0.0, 0.0), r, psi), 0, "r"),
        view.angle((0.0, 0.0), 0.62 * r, 0.0, psi, "ψ"),
        view.angle(hinge, 0.3 * r, 0.0, values.crank_angle_start, "φ"),
    ]


def _notch(view: View, values: SimpleNamespace) -> list[str]:
    """Slope and face of one root, upright, and the nose between them."""
    tooth, radius = sharp_tooth(values), values.nose_radius
    turn, pitch = math.pi / 2, 2 * math.pi / TOOTH_COUNT
    teeth = [tooth_outline(values).moved(angle=turn + k * pitch) for k in (-1, 0, 1)]
    rim = [*(point for one in teeth for point in one.drawn()), teeth[-1].points[-1]]
    inside = [polar((0.0, 0.0), 0.9 * values.wheel_inner_radius, turn + k * pitch) for k in (1, 0.5, 0, -0.5, -1, -2)]
    (a, b), (c, d) = tooth.slope_normal, tooth.face_normal
    det = a * d - b * c
    x, y = values.wheel_inner_radius + radius * (d - b) / det, radius * (a - c) / det
    nose = -y, x  # a quarter turn on
    touches = [(nose[0] + radius * v, nose[1] - radius * u) for u, v in (tooth.slope_normal, tooth.face_normal)]
    shank = polar(nose, 9 * radius, math.radians(38))
    return [
        view.path([*rim, *inside], f'fill="{WHEEL}" stroke="none"', closed=True),
        view.path(rim, f'fill="none" {_EDGE}'),
        _bar(view, shank, nose, PAWL),
        view.circle(nose, radius * view.scale, f'fill="{PAWL}" {_EDGE}'),
        *(view.circle(point, 4.5, f'fill="#fff" {_EDGE}') for point in touches),
        view.label(touches[0], "slope", _NOTE, dx=30, dy=26),
        view.label(touches[1], "face", _NOTE, dx=-34, dy=4),
    ]


def _bar(view: View, start: Point, end: Point, colour: str) -> str:
    line = view.path([start, end], f'fill="none" stroke="{INK}" stroke-width="17"')
    return line + view.path([start, end], f'fill="none" stroke="{colour}" stroke-width="13.8"')


if __name__ == "__main__":
    shown = MODEL.values()
    rewrite("ratchet_free", drawing(shown), icon, shown)
