"""Where the ratchet stands at the start: the crank pin and the pawl against the tooth."""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import SimpleNamespace

from mechanism_fmu.model.functions import Number, atan2, cos, sin, where_positive
from mechanism_fmu.model.sawtooth import Sawtooth, sawtooth
from mechanism_fmu.model.triangles import angle_between, root


@dataclass(frozen=True)
class Pin:
    """The crank pin at the start.

    Attributes:
        x, y: in the global frame, origin at the wheel's hinge [m].
        height: distance from the line of the slope, positive outside the tooth [m].
        distance: from the struck root along the slope, positive towards the apex [m].
    """

    x: Number
    y: Number
    height: Number
    distance: Number


def tooth(values: SimpleNamespace) -> Sawtooth:
    """Geometry of the wheel's teeth."""
    return sawtooth(values.tooth_count, values.tooth_slope_angle, values.wheel_inner_radius, values.slope_ratio)


def crank_pin(values: SimpleNamespace) -> Pin:
    """The crank pin at the start."""
    x = values.hinge_distance + values.crank_length * cos(values.crank_angle_start)
    y = values.crank_length * sin(values.crank_angle_start)
    # in wheel axes, from the root that is struck
    c, s = cos(values.wheel_angle_start), sin(values.wheel_angle_start)
    along, across = c * x + s * y - values.wheel_inner_radius, c * y - s * x
    cb, sb = cos(values.tooth_slope_angle), sin(values.tooth_slope_angle)
    return Pin(x, y, height=sb * along - cb * across, distance=-cb * along - sb * across)


def pawl_angle(values: SimpleNamespace) -> Number:
    """Start angle gamma [rad] of the pawl: given, on the slope (guided), or near the wheel, for assembly to close."""
    guided = where_positive(values.guided, angle_on_slope(values), angle_near_wheel(values))
    given = values.pawl_angle_start * values.pawl_angle_start * (1 - values.guided)
    return where_positive(given, values.pawl_angle_start, guided)


def starts_on_slope(values: SimpleNamespace) -> Number:
    """1 when assembly puts the pawl's tip on a slope, 0 when the pawl's start angle is given (free pawl only)."""
    return where_positive(values.pawl_angle_start * values.pawl_angle_start * (1 - values.guided), 0.0, 1.0)


def angle_on_slope(values: SimpleNamespace) -> Number:
    """Pawl angle [rad] with the tip on the line of the slope of tooth 0, the pawl pointing towards the face.

    The normal of the slope has the polar angle psi + beta_0 - pi/2, and the tip lies on the slope when
    height + b cos(gamma - that angle) = 0. Needs |height| <= b.
    """
    height, b = crank_pin(values).height, values.pawl_length
    normal_angle = values.wheel_angle_start + values.tooth_slope_angle - math.pi / 2
    return normal_angle + angle_between(-height, b * b)


def angle_near_wheel(values: SimpleNamespace) -> Number:
    """Pawl angle [rad] with the tip on the circle of the roots, where turning counter-clockwise presses on the wheel.

    From the pin, D away from the wheel's hinge: cos(angle between pawl and centre) = (D^2 + b^2 - r^2) / (2 D b).
    """
    pin, b, r = crank_pin(values), values.pawl_length, values.wheel_inner_radius
    square = pin.x * pin.x + pin.y * pin.y
    return 2 * math.pi + atan2(-pin.y, -pin.x) - angle_between(square + b * b - r * r, 4 * square * b * b)


def tip_distance(values: SimpleNamespace) -> Number:
    """Start distance of the guided pawl's tip from the struck root, along the slope [m]. Needs |height| <= b."""
    pin, b = crank_pin(values), values.pawl_length
    return pin.distance - root(b * b - pin.height * pin.height)
