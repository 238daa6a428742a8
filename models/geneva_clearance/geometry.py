"""Outlines of the Geneva drive with play, from the lengths of `models.geneva`."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Outline, geneva_sector
from mechanism_fmu.model.four_bar import angle_between
from mechanism_fmu.model.functions import Number, atan2, sqrt

from ..geneva.geometry import Geneva, geneva

#: Slots of the wheel. How many copies an outline has belongs to the structure, which no parameter changes.
SLOT_COUNT = 4

#: The relief of the locking disc leaves this part of the distance between the driver's hinge and the passing arms.
_RELIEF = 0.9


def with_slots(values: SimpleNamespace) -> SimpleNamespace:
    """Parameter values as `models.geneva` has them, with the number of slots."""
    return SimpleNamespace(**{**vars(values), "slot_count": SLOT_COUNT})


def lengths(values: SimpleNamespace) -> Geneva:
    """Lengths and angles of the drive without play."""
    return geneva(with_slots(values))


def slot_half(values: SimpleNamespace) -> Number:
    """Half the width of a slot [m]."""
    return (values.pin_diameter + values.slot_clearance) / 2


def arc_radius(values: SimpleNamespace) -> Number:
    """Radius of the wheel's locking arcs [m]."""
    return lengths(values).locking_radius + values.locking_clearance


def slot_depth(values: SimpleNamespace) -> Number:
    """From a slot's mouth to its round bottom [m], which the pin stays away from by a quarter of its diameter."""
    return lengths(values).slot_depth + slot_half(values) + values.pin_diameter / 4


def land(values: SimpleNamespace) -> Number:
    """Width of what is left of the wheel's rim between a mouth's rounding and the locking arc [m]."""
    return lengths(values).pin_radius - slot_half(values) - values.mouth_radius - arc_radius(values)


def arm_outline(values: SimpleNamespace) -> Outline:
    """An arm of the wheel, from the middle of slot 0, which is along the x axis, to the next one; open."""
    arm = geneva_sector(
        SLOT_COUNT,
        values.centre_distance,
        2.0 * slot_half(values),
        slot_depth(values),
        arc_radius(values),
        mouth_radius=values.mouth_radius,
    )
    return arm.moved(angle=math.pi / SLOT_COUNT)


def pin_outline(values: SimpleNamespace) -> Outline:
    """The pin, on the driver's x axis."""
    return Outline.circle(values.pin_diameter / 2, (lengths(values).pin_radius, 0.0))


def disc_outline(values: SimpleNamespace) -> Outline:
    """The locking disc: full but for a relief around the pin's direction, where the arms of the wheel pass.

    Its corners, the horns, stand phi_0 from the pin on either side: where the pin enters or leaves, one of them is on
    the line of centres.
    """
    edge, r, inner = math.pi / 2 - math.pi / SLOT_COUNT, disc_radius(values), relief_radius(values)
    c, s = math.cos(edge), math.sin(edge)
    half_full = math.tan((math.pi - edge) / 4)
    return Outline(
        (
            (r * c, r * s, half_full),
            (-1.0 * r, 0.0, half_full),
            (r * c, -s * r, 0.0),
            (inner * c, -s * inner, math.tan(edge / 2)),
            (inner * c, inner * s, 0.0),
        )
    )


def disc_radius(values: SimpleNamespace) -> Number:
    """Radius of the locking disc [m]."""
    return lengths(values).locking_radius


def relief_radius(values: SimpleNamespace) -> Number:
    """Radius of the relief [m]: inside of where the ends of the arms pass the line of centres."""
    R, beside = lengths(values).mouth_radius, lengths(values).pin_radius - arc_radius(values)
    return _RELIEF * (values.centre_distance - sqrt(R * R + beside * beside))


# What is known in advance, in closed form.


def entry(values: SimpleNamespace) -> tuple[Number, Number, Number]:
    """Where the pin strikes after it has come in along the middle of a slot of the resting wheel.

    The driver has turned by tau since then: across the slot the pin is off its middle by a (1 - cos tau), which is
    half the clearance.

    Returns:
        tau [rad]; the closing speed over the driver's speed, a sin tau [m/rad]; the distance of the pin from the
        wheel's hinge, along the slot [m].
    """
    a, R = lengths(values).pin_radius, lengths(values).mouth_radius
    cosine = 1.0 - values.slot_clearance / 2 / a
    sine = sqrt(1.0 - cosine * cosine)
    return atan2(sine, cosine), a * sine, R - a * sine


def rest_play(values: SimpleNamespace) -> Number:
    """By how much the resting wheel can turn to either side [rad], until an end of its arc is on the locking disc.

    The end stands at the distance q from the wheel's hinge, at the angle eps from the line of centres when the wheel
    is in the middle: |end - driver's hinge| = r gives q^2 + c^2 - 2 q c cos(eps - play) = r^2.
    """
    c, r, arc = values.centre_distance, lengths(values).locking_radius, arc_radius(values)
    away = math.pi / 2 - math.pi / SLOT_COUNT
    x, y = c - arc * math.cos(away), arc * math.sin(away)
    square = x * x + y * y
    return atan2(y, x) - angle_between(square + c * c - r * r, 4.0 * square * c * c)
