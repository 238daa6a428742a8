"""The drawings of the page of profiles: the standard motion laws, and the cam of the slides."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from docs.drawings.pictures import INK, Point, polar, sheet
from mechanism_fmu.kinematics.profiles import curve_values
from mechanism_fmu.model import Curve, Piece, cycloidal, modified_sine, polynomial_345
from mechanism_fmu.slides import CAM

from .sketch import ACCENT, AXIS, BODY_I, BODY_J, EDGE, NOTE, THIN, Sketch

COLOURS = {"cycloidal": "#1d6996", "modified_sine": ACCENT, "polynomial_345": "#2d936c"}
LAWS = {"cycloidal": cycloidal, "modified_sine": modified_sine, "polynomial_345": polynomial_345}
_STEPS = 200


def value(curve: Curve, x: float, order: int) -> float:
    """A derivative of a curve."""
    return float(curve_values(curve, np.array([x]))[order, 0])


def motion_laws() -> str:
    """Lift, velocity and acceleration over the width of a move, of all three laws."""
    axes = [("lift", "h", 1.0, (0.0, 1.0)), ("velocity", "(h/β)", 2.2, (0.0, 1.0, 2.0))]
    rows = [*axes, ("acceleration", "(h/β²)", 7.0, (-6.0, -3.0, 0.0, 3.0, 6.0))]
    parts: list[str] = []
    for order, (name, unit, most, ticks) in enumerate(rows):
        parts += _chart(70 + 345 * order, f"{name} / {unit}", order, most, ticks)
    for k, name in enumerate(LAWS):
        x = 180 + 300 * k
        line = f'fill="none" stroke="{COLOURS[name]}" stroke-width="2.4"'
        parts.append(f'<path d="M{x} 372 h40" {line}/>')
        parts.append(f'<text x="{x + 52}" y="377" {NOTE} style="text-anchor:start">{name}</text>')
    return sheet(1100, 400, "Lift, velocity and acceleration of the three motion laws", parts)


def _chart(left: float, title: str, order: int, most: float, ticks: Sequence[float]) -> list[str]:
    """One chart: x from 0 to 1, y up to `most`, from `-most` where a tick is negative."""
    low = -most if min(ticks) < 0 else 0.0
    height, width, bottom = 250.0, 280.0, 320.0

    def place(x: float, y: float) -> Point:
        return left + width * x, bottom - height * (y - low) / (most * 1.04 - low)

    parts = [f'<text x="{left + width / 2:.1f}" y="38" {NOTE}>{title}</text>']
    for y in ticks:
        (x0, y0), (x1, _) = place(0.0, y), place(1.0, y)
        parts.append(f'<path d="M{x0:.2f} {y0:.2f} H{x1:.2f}" fill="none" stroke="#cbd2d9" stroke-width="1"/>')
        parts.append(f'<text x="{x0 - 16:.2f}" y="{y0 + 5:.2f}" {NOTE}>{y:g}</text>')
    for x in (0.0, 0.5, 1.0):
        x0, y0 = place(x, low)
        parts.append(f'<text x="{x0:.2f}" y="{y0 + 20:.2f}" {NOTE}>{x:g}</text>')
    x0, y0 = place(0.75, low)
    parts.append(f'<text x="{x0:.2f}" y="{y0 + 20:.2f}">ξ/β</text>')
    for name, law in LAWS.items():
        parts.append(_graph(law(0.0, 0.0, 1.0, 1.0), order, place, COLOURS[name]))
    return parts


def _graph(pieces: tuple[Piece, ...], order: int, place: Callable[[float, float], Point], colour: str) -> str:
    curve = Curve(pieces)
    places = np.linspace(0.0, 1.0, _STEPS + 1)
    points = map(place, places.tolist(), curve_values(curve, places)[order].tolist())
    corners = " L".join(f"{x:.2f} {y:.2f}" for x, y in points)
    return f'<path d="M{corners}" fill="none" stroke="{colour}" stroke-width="2"/>'


def slides_cam() -> str:
    """The cam with its roller where it stands at phi = 0, and with its hollows and nose."""
    s, q = Sketch((250, 260), 125), (0.0, 0.0)
    join = 2 * math.pi / 3
    hollow = math.radians(14.96)
    roller, touch = (0.0, 1.532285823696), _nearest((0.0, 1.532285823696))
    filled = f'fill="{BODY_I}" fill-opacity="0.75" {EDGE}'
    concave = f'fill="none" stroke="{ACCENT}" stroke-width="5" stroke-opacity="0.8"'

    def rho(alpha: float) -> float:
        return value(CAM, alpha, 0)

    return sheet(
        600,
        430,
        "The cam of the slides",
        [
            s.outline(rho, q, filled, 0.0, 2 * math.pi),
            s.outline(rho, q, concave, 0.0, hollow),
            s.outline(rho, q, concave, join - hollow, join),
            s.disc(q, 1.0, THIN + ' stroke-dasharray="4 4"'),
            s.path([q, (1.9, 0.0)], AXIS),
            s.path([q, polar(q, 1.35, join)], AXIS),
            s.path([q, polar(q, 1.85, join / 2)], AXIS),
            s.disc(roller, 0.25, f'fill="{BODY_J}" fill-opacity="0.75" {EDGE}'),
            s.angle(q, 0.45, 0.0, join / 2, "α", 13),
            s.path([q, roller], THIN),
            s.dot(roller),
            s.dot(touch, "C", 16, -4),
            s.dot(q, "Q", -14, 10),
            s.text((-0.5, -0.45), "ρ = 1"),
            s.text(polar(q, 1.5, join / 2), "ρ = 3/2", 62, -2),
            s.text((1.2, 0.8), "ρ = 5/4 − ¼ cos 3α", 95, 0),
            s.label((1.0, 0.0), "hollow, curvature −5/4", f'{NOTE} fill="{ACCENT}"', 100, 22),
            s.label(polar(q, 1.0, join), "hollow", f'{NOTE} fill="{ACCENT}"', -60, -8),
            f'<text x="300" y="418" fill="{INK}" {NOTE}>at φ = 0 a roller of radius ¼ stands at y = 1.532286</text>',
        ],
    )


def _nearest(point: Point) -> Point:
    """The point of the slides' cam nearest to another."""
    angles = np.linspace(0.0, 2 * math.pi, 62833)
    x, y = curve_values(CAM, angles)[0] * np.array([np.cos(angles), np.sin(angles)])
    k = np.hypot(x - point[0], y - point[1]).argmin()
    return float(x[k]), float(y[k])
