"""Where the links of a four-bar linkage are and how fast, in closed form from the crank; and what is known of its form.

With the ground d, the crank a, the coupler b, the rocker c and their angles theta, phi, psi:

    a e(theta) + b e(phi) = d e(0) + c e(psi)        e(angle) = (cos(angle), sin(angle))

`values` are those of a model's parameters: crank_length, coupler_length, rocker_length, ground_length, crossed,
crank_angle_start, crank_speed_start.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace

from .functions import Number, atan2, cos, sin, sqrt, where_positive
from .triangles import angle_between


@dataclass(frozen=True)
class Start:
    """The linkage at the start.

    Attributes:
        coupler_angle, coupler_speed: phi [rad] and its rate [rad/s].
        rocker_angle, rocker_speed: psi [rad] and its rate [rad/s].
    """

    coupler_angle: Number
    coupler_speed: Number
    rocker_angle: Number
    rocker_speed: Number


def start(values: SimpleNamespace) -> Start:
    """The start from the crank's angle and speed, by the triangle of crank pin, rocker pin and rocker hinge.

    It needs `diagonal(values)` between |b - c| and b + c.
    """
    a, b, c = values.crank_length, values.coupler_length, values.rocker_length
    theta, speed = values.crank_angle_start, values.crank_speed_start
    side = where_positive(values.crossed, -1.0, 1.0)
    square = _diagonal_square(values)
    # Both angles are seen from the line that goes from the crank pin to the rocker's hinge.
    line = atan2(-a * sin(theta), values.ground_length - a * cos(theta))
    phi = line + side * angle_between(square + b * b - c * c, 4 * square * b * b)
    psi = line + side * angle_between(b * b - c * c - square, 4 * square * c * c)
    across = sin(phi - psi)
    return Start(
        coupler_angle=phi,
        coupler_speed=a * speed * sin(psi - theta) / (b * across),
        rocker_angle=psi,
        rocker_speed=a * speed * sin(phi - theta) / (c * across),
    )


def diagonal(values: SimpleNamespace) -> Number:
    """Distance of the crank pin from the rocker's hinge at the start [m]."""
    return sqrt(_diagonal_square(values))


def _diagonal_square(values: SimpleNamespace) -> Number:
    a, theta = values.crank_length, values.crank_angle_start
    x, y = values.ground_length - a * cos(theta), a * sin(theta)
    return x * x + y * y


@dataclass(frozen=True)
class Form:
    """What is known of a linkage whose crank turns fully.

    Attributes:
        folded: transmission angle, between coupler and rocker, with the crank towards the rocker's hinge [rad].
        stretched: likewise with the crank away from it [rad]. Between these two lie all others. A position that the
            linkage does not reach has 0 or pi, whichever is nearer.
    """

    folded: Number
    stretched: Number


def form(values: SimpleNamespace) -> Form:
    """The transmission angles mu from cos(mu) = (b^2 + c^2 - (d -+ a)^2)/(2 b c)."""
    a, b, c, d = values.crank_length, values.coupler_length, values.rocker_length, values.ground_length
    near, far = d - a, d + a
    sides, product = b * b + c * c, 4 * b * b * c * c
    return Form(angle_between(sides - near * near, product), angle_between(sides - far * far, product))
