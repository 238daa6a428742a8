"""A four-bar linkage whose coupler carries a path point, with links that bend.

Frame: the crank's hinge at the origin, the rocker's hinge at (d, 0). The coupler is two beams, welded at the crank
pin: one to the rocker pin, and the arm to the path point P. Equations and sources: README.md beside this file.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    Body,
    Calculated,
    CompliantShaft,
    Disc,
    LumpedBody,
    LumpedMass,
    Mechanism,
    Member,
    Model,
    Parameter,
    Revolute,
    Section,
    Torque,
    Wheel,
    lumped_body,
    port_builders as ports,
)
from mechanism_fmu.model.body import MovingPoint
from mechanism_fmu.model.four_bar import (
    CROSSED,
    MOTIONS,
    SHAPES as LINKAGE,
    objections,
    start,
    transmission_angles,
    warnings,
)
from mechanism_fmu.model.functions import Number, cos, sin

# The bodies of the path generator, made of elastic members and lumped masses.


@dataclass(frozen=True)
class Link:
    """A body at the start of the motion, and its members and lumped masses in its own frame."""

    body: Body
    parts: LumpedBody


def links(values: SimpleNamespace) -> tuple[Link, Link, Link]:
    """Crank, coupler (its members: arm, bar) and rocker; half of each member's mass is at each of its ends."""
    at, theta, speed = start(values), values.crank_angle_start, values.crank_speed_start
    origin, hinge = MovingPoint(0.0, 0.0), MovingPoint(values.ground_length, 0.0)
    pin = origin.along(values.crank_length, theta, speed)
    path = values.arm_length * cos(values.arm_angle), values.arm_length * sin(values.arm_angle)
    crank_pin, rocker_pin = (0.0, 0.0), (values.coupler_length, 0.0)
    disks = (
        LumpedMass("path_disk", "coupler", path, values.path_disk_mass, values.path_disk_inertia),
        LumpedMass("crank_pin_disk", "coupler", crank_pin, values.crank_pin_disk_mass, values.crank_pin_disk_inertia),
        LumpedMass("rocker_pin_disk", "coupler", rocker_pin, values.rocker_pin_disk_mass),
    )
    coupler = _member(values, "arm", "coupler", path), _member(values, "coupler_bar", "coupler", rocker_pin)
    crank = _member(values, "crank_bar", "crank", (values.crank_length, 0.0))
    rocker = _member(values, "rocker_bar", "rocker", (values.rocker_length, 0.0))
    return (
        _link("crank", lumped_body((crank,)), origin, theta, speed),
        _link("coupler", lumped_body(coupler, disks), pin, at.coupler_angle, at.coupler_speed),
        _link("rocker", lumped_body((rocker,)), hinge, at.rocker_angle, at.rocker_speed),
    )


def _member(values: SimpleNamespace, name: str, body: str, end: tuple[Number, Number]) -> Member:
    link = name.removesuffix("_bar")
    section = Section.rectangle(getattr(values, f"{link}_width"), getattr(values, f"{link}_depth"))
    return Member(name, body, (0.0, 0.0), end, section, values.elastic_modulus, values.density)


def _link(name: str, parts: LumpedBody, begin: MovingPoint, angle: Number, speed: Number) -> Link:
    x, y = parts.centre
    c, s = cos(angle), sin(angle)
    across, up = c * x - s * y, s * x + c * y
    place = begin.x + across, begin.y + up, angle
    rate = begin.x_rate - up * speed, begin.y_rate + across * speed, speed
    return Link(Body(name, parts.mass, parts.inertia, place, rate), parts)


# How the path generator is drawn from its variables: links, hinges and the path point, all as if they were rigid.

#: Pin, pin and path point, in polar coordinates of the coupler.
_PLATE = ((0.0, 0.0), ("coupler_length", 0.0), ("arm_length", "arm_angle"))

SHAPES = (
    LINKAGE[0],
    Wheel("coupler with arm", "crank", "coupler_angle", 1, _PLATE),
    *LINKAGE[1:],
    Disc("path point", ("path_x", "path_y"), "outline_path_radius"),
)


# Inputs, outputs and parameters of the path generator.
#
# The defaults are an example of this project, in round numbers of inches and pounds: Erdman, Sandor and Oakberg (1972)
# draw the linkage (Fig. 3), but the pages at hand give no dimensions of it.

#: Inch [m], pound [kg], and pound of force [N].
_INCH, _POUND = 0.0254, 0.45359237
_POUND_FORCE = _POUND * 9.80665
#: 500 rpm [rad/s].
_SPEED = 500 * math.pi / 30

INPUTS = (*ports.shaft_inputs(speed=_SPEED), ports.torque_input("drive", "crank", usual=(-50.0, 50.0)))

