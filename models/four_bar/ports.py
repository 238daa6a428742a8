"""Inputs, outputs and parameters of the four-bar linkage."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import (
    Calculated,
    Parameter,
    angle_parameter,
    body_angle_output,
    body_speed_output,
    damping_parameter,
    energy_outputs,
    flag_parameter,
    joint_friction_parameter,
    length_parameter,
    link_parameters,
    load_torque_input,
    settings_parameters,
    shaft_inputs,
    shaft_parameters,
    shaft_torque_output,
    speed_parameter,
    stiffness_parameter,
    torque_input,
)
from mechanism_fmu.model.four_bar import form

INPUTS = (
    *shaft_inputs(speed=2 * math.pi),
    torque_input("drive", "crank"),
    load_torque_input("rocker"),
)

OUTPUTS = (
    body_angle_output("crank", "theta"),
    body_angle_output("coupler", "phi"),
    body_angle_output("rocker", "psi"),
    body_speed_output("crank"),
    body_speed_output("coupler"),
    body_speed_output("rocker"),
    shaft_torque_output("crank"),
    *energy_outputs(
        kinetic="Kinetic energy of crank, coupler and rocker",
        spring="Energy of the rocker's spring",
        work="Work done by drive shaft, inputs and weights since the start",
        lost="Energy lost in friction and the damper since the start",
    ),
)

PARAMETERS = (
    length_parameter("ground_length", 0.2, "Distance between the fixed hinges of crank and rocker (d)"),
    *link_parameters("crank", 0.05, 0.2, 1e-3, 0.025, "its hinge"),
    *link_parameters("coupler", 0.18, 0.5, 1.35e-3, 0.09, "the crank pin"),
    *link_parameters("rocker", 0.12, 0.4, 4.8e-4, 0.06, "its hinge"),
    flag_parameter(
        "crossed",
        False,
        "Whether coupler and rocker are assembled on the other side of the line from crank pin to rocker hinge",
    ),
    angle_parameter("crank_angle_start", 0.0, "Crank angle at the start (theta)"),
    speed_parameter("crank_speed_start", 2 * math.pi, "Crank speed at the start; those of coupler and rocker follow"),
    Parameter("gravity", 0.0, "Gravitational acceleration, downwards", "m/s2", -1e3, 1e3),
    damping_parameter("crank"),
    stiffness_parameter("spring_stiffness", 0.0, "Stiffness of the rocker's torsion spring"),
    angle_parameter("spring_free_angle", math.radians(90), "Rocker angle at which the torsion spring is relaxed"),
    *shaft_parameters(damping=0.1),
    joint_friction_parameter(),
    *settings_parameters(),
)


def calculated(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """The extreme transmission angles."""
    known = form(values)
    between = "Transmission angle, between coupler and rocker, with the crank pointing"
    return (
        Calculated("folded_transmission_angle", known.folded, f"{between} to the rocker's hinge", "rad", "deg"),
        Calculated("stretched_transmission_angle", known.stretched, f"{between} away from it", "rad", "deg"),
    )
