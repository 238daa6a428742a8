"""The rotary table: a disc on a fixed hinge, a brake that holds it up to a torque, and the shaft that turns it.

Frame: the table's hinge at the origin. Equations and source: README.md beside this file.
"""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    Brake,
    Calculated,
    Case,
    CompliantShaft,
    Damper,
    Disc,
    Hinge,
    Input,
    Mechanism,
    Model,
    Parameter,
    Revolute,
    SineSignal,
    Torque,
    Wheel,
    port_builders as ports,
)
from mechanism_fmu.model.body import rotor_body
from mechanism_fmu.model.drawing import square_tooth

# How the rotary table is drawn from its variables: the table with its stations, and the brake's disc.

#: Radii as drawn [m]; the table's equations know none.
RIM, STATION, BRAKE = 0.13, 0.115, 0.05
STATIONS = 10
OUTLINE = square_tooth(RIM, STATION, 0.6, STATIONS)

SHAPES = (
    Wheel("table", (0.0, 0.0), "table_angle", STATIONS, OUTLINE),
    Disc("brake", (0.0, 0.0), "outline_brake_radius"),
    Hinge((0.0, 0.0)),
)


# Inputs, outputs and parameters of the rotary table.

INPUTS = (
    *ports.shaft_inputs(speed=0.0, angle=0.3),
    ports.load_torque_input("table", usual=(-1.0, 1.0)),
    Input("brake_torque", "brake.limit", 0.2, "Torque up to which the brake holds the table", "N.m", 0.0, 1e6),
)

OUTPUTS = (
    ports.body_angle_output("table", "theta"),
    ports.body_speed_output("table", nominal=0.1),
    ports.shaft_torque_output("table"),
    ports.torque_output(
        "friction_torque",
        "brake.friction_force",
        "Torque of the brake on the table; at most brake_torque either way, and less while it holds",
        INPUTS,
    ),
    ports.speed_output("brake_slip_speed", "brake.slip_speed", "Slip of the table in its brake; 0 while it sticks"),
    ports.flag_output("brake_sticks", "brake.sticks", "The brake holds the table"),
    *ports.energy_outputs(
        kinetic="Kinetic energy of the table",
        spring="Energy of springs: there are none",
        work="Work done by drive shaft and load_torque since the start",
        lost="Energy lost in brake and damper since the start",
        nominal=1e-2,
    ),
)

PARAMETERS = (
    *ports.rotor_parameters("table", 2.0, 0.02),
    ports.damping_parameter("table", usual=(0.0, 0.1)),
    Parameter("drive_stiffness", 2.0, "Stiffness of the drive shaft", "N.m/rad", 0.0, 1e9),
    Parameter("drive_damping", 0.02, "Damping of the drive shaft: torque per lag of speed", "N.m.s/rad", 0.0, 1e9),
    ports.angle_parameter("table_angle_start", 0.0, "Table angle at the start (theta)"),
    ports.speed_parameter("table_speed_start", 0.0, "Table speed at the start"),
    *ports.settings_parameters(),
)


def calculated(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """What drawings need."""
    return (Calculated("outline_brake_radius", BRAKE, "Drawing: radius of the brake's disc", "m"),)


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The rotary table for parameter values."""
    return Mechanism(
        bodies=(rotor_body(values, "table", (0.0, 0.0), values.table_angle_start, values.table_speed_start),),
        joints=(Revolute("hinge", "table", (0.0, 0.0), GROUND, (0.0, 0.0)),),
        forces=(
            CompliantShaft("shaft", "table", stiffness=values.drive_stiffness, damping=values.drive_damping),
            Brake("brake", "table"),
            Torque("load", "table"),
            Damper("table_damper", "table", damping=values.table_damping),
        ),
        held=("table.angle",),
    )


CASES = (
    Case(
        "to_and_fro",
        "The drive swings: the brake holds the table until the shaft is wound up, and lets it slip",
        signals={
            "drive_angle": SineSignal(0.0, 0.3, 2.0),
            "drive_speed": SineSignal(0.0, 0.3 * math.pi, 2.0, math.pi / 2),
        },
    ),
)

MODEL = Model(
    name="RotaryTable",
    description="Rotary table with a friction brake that sticks and slips, turned through a compliant shaft",
    author="The mechanism_fmu team",
    license="MIT",
    inputs=INPUTS,
    outputs=OUTPUTS,
    parameters=PARAMETERS,
    calculated=calculated,
    mechanism=mechanism,
    stop_time=4.0,
    step_size=5e-3,
    drawing=SHAPES,
    cases=CASES,
)
