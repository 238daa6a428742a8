"""Drawings of joints with pins and slides."""

from __future__ import annotations

import math

from .sketch import AXIS, BODY_I, BODY_J, THIN, add, joint_sheet, joint_sketch, quarter, scale


def revolute() -> str:
    """A pin through two bodies."""
    s = joint_sketch()
    i, j, p = (1.1, 0.95), (3.4, 1.75), (2.3, 1.25)
    return joint_sheet(
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
    s, angle = joint_sketch(), math.radians(14)
    u = (math.cos(angle), math.sin(angle))
    start = (0.5, 0.75)
    middle, p_i, p_j = add(start, scale(u, 1.9)), add(start, scale(u, 0.75)), add(start, scale(u, 2.7))
    i, j = add(p_i, scale(quarter(u), -0.55)), add(p_j, scale(quarter(u), 0.62))
    lower = add(middle, scale(quarter(u), -0.48))
    return joint_sheet(
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
    s = joint_sketch()
    i, j, p_i, p_j = (0.75, 0.75), (3.75, 1.55), (1.2, 1.35), (3.25, 2.15)
    return joint_sheet(
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
    s, angle = joint_sketch(), math.radians(10)
    u = (math.cos(angle), math.sin(angle))
    p_i = (1.0, 0.8)
    p_j = add(p_i, scale(u, 1.9), scale(quarter(u), 0.75))
    i, j = add(p_i, (0.2, -0.5)), add(p_j, (0.95, 0.45))
    foot = add(p_i, scale(u, 1.9))
    return joint_sheet(
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
