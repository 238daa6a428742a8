"""Lengths, angles and known ratios of an external Geneva drive with tangential entry (Bickford 1972), and its start.

With n slots and the centre distance c, the pin enters a slot along its centre line when the driver is at a right
angle to it: a = c sin(pi/n) for the pin, R = c cos(pi/n) for the mouth of the slot, a^2 + R^2 = c^2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import SimpleNamespace

from mechanism_fmu.model.functions import Number, atan2, cos, sin, sqrt, where_positive


@dataclass(frozen=True)
class Geneva:
    """Geometry of the drive.

    Attributes:
        pitch: 2 pi/n, by which one turn of the driver indexes the wheel [rad].
        pin_radius: a, distance of the pin from the driver's hinge [m].
        mouth_radius: R, distance of a slot's mouth from the wheel's hinge [m]; the wheel's outer radius.
        engagement: phi_0 = pi/2 - pi/n, the driver's angle from the line of centres at entry and exit [rad].
        locking_radius: of the disc on the driver that holds the wheel: one pin diameter less than a [m].
        slot_depth: a + R - c, from the mouth to the innermost place of the pin's centre [m].
        slot_spacing: distance between neighbouring slots, centre line to centre line, where they end [m].
    """

    pitch: Number
    pin_radius: Number
    mouth_radius: Number
    engagement: Number
    locking_radius: Number
    slot_depth: Number
    slot_spacing: Number


def geneva(values: SimpleNamespace) -> Geneva:
    """Geometry for parameter values."""
    n, c = values.slot_count, values.centre_distance
    a, R = c * sin(math.pi / n), c * cos(math.pi / n)
    return Geneva(
        pitch=2 * math.pi / n,
        pin_radius=a,
        mouth_radius=R,
        engagement=math.pi / 2 - math.pi / n,
        locking_radius=a - values.pin_diameter,
        slot_depth=a + R - c,
        slot_spacing=2 * (c - a) * sin(math.pi / n),
    )


@dataclass(frozen=True)
class Ratios:
    """What is known in advance about the wheel's motion, at a constant driver speed w.

    Attributes:
        motion_to_rest: time of motion over time of rest in one turn, (n - 2)/(n + 2).
        peak_speed: largest wheel speed over w, mu/(1 - mu) with mu = a/c, when the pin is on the line of centres.
        peak_acceleration: largest wheel acceleration over w^2.
        peak_angle: the driver's angle from the line of centres there [rad]; the other peak is opposite.
        entry_acceleration: wheel acceleration over w^2 just after entry, tan(pi/n).
    """

    motion_to_rest: Number
    peak_speed: Number
    peak_acceleration: Number
    peak_angle: Number
    entry_acceleration: Number


def ratios(values: SimpleNamespace) -> Ratios:
    """The ratios of motion for parameter values.

    With D = 1 + mu^2 - 2 mu cos(phi), beta' = mu (cos(phi) - mu)/D and beta'' = -mu (1 - mu^2) sin(phi)/D^2. beta'' is
    largest where cos(phi) = sqrt(G^2 + 2) - G, G = (1 + mu^2)/(4 mu).
    """
    n = values.slot_count
    mu = sin(math.pi / n)
    G = (1 + mu * mu) / (4 * mu)
    cosine = sqrt(G * G + 2) - G
    sine = sqrt(1 - cosine * cosine)
    D = 1 + mu * mu - 2 * mu * cosine
    return Ratios(
        motion_to_rest=(n - 2) / (n + 2),
        peak_speed=mu / (1 - mu),
        peak_acceleration=mu * (1 - mu * mu) * sine / (D * D),
        peak_angle=atan2(sine, cosine),
        entry_acceleration=sin(math.pi / n) / cos(math.pi / n),
    )


# Where the wheel stands at the start, and how fast it turns: in closed form from the driver.


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
