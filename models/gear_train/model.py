"""The gear train: a pinion and a wheel on fixed hinges, whose pitch circles roll on each other.

Frame: the pinion's hinge at the origin, the wheel's at (R1 + R2, 0). Both angles are 0 together. Equations and
source: README.md beside this file.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    Body,
    Calculated,
    CompliantShaft,
    Damper,
    Disc,
    Finding,
    Gears,
    Hinge,
    Mechanism,
    Model,
    Revolute,
    Torque,
    Wheel,
    port_builders as ports,
)
from mechanism_fmu.model.body import rotor_body
from mechanism_fmu.model.findings import either
from mechanism_fmu.model.functions import Number

# What follows from the radii and inertias of a pair of external gears on fixed hinges.


@dataclass(frozen=True)
class GearPairing:
    """The pair.

    Attributes:
        centre_distance: R1 + R2, between the hinges [m].
        ratio: i = -R1/R2, of the wheel's speed over the pinion's.
        reduced_inertia: J1 + i^2 J2, of both gears seen at the pinion [kg m2].
    """

    centre_distance: Number
    ratio: Number
    reduced_inertia: Number


def pairing(values: SimpleNamespace) -> GearPairing:
    """The pair for parameter values."""
    ratio = -values.pinion_radius / values.wheel_radius
    return GearPairing(
        centre_distance=values.pinion_radius + values.wheel_radius,
        ratio=ratio,
        reduced_inertia=values.pinion_inertia + ratio * ratio * values.wheel_inertia,
    )


# How the gear train is drawn from its variables: pitch circles, and in each gear arms that show how it turns.

#: Arms of a gear as drawn, and where they begin and end, in pitch radii.
ARMS = 5
ENDS = {"inner": 0.25, "outer": 0.92}

_HALF, _GAP = 0.35 * math.pi / ARMS, math.pi / ARMS
#: One arm, about the x axis, from the middle of the gap before it to that behind it: which end, and the angle [rad].
ARM = (
    ("inner", -_GAP),
    ("inner", -_HALF),
    ("outer", -_HALF),
    ("outer", _HALF),
    ("inner", _HALF),
    ("inner", _GAP),
)

_PINION_HINGE, _WHEEL_HINGE = (0.0, 0.0), ("centre_distance", 0.0)


def _arms(gear: str) -> tuple[tuple[str, float], ...]:
    return tuple((f"outline_{gear}_{end}_radius", angle) for end, angle in ARM)


SHAPES = (
    Disc("pinion", _PINION_HINGE, "pinion_radius"),
    Disc("wheel", _WHEEL_HINGE, "wheel_radius"),
    Wheel("pinion's arms", _PINION_HINGE, "pinion_angle", ARMS, _arms("pinion")),
    Wheel("wheel's arms", _WHEEL_HINGE, "wheel_angle", ARMS, _arms("wheel")),
    Hinge(_PINION_HINGE),
    Hinge(_WHEEL_HINGE),
)


def form(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """Where the arms begin and end."""
    radii = {"pinion": values.pinion_radius, "wheel": values.wheel_radius}
    return tuple(
        Calculated(f"outline_{gear}_{end}_radius", share * radius, f"Drawing: {end} end of the {gear}'s arms", "m")
        for gear, radius in radii.items()
        for end, share in ENDS.items()
    )


# What is wrong with parameter values that are each within their limits.

#: Of one radius over the other. Beyond this, rounding of the fast gear's angle would turn the slow one to and fro.
MOST_RATIO = 1000.0


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the gears cannot mesh: value, limit and way out."""
    R1, R2 = values.pinion_radius, values.wheel_radius
    return (
        Finding(
            either(R1 - MOST_RATIO * R2, R2 - MOST_RATIO * R1),
            "pinion_radius = {:.6g} m and wheel_radius = {:.6g} m differ by more than a factor of "
            f"{MOST_RATIO:g}, which no pair of gears bridges. Give radii that are closer, or use one gear train after "
            "the other.",
            (R1, R2),
        ),
    )


# Inputs, outputs and parameters of the gear train.

INPUTS = (
    ports.torque_input("drive", "pinion", 1.5, usual=(-5.0, 5.0)),
    ports.load_torque_input("wheel", -0.7, usual=(-5.0, 5.0)),
    *ports.shaft_inputs(speed=0.0),
)

OUTPUTS = (
    *ports.body_motion_outputs({"pinion": "phi_1", "wheel": "phi_2"}),
    ports.force_output(
        "mesh_force",
        "gears.force",
        "Tangential force between the gears (F); its torque on each gear is F times that gear's radius",
        INPUTS,
        nominal=10.0,
    ),
    ports.shaft_torque_output("pinion"),
    *ports.energy_outputs(
        kinetic="Kinetic energy of both gears",
        spring="Energy of springs within the gear train: none, 0",
        work="Work done by drive shaft, drive_torque and load_torque since the start",
        lost="Energy lost in friction and dampers since the start",
    ),
)

PARAMETERS = (
    ports.length_parameter("pinion_radius", 0.05, "Radius of the pinion's pitch circle (R1)"),
    ports.length_parameter("wheel_radius", 0.12, "Radius of the wheel's pitch circle (R2)"),
    *ports.rotor_parameters("pinion", 16.0, 0.02),
    *ports.rotor_parameters("wheel", 15.3, 0.11),
    ports.angle_parameter(
        "pinion_angle_start", 0.0, "Pinion angle at the start (phi_1); the wheel's is ratio times this"
    ),
    ports.speed_parameter("pinion_speed_start", 0.0, "Pinion speed at the start; the wheel's is ratio times this"),
    ports.damping_parameter("pinion", usual=(0.0, 0.5)),
    ports.damping_parameter("wheel", usual=(0.0, 0.5)),
    *ports.shaft_parameters(damping=0.0),
    ports.joint_friction_parameter(),
    *ports.settings_parameters(),
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
        held=("pinion.angle",),
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
    author="The mechanism_fmu team",
    license="MIT",
    inputs=INPUTS,
    outputs=OUTPUTS,
    parameters=PARAMETERS,
    calculated=calculated,
    mechanism=mechanism,
    objections=objections,
    stop_time=1.0,
    step_size=5e-3,
    drawing=SHAPES,
)
