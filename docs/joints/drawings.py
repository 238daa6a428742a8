"""The drawings of the pages of joints.

python -m docs.joints.drawings      rewrites the .svg files beside this file, in the root of a clone
"""

from __future__ import annotations

import math
from pathlib import Path

from models.svg import Point, polar, sheet

from .driver_drawing import drivers
from .profile_drawings import motion_laws, slides_cam
from .sketch import AXIS, BODY_I, BODY_J, EDGE, LINE, THIN, Sketch, add, quarter, scale, turn

WIDTH, HEIGHT = 520, 340
ROUND = [(0, 0.6), (70, 0.52), (140, 0.62), (200, 0.5), (270, 0.56)]


def _sketch(x: float = 40, y: float = 300, unit: float = 100) -> Sketch:
    return Sketch((x, y), unit)


def _sheet(title: str, parts: list[str]) -> str:
    return sheet(WIDTH, HEIGHT, title, parts)


def revolute() -> str:
    """A pin through two bodies."""
    s = _sketch()
    i, j, p = (1.1, 0.95), (3.4, 1.75), (2.3, 1.25)
    return _sheet(
        "Revolute joint",
        [
            s.blob(i, [(-10, 1.35), (40, 1.2), (95, 0.75), (170, 0.75), (250, 0.65), (310, 0.85)], BODY_I),
            s.blob(j, [(0, 0.75), (60, 0.8), (130, 0.75), (190, 1.45), (222, 1.35), (290, 0.7)], BODY_J),
            s.vector(i, p, "s^i", 2, -14),
            s.vector(j, p, "s^j", 2, -14),
            s.centre(i, "i", -16, 6),
            s.centre(j, "j", 18, 0),
            s.pin(p, "P", 0, -24),
        ],
    )


def translational() -> str:
    """A block on a bar, with the points and vectors along the axis."""
    s, angle = _sketch(), math.radians(14)
    u = (math.cos(angle), math.sin(angle))
    start = (0.5, 0.75)
    middle, p_i, p_j = add(start, scale(u, 1.9)), add(start, scale(u, 0.75)), add(start, scale(u, 2.7))
    i, j = add(p_i, scale(quarter(u), -0.55)), add(p_j, scale(quarter(u), 0.62))
    lower = add(middle, scale(quarter(u), -0.48))
    return _sheet(
        "Translational joint",
        [
            s.box(lower, 3.9, 0.96, angle, BODY_I),
            s.box(add(p_j, scale(quarter(u), 0.45)), 1.3, 0.9, angle, BODY_J),
            s.path([add(start, scale(u, -0.4)), add(start, scale(u, 4.2))], AXIS),
            s.vector(i, p_i, "s^i", 16, 2),
            s.vector(j, p_j, "s^j", 18, -2),
            s.vector(p_i, p_j, "d", -4, -14, 0.42),
            s.vector(add(p_i, scale(u, -0.95)), add(p_i, scale(u, -0.2)), "v^i", -6, -15),
            s.vector(p_j, add(p_j, scale(u, 1.05)), "v^j", 12, -14, 0.8),
            s.centre(i, "i", -18, 4),
            s.centre(j, "j", -18, -2),
            s.dot(p_i, "P^i", 0, -18),
            s.dot(p_j, "P^j", -2, 18),
        ],
    )


def distance() -> str:
    """A rod between two bodies."""
    s = _sketch()
    i, j, p_i, p_j = (0.75, 0.75), (3.75, 1.55), (1.2, 1.35), (3.25, 2.15)
    return _sheet(
        "Distance",
        [
            s.blob(i, [(20, 0.6), (55, 1.05), (100, 0.75), (170, 0.62), (250, 0.6), (320, 0.62)], BODY_I),
            s.blob(j, [(10, 0.62), (75, 0.75), (130, 1.1), (175, 0.65), (250, 0.62), (320, 0.6)], BODY_J),
            s.path([p_i, p_j], 'fill="none" stroke="#52606d" stroke-width="7" stroke-opacity="0.55"'),
            s.vector(i, p_i, "s^i", -18, 0),
            s.vector(j, p_j, "s^j", 20, -4),
            s.vector(p_i, p_j, "d", 6, 16),
            s.length(p_i, p_j, 48, "C"),
            s.centre(i, "i", -16, 6),
            s.centre(j, "j", 18, 4),
            s.pin(p_i, "P^i", -22, -10),
            s.pin(p_j, "P^j", 26, -10),
        ],
    )


