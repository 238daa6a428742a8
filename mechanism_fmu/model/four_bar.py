"""Four-bar linkages: their positions and rates, and what keeps them from turning."""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import SimpleNamespace

from .drawing import Bar, Hinge, Shape
from .findings import Finding, at_most, first, size
from .functions import Number, atan2, cos, sin, sqrt, where_positive
from .port_builders import body_motion_outputs, flag_parameter
from .ports import Calculated

# Sides and angles of triangles, in a form that also has a value where there is no such triangle.
#
# Parameters can be out of reach of each other: these give the nearest that there is, and objections say what is wrong.


def root(square: Number) -> Number:
    """Square root, 0 of what is negative."""
    return sqrt(where_positive(square, square, 0.0))


def angle_between(adjacent: Number, square: Number = 1.0) -> Number:
    """The angle in 0..pi [rad] whose cosine is adjacent/sqrt(square); 0 or pi where that is beyond 1 or -1."""
    return atan2(root(square - adjacent * adjacent), adjacent)


# Where the links of a four-bar linkage are and how fast, in closed form from the crank; and what is known of its form.
#
# With the ground d, the crank a, the coupler b, the rocker c and their angles theta, phi, psi:
#
#     a e(theta) + b e(phi) = d e(0) + c e(psi)        e(angle) = (cos(angle), sin(angle))
#
# `values` are those of a model's parameters: crank_length, coupler_length, rocker_length, ground_length, crossed,
# crank_angle_start, crank_speed_start.


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


# Ports and drawing that all four-bar linkages have.

CROSSED = flag_parameter(
    "crossed",
    False,
    "Whether coupler and rocker are assembled on the other side of the line from crank pin to rocker hinge",
)

MOTIONS = body_motion_outputs({"crank": "theta", "coupler": "phi", "rocker": "psi"})

_CRANK_HINGE, _ROCKER_HINGE = (0.0, 0.0), ("ground_length", 0.0)

SHAPES: tuple[Shape, ...] = (
    Bar("crank", _CRANK_HINGE, "crank_angle", "crank_length"),
    Bar("coupler", "crank", "coupler_angle", "coupler_length"),
    Bar("rocker", _ROCKER_HINGE, "rocker_angle", "rocker_length"),
    *(Hinge(at) for at in (_CRANK_HINGE, _ROCKER_HINGE, "crank", "coupler")),
)


def transmission_angles(values: SimpleNamespace) -> tuple[Calculated, Calculated]:
    """The extreme transmission angles."""
    known = form(values)
    between = "Transmission angle, between coupler and rocker, with the crank pointing"
    return (
        Calculated("folded_transmission_angle", known.folded, f"{between} to the rocker's hinge", "rad", "deg"),
        Calculated("stretched_transmission_angle", known.stretched, f"{between} away from it", "rad", "deg"),
    )


# What is wrong, or odd, with lengths of a four-bar linkage that are each within their limits.

#: Coupler and rocker in line to this fraction of their lengths cannot say where they go.
_IN_LINE = 1e-9
#: Lengths are those of a change point when they are off by less than this fraction of their sum.
_CHANGES_WITHIN = 1e-6

_AT = "at crank_angle_start = {:.6g} deg the crank pin is {:.6g} m from the rocker's hinge"


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the linkage cannot be assembled at the start: value, limit and way out; at most one applies."""
    b, c, distance = values.coupler_length, values.rocker_length, diagonal(values)
    both, difference = b + c, size(b - c)
    where = (values.crank_angle_start * (180 / math.pi), distance)
    return first(
        Finding(
            at_most(distance, _IN_LINE * both),
            "At crank_angle_start = {:.6g} deg the crank pin lies on the rocker's hinge, so that coupler and rocker "
            "can point anywhere: crank_length and ground_length are {:.6g} m. Change one, or crank_angle_start.",
            (where[0], values.crank_length),
        ),
        Finding(
            at_most(both * (1 - _IN_LINE), distance),
            "coupler_length + rocker_length = {:.6g} m is too short: " + _AT + ", so that the two must reach over more "
            "than that. Give links that are longer by more than {:.6g} m in all, or change crank_angle_start.",
            (both, *where, distance - both),
        ),
        Finding(
            at_most(distance, difference + _IN_LINE * both),
            "coupler_length = {:.6g} m and rocker_length = {:.6g} m differ by {:.6g} m, which is too much: " + _AT + "."
            " Give lengths that differ by less than {:.6g} m, or change crank_angle_start.",
            (b, c, difference, *where, distance),
        ),
    )


def warnings(values: SimpleNamespace) -> tuple[Finding, ...]:
    """What the linkage cannot do, by Grashof's rule; it means something only where nothing is objected to."""
    a, b, c, d = values.crank_length, values.coupler_length, values.rocker_length, values.ground_length
    flat = _CHANGES_WITHIN * (a + b + c + d)
    nearest, difference = size(d - a), size(b - c)
    shown = (d, a, b, c)
    return first(
        *(
            Finding(
                flat - size(excess),
                f"Change point: {sums}, with ground_length = {{:.6g}} m, crank_length = {{:.6g}} m, coupler_length = "
                "{:.6g} m, rocker_length = {:.6g} m, so that all links can lie in one line. There the constraints lose "
                "a rank, and whether the linkage goes on open or crossed is undetermined. Change a length by more than "
                "{:.3g} m, or keep the motion away from there.",
                (*shown, flat),
            )
            for sums, excess in (
                ("ground + crank = coupler + rocker", d + a - b - c),
                ("ground + coupler = crank + rocker", d + b - a - c),
                ("ground + rocker = crank + coupler", d + c - a - b),
            )
        ),
        Finding(
            d + a - b - c,
            "The crank cannot turn fully: coupler_length + rocker_length = {:.6g} m is shorter than ground_length + "
            "crank_length = {:.6g} m. It swings between positions where coupler and rocker are stretched in line. For "
            "full turns make the two longer by more than {:.6g} m in all.",
            (b + c, d + a, d + a - b - c),
        ),
        Finding(
            difference - nearest,
            "The crank cannot turn fully: coupler_length and rocker_length differ by {:.6g} m, ground_length and "
            "crank_length only by {:.6g} m. It swings between positions where coupler and rocker are folded in line. "
            "For full turns let the two differ by less than {:.6g} m.",
            (difference, nearest, nearest),
        ),
    )
