"""The motor: a rotor on a fixed hinge, its armature circuit, and a PI controller of its speed.

Frame: the rotor's hinge at the origin. Equations and source: README.md beside this file.
"""

from __future__ import annotations

from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    Calculated,
    Case,
    Damper,
    DCMotor,
    Disc,
    Finding,
    Hinge,
    Input,
    Mechanism,
    Model,
    Output,
    Parameter,
    Revolute,
    TableSignal,
    Torque,
    Wheel,
    port_builders as ports,
)
from mechanism_fmu.model.body import rotor_body
from mechanism_fmu.model.drawing import square_tooth

# How the motor is drawn from its variables: housing, and a rotor whose poles show how it turns.

#: Radii as drawn [m]; the motor's equations know none.
HOUSING, POLE, CORE = 0.05, 0.042, 0.018
POLES = 4
OUTLINE = square_tooth(CORE, POLE, 0.55, POLES)

SHAPES = (
    Disc("housing", (0.0, 0.0), "outline_housing_radius"),
    Wheel("rotor", (0.0, 0.0), "rotor_angle", POLES, OUTLINE),
    Hinge((0.0, 0.0)),
)


# What is wrong with parameter values that are each within their limits.

#: An armature or a controller that is so fast [s] costs millions of steps a second and shows nothing.
FASTEST = 1e-6


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the motor cannot be run: value, limit and way out."""
    electrical = values.inductance / values.resistance
    rate = values.anti_windup * values.integral_gain
    return (
        Finding(
            FASTEST - electrical,
            "The armature's time constant inductance / resistance = {:.3g} s is shorter than "
            f"{FASTEST:g} s, and steps would be as small. Give a larger inductance = {{:.3g}} H: as long as the time "
            "constant stays far below the rotor's, it changes little.",
            (electrical, values.inductance),
        ),
        Finding(
            rate * FASTEST - 1.0,
            "anti_windup * integral_gain = {:.3g} 1/s is more than "
            f"{1 / FASTEST:g} 1/s, and steps would be too small. Give a smaller anti_windup.",
            (rate,),
        ),
    )


# Inputs, outputs and parameters of the motor.

INPUTS = (
    Input("speed_reference", "motor.speed", 50.0, "Speed that the controller keeps", "rad/s", -1e6, 1e6, "rpm"),
    ports.load_torque_input("rotor", usual=(-2.0, 2.0)),
)

OUTPUTS = (
    ports.body_angle_output("rotor", "phi"),
    ports.body_speed_output("rotor", "omega", nominal=10.0),
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
    *ports.energy_outputs(
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
    *ports.rotor_parameters("rotor", 1.0, 1e-3),
    ports.damping_parameter("rotor", 1e-4),
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
    ports.angle_parameter("rotor_angle_start", 0.0, "Rotor angle at the start (phi)"),
    ports.speed_parameter(
        "rotor_speed_start",
        0.0,
        "Rotor speed at the start (omega); current and integral begin at 0",
        usual=(-100.0, 100.0),
    ),
    *ports.settings_parameters(),
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
        Calculated("outline_housing_radius", HOUSING, "Drawing: radius of the housing", "m"),
    )


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The motor for parameter values."""
    return Mechanism(
        bodies=(rotor_body(values, "rotor", (0.0, 0.0), values.rotor_angle_start, values.rotor_speed_start),),
        joints=(Revolute("hinge", "rotor", (0.0, 0.0), GROUND, (0.0, 0.0)),),
        forces=(
            DCMotor(
                "motor",
                "rotor",
                constant=values.motor_constant,
                resistance=values.resistance,
                inductance=values.inductance,
                voltage=values.voltage_limit,
                gain=values.speed_gain,
                integral_gain=values.integral_gain,
                anti_windup=values.anti_windup,
            ),
            Torque("load", "rotor"),
            Damper("rotor_damper", "rotor", damping=values.rotor_damping),
        ),
        held=("rotor.angle",),
    )


CASES = (
    Case(
        "load_step",
        "A load of 1 N.m comes on in the middle, and the controller finds back",
        signals={"load_torque": TableSignal((0.25, 0.251), (0.0, -1.0))},
    ),
)

MODEL = Model(
    name="Motor",
    description="Direct-current motor with a PI controller of its speed and limited voltage",
    author="The mechanism_fmu team",
    license="MIT",
    inputs=INPUTS,
    outputs=OUTPUTS,
    parameters=PARAMETERS,
    calculated=calculated,
    mechanism=mechanism,
    objections=objections,
    stop_time=0.5,
    step_size=1e-3,
    drawing=SHAPES,
    cases=CASES,
)