def revolute_translational() -> str:
    """A pin at a distance from a line of body i."""
    s, angle = _sketch(), math.radians(10)
    u = (math.cos(angle), math.sin(angle))
    p_i = (1.0, 0.8)
    p_j = add(p_i, scale(u, 1.9), scale(quarter(u), 0.75))
    i, j = add(p_i, (0.2, -0.5)), add(p_j, (0.95, 0.45))
    foot = add(p_i, scale(u, 1.9))
    return _sheet(
        "Revolute-translational composite joint",
        [
            s.box(add(p_i, scale(u, 1.2), scale(quarter(u), -0.35)), 3.7, 0.7, angle, BODY_I),
            s.blob(j, [(0, 0.6), (80, 0.55), (150, 0.75), (206, 1.3), (250, 0.75), (310, 0.55)], BODY_J),
            s.path([add(p_i, scale(u, -0.65)), add(p_i, scale(u, 3.3))], AXIS),
            s.path([add(p_j, scale(u, -1.3)), add(p_j, scale(u, 1.9))], THIN + ' stroke-dasharray="4 4"'),
            s.length(foot, p_j, -95, "c"),
            s.vector(i, p_i, "s^i", -18, 2),
            s.vector(j, p_j, "s^j", 2, -16),
            s.vector(p_i, p_j, "d", -8, -14),
            s.vector(p_i, add(p_i, scale(u, 0.85)), "u^i", 8, 16),
            s.vector(p_i, add(p_i, scale(quarter(u), 0.7)), "n", -14, -4, 0.8),
            s.centre(i, "i", 18, 4),
            s.centre(j, "j", 18, 0),
            s.dot(p_i, "P^i", -20, -12),
            s.pin(p_j, "P^j", -4, -24),
        ],
    )


def _wheel(s: Sketch, centre: Point, radius: float, colour: str, name: str, offset: tuple[float, float]) -> str:
    return s.disc(centre, radius, f'fill="{colour}" fill-opacity="0.75" {EDGE}') + s.pin(centre, name, *offset)


def gears() -> str:
    """Two pitch circles side by side."""
    s, theta = _sketch(), math.radians(20)
    r_i, r_j = 1.15, 0.8
    p_i = (1.35, 1.2)
    p_j = polar(p_i, r_i + r_j, theta)
    mark_i, mark_j = math.radians(75), math.radians(100)
    return _sheet(
        "External gears",
        [
            _wheel(s, p_i, r_i, BODY_I, "P^i", (-8, 24)),
            _wheel(s, p_j, r_j, BODY_J, "P^j", (12, 24)),
            s.path([polar(p_i, -0.4, theta), polar(p_i, r_i + 2 * r_j + 0.4, theta)], AXIS),
            s.path([p_i, add(p_i, (1.0, 0.0))], AXIS),
            s.angle(p_i, 0.8, 0.0, theta, "θ", 15),
            s.path([p_i, polar(p_i, r_i, mark_i)], THIN),
            s.path([p_j, polar(p_j, r_j, mark_j)], THIN),
            s.dot(polar(p_i, r_i, mark_i), "θ^i", -8, -18),
            s.dot(polar(p_j, r_j, mark_j), "θ^j", 0, -18),
            s.vector(p_i, polar(p_i, r_i, math.radians(205)), "R^i", -2, -15, 0.6),
            s.vector(p_j, polar(p_j, r_j, math.radians(-45)), "R^j", 16, -8, 0.6),
            s.vector(p_i, add(p_i, scale(quarter(polar((0, 0), 1, theta)), 0.6)), "n", -14, 2, 0.85),
            s.vector(p_i, p_j, "d", -6, -14, 0.42),
        ],
    )


def internal_gears() -> str:
    """A pitch circle inside a larger one."""
    s, theta = _sketch(), math.radians(42)
    r_i, r_j = 1.38, 0.7
    p_i = (2.2, 1.3)
    p_j = polar(p_i, r_i - r_j, theta)
    mark_i, mark_j = math.radians(125), math.radians(150)
    ring = f'fill="{BODY_I}" fill-opacity="0.75" {EDGE}'
    return sheet(
        WIDTH,
        HEIGHT,
        "Internal gears",
        [
            s.disc(p_i, r_i + 0.18, ring),
            s.disc(p_i, r_i, f'fill="#fff" {EDGE}'),
            s.disc(p_j, r_j, f'fill="{BODY_J}" fill-opacity="0.75" {EDGE}'),
            s.path([polar(p_i, -1.0, theta), polar(p_i, r_i + 0.55, theta)], AXIS),
            s.path([p_i, add(p_i, (1.2, 0.0))], AXIS),
            s.angle(p_i, 0.42, 0.0, theta, "θ", 13),
            s.path([p_i, polar(p_i, r_i, mark_i)], THIN),
            s.path([p_j, polar(p_j, r_j, mark_j)], THIN),
            s.pin(p_i, "P^i", -6, 26),
            s.pin(p_j, "P^j", 30, 4),
            s.dot(polar(p_i, r_i, mark_i), "θ^i", 6, 24),
            s.dot(polar(p_j, r_j, mark_j), "θ^j", -18, -4),
            s.vector(p_i, polar(p_i, r_i, math.radians(200)), "R^i", 0, -15, 0.6),
            s.vector(p_j, polar(p_j, r_j, math.radians(95)), "R^j", 18, -2, 0.6),
            s.vector(p_i, add(p_i, scale(quarter(polar((0, 0), 1, theta)), 0.6)), "n", -14, 0, 0.85),
            s.vector(p_i, p_j, "d", -10, -12, 0.6),
        ],
    )


