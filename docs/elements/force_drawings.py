"""Drawings of forces, and of springs between points and angles."""

from __future__ import annotations

import math

from docs.drawings.pictures import polar
from docs.joints.sketch import AXIS, BODY_I, BODY_J, EDGE, LINE, THIN

from .pieces import element_sheet, element_sketch

_LEFT = [(0, 0.65), (60, 0.5), (130, 0.55), (200, 0.65), (290, 0.55)]
_RIGHT = [(0, 0.65), (70, 0.55), (150, 0.62), (180, 0.65), (220, 0.6), (290, 0.55)]


def torque() -> str:
    """A torque on a disc, and its reaction on another."""
    s = element_sketch()
    i, j = (1.1, 1.2), (3.3, 1.2)
    return element_sheet(
        "Torque",
        [
            s.disc(i, 0.75, f'fill="{BODY_I}" fill-opacity="0.75" {EDGE}'),
            s.disc(j, 0.75, f'fill="{BODY_J}" fill-opacity="0.75" {EDGE}'),
            s.pin(i),
            s.pin(j),
            s.angle(i, 1.0, math.radians(20), math.radians(150), "torque", 16),
            s.angle(j, 1.0, math.radians(150), math.radians(20), "−torque", 16),
            s.note(i, "body", -48),
            s.note(j, "reaction", -48),
        ],
    )


def force() -> str:
    """A force at the centre of mass, one at a point, and the weight."""
    s = element_sketch()
    c, p = (2.0, 1.3), (3.1, 1.75)
    return element_sheet(
        "Force, PointForce and gravity",
        [
            s.blob(c, [(0, 1.3), (40, 1.4), (90, 0.8), (170, 1.0), (250, 0.8), (310, 0.9)], BODY_I),
            s.vector(c, p, "a", 6, 16),
            s.vector(c, (0.6, 1.75), "Force", 0, -16, 0.7),
            s.vector(p, (4.1, 2.45), "PointForce", 0, -16, 0.9),
            s.vector(c, (2.0, 0.15), "m g", 26, 0, 0.75),
            s.centre(c, ""),
            s.dot(p, "P", 16, 12),
        ],
    )


def marker() -> str:
    """A point of a body, its place from the origin and its velocity."""
    s = element_sketch()
    c, p, o = (2.3, 1.1), (3.2, 1.75), (0.5, 0.3)
    return element_sheet(
        "Marker",
        [
            s.blob(c, [(0, 1.3), (40, 1.4), (90, 0.8), (170, 1.0), (250, 0.8), (310, 0.9)], BODY_I),
            s.path([o, (1.3, 0.3)], AXIS),
            s.path([o, (0.5, 1.1)], AXIS),
            s.vector(o, p, "(x, y)", -8, -14, 0.7),
            s.vector(c, p, "s", 8, 16),
            s.vector(p, (2.75, 2.4), "(x_rate, y_rate)", 84, -8, 0.7),
            s.centre(c, ""),
            s.dot(p, "P", 16, 12),
        ],
    )


def oscillation() -> str:
    """A pendulum at its extremes and at its middle."""
    s = element_sketch()
    o, middle, reach = (2.2, 2.3), math.radians(-90), math.radians(32)
    ends = [polar(o, 1.75, middle + side * reach) for side in (-1, 0, 1)]
    return element_sheet(
        "Oscillation",
        [
            *(s.path([o, end], AXIS if k == 1 else THIN) for k, end in enumerate(ends)),
            *(s.disc(end, 0.2, f'fill="{BODY_I}" fill-opacity="0.75" {EDGE}') for end in (ends[0], ends[2])),
            s.pin(o),
            s.angle(o, 1.2, middle, middle + reach, "amplitude", 30),
            s.note(ends[1], "middle", -14),
        ],
    )