OUTPUTS = (
    *MOTIONS,
    ports.shaft_torque_output("crank", nominal=5.0),
    *ports.bent_point_outputs("path", "arm.end", "path point", INPUTS, nominal=0.2),
    *(
        output
        for member in ("arm", "crank_bar", "coupler_bar", "rocker_bar")
        for output in ports.member_outputs(member, INPUTS, force=100.0, moment=5.0, stress=5e7)
    ),
    *ports.energy_outputs(
        kinetic="Kinetic energy of crank, coupler and rocker",
        spring="Energy of springs: there are none",
        work="Work done by drive shaft and drive torque since the start",
        lost="Energy lost: there is no friction",
        nominal=10.0,
    ),
)


def _section(link: str) -> tuple[Parameter, Parameter]:
    return (
        ports.length_parameter(
            f"{link}_width", 0.25 * _INCH, f"Width of the {link}'s section, normal to the plane (b)"
        ),
        ports.length_parameter(f"{link}_depth", 0.5 * _INCH, f"Depth of the {link}'s section, in the plane (h)"),
    )


def _disk(name: str, place: str, weight: float, radius: float = 0.0) -> tuple[Parameter, ...]:
    """A disk of the coupler; `weight` in pounds, `radius` in inches."""
    mass = weight * _POUND
    found = Parameter(f"{name}_mass", mass, f"Mass of the disk at the {place}", "kg", 0.0, 1e6)
    if not radius:
        return (found,)
    inertia = mass * (radius * _INCH) ** 2 / 2
    what = f"Moment of inertia of the disk at the {place}; it turns with the coupler"
    return found, Parameter(f"{name}_inertia", inertia, what, "kg.m2", 0.0, 1e6)


PARAMETERS = (
    ports.length_parameter("ground_length", 10 * _INCH, "Distance between the fixed hinges of crank and rocker (d)"),
    ports.length_parameter("crank_length", 4 * _INCH, "Length of the crank (a)"),
    ports.length_parameter("coupler_length", 10 * _INCH, "Length of the coupler, from pin to pin (b)"),
    ports.length_parameter("rocker_length", 8 * _INCH, "Length of the rocker (c)"),
    ports.length_parameter(
        "arm_length", 6 * _INCH, "Length of the coupler's arm, from the crank pin to the path point (p)"
    ),
    ports.angle_parameter("arm_angle", math.radians(30), "Angle of the arm against the coupler (alpha)"),
    *(parameter for link in ("crank", "coupler", "rocker", "arm") for parameter in _section(link)),
    Parameter("elastic_modulus", 30e6 * _POUND_FORCE / _INCH**2, "Modulus of elasticity (E)", "Pa", 1.0, 1e15),
    Parameter("density", 0.283 * _POUND / _INCH**3, "Density of the links", "kg/m3", 1e-3, 1e6),
    *_disk("path_disk", "path point", 0.5, 0.75),
    *_disk("crank_pin_disk", "crank pin", 0.1, 0.5),
    *_disk("rocker_pin_disk", "rocker pin", 0.1),
    CROSSED,
    ports.angle_parameter("crank_angle_start", math.radians(30), "Crank angle at the start (theta)"),
    ports.speed_parameter("crank_speed_start", _SPEED, "Crank speed at the start; those of coupler and rocker follow"),
    *ports.shaft_parameters(damping=100.0, stiffest=1e4),
    *ports.settings_parameters(),
)


def calculated(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """The extreme transmission angles, and how large the path point is drawn."""
    return (
        *transmission_angles(values),
        Calculated("outline_path_radius", values.arm_length / 15, "Drawing: radius of the path point", "m"),
    )


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The path generator for parameter values that raise no objection."""
    crank, coupler, rocker = linkage = links(values)
    arm, bar = coupler.parts.members
    crank_bar, rocker_bar = crank.parts.members[0], rocker.parts.members[0]
    return Mechanism(
        bodies=tuple(link.body for link in linkage),
        joints=(
            Revolute("crank_hinge", "crank", crank_bar.start, GROUND, (0.0, 0.0)),
            Revolute("crank_pin", "coupler", bar.start, "crank", crank_bar.end),
            Revolute("rocker_pin", "rocker", rocker_bar.end, "coupler", bar.end),
            Revolute("rocker_hinge", "rocker", rocker_bar.start, GROUND, (values.ground_length, 0.0)),
        ),
        forces=(
            Torque("drive", "crank"),
            CompliantShaft("shaft", "crank", stiffness=values.drive_stiffness, damping=values.drive_damping),
        ),
        members=(arm, crank_bar, bar, rocker_bar),
        lumped_masses=coupler.parts.lumped_masses,
        held=("crank.angle",),
    )


MODEL = Model(
    name="FourBarPathGenerator",
    description="Four-bar path generator whose links bend: rigid and elastic path, stresses",
    author="The mechanism_fmu team",
    license="MIT",
    inputs=INPUTS,
    outputs=OUTPUTS,
    parameters=PARAMETERS,
    calculated=calculated,
    mechanism=mechanism,
    objections=objections,
    warnings=warnings,
    stop_time=0.24,
    step_size=5e-4,
    drawing=SHAPES,
)