def rack_and_pinion() -> str:
    """A pitch circle on the pitch line of a rack."""
    s, angle, radius = _sketch(), math.radians(8), 0.85
    u = (math.cos(angle), math.sin(angle))
    p_i, q_i = (0.9, 0.85), (1.75, 0.85 + 0.85 * math.tan(angle))
    touch = add(p_i, scale(u, 2.35))
    p_j = add(touch, scale(quarter(u), radius))
    mark = math.radians(318)
    return _sheet(
        "Rack and pinion",
        [
            s.box(add(p_i, scale(u, 1.5), scale(quarter(u), -0.3)), 4.0, 0.6, angle, BODY_I),
            s.disc(p_j, radius, f'fill="{BODY_J}" fill-opacity="0.75" {EDGE}'),
            s.path([add(p_i, scale(u, -0.6)), add(p_i, scale(u, 3.7))], AXIS),
            s.path([p_j, touch], THIN),
            s.path([p_j, polar(p_j, radius, mark)], THIN),
            s.vector(p_j, polar(p_j, radius, math.radians(35)), "R^j", -8, -14, 0.6),
            s.vector(p_i, p_j, "d", -6, -14, 0.4),
            s.vector(p_i, add(p_i, scale(quarter(u), 0.75)), "n", -14, -2, 0.8),
            s.vector(p_i, add(p_i, scale(u, 0.6)), "u", 0, 18, 0.6),
            s.dot(p_i, "P^i", -22, 10),
            s.dot(q_i, "Q^i", 4, 20),
            s.dot(polar(p_j, radius, mark), "θ^j", 20, 4),
            s.pin(p_j, "P^j", 2, -26),
        ],
    )


def _cam(alpha: float) -> float:
    """An egg that is a fair cam."""
    return 0.85 + 0.28 * math.cos(alpha) + 0.05 * math.cos(2 * alpha)


def _cam_slope(alpha: float) -> float:
    return -0.28 * math.sin(alpha) - 0.1 * math.sin(2 * alpha)


def _tangent(alpha: float) -> Point:
    """The unit tangent of the egg."""
    e = (math.cos(alpha), math.sin(alpha))
    g = add(scale(e, _cam_slope(alpha)), scale(quarter(e), _cam(alpha)))
    return scale(g, 1 / math.hypot(*g))


def _with_cam(s: Sketch, q: Point, phi: float, alpha: float) -> tuple[list[str], Point, Point]:
    """A cam that is turned by phi, its coordinate alpha, the point of contact there and the tangent."""
    touch = polar(q, _cam(alpha), phi + alpha)
    tangent = turn(_tangent(alpha), phi)
    filled = f'fill="{BODY_I}" fill-opacity="0.75" {EDGE}'
    parts = [
        s.outline(lambda a: _cam(a - phi), q, filled, 0.0, 2 * math.pi),
        s.path([q, polar(q, 1.5, phi)], AXIS),
        s.angle(q, 0.42, phi, phi + alpha, "α^i", 15),
        s.vector(q, touch, "ρ^i", -16, -2, 0.55),
    ]
    return parts, touch, tangent


def cam_follower() -> str:
    """A cam with a roller."""
    s, q, radius = _sketch(), (1.9, 0.9), 0.55
    parts, c, t = _with_cam(s, q, math.radians(-20), math.radians(70))
    q_j = add(c, scale(quarter(t), -radius))
    filled = f'fill="{BODY_J}" fill-opacity="0.75" {EDGE}'
    opposite = math.atan2(c[1] - q_j[1], c[0] - q_j[0])
    start = opposite - math.radians(130)
    return _sheet(
        "Cam-follower",
        [
            *parts,
            s.disc(q_j, radius, filled),
            s.path([q_j, polar(q_j, radius + 0.25, start)], AXIS),
            s.angle(q_j, 0.3, start, opposite, "α^j", 14),
            s.path([add(c, scale(t, -0.9)), add(c, scale(t, 0.9))], THIN),
            s.vector(q_j, c, "ρ^j", 16, 10, 0.55),
            s.vector(c, add(c, scale(t, 0.75)), "g^i", -2, -16, 0.8),
            s.vector(c, add(c, scale(t, -0.75)), "g^j", 22, -2, 0.8),
            s.dot(q, "s^i", -16, 10),
            s.dot(q_j, "s^j", 4, -18),
            s.dot(c, "C", 4, 22),
            s.note(add(q, (0.3, -0.5)), "body i"),
            s.note(add(q_j, (radius + 0.4, 0.1)), "body j"),
        ],
    )


