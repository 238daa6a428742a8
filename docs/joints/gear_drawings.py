"""Drawings of gears, and of rack and pinion."""

from __future__ import annotations

import math

from docs.drawings.pictures import INK, Point, polar, sheet
from mechanism_fmu.slides import CARRIER, MARK_1, MARK_2, RADIUS_1, RADIUS_2, rolled_angle

from .sketch import AXIS, BODY_I, BODY_J, EDGE, NOTE, THIN, Sketch, add, joint_sheet, joint_sketch, quarter, scale


def _wheel(s: Sketch, centre: Point, radius: float, colour: str, name: str, offset: tuple[float, float]) -> str:
    return s.disc(centre, radius, f'fill="{colour}" fill-opacity="0.75" {EDGE}') + s.pin(centre, name, *offset)


def gears() -> str:
    """Two pitch circles side by side."""
    s, theta = joint_sketch(), math.radians(20)
    r_i, r_j = 1.15, 0.8
    p_i = (1.35, 1.2)
    p_j = polar(p_i, r_i + r_j, theta)
    mark_i, mark_j = math.radians(75), math.radians(100)
    return joint_sheet(
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
    s, theta = joint_sketch(), math.radians(42)
    r_i, r_j = 1.38, 0.7
    p_i = (2.2, 1.3)
    p_j = polar(p_i, r_i - r_j, theta)
    mark_i, mark_j = math.radians(125), math.radians(150)
    ring = f'fill="{BODY_I}" fill-opacity="0.75" {EDGE}'
    return joint_sheet(
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
    s, angle, radius = joint_sketch(), math.radians(8), 0.85
    u = (math.cos(angle), math.sin(angle))
    p_i, q_i = (0.9, 0.85), (1.75, 0.85 + 0.85 * math.tan(angle))
    touch = add(p_i, scale(u, 2.35))
    p_j = add(touch, scale(quarter(u), radius))
    mark = math.radians(318)
    return joint_sheet(
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


def gears_falling() -> str:
    """Example 3.4.1 of the slides: gear 2 where it is let go, and at the bottom."""
    s, p_1 = Sketch((300, 250), 58), (0.0, 0.0)
    wheel_1 = f'fill="{BODY_I}" fill-opacity="0.75" {EDGE}'
    parts = [s.disc(p_1, RADIUS_1, wheel_1)]
    for carrier, ghost in (
        (MARK_1, ' stroke-dasharray="5 4" fill-opacity="0.3"'),
        (-math.pi / 2, ' fill-opacity="0.75"'),
    ):
        p_2, phi = polar(p_1, CARRIER, carrier), rolled_angle(carrier)
        mark = polar(p_2, RADIUS_2, phi + MARK_2)
        parts += [
            s.disc(p_2, RADIUS_2, f'fill="{BODY_J}" {EDGE}{ghost}'),
            s.path([p_1, p_2], AXIS),
            s.vector(p_2, polar(p_2, 0.95, phi), "x^2", 0, -14, 1.0),
            s.path([p_2, mark], THIN),
            s.dot(mark),
        ]
        parts.append(s.dot(p_2, "P^2", 16, 12))
    parts += [
        s.hinge(p_1),
        s.angle(p_1, 0.75, 0.0, MARK_1, "π/6", 16),
        s.text(polar(p_1, CARRIER, MARK_1), "φ₂ = 0", 0, -62),
        s.text(polar(p_1, CARRIER, -math.pi / 2), "φ₂ = −π", -35, 40),
        s.text(p_1, "P^1", -24, -14),
        s.label(p_1, "dots: the mark θ₂ of gear 2", f'{NOTE} fill="{INK}"', 170, 260),
    ]
    return sheet(600, 560, "Gear 2 falls around gear 1", parts)
