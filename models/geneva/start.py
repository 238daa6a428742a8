"""Where the wheel stands at the start, and how fast it turns: in closed form from the driver."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model.functions import Number, atan2, cos, sin, where_positive

from .geometry import geneva


def wheel_angle(values: SimpleNamespace) -> Number:
    """Start angle psi of the wheel [rad].

    With the pin in slot 0 the slot points to it: psi = atan2(a sin theta, c + a cos theta). Otherwise slot 0 rests
    where it waits for the pin (+pi/n, pin on the upper side) or where the pin has left it (-pi/n, on the lower side).
    """
    a, c, theta = geneva(values).pin_radius, values.centre_distance, values.driver_angle_start
    driven = atan2(a * sin(theta), c + a * cos(theta))
    half = math.pi / values.slot_count
    return where_positive(_inside(values), driven, where_positive(-sin(theta), -half, half))


def wheel_speed(values: SimpleNamespace) -> Number:
    """Start rate of the wheel [rad/s]: psi' = theta' a (a + c cos theta)/(a^2 + c^2 + 2 a c cos theta), 0 at rest."""
    a, c, theta = geneva(values).pin_radius, values.centre_distance, values.driver_angle_start
    ratio = a * (a + c * cos(theta)) / (a * a + c * c + 2 * a * c * cos(theta))
    return values.driver_speed_start * where_positive(_inside(values), ratio, 0.0)


def _inside(values: SimpleNamespace) -> Number:
    """Positive when the pin is in a slot: the driver is nearer to the line of centres than phi_0 = pi/2 - pi/n."""
    return -cos(values.driver_angle_start) - sin(math.pi / values.slot_count)
