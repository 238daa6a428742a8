"""The cam's profile, the triangle of hinges and roller, and what follows from them in closed form."""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import SimpleNamespace

from mechanism_fmu.model import Curve
from mechanism_fmu.model.curves.motions import Move, dwell
from mechanism_fmu.model.curves.profiles import motion_profile
from mechanism_fmu.model.four_bar import angle_between
from mechanism_fmu.model.functions import Number, atan2, cos, sin, where_positive


def profile(values: SimpleNamespace) -> Curve:
    """The cam: base radius, cycloidal rise and return, dwells between.

    A cam that turns forwards meets its profile backwards: the rise is the last move of the profile, and ends at the
    upper dwell.
    """
    return motion_profile(
        values.base_radius,
        (
            Move(values.lift, values.return_angle),
            Move(values.lift, values.dwell_angle, dwell),
            Move(0.0, values.rise_angle),
        ),
        back=dwell,
    )


@dataclass(frozen=True)
class Point:
    """A point of the cam: radius over the angle alpha, and its first two derivatives by it [m]."""

    radius: Number
    slope: Number
    bend: Number


def move_at(values: SimpleNamespace, width: Number, share: Number) -> Point:
    """A point of a move from the base circle up, at a share 0..1 of its width [rad]."""
    h, turn = values.lift, 2 * math.pi * share
    return Point(
        radius=values.base_radius + h * (share - sin(turn) / (2 * math.pi)),
        slope=h / width * (1 - cos(turn)),
        bend=2 * math.pi * h / (width * width) * sin(turn),
    )


def radius_at(values: SimpleNamespace, alpha: Number) -> Number:
    """The cam's radius [m] at any angle of its profile [rad]."""
    a = atan2(sin(alpha), cos(alpha))
    a = where_positive(-a, a + 2 * math.pi, a)
    upper = values.return_angle + values.dwell_angle
    after = upper + values.rise_angle
    rising = move_at(values, values.return_angle, a / values.return_angle).radius
    falling = move_at(values, values.rise_angle, (after - a) / values.rise_angle).radius
    high = values.base_radius + values.lift
    beyond = where_positive(upper - a, high, where_positive(after - a, falling, values.base_radius))
    return where_positive(values.return_angle - a, rising, beyond)


def follower_angle(values: SimpleNamespace, distance: Number) -> Number:
    """The follower's angle psi [rad] with its roller's centre at a distance [m] from the cam's hinge.

    The law of cosines; where the sides are no triangle, 0 or pi, whichever is nearer.
    """
    d, arm = values.hinge_distance, values.follower_length
    cosine = (d * d + arm * arm - distance * distance) / (2 * d * arm)
    return angle_between(cosine)


def roller_direction(values: SimpleNamespace, psi: Number) -> Number:
    """Where the roller's centre stands, seen from the cam's hinge [rad]."""
    d, arm = values.hinge_distance, values.follower_length
    return atan2(arm * sin(psi), arm * cos(psi) - d)


@dataclass(frozen=True)
class Timing:
    """Ends of the follower's swing, and the cam's angles that belong to them [rad].

    Attributes:
        low, high: the follower's angle on the base circle and on the upper dwell.
        rise_start, rise_end, return_start, return_end: of a cam that turns forwards.
    """

    low: Number
    high: Number
    rise_start: Number
    rise_end: Number
    return_start: Number
    return_end: Number


def timing(values: SimpleNamespace) -> Timing:
    """When the follower moves, in the first turn of the cam that has a whole swing.

    At the ends of dwells the contact lies on the line from the cam's hinge to the roller: theta is its direction less
    alpha of the profile there.
    """
    near = values.base_radius + values.roller_radius
    low, high = follower_angle(values, near), follower_angle(values, near + values.lift)
    below, above = roller_direction(values, low), roller_direction(values, high)
    turn, top = 2 * math.pi, values.dwell_angle + values.return_angle
    return Timing(
        low,
        high,
        rise_start=below + turn - top - values.rise_angle,
        rise_end=above + turn - top,
        return_start=above + turn - values.return_angle,
        return_end=below + turn,
    )


def start_angle(values: SimpleNamespace) -> Number:
    """The follower's angle at the start [rad], to within a few degrees: assembly closes the contact from there.

    As if the roller touched the cam on the line of their centres; its direction is found from the angle, and that from
    the direction, beginning in the middle of the swing.
    """
    ends = timing(values)
    psi = (ends.low + ends.high) / 2
    for _ in range(2):
        rho = radius_at(values, roller_direction(values, psi) - values.cam_angle_start)
        psi = follower_angle(values, rho + values.roller_radius)
    return psi
