"""The rotary table: a disc on a fixed hinge, a brake that holds it up to a torque, and the shaft that turns it.

Frame: the table's hinge at the origin. Equations and source: README.md beside this file.
"""

from __future__ import annotations

from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    CompliantShaft,
    Damper,
    Mechanism,
    Model,
    Revolute,
    Settings,
    SlipClutch,
    Torque,
)
from mechanism_fmu.model.part_bodies import rotor_body

from .checks import objections
from .ports import INPUTS, OUTPUTS, PARAMETERS, calculated
from .shapes import SHAPES


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The rotary table for parameter values."""
    return Mechanism(
        bodies=(rotor_body(values, "table", (0.0, 0.0), values.table_angle_start, values.table_speed_start),),
        joints=(Revolute("hinge", "table", (0.0, 0.0), GROUND, (0.0, 0.0)),),
        forces=(
            CompliantShaft("shaft", "table", stiffness=values.drive_stiffness, damping=values.drive_damping),
            SlipClutch("brake", "table", stiffness=values.brake_stiffness, damping=values.brake_damping),
            Torque("load", "table"),
            Damper("table_damper", "table", damping=values.table_damping),
        ),
        inputs=INPUTS,
        outputs=OUTPUTS,
        calculated=calculated(values),
        held=("table.angle",),
        settings=Settings.of(values),
    )


MODEL = Model(
    name="RotaryTable",
    description="Rotary table with a friction brake that sticks and slips, turned through a compliant shaft",
    parameters=PARAMETERS,
    mechanism=mechanism,
    objections=objections,
    stop_time=4.0,
    step_size=5e-3,
    drawing=SHAPES,
    author="The mechanism_fmu team",
    license="MIT",
)