def spring_damper() -> str:
    """Two bodies with a spring and a damper between them."""
    s = element_sketch()
    i, j, p, q = (0.45, 1.3), (4.05, 1.3), (1.0, 1.3), (3.5, 1.3)
    up, down = 0.28, -0.28
    bars = [[(x, 1.3 + down), (x, 1.3 + up)] for x in (1.3, 3.2)]
    return element_sheet(
        "SpringDamper",
        [
            s.blob(i, _LEFT, BODY_I),
            s.blob(j, _RIGHT, BODY_J),
            *(s.path(bar, LINE) for bar in bars),
            s.path([p, (1.3, 1.3)], LINE),
            s.path([(3.2, 1.3), q], LINE),
            s.spring((1.3, 1.3 + up), (3.2, 1.3 + up)),
            s.damper((1.3, 1.3 + down), (3.2, 1.3 + down)),
            s.dot(p, "P", -4, 22),
            s.dot(q, "Q", 4, 22),
            s.length(p, q, 85, "l"),
            s.vector((1.3, 0.55), (1.95, 0.55), "f", 0, 18),
            s.vector((3.2, 0.55), (2.55, 0.55), "f", 0, 18),
            s.note((0.4, 1.3), "body", 0),
            s.note((4.15, 1.3), "reaction", 0),
        ],
    )


def torsion_spring() -> str:
    """A lever with a spiral spring about its hinge."""
    s = element_sketch()
    o, angle = (1.6, 0.9), math.radians(38)
    end = polar(o, 2.4, angle)
    turns = [0.1 + 0.035 * k for k in range(16)]
    spiral = [polar(o, 0.12 + 0.4 * k / 100, angle + 4 * math.pi * (k / 100 - 1)) for k in range(101)]
    return element_sheet(
        "TorsionSpring, Damper, TorsionSpringDamper",
        [
            s.box(polar(o, 1.15, angle), 2.7, 0.3, angle, BODY_I),
            s.path([o, (o[0] + 2.6, o[1])], AXIS),
            s.path(spiral, LINE),
            s.path([polar(o, 0.52, angle), polar(o, turns[-1] + 0.2, angle)], LINE),
            s.hinge(o),
            s.angle(o, 1.9, 0.0, angle, "θ", 14),
            s.angle(o, 1.25, angle + 0.75, angle + 0.16, "m", 14),
            s.dot(end),
            s.note((0.75, 0.9), "reaction", 0),
            s.note((3.1, 2.75), "body", 0),
        ],
    )


def bushing() -> str:
    """A point held by springs along two axes."""
    s = element_sketch()
    o, p = (1.5, 0.9), (2.35, 1.55)
    return element_sheet(
        "Bushing",
        [
            s.blob((2.9, 2.0), [(0, 1.0), (60, 0.7), (130, 0.6), (210, 1.0), (290, 0.7)], BODY_I),
            s.ground((0.1, 2.1), (0.1, 0.9)),
            s.ground((1.8, -0.05), (3.0, -0.05)),
            s.spring((0.1, 1.55), p),
            s.spring((2.35, -0.05), p),
            s.vector(o, (2.25, 0.9), "x", 10, 14, 0.9),
            s.vector(o, (1.5, 1.4), "y", -14, 0, 0.9),
            s.path([o, p], THIN),
            s.dot(o, "Q", -12, 14),
            s.dot(p, "P", 14, -14),
            s.angle((2.9, 2.0), 0.55, 0.2, 1.7, "θ", 14),
            s.note((3.35, 1.75), "body", 0),
            s.note((0.85, 0.55), "reaction", 0),
        ],
    )


def nonlinear_spring() -> str:
    """A force over a length, through points."""
    s = element_sketch()
    curve = [(0.5 + 0.035 * k, 0.95 + 0.35 * math.tanh(0.06 * (k - 30)) + 0.000004 * (k - 30) ** 3) for k in range(101)]
    places = [curve[k] for k in (5, 30, 62, 90)]
    return element_sheet(
        "A law of force",
        [
            s.vector((0.3, 0.95), (4.3, 0.95), "l", 0, 18, 0.98),
            s.vector((0.5, 0.1), (0.5, 2.8), "law", 26, 0, 0.95),
            s.path(curve, f'{LINE} stroke-dasharray="none"'),
            *(s.dot(place) for place in places),
            s.note((3.0, 0.45), "below 0: pushes", 0),
            s.note((1.6, 2.3), "above 0: pulls", 0),
        ],
    )
