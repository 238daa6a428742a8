"""Inputs, outputs and parameters of the path generator.

The defaults are an example of this project, in round numbers of inches and pounds: Erdman, Sandor and Oakberg (1972)
draw the linkage (Fig. 3), but the pages at hand give no dimensions of it.
"""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import (
    Calculated,
    Parameter,
    angle_parameter,
    bent_point_outputs,
    body_angle_output,
    body_speed_output,
    energy_outputs,
    flag_parameter,
    length_parameter,
    member_outputs,
    settings_parameters,
    shaft_inputs,
    shaft_parameters,
    shaft_torque_output,
    speed_parameter,
    torque_input,
)
from mechanism_fmu.model.four_bar import form

#: Inch [m], pound [kg], and pound of force [N].
_INCH, _POUND = 0.0254, 0.45359237
_POUND_FORCE = _POUND * 9.80665
#: 500 rpm [rad/s].
_SPEED = 500 * math.pi / 30

INPUTS = (*shaft_inputs(speed=_SPEED), torque_input("drive", "crank"))

OUTPUTS = (
    body_angle_output("crank", "theta"),
    body_angle_output("coupler", "phi"),
    body_angle_output("rocker", "psi"),
    body_speed_output("crank"),
    body_speed_output("coupler"),
    body_speed_output("rocker"),
    shaft_torque_output("crank", nominal=5.0),
    *bent_point_outputs("path", "arm.end", "path point", INPUTS, nominal=0.2),
    *(
        output
        for member in ("arm", "crank_bar", "coupler_bar", "rocker_bar")
        for output in member_outputs(member, INPUTS, force=100.0, moment=5.0, stress=5e7)
    ),
    *energy_outputs(
        kinetic="Kinetic energy of crank, coupler and rocker",
        spring="Energy of springs: there are none",
        work="Work done by drive shaft and drive torque since the start",
        lost="Energy lost: there is no friction",
        nominal=10.0,
    ),
)


def _section(link: str) -> tuple[Parameter, Parameter]:
    return (
        length_parameter(f"{link}_width", 0.25 * _INCH, f"Width of the {link}'s section, normal to the plane (b)"),
        length_parameter(f"{link}_depth", 0.5 * _INCH, f"Depth of the {link}'s section, in the plane (h)"),
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
    length_parameter("ground_length", 10 * _INCH, "Distance between the fixed hinges of crank and rocker (d)"),
    length_parameter("crank_length", 4 * _INCH, "Length of the crank (a)"),
    length_parameter("coupler_length", 10 * _INCH, "Length of the coupler, from pin to pin (b)"),
    length_parameter("rocker_length", 8 * _INCH, "Length of the rocker (c)"),
    length_parameter("arm_length", 6 * _INCH, "Length of the coupler's arm, from the crank pin to the path point (p)"),
    angle_parameter("arm_angle", math.radians(30), "Angle of the arm against the coupler (alpha)"),
    *(parameter for link in ("crank", "coupler", "rocker", "arm") for parameter in _section(link)),
    Parameter("elastic_modulus", 30e6 * _POUND_FORCE / _INCH**2, "Modulus of elasticity (E)", "Pa", 1.0, 1e15),
    Parameter("density", 0.283 * _POUND / _INCH**3, "Density of the links", "kg/m3", 1e-3, 1e6),
    *_disk("path_disk", "path point", 0.5, 0.75),
    *_disk("crank_pin_disk", "crank pin", 0.1, 0.5),
    *_disk("rocker_pin_disk", "rocker pin", 0.1),
    flag_parameter(
        "crossed",
        False,
        "Whether coupler and rocker are assembled on the other side of the line from crank pin to rocker hinge",
    ),
    angle_parameter("crank_angle_start", math.radians(30), "Crank angle at the start (theta)"),
    speed_parameter("crank_speed_start", _SPEED, "Crank speed at the start; those of coupler and rocker follow"),
    *shaft_parameters(damping=100.0),
    *settings_parameters(),
)


def calculated(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """The extreme transmission angles, and how large the path point is drawn."""
    known = form(values)
    between = "Transmission angle, between coupler and rocker, with the crank pointing"
    return (
        Calculated("folded_transmission_angle", known.folded, f"{between} to the rocker's hinge", "rad", "deg"),
        Calculated("stretched_transmission_angle", known.stretched, f"{between} away from it", "rad", "deg"),
        Calculated("outline_path_radius", values.arm_length / 15, "Drawing: radius of the path point", "m"),
    )
