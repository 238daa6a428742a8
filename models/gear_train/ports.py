"""Inputs, outputs and parameters of the gear train."""

from __future__ import annotations

from types import SimpleNamespace

from mechanism_fmu.model import Calculated, Output
from mechanism_fmu.model.port_builders import (
    JOINT_FRICTION,
    SETTINGS,
    angle_output,
    damping_parameter,
    drive_torque_input,
    energy_outputs,
    length_parameter,
    load_torque_input,
    rotor_parameters,
    shaft_inputs,
    shaft_parameters,
    shaft_torque_output,
    speed_output,
    start_parameters,
)

from .geometry import pairing
from .shapes import form

INPUTS = (
    drive_torque_input("pinion", 1.5),
    load_torque_input("wheel", -0.7),
    *shaft_inputs(speed=0.0),
)

OUTPUTS = (
    angle_output("pinion", "phi_1"),
    angle_output("wheel", "phi_2"),
    speed_output("pinion"),
    speed_output("wheel"),
    Output(
        "mesh_force",
        "gears.force",
        "Tangential force between the gears (F); its torque on each gear is F times that gear's radius",
        "N",
        nominal=10.0,
        feedthrough=tuple(port.name for port in INPUTS),
    ),
    shaft_torque_output("pinion"),
    *energy_outputs(
        "Kinetic energy of both gears",
        "Energy of springs within the gear train: none, 0",
        "Work done by drive shaft, drive_torque and load_torque since the start",
        "Energy lost in friction and dampers since the start",
    ),
)

PARAMETERS = (
    length_parameter("pinion_radius", 0.05, "Radius of the pinion's pitch circle (R1)"),
    length_parameter("wheel_radius", 0.12, "Radius of the wheel's pitch circle (R2)"),
    *rotor_parameters("pinion", 16.0, 0.02),
    *rotor_parameters("wheel", 15.3, 0.11),
    *start_parameters("pinion", 0.0, " (phi_1); the wheel's is ratio times this", "the wheel's is ratio times this"),
    damping_parameter("pinion"),
    damping_parameter("wheel"),
    *shaft_parameters(damping=0.0),
    JOINT_FRICTION,
    *SETTINGS,
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
