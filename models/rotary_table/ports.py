"""Inputs, outputs and parameters of the rotary table."""

from __future__ import annotations

from types import SimpleNamespace

from mechanism_fmu.model import (
    Calculated,
    Input,
    Parameter,
    angle_parameter,
    body_angle_output,
    body_speed_output,
    damping_parameter,
    energy_outputs,
    load_torque_input,
    rotor_parameters,
    settings_parameters,
    shaft_inputs,
    shaft_torque_output,
    speed_parameter,
    torque_output,
)

from .shapes import form

INPUTS = (
    *shaft_inputs(speed=0.0, angle=0.3),
    load_torque_input("table"),
    Input("brake_torque", "brake.limit", 0.2, "Torque up to which the brake holds the table", "N.m", 0.0, 1e6),
)

OUTPUTS = (
    body_angle_output("table", "theta"),
    body_speed_output("table", nominal=0.1),
    shaft_torque_output("table"),
    torque_output(
        "friction_torque",
        "brake.torque",
        "Torque of the brake on the table; at most brake_torque either way, and less while it holds",
        [INPUTS[3]],
    ),
    *energy_outputs(
        kinetic="Kinetic energy of the table",
        spring="Energy in the compliance of the brake",
        work="Work done by drive shaft and load_torque since the start",
        lost="Energy lost in brake and damper since the start",
        nominal=1e-2,
    ),
)

PARAMETERS = (
    *rotor_parameters("table", 2.0, 0.02),
    damping_parameter("table"),
    Parameter("brake_stiffness", 200.0, "Stiffness of the brake while it holds", "N.m/rad", 1e-6, 1e9),
    Parameter("brake_damping", 1.0, "Damping of the brake while it holds", "N.m.s/rad", 1e-6, 1e9),
    Parameter("drive_stiffness", 2.0, "Stiffness of the drive shaft", "N.m/rad", 0.0, 1e9),
    Parameter("drive_damping", 0.02, "Damping of the drive shaft: torque per lag of speed", "N.m.s/rad", 0.0, 1e9),
    angle_parameter("table_angle_start", 0.0, "Table angle at the start (theta)"),
    speed_parameter("table_speed_start", 0.0, "Table speed at the start"),
    *settings_parameters(),
)


def calculated(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """What drawings need, and how far the brake gives before it slips."""
    time = values.brake_damping / values.brake_stiffness
    return (
        Calculated("brake_time", time, "Within this the brake gives way or holds again", "s", "ms"),
        *form(),
    )
