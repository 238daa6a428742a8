"""The drawing and the icon of the ratchet, made from the model's own geometry.

    python -m docs.drawings.ratchet_drawing      rewrites drawing.svg and model.png beside this file

The icon needs matplotlib (`pip install ".[docs]"`); the drawing needs nothing.
"""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

from mechanism_fmu.model.sawtooth import wheel_outline
from models.ratchet.model import MODEL
from models.ratchet.start import crank_pin, pawl_angle, tooth

from .pictures import INK, Point, View, icon_axes, polar, rewrite, sheet

WHEEL, CRANK, PAWL, SPRING, BEAM = "#e4e9ef", "#2b7a78", "#d9731a", "#6b46c1", "#f3c9a5"

_EDGE = f'stroke="{INK}" stroke-width="1.6"'
_AXIS = 'fill="none" stroke="#7b8794" stroke-width="1" stroke-dasharray="9 4 2 4"'
_NOTE = 'font-style="normal" font-family="Helvetica, Arial, DejaVu Sans, sans-serif" font-size="14"'


def drawing(values: SimpleNamespace) -> str:
    """The mechanism at the start, and one tooth enlarged, as SVG text."""
    radius = max(math.hypot(*p) for p in _wheel(values))
    pin = crank_pin(values)
    left, right = -radius, max(radius, values.hinge_distance, pin.x) + 0.2 * values.wheel_inner_radius
    scale = 740 / (right - left)
    height = round(2 * radius * scale) + 90
    whole = View((30 - left * scale, radius * scale + 40), scale)
    enlarged = View((860, 0.42 * height), 240 / tooth(values).chord)
    angles = (values.crank_angle_start, values.wheel_angle_start, pawl_angle(values))
    start = "at the start: φ = {:.4g}°, ψ = {:.4g}°, γ = {:.4g}°".format(*map(math.degrees, angles))
    parts = [
        *_mechanism(whole, values),
        *_tooth(values, enlarged),
        whole.label((0.0, -radius), start, _NOTE, dy=32),
        enlarged.label((0.0, 0.0), "one tooth; shaded: its beam of length l", _NOTE, dx=150, dy=height * 0.58 - 18),
    ]
    return sheet(1220, height, "Ratchet: mechanism at the start, and one tooth", parts)


def icon(values: SimpleNamespace, path: Path) -> None:
    """Write the model's icon, 100 x 100 px, with matplotlib."""
    hinge, pin, tip = _points(values)
    with icon_axes(path) as axes:
        axes.fill(*zip(*_wheel(values), strict=True), facecolor="#9aa5b1", edgecolor=INK, linewidth=0.8)
        for start, end, colour in ((hinge, pin, CRANK), (pin, tip, PAWL)):
            axes.plot(*zip(start, end, strict=True), color=colour, linewidth=3.5, solid_capstyle="round")
        axes.plot(*zip((0.0, 0.0), hinge, pin, strict=True), "o", color="white", markeredgecolor=INK, markersize=3.5)


def _points(values: SimpleNamespace) -> tuple[Point, Point, Point]:
    """Crank hinge, crank pin and pawl tip."""
    pin = crank_pin(values)
    tip = polar((pin.x, pin.y), values.pawl_length, pawl_angle(values))
    return (values.hinge_distance, 0.0), (pin.x, pin.y), tip


def _wheel(values: SimpleNamespace) -> list[Point]:
    outline = wheel_outline(tooth(values), int(values.tooth_count), values.wheel_inner_radius)
    return [_turned(point, values.wheel_angle_start) for point in outline]


def _turned(point: Point, angle: float) -> Point:
    c, s = math.cos(angle), math.sin(angle)
    return c * point[0] - s * point[1], s * point[0] + c * point[1]


def _mechanism(view: View, values: SimpleNamespace) -> list[str]:
    hinge, pin, tip = _points(values)
    psi, phi, gamma = values.wheel_angle_start, values.crank_angle_start, pawl_angle(values)
    r, geometry, origin = values.wheel_inner_radius, tooth(values), (0.0, 0.0)
    root, apex = _turned((r, 0.0), psi), _turned(geometry.apex, psi)
    face_top, face_normal = _turned(geometry.apex, psi + geometry.pitch), _turned(geometry.face_normal, psi)
    gap = sum(n * (p - q) for n, p, q in zip(face_normal, tip, root, strict=True))
    foot = (tip[0] - gap * face_normal[0], tip[1] - gap * face_normal[1])
    spiral = [polar(origin, r * (0.1 + 0.016 * t), 2.6 - 4.5 * math.pi + t) for t in _range(0.0, 4.5 * math.pi)]
    return [
        view.path(_wheel(values), f'fill="{WHEEL}" {_EDGE}', closed=True),
        view.path([apex, root, face_top], f'fill="none" stroke="{PAWL}" stroke-width="3.5"'),
        view.path(spiral, f'fill="none" stroke="{SPRING}" stroke-width="2"'),
        view.circle(spiral[-1], 3.5, f'fill="{SPRING}"'),
        view.label(spiral[-1], "k", f'fill="{SPRING}"', dx=-12, dy=2),
        view.path([(-0.2 * r, 0.0), (hinge[0] + 0.45 * r, 0.0)], _AXIS),
        view.path([origin, _turned((r, 0.0), psi - geometry.pitch)], _AXIS),
        view.path([pin, (pin[0] + 0.3 * r, pin[1])], _AXIS),
        _link(view, hinge, pin),
        _pawl(view, pin, tip, gamma),
        view.hinge(origin),
        view.hinge(hinge),
        view.length(origin, hinge, -78, "d"),
        view.length(hinge, pin, -30, "a"),
        view.length(pin, tip, -30, "b"),
        view.length(origin, root, 0, "r"),
        view.length(foot, tip, 26, "s"),
        view.angle(origin, 0.62 * r, 0.0, psi, "ψ"),
        view.angle(origin, 0.88 * r, psi, psi - geometry.pitch, "θ"),
        view.angle(hinge, 0.3 * r, 0.0, phi, "φ"),
        view.angle(pin, 0.17 * r, 0.0, gamma, "γ"),
    ]


