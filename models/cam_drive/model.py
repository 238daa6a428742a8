"""The cam drive: a cam, a follower arm with a roller, and the spring that holds the roller on the cam.

Frame: the cam's hinge at the origin, the follower's at (-d, 0), so that the cam lifts the roller counter-clockwise.
The follower's x axis passes through the roller's centre. Equations and sources: README.md beside this file.
"""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    CamFollower,
    Case,
    CompliantShaft,
    Damper,
    Finding,
    Mechanism,
    Model,
    Revolute,
    Torque,
    TorsionSpring,
)
from mechanism_fmu.model.body import rotor_body
from mechanism_fmu.model.curves.profiles import circle
from mechanism_fmu.model.findings import at_most, first
from mechanism_fmu.model.four_bar import angle_between
from mechanism_fmu.model.functions import Number, atan2, cos, sin, sqrt, where_positive

from .geometry import Point, follower_angle, move_at, profile, roller_direction, start_angle, timing
from .ports import INPUTS, OUTPUTS, PARAMETERS, SHAPES, calculated

# What is wrong, or odd, with parameter values that are each within their limits.

#: Each move is looked at in so many places; between them the engine finds what is missed here.
_PLACES = 12
#: A triangle of hinges and roller that is flatter than this share of its sides cannot say where the follower goes.
_FLAT = 1e-6
#: Beyond this pressure angle the cam does not drive its follower; from that one on it strains the follower's hinge.
_MOST, _LARGE = math.radians(85), math.radians(45)
_DEGREES = 180 / math.pi


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the cam cannot turn its follower: value, limit and way out."""
    turn = values.rise_angle + values.dwell_angle + values.return_angle
    roundness, worst = _hollow(values), _pressure_angle(values)
    return first(
        Finding(
            turn - 2 * math.pi * (1 + 1e-12),
            "rise_angle + dwell_angle + return_angle = {:.6g} deg is more than one turn of the cam. Give at most 360 "
            "deg.",
            (turn * _DEGREES,),
        ),
        *_reach(values),
        Finding(
            where_positive(roundness, at_most(1.0, values.roller_radius * roundness), 0.0),
            "roller_radius = {:.6g} m is too large for the hollows of the cam, whose radius of curvature goes down to "
            "{:.6g} m. Give a smaller roller, or a larger base_radius, rise_angle or return_angle, or less lift.",
            (values.roller_radius, 1 / where_positive(roundness, roundness, 1.0)),
        ),
        Finding(
            worst - _MOST,
            "The pressure angle reaches {:.4g} deg, and the cam would jam or lose its follower. Give less lift = "
            "{:.6g} m, a larger rise_angle or return_angle, a larger base_radius = {:.6g} m, or another "
            "hinge_distance or follower_length.",
            (worst * _DEGREES, values.lift, values.base_radius),
        ),
    )


def warnings(values: SimpleNamespace) -> tuple[Finding, ...]:
    """What is legal but hard on the mechanism."""
    worst = _pressure_angle(values)
    return (
        Finding(
            worst - _LARGE,
            "The pressure angle reaches {:.4g} deg; above {:g} deg most of the contact force loads the follower's "
            "hinge and little of it turns the follower. Less lift, longer moves or a larger base_radius lessen it.",
            (worst * _DEGREES, _LARGE * _DEGREES),
        ),
    )


def _reach(values: SimpleNamespace) -> tuple[Finding, Finding]:
    """The arm must reach the base circle, and the upper dwell must not stretch it."""
    d, arm = values.hinge_distance, values.follower_length
    near = values.base_radius + values.roller_radius
    far = near + values.lift
    apart = where_positive(d - arm, d - arm, arm - d)
    return (
        Finding(
            at_most(near, apart + _FLAT * (d + arm)),
            "hinge_distance = {:.6g} m and follower_length = {:.6g} m differ by {:.6g} m, which is too much: on the "
            "base circle the roller's centre is base_radius + roller_radius = {:.6g} m from the cam's hinge. Give "
            "lengths that differ by less than that.",
            (d, arm, apart, near),
        ),
        Finding(
            at_most((d + arm) * (1 - _FLAT), far),
            "hinge_distance + follower_length = {:.6g} m is too short: on the upper dwell the roller's centre is "
            "base_radius + lift + roller_radius = {:.6g} m from the cam's hinge. Give lengths that are more together.",
            (d + arm, far),
        ),
    )


def _hollow(values: SimpleNamespace) -> Number:
    """The largest hollow curvature found [1/m], 0 or less when there is none.

    A move is hollow at most in its lower half, where the profile bends outwards.
    """
    hollowest: Number = 0.0
    for width in (values.rise_angle, values.return_angle):
        for k in range(1, _PLACES):
            at = move_at(values, width, k / (2 * _PLACES))
            square = at.radius * at.radius + at.slope * at.slope
            curvature = (at.radius * at.bend - square - at.slope * at.slope) / (square * sqrt(square))
            hollowest = where_positive(curvature - hollowest, curvature, hollowest)
    return hollowest


def _pressure_angle(values: SimpleNamespace) -> Number:
    """The largest angle found between contact force and motion of the roller's centre [rad]."""
    least: Number = 1.0
    for width, sense in ((values.return_angle, 1), (values.rise_angle, -1)):
        for k in range(_PLACES + 1):
            cosine = _transmission(values, move_at(values, width, k / _PLACES), sense)
            least = where_positive(least - cosine, cosine, least)
    return angle_between(least)


