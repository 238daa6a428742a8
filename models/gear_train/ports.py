"""Inputs, outputs and parameters of the gear train."""

from __future__ import annotations

from types import SimpleNamespace

from mechanism_fmu.model import (
    Calculated,
    angle_parameter,
    body_angle_output,
    body_speed_output,
    damping_parameter,
    energy_outputs,
    force_output,
    joint_friction_parameter,
    length_parameter,
    load_torque_input,
    rotor_parameters,
    settings_parameters,
    shaft_inputs,
    shaft_parameters,
    shaft_torque_output,
    speed_parameter,
    torque_input,
)

from .geometry import pairing
from .shapes import form

INPUTS = (
    torque_input("drive", "pinion", 1.5),
    load_torque_input("wheel", -0.7),
    *shaft_inputs(speed=0.0),
)

OUTPUTS = (
    body_angle_output("pinion", "phi_1"),
    body_angle_output("wheel", "phi_2"),
    body_speed_output("pinion"),
    body_speed_output("wheel"),
    force_output(
        "mesh_force",
        "gears.force",
        "Tangential force between the gears (F); its torque on each gear is F times that gear's radius",
        INPUTS,
        nominal=10.0,
    ),
    shaft_torque_output("pinion"),
    *energy_outputs(
        kinetic="Kinetic energy of both gears",
        spring="Energy of springs within the gear train: none, 0",
        work="Work done by drive shaft, drive_torque and load_torque since the start",
        lost="Energy lost in friction and dampers since the start",
    ),
)

PARAMETERS = (
    length_parameter("pinion_radius", 0.05, "Radius of the pinion's pitch circle (R1)"),
    length_parameter("wheel_radius", 0.12, "Radius of the wheel's pitch circle (R2)"),
    *rotor_parameters("pinion", 16.0, 0.02),
    *rotor_parameters("wheel", 15.3, 0.11),
    angle_parameter("pinion_angle_start", 0.0, "Pinion angle at the start (phi_1); the wheel's is ratio times this"),
    speed_parameter("pinion_speed_start", 0.0, "Pinion speed at the start; the wheel's is ratio times this"),
    damping_parameter("pinion"),
    damping_parameter("wheel"),
    *shaft_parameters(damping=0.0),
    joint_friction_parameter(),
    *settings_parameters(),
)


def calculated(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """What follows from radii and inertias, and what drawings need."""
    pair = pairing(values)
    return (
        Calculated("ratio", pair.ratio, "Speed of the wheel over speed of the pinion: negative, it turns back"),
        Calculated("centre_distance", pair.centre_distance, "Distance between the hinges (R1 + R2)", "m"),
        Calculated("reduced_inertia", pair.reduced_inertia, "Inertia of both gears seen at the pinion", "kg.m2"),
        *form(values),
    )