def cam_flat_follower() -> str:
    """A cam under a face."""
    s, q = _sketch(), (1.8, 1.15)
    phi = math.radians(50)
    # The face is level: the tangent at alpha points to the left.
    low, high = 0.0, math.pi
    for _ in range(60):
        alpha = (low + high) / 2
        if turn(_tangent(alpha), phi)[1] > 0:
            low = alpha
        else:
            high = alpha
    parts, c, t = _with_cam(s, q, phi, alpha)
    p_j = (c[0] + 1.3, c[1])
    return _sheet(
        "Cam-flat-faced follower",
        [
            *parts,
            s.box((c[0] + 0.25, c[1] + 0.25), 3.6, 0.5, 0.0, BODY_J),
            s.vector(c, add(c, scale(t, 0.8)), "g^i", -6, 18, 0.8),
            s.vector(p_j, add(p_j, (-0.7, 0.0)), "u^j", 0, 18, 0.5),
            s.vector(p_j, add(p_j, (0.0, -0.75)), "n = R u^j", 42, 0, 0.8),
            s.dot(q, "s^i", -16, 10),
            s.dot(c, "C", 4, -20),
            s.dot(p_j, "P^j", 4, -20),
            s.note(add(q, (0.0, -0.5)), "body i"),
            s.note((c[0] - 1.15, c[1] + 0.2), "body j"),
        ],
    )


def point_follower() -> str:
    """A pin in a curved slot of body j."""
    s, q = _sketch(), (1.9, 0.75)
    first, last = math.radians(20), math.radians(130)

    def rho(alpha: float) -> float:
        return 1.35 + 0.15 * math.cos(3 * alpha)

    alpha = math.radians(62)
    p = polar(q, rho(alpha), alpha)
    e = (math.cos(alpha), math.sin(alpha))
    g = add(scale(e, -0.45 * math.sin(3 * alpha)), scale(quarter(e), rho(alpha)))
    t = scale(g, 1 / math.hypot(*g))
    i = (3.75, 2.35)
    groove = 'fill="none" stroke="#fff" stroke-width="17"'
    edge = LINE.replace('"1.6"', '"20"')
    plate = [(20, 1.95), (50, 1.7), (80, 1.6), (110, 1.65), (140, 1.95), (180, 1.0), (230, 0.8), (300, 0.8), (345, 1.0)]
    return _sheet(
        "Point-follower",
        [
            s.blob(q, plate, BODY_J),
            s.outline(rho, q, edge, first, last),
            s.outline(rho, q, groove, first, last),
            s.outline(rho, q, AXIS, first, last),
            s.blob(i, [(0, 0.5), (70, 0.45), (140, 0.6), (197, 1.4), (222, 1.3), (280, 0.5)], BODY_I),
            s.path([q, add(q, (1.2, 0.0))], AXIS),
            s.angle(q, 0.5, 0.0, alpha, "α^j", 15),
            s.vector(q, p, "ρ^j", -14, -6, 0.55),
            s.vector(p, add(p, scale(t, 0.8)), "g^j", 0, -16, 0.85),
            s.vector(i, p, "s^i", 0, -16, 0.5),
            s.centre(i, "i", 18, 0),
            s.dot(q, "s^j", -16, 10),
            s.pin(p, "P^i", 12, 24),
        ],
    )


DRAWINGS = {
    "revolute": revolute,
    "translational": translational,
    "distance": distance,
    "revolute_translational": revolute_translational,
    "gears": gears,
    "internal_gears": internal_gears,
    "rack_and_pinion": rack_and_pinion,
    "drivers": drivers,
    "cam_follower": cam_follower,
    "cam_flat_follower": cam_flat_follower,
    "point_follower": point_follower,
    "motion_laws": motion_laws,
    "slides_cam": slides_cam,
}


def main() -> None:
    """Rewrite all drawings."""
    for name, draw in DRAWINGS.items():
        (Path(__file__).parent / f"{name}.svg").write_text(draw(), encoding="utf-8")


if __name__ == "__main__":
    main()