def _transmission(values: SimpleNamespace, at: Point, sense: int) -> Number:
    """Cosine of the pressure angle with the contact at a point; `sense`: whether the radius grows with alpha, or -1.

    In axes along the cam's radius at the contact and across it, the outward normal is (radius, -slope)/|..| and the
    roller's centre lies at (radius, 0) + roller_radius times it, at an angle `off` from the radius. The cam has turned
    so far that it stands in the direction of the roller.
    """
    slope = sense * at.slope
    length = sqrt(at.radius * at.radius + slope * slope)
    nx, ny = at.radius / length, -slope / length
    x, y = at.radius + values.roller_radius * nx, values.roller_radius * ny
    off = atan2(y, x)
    psi = follower_angle(values, sqrt(x * x + y * y))
    turned = roller_direction(values, psi) - off
    return ny * cos(turned - psi) + nx * sin(turned - psi)


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The cam drive for parameter values that raise no objection."""
    follower_hinge, rubbing = (-values.hinge_distance, 0.0), values.joint_friction_radius
    return Mechanism(
        bodies=(
            rotor_body(values, "cam", (0.0, 0.0), values.cam_angle_start, values.cam_speed_start),
            rotor_body(values, "follower", follower_hinge, start_angle(values)),
        ),
        joints=(
            Revolute("cam_hinge", "cam", (0.0, 0.0), GROUND, (0.0, 0.0), rubbing),
            Revolute("follower_hinge", "follower", (0.0, 0.0), GROUND, follower_hinge, rubbing),
        ),
        forces=(
            Torque("drive", "cam"),
            Torque("load", "follower"),
            CompliantShaft("shaft", "cam", stiffness=values.drive_stiffness, damping=values.drive_damping),
            TorsionSpring(
                "spring",
                "follower",
                stiffness=values.spring_stiffness,
                free_angle=timing(values).low,
                preload=values.spring_preload,
            ),
            Damper("follower_damper", "follower", damping=values.follower_damping),
        ),
        contacts=(
            CamFollower(
                "contact",
                "cam",
                profile(values),
                "follower",
                circle(values.roller_radius),
                centre_j=(values.follower_length, 0.0),
                unilateral=values.unilateral,
                restitution=values.restitution,
                friction=values.contact_friction,
            ),
        ),
        held=("cam.angle",),
    )


CASES = (
    Case(
        "lift_off",
        "So fast that the roller leaves the cam, and strikes when it lands",
        {"unilateral": True, "cam_speed_start": "400 rpm", "drive_speed": "400 rpm", "restitution": 0.2},
        stop_time=0.6,
        step_size=1e-3,
    ),
)

MODEL = Model(
    name="CamDrive",
    description="Cam with a roller follower on an arm: a steady rotation becomes a swing to and fro with dwells",
    author="The mechanism_fmu team",
    license="MIT",
    inputs=INPUTS,
    outputs=OUTPUTS,
    parameters=PARAMETERS,
    calculated=calculated,
    mechanism=mechanism,
    objections=objections,
    warnings=warnings,
    stop_time=2.0,
    step_size=5e-3,
    drawing=SHAPES,
    cases=CASES,
)
