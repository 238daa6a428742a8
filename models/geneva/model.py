"""The external Geneva drive: a pin in a slot while it is in there, a locking arc while it is not.

Frame: the wheel's hinge at the origin, the driver's hinge at (c, 0). The driver's x axis passes through its pin, the
wheel's through slot 0; slots are counted counter-clockwise. Equations and sources: README.md beside this file.
"""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    AngleLock,
    AngleStop,
    Case,
    CircularPattern,
    CompliantShaft,
    Contact,
    Damper,
    Finding,
    LogicalFunction,
    Mechanism,
    Model,
    PointLineContact,
    Revolute,
    Torque,
)
from mechanism_fmu.model.body import rotor_body
from mechanism_fmu.model.findings import at_most
from mechanism_fmu.model.functions import cos, sin

from .geometry import geneva, wheel_angle, wheel_speed
from .ports import INPUTS, OUTPUTS, PARAMETERS, SHAPES, calculated

# What is wrong with parameter values that are each within their limits.


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the drive cannot be built: value, limit and way out."""
    geometry = geneva(values)
    limits = {
        "no locking disc is left beside it": geometry.slot_depth,
        "the slots run into each other where they end": geometry.slot_spacing,
    }
    return tuple(
        Finding(
            at_most(most, values.pin_diameter),
            "pin_diameter = {:.6g} m is too thick for slot_count = {:g} and centre_distance = {:.6g} m: "
            f"{reason}. Give less than {{:.6g}} m, or a larger centre_distance.",
            (values.pin_diameter, values.slot_count, values.centre_distance, most),
        )
        for reason, most in limits.items()
    )


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The Geneva drive for parameter values that raise no objection."""
    c, rubbing = values.centre_distance, values.joint_friction_radius
    return Mechanism(
        bodies=(
            rotor_body(values, "driver", (c, 0.0), values.driver_angle_start, values.driver_speed_start),
            rotor_body(values, "wheel", (0.0, 0.0), wheel_angle(values), wheel_speed(values)),
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
        contacts=_contacts(values),
        patterns=(_slots(values),),
        functions=(LogicalFunction("pin_in_slot", of="slot.along", below=geneva(values).mouth_radius),),
        held=("driver.angle",),
    )


def _contacts(values: SimpleNamespace) -> tuple[Contact, ...]:
    """The slot and the locking arc, of which always one acts, and the backstop."""
    geometry = geneva(values)
    return (
        PointLineContact(
            "slot",
            "driver",
            (geometry.pin_radius, 0.0),
            "wheel",
            (0.0, 0.0),
            (0.0, 1.0),
            friction=values.slot_friction,
            pattern="slots",
            closed_while="pin_in_slot",
        ),
        AngleLock(
            "locking_arc",
            "wheel",
            GROUND,
            angle=geometry.pitch / 2,
            pitch=geometry.pitch,
            closed_while="not pin_in_slot",
        ),
        AngleStop(
            "backstop",
            "driver",
            GROUND,
            angle=values.driver_angle_start,
            pitch=2 * math.pi / values.backstop_teeth,
            restitution=values.backstop_restitution,
            enabled=values.backstop,
        ),
    )


def _slots(values: SimpleNamespace) -> CircularPattern:
    """The slots, counted counter-clockwise: as the driver turns forwards, its pin comes to slots 1, 2, 3 ...

    While the wheel rests, the boundary half way between two slots lies on the line of centres: the pin crosses it on
    the far side, where `along` of either slot is above R by a cos(pi/n), so that the logical function does not change.
    """
    half = math.pi / values.slot_count
    return CircularPattern(
        "slots",
        "driver",
        (geneva(values).pin_radius, 0.0),
        "wheel",
        2 * half,
        (0.0, 0.0),
        (-sin(half), cos(half)),
    )


CASES = (
    Case("friction", "Friction between pin and slot brakes the driver", {"slot_friction": 0.3}),
    Case(
        "backstop",
        "No drive, and a load on the wheel: the backstop keeps the driver from turning back",
        {"drive_damping": 0.0, "load_torque": 0.2, "backstop": True},
    ),
)

MODEL = Model(
    name="Geneva",
    description="External Geneva drive: a driver's pin turns a slotted wheel by one station per turn",
    author="The mechanism_fmu team",
    license="MIT",
    inputs=INPUTS,
    outputs=OUTPUTS,
    parameters=PARAMETERS,
    calculated=calculated,
    mechanism=mechanism,
    objections=objections,
    stop_time=3.0,
    step_size=5e-3,
    drawing=SHAPES,
    cases=CASES,
)
