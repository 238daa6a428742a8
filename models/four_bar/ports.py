"""Inputs, outputs and parameters of the four-bar linkage."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Calculated, Parameter
from mechanism_fmu.model.port_builders import (
    JOINT_FRICTION,
    SETTINGS,
    angle_output,
    damping_parameter,
    drive_torque_input,
    energy_outputs,
    length_parameter,
    link_parameters,
    load_torque_input,
    shaft_inputs,
    shaft_parameters,
    shaft_torque_output,
    speed_output,
    start_parameters,
)

from .geometry import form

INPUTS = (*shaft_inputs(speed=2 * math.pi), drive_torque_input("crank"), load_torque_input("rocker"))

OUTPUTS = (
    angle_output("crank", "theta"),
    angle_output("coupler", "phi"),
    angle_output("rocker", "psi"),
    speed_output("crank"),
    speed_output("coupler"),
    speed_output("rocker"),
    shaft_torque_output("crank"),
    *energy_outputs(
        "Kinetic energy of crank, coupler and rocker",
        "Energy of the rocker's spring",
        "Work done by drive shaft, inputs and weights since the start",
        "Energy lost in friction and the damper since the start",
    ),
)

PARAMETERS = (
    length_parameter("ground_length", 0.2, "Distance between the fixed hinges of crank and rocker (d)"),
    *link_parameters("crank", 0.05, 0.2, 1e-3, 0.025, "its hinge"),
    *link_parameters("coupler", 0.18, 0.5, 1.35e-3, 0.09, "the crank pin"),
    *link_parameters("rocker", 0.12, 0.4, 4.8e-4, 0.06, "its hinge"),
    Parameter(
        "crossed",
        0.0,
        "Whether coupler and rocker are assembled on the other side of the line from crank pin to rocker hinge",
        type="Boolean",
    ),
    *start_parameters("crank", 2 * math.pi, " (theta)", "those of coupler and rocker follow"),
    Parameter("gravity", 0.0, "Gravitational acceleration, downwards", "m/s2", -1e3, 1e3),
    damping_parameter("crank"),
    Parameter("spring_stiffness", 0.0, "Stiffness of the rocker's torsion spring", "N.m/rad", 0.0, 1e6),
    Parameter(
        "spring_free_angle",
        math.radians(90),
        "Rocker angle at which the torsion spring is relaxed",
        "rad",
        -1e3,
        1e3,
        display_unit="deg",
    ),
    *shaft_parameters(damping=0.1),
    JOINT_FRICTION,
    *SETTINGS,
)


def calculated(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """The extreme transmission angles."""
    known = form(values)
    between = "Transmission angle, between coupler and rocker, with the crank pointing"
    return (
        Calculated("folded_transmission_angle", known.folded, f"{between} to the rocker's hinge", "rad", "deg"),
        Calculated("stretched_transmission_angle", known.stretched, f"{between} away from it", "rad", "deg"),
    )
