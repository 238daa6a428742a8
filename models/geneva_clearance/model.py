"""The Geneva drive with play: pin, slots, locking disc and locking arcs are outlines that touch or do not.

Frame and symbols: those of `models.geneva`. Equations and sources: README.md beside this file.
"""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    Case,
    CircularCopies,
    CompliantShaft,
    Damper,
    Finding,
    Mechanism,
    Model,
    Outline,
    OutlineContact,
    Revolute,
    Torque,
)
from mechanism_fmu.model.body import rotor_body
from mechanism_fmu.model.findings import at_most, first
from mechanism_fmu.model.functions import Number

from ..geneva.geometry import wheel_angle, wheel_speed
from .geometry import (
    SLOT_COUNT,
    arm_outline,
    disc_outline,
    land,
    lengths,
    pin_outline,
    slot_depth,
    slot_half,
    with_slots,
)
from .ports import INPUTS, OUTPUTS, PARAMETERS, SHAPES, calculated

#: Half the angle between two slots, its sine.
_HALF_PITCH_SINE = math.sin(math.pi / SLOT_COUNT)

#: Of the centre distance. Faces are looked at as finely as the pin needs, which for a thinner one takes seconds; in
#: steel, such a pin carries nothing.
_THINNEST_PIN = 0.005

#: Lengths that are nearer to nothing than this part of the centre distance are nothing.
_FLAT = 1e-6


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the drive cannot be built: value, limit and way out; at most one applies."""
    flat = _FLAT * values.centre_distance
    half = slot_half(values)
    bottoms = lengths(values).mouth_radius - slot_depth(values) + half  # where two bottoms are nearest to each other
    thinnest = _THINNEST_PIN * values.centre_distance
    return first(
        Finding(
            at_most(values.pin_diameter, thinnest),
            "pin_diameter = {:.6g} m must be more than 0.005 centre_distance = {:.6g} m: give a thicker pin, "
            "or a smaller centre_distance.",
            (values.pin_diameter, thinnest),
        ),
        Finding(
            at_most(bottoms * _HALF_PITCH_SINE, half + flat),
            "pin_diameter = {:.6g} m and slot_clearance = {:.6g} m make the slots run into each other where they end: "
            "give less, or a larger centre_distance.",
            (values.pin_diameter, values.slot_clearance),
        ),
        Finding(
            at_most(land(values), flat),
            "Between a slot's mouth and the locking arc {:.6g} m are left of the wheel's rim: pin_diameter = {:.6g} m "
            "must be more than (pin_diameter + slot_clearance)/2 + mouth_radius + locking_clearance = {:.6g} m. Give "
            "a smaller mouth_radius or less clearance.",
            (land(values), values.pin_diameter, values.pin_diameter - land(values)),
        ),
    )


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The drive for parameter values that raise no objection."""
    c, rubbing, ideal = values.centre_distance, values.joint_friction_radius, with_slots(values)
    arm = arm_outline(values)
    return Mechanism(
        bodies=(
            rotor_body(values, "driver", (c, 0.0), values.driver_angle_start, values.driver_speed_start),
            rotor_body(values, "wheel", (0.0, 0.0), wheel_angle(ideal), wheel_speed(ideal)),
        ),
        joints=(
            Revolute("driver_hinge", "driver", (0.0, 0.0), GROUND, (c, 0.0), rubbing),
            Revolute("wheel_hinge", "wheel", (0.0, 0.0), GROUND, (0.0, 0.0), rubbing),
        ),
        forces=(
            Torque("drive", "driver"),
            Torque("load", "wheel"),
            CompliantShaft("shaft", "driver", stiffness=values.drive_stiffness, damping=values.drive_damping),
            Damper("wheel_damper", "wheel", damping=values.wheel_damping),
        ),
        contacts=(
            _contact("slot", pin_outline(values), arm, values, values.slot_friction),
            _contact("locking_disc", disc_outline(values), arm, values, values.locking_friction),
        ),
        calculated=calculated(values, arm),
        held=("driver.angle",),
    )


def _contact(name: str, of_driver: Outline, arm: Outline, values: SimpleNamespace, friction: Number) -> OutlineContact:
    return OutlineContact(
        name,
        "driver",
        "wheel",
        outline_i=of_driver,
        outline_j=arm,
        copies=CircularCopies(SLOT_COUNT),
        points=3,
        restitution=values.restitution,
        friction=friction,
    )


CASES = (
    Case("worn", "Ten times the play: the pin strikes its slot three times as fast", {"slot_clearance": "1 mm"}),
    Case("bouncing", "Blows that are not plastic: the wheel rattles", {"restitution": 0.5}),
    Case("friction", "Friction in slot and locking arc brakes", {"slot_friction": 0.2, "locking_friction": 0.2}),
)

MODEL = Model(
    name="GenevaClearance",
    description="Geneva drive with play: the pin strikes its slot, and the wheel rattles in its locking arc",
    author="The mechanism_fmu team",
    license="MIT",
    inputs=INPUTS,
    outputs=OUTPUTS,
    parameters=PARAMETERS,
    mechanism=mechanism,
    objections=objections,
    stop_time=3.0,
    step_size=5e-3,
    drawing=SHAPES,
    cases=CASES,
)
