"""Drawings of cams with their followers."""

from __future__ import annotations

import math

from docs.drawings.pictures import Point, polar

from .sketch import AXIS, BODY_I, BODY_J, EDGE, LINE, THIN, Sketch, add, joint_sheet, joint_sketch, quarter, scale, turn


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
    s, q, radius = joint_sketch(), (1.9, 0.9), 0.55
    parts, c, t = _with_cam(s, q, math.radians(-20), math.radians(70))
    q_j = add(c, scale(quarter(t), -radius))
    filled = f'fill="{BODY_J}" fill-opacity="0.75" {EDGE}'
    opposite = math.atan2(c[1] - q_j[1], c[0] - q_j[0])
    start = opposite - math.radians(130)
    return joint_sheet(
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
    s, q = joint_sketch(), (1.8, 1.15)
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
    return joint_sheet(
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
    s, q = joint_sketch(), (1.9, 0.75)
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
    return joint_sheet(
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
