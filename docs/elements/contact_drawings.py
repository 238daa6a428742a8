"""Drawings of contacts, their patterns, and of what switches them."""

from __future__ import annotations

import math

from docs.drawings.pictures import polar
from docs.joints.sketch import AXIS, BODY_I, BODY_J, LINE, THIN, add, scale

from .pieces import element_sheet, element_sketch


def point_line_contact() -> str:
    """A point above an inclined line with its normal."""
    s, angle = element_sketch(), math.radians(12)
    u, n = (math.cos(angle), math.sin(angle)), (-math.sin(angle), math.cos(angle))
    o = (0.5, 0.55)
    foot = add(o, scale(u, 2.3))
    p = add(foot, scale(n, 0.5))
    return element_sheet(
        "PointLineContact",
        [
            s.box(add(o, scale(u, 1.9), scale(n, -0.3)), 4.2, 0.6, angle, BODY_J),
            s.blob(
                add(p, (0.25, 0.65)), [(0, 0.6), (70, 0.45), (150, 0.5), (210, 0.5), (249, 0.7), (290, 0.5)], BODY_I
            ),
            s.path([p, foot], THIN),
            s.length(foot, p, -32, "s"),
            s.vector(o, add(o, scale(u, 1.1)), "line", 0, 20, 0.5),
            s.vector(o, add(o, scale(n, 0.75)), "n", -14, 0, 0.8),
            s.dot(p, "P", -14, -10),
            s.note((0.95, 2.1), "open side: left"),
        ],
    )


def outline_contact() -> str:
    """A pallet above the tip of a tooth, with the two nearest points, and the way along the tooth."""
    s = element_sketch()
    root, tip, foot = (0.6, 0.75), (2.6, 1.55), (2.9, 0.75)
    nearest = (2.68, 2.46)
    middle = (1.9, 1.27)
    return element_sheet(
        "OutlineContact",
        [
            s.path([(4.4, 0.75), foot, tip, root, (0.1, 0.75)], LINE),
            s.path([(1.1, 2.85), (2.85, 2.42), (4.1, 2.85)], LINE),
            s.path([nearest, tip], THIN),
            s.length(tip, nearest, 30, "s"),
            s.vector(middle, add(middle, scale((-0.928, -0.371), 0.9)), "", 0, 0),
            s.dot(tip, "R = 0", 34, -4),
            s.note((1.3, 0.45), "material: left of the way"),
            s.note((3.4, 2.3), "segment"),
        ],
    )


def clearance_joint() -> str:
    """A pin that touches the wall of its hole, with their centres, the clearance and the contact angle."""
    s = element_sketch()
    o, angle, hole, pin = (2.2, 1.3), math.radians(-52), 1.15, 0.7
    at = polar(o, hole - pin, angle)
    return element_sheet(
        "ClearanceJoint",
        [
            s.box(o, 3.9, 2.8, 0.0, BODY_J),
            s.disc(o, hole, 'fill="#fff" stroke="#1f2933" stroke-width="1.6"'),
            s.disc(at, pin, f'fill="{BODY_I}" fill-opacity="0.75" stroke="#1f2933" stroke-width="1.6"'),
            s.path([o, (o[0] + 1.8, o[1])], AXIS),
            s.path([o, polar(o, hole + 0.25, angle)], THIN),
            s.angle(o, 0.85, angle, 0.0, "angle", 24),
            s.length(o, at, 26, "d"),
            s.dot(o),
            s.dot(at),
            s.dot(polar(o, hole, angle)),
            s.note((0.75, 2.35), "body j"),
        ],
    )


def angle_stop() -> str:
    """A lever above its stop, with the next latched angles."""
    s = element_sketch()
    o, latched, theta, pitch = (0.9, 0.6), math.radians(8), math.radians(20), math.radians(19)
    ticks = [latched + k * pitch for k in range(3)]
    return element_sheet(
        "AngleStop",
        [
            s.box(polar(o, 1.3, theta), 2.8, 0.24, theta, BODY_I),
            s.path([o, (4.4, o[1])], AXIS),
            *(s.path([polar(o, 2.2, tick), polar(o, 3.1, tick)], LINE) for tick in ticks),
            s.angle(o, 2.95, latched, theta, "s", 14),
            s.angle(o, 2.0, 0.0, latched, "angle", 26),
            s.angle(o, 2.5, ticks[1], ticks[2], "pitch", 24),
            s.hinge(o),
        ],
    )


def angle_lock() -> str:
    """A wheel with notches, one of which is held."""
    s = element_sketch()
    o = (2.1, 1.4)
    ticks = [math.radians(90 * k) for k in range(4)]
    return element_sheet(
        "AngleLock",
        [
            s.disc(o, 1.1, f'fill="{BODY_I}" fill-opacity="0.75" stroke="#1f2933" stroke-width="1.6"'),
            *(s.path([polar(o, 0.75, tick), polar(o, 1.1, tick)], LINE) for tick in ticks),
            s.box((3.35, 1.4), 0.8, 0.2, 0.0, BODY_J),
            s.ground((3.9, 1.0), (3.9, 1.8)),
            s.angle(o, 0.6, ticks[0], ticks[1], "pitch", 18),
            s.pin(o),
            s.note((3.35, 1.75), "closed while"),
        ],
    )


def circular_pattern() -> str:
    """A hexagon with its flats as copies, and the boundary between the first two."""
    s = element_sketch()
    o, size = (2.1, 1.25), 1.1
    corners = [polar(o, size, math.radians(60 * k)) for k in range(6)]
    middles = [polar(o, size * math.cos(math.pi / 6) - 0.22, math.radians(90 + 60 * k)) for k in (0, 1, -1)]
    edge = math.radians(120)
    return element_sheet(
        "CircularPattern",
        [
            s.path(corners, f'fill="{BODY_J}" fill-opacity="0.75" stroke="#1f2933" stroke-width="1.6"', closed=True),
            s.path([polar(o, 1.75, edge), polar(o, -1.4, edge)], AXIS),
            s.vector(polar(o, 1.2, edge), polar(o, 1.65, edge), "boundary", -50, -4, 0.8),
            s.text(middles[0], "0"),
            s.text(middles[1], "1"),
            s.text(middles[2], "−1"),
            s.angle(o, 0.42, math.radians(90), math.radians(150), "pitch", 26),
            s.pin(o),
            s.dot((2.35, o[1] + size * math.cos(math.pi / 6)), "P", 4, -18),
        ],
    )


def logical_function() -> str:
    """A pin in a slot with a mouth, and the distance along the slot."""
    s = element_sketch()
    y, o, p = 1.3, (0.7, 1.3), (2.3, 1.3)
    return element_sheet(
        "LogicalFunction",
        [
            s.box((1.6, y + 0.4), 2.6, 0.5, 0.0, BODY_J),
            s.box((1.6, y - 0.4), 2.6, 0.5, 0.0, BODY_J),
            s.path([o, (4.4, y)], AXIS),
            s.vector(o, (1.5, y), "line", 0, -16, 0.8),
            s.length(o, p, -105, "along"),
            s.length(o, (2.9, y), 105, "below"),
            s.dot(o),
            s.pin(p, "P", 0, -20),
            s.note((3.6, y + 0.25), "0 here"),
        ],
    )
