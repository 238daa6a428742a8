"""The drawing of the drivers: the same two bodies five times, each time with what one driver prescribes."""

from __future__ import annotations

import math

from docs.drawings.pictures import Point, sheet

from .sketch import AXIS, BODY_I, BODY_J, THIN, Sketch, add, quarter, scale

UNIT = 100
MASS_I, MASS_J = (0.6, 0.65), (2.45, 1.75)
P_I, P_J = (1.0, 0.95), (2.15, 1.4)
_OUTLINE = [(30, 0.62), (90, 0.45), (170, 0.5), (250, 0.45), (320, 0.42)]


def _bodies(s: Sketch) -> list[str]:
    mirrored = [(angle + 180, radius) for angle, radius in _OUTLINE]
    return [
        s.blob(MASS_I, _OUTLINE, BODY_I),
        s.blob(MASS_J, mirrored, BODY_J),
        s.centre(MASS_I, "i", -16, 4),
        s.centre(MASS_J, "j", 16, -4),
    ]


def _points(s: Sketch, with_d: bool = True) -> list[str]:
    between = [s.vector(P_I, P_J, "d", 2, -14)] if with_d else []
    return [*between, s.dot(P_I, "P^i", -14, -12), s.dot(P_J, "P^j", 16, 10)]


def _level(s: Sketch) -> list[str]:
    corner: Point = (P_J[0], P_I[1])
    return [s.path([P_J, corner], THIN), s.length(P_I, corner, -75, "C")]


def _upright(s: Sketch) -> list[str]:
    corner: Point = (P_J[0], P_I[1])
    return [s.path([P_I, corner], THIN), s.length(corner, P_J, -85, "C")]


def _angle(s: Sketch) -> list[str]:
    turned = math.radians(-25)
    away = math.radians(35)
    return [
        s.path([MASS_I, add(MASS_I, (math.cos(turned), math.sin(turned)))], AXIS),
        s.path([MASS_J, add(MASS_J, (math.cos(turned), math.sin(turned)))], AXIS),
        s.path([MASS_J, add(MASS_J, (math.cos(away), math.sin(away)))], AXIS),
        s.angle(MASS_J, 0.8, turned, away, "C", 12),
    ]


def _apart(s: Sketch) -> list[str]:
    return [s.length(P_I, P_J, 55, "C")]


def _axis(s: Sketch) -> list[str]:
    u = (math.cos(math.radians(-8)), math.sin(math.radians(-8)))
    reach = u[0] * (P_J[0] - P_I[0]) + u[1] * (P_J[1] - P_I[1])
    foot = add(P_I, scale(u, reach))
    return [
        s.path([add(P_I, scale(u, -0.5)), add(P_I, scale(u, 2.2))], AXIS),
        s.path([P_J, foot], THIN),
        s.right_angle(foot, scale(quarter(u), 1.0)),
        s.vector(P_I, add(P_I, scale(u, 0.6)), "u^i", 12, 14, 0.75),
        s.length(P_I, foot, -62, "C"),
    ]


def drivers() -> str:
    """All five."""
    panels = [
        ("XDriver", _level, True),
        ("YDriver", _upright, True),
        ("AngleDriver", _angle, False),
        ("DistanceDriver", _apart, True),
        ("TranslationalDriver", _axis, True),
    ]
    parts: list[str] = []
    for number, (name, prescribed, with_points) in enumerate(panels):
        column, row = number % 3, number // 3
        x = 20 + 340 * column + 170 * row
        s = Sketch((x, 260 + 290 * row), UNIT)
        parts += _bodies(s)
        if with_points:
            parts += _points(s)
        parts += prescribed(s)
        parts.append(s.note((1.5, -0.18), name))
    return sheet(1080, 600, "What each of the five drivers prescribes", parts)
