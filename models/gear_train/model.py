"""The gear train: a pinion and a wheel on fixed hinges, whose pitch circles roll on each other.

Frame: the pinion's hinge at the origin, the wheel's at (R1 + R2, 0). Both angles are 0 together. Equations and source:
README.md beside this file.
"""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    Body,
    CompliantShaft,
    Damper,
    Gears,
    Mechanism,
    Model,
    Revolute,
    Settings,
    Torque,
)
from mechanism_fmu.model.part_bodies import rotor_body

from .checks import objections
from .geometry import pairing
from .ports import INPUTS, OUTPUTS, PARAMETERS, calculated
from .shapes import SHAPES


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The gear train for parameter values that raise no objection."""
    rubbing = values.joint_friction_radius
    distance = pairing(values).centre_distance
    return Mechanism(
        bodies=_bodies(values),
        joints=(
            Revolute("pinion_hinge", "pinion", (0.0, 0.0), GROUND, (0.0, 0.0), rubbing),
            Revolute("wheel_hinge", "wheel", (0.0, 0.0), GROUND, (distance, 0.0), rubbing),
            # With the pinion at 0, its point at angle 0 meets the wheel's at pi: then the wheel is at 0, too.
            Gears("gears", "pinion", values.pinion_radius, 0.0, "wheel", values.wheel_radius, math.pi),
        ),
        forces=(
            Torque("drive", "pinion"),
            Torque("load", "wheel"),
            CompliantShaft("shaft", "pinion", stiffness=values.drive_stiffness, damping=values.drive_damping),
            Damper("pinion_damper", "pinion", damping=values.pinion_damping),
            Damper("wheel_damper", "wheel", damping=values.wheel_damping),
        ),
        inputs=INPUTS,
        outputs=OUTPUTS,
        calculated=calculated(values),
        held=("pinion.angle",),
        settings=Settings.of(values),
    )


def _bodies(values: SimpleNamespace) -> tuple[Body, Body]:
    """Both gears; the wheel starts where the pinion has brought it, and as fast."""
    pair = pairing(values)
    angle, speed = values.pinion_angle_start, values.pinion_speed_start
    return (
        rotor_body(values, "pinion", (0.0, 0.0), angle, speed),
        rotor_body(values, "wheel", (pair.centre_distance, 0.0), pair.ratio * angle, pair.ratio * speed),
    )


MODEL = Model(
    name="GearTrain",
    description="Pair of external gears: a pinion turns a wheel, slower and the other way round",
    parameters=PARAMETERS,
    mechanism=mechanism,
    objections=objections,
    stop_time=1.0,
    step_size=5e-3,
    drawing=SHAPES,
    author="The mechanism_fmu team",
    license="MIT",
)
