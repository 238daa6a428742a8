"""Inputs, outputs and parameters of the motor."""

from __future__ import annotations

from types import SimpleNamespace

from mechanism_fmu.model import (
    Calculated,
    Input,
    Output,
    Parameter,
    angle_parameter,
    body_angle_output,
    body_speed_output,
    damping_parameter,
    energy_outputs,
    load_torque_input,
    rotor_parameters,
    settings_parameters,
    speed_parameter,
)

from .shapes import form

INPUTS = (
    Input("speed_reference", "motor.speed", 50.0, "Speed that the controller keeps", "rad/s", -1e6, 1e6, "rpm"),
    load_torque_input("rotor"),
)

OUTPUTS = (
    body_angle_output("rotor", "phi"),
    body_speed_output("rotor", "omega", nominal=10.0),
    Output("motor_torque", "motor.torque", "Torque of the motor on its rotor (K i)", "N.m", nominal=1.0),
    Output("current", "motor.current", "Current of the armature (i)", "A", nominal=1.0),
    Output(
        "voltage",
        "motor.voltage",
        "Voltage that the controller gives to the armature (u)",
        "V",
        nominal=10.0,
        feedthrough=("speed_reference",),
    ),
    *energy_outputs(
        kinetic="Kinetic energy of the rotor",
        spring="Magnetic energy of the armature",
        work="Work done by the electric supply and load_torque since the start",
        lost="Energy lost in the armature's resistance and the rotor's damping since the start",
    ),
)

PARAMETERS = (
    Parameter("motor_constant", 0.25, "Torque per current, and voltage per speed (K)", "N.m/A", 1e-9, 1e6),
    Parameter("resistance", 2.0, "Resistance of the armature (R)", "ohm", 1e-9, 1e9),
    Parameter("inductance", 4e-3, "Inductance of the armature (L)", "H", 1e-9, 1e6),
    *rotor_parameters("rotor", 1.0, 1e-3),
    damping_parameter("rotor", 1e-4),
    Parameter("voltage_limit", 24.0, "Most that the controller gives, either way (U)", "V", 0.0, 1e6),
    Parameter("speed_gain", 0.5, "Proportional gain of the controller (kp)", "V.s/rad", 0.0, 1e6),
    Parameter("integral_gain", 10.0, "Integral gain of the controller (ki)", "V/rad", 0.0, 1e9),
    Parameter(
        "anti_windup",
        20.0,
        "By how much the integral gives way where the voltage is at its limit (g); 0: not at all",
        "rad/(V.s)",
        0.0,
        1e6,
    ),
    angle_parameter("rotor_angle_start", 0.0, "Rotor angle at the start (phi)"),
    speed_parameter("rotor_speed_start", 0.0, "Rotor speed at the start (omega); current and integral begin at 0"),
    *settings_parameters(),
)


def calculated(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """Time constants and limits of the motor, and what drawings need."""
    K, R = values.motor_constant, values.resistance
    return (
        Calculated("electrical_time", values.inductance / R, "Time constant of the armature (L/R)", "s", "ms"),
        Calculated(
            "mechanical_time", values.rotor_inertia * R / (K * K), "Time constant of the rotor (J R/K2)", "s", "ms"
        ),
        Calculated("stall_torque", K * values.voltage_limit / R, "Torque at rest and voltage_limit (K U/R)", "N.m"),
        Calculated(
            "idle_speed",
            K * values.voltage_limit / (K * K + R * values.rotor_damping),
            "Speed at voltage_limit without load",
            "rad/s",
            "rpm",
        ),
        *form(),
    )