def _tooth(values: SimpleNamespace, view: View) -> list[str]:
    """One tooth as Figs. 5 and 7 show it: radius at P0 upright, clockwise to the right; P0 is the origin."""
    g, r, h = tooth(values), values.wheel_inner_radius, tooth(values).chord

    def seen(point: Point) -> Point:
        return -point[1], point[0] - r

    p0, apex = (0.0, 0.0), seen(g.apex)
    p1, apex_before = seen(_turned((r, 0.0), -g.pitch)), seen(_turned(g.apex, g.pitch))
    on_next_slope = seen(_turned((r + 0.35 * (g.apex[0] - r), 0.35 * g.apex[1]), -g.pitch))
    inside = [seen(polar((0.0, 0.0), r - 0.75 * h, t)) for t in _range(-1.35 * g.pitch, 0.25 * g.pitch)]
    slope, chord = values.tooth_slope_angle - math.pi / 2, -g.pitch / 2
    face = math.atan2(p1[1] - apex[1], p1[0] - apex[0])
    beam = [
        apex,
        polar(apex, g.beam_length, face),
        polar(apex, g.beam_length / math.cos(g.apex_angle), slope + math.pi),
    ]
    return [
        view.path([apex_before, p0, apex, p1, on_next_slope, *inside], f'fill="{WHEEL}"', closed=True),
        view.path(beam, f'fill="{BEAM}" stroke="{PAWL}" stroke-width="1"', closed=True),
        view.path([apex_before, p0, apex, p1, on_next_slope], f'fill="none" {_EDGE}'),
        view.path([p0, p1], _AXIS),
        view.path([p0, (0.0, -0.7 * h)], _AXIS),
        view.path([p1, seen(_turned((r - 0.7 * h, 0.0), -g.pitch))], _AXIS),
        view.length(p0, apex, 30, "L"),
        view.length(p1, apex, -28, "l"),
        view.length(p1, apex, -58, "F"),
        view.label(((p0[0] + p1[0]) / 2, p1[1] / 2), "h", dx=-6, dy=20),
        view.angle(p0, 0.2 * h, -math.pi / 2, slope, "β^0", out=18),
        view.angle(p0, 0.5 * h, chord, slope, "α^2", out=-20),
        view.angle(apex, 0.17 * h, slope + math.pi, face + 2 * math.pi, "α"),
        view.label(p0, "P^0", _NOTE, dx=-18, dy=6),
        view.label(p1, "P^1", _NOTE, dx=6, dy=32),
        view.label(apex, "T", _NOTE, dx=12, dy=-6),
    ]


def _link(view: View, start: Point, end: Point) -> str:
    (x1, y1), (x2, y2) = view.place(start), view.place(end)
    line = f'<path d="M{x1:.2f} {y1:.2f} L{x2:.2f} {y2:.2f}" fill="none" '
    return f'{line}stroke="{INK}" stroke-width="17"/>{line}stroke="{CRANK}" stroke-width="13.8"/>'


def _pawl(view: View, pin: Point, tip: Point, angle: float) -> str:
    w = 7 / view.scale
    shoulder = polar(tip, -3 * w, angle)
    sides = [polar(p, s * w, angle + math.pi / 2) for p, s in ((pin, 1), (shoulder, 1), (shoulder, -1), (pin, -1))]
    outline = view.path([*sides[:2], tip, *sides[2:]], f'fill="{PAWL}" {_EDGE}', closed=True)
    eye = view.circle(pin, 9, f'fill="{PAWL}" {_EDGE}') + view.circle(pin, 4, f'fill="#fff" {_EDGE}')
    return outline + eye


def _range(start: float, end: float) -> list[float]:
    return [start + (end - start) * k / 100 for k in range(101)]


if __name__ == "__main__":
    shown = MODEL.values()
    rewrite("ratchet", drawing(shown), icon, shown)
