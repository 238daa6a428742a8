"""Inputs, outputs and parameters of the Geneva drive with play, and how it is drawn from them."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Bar, Calculated, Disc, Hinge, Outline, Output, Parameter, Wheel, port_builders as ports
from mechanism_fmu.model.functions import Number, atan2, sqrt

from ..geneva import ports as geneva
from .geometry import SLOT_COUNT, entry, lengths, relief_radius, rest_play

INPUTS = geneva.INPUTS

_CONTACTS = "0, 1: pin in its slot, first and second place; 4, 5: locking disc, likewise"

_IMPACT = (
    ports.whole_output("contact", "contact", f"What struck ({_CONTACTS}): {{impact}}"),
    ports.whole_output("arm", "tooth", "Arm of the wheel that was struck, 0 ahead of slot 0: {impact}"),
    Output("closing_speed", "closing_speed", "Normal closing speed: {impact}", "m/s", nominal=0.01),
    Output("impulse", "impulse", "Impulse: {impact}", "N.s", nominal=1e-3),
    *ports.impact_speed_fields("driver", "wheel"),
)

OUTPUTS = (
    *ports.body_motion_outputs({"driver": "theta", "wheel": "psi"}),
    ports.force_output("slot_force", "slot.force", "Normal force of a slot on the pin; 0 when apart", INPUTS),
    ports.force_output(
        "locking_force", "locking_disc.force", "Normal force of a locking arc on the locking disc; 0 when apart", INPUTS
    ),
    ports.force_output(
        "second_locking_force",
        "locking_disc_2.force",
        "The same where it touches at the same time: at the other end of the arc",
        INPUTS,
    ),
    Output("slot_gap", "slot.gap", "Distance of the pin from the wheel; 0 when it touches", "m", nominal=1e-4),
    Output("locking_gap", "locking_disc.gap", "Distance of the locking disc from the wheel", "m", nominal=1e-4),
    ports.shaft_torque_output("driver"),
    *ports.friction_outputs("slot", "the pin on the wall of its slot", INPUTS),
    *ports.friction_outputs("locking_disc", "the locking disc on the wheel", INPUTS),
    ports.active_output("slot", "The pin touches a slot"),
    ports.active_output("locking_disc", "The locking disc touches the wheel"),
    ports.whole_output("event_count", "event.count", "Events since the start: impacts, hand-overs, openings"),
    *ports.impact_outputs("Impacts of pin and locking disc on the wheel", _IMPACT),
    *ports.energy_outputs(
        kinetic="Kinetic energy of driver and wheel",
        spring="Energy of springs within the drive: none, 0",
        work="Work done by drive shaft, drive_torque and load_torque since the start",
        lost="Energy lost in impacts, friction and the damper since the start",
    ),
)

PARAMETERS = (
    ports.length_parameter("centre_distance", 0.1, "Distance between the hinges of wheel and driver (c)"),
    ports.length_parameter("pin_diameter", 0.008, "Diameter of the pin"),
    ports.length_parameter(
        "slot_clearance", 1e-4, "Width of a slot less the pin's diameter", minimum=1e-5, usual=(2e-5, 1e-3)
    ),
    ports.length_parameter(
        "locking_clearance",
        1e-4,
        "Radius of the locking arcs less that of the locking disc",
        minimum=1e-5,
        usual=(2e-5, 5e-4),
    ),
    ports.length_parameter("mouth_radius", 1e-3, "Radius of the rounded mouths of the slots"),
    *ports.rotor_parameters("driver", 1.0, 1e-2),
    *ports.rotor_parameters("wheel", 0.5, 1e-3),
    ports.angle_parameter(
        "driver_angle_start",
        0.0,
        "Driver angle at the start (theta); 0: pin on the far side, 180 deg: pin in the middle of its way in the slot",
    ),
    ports.speed_parameter("driver_speed_start", 2 * math.pi, "Driver speed at the start; the wheel's follows"),
    ports.damping_parameter("wheel", usual=(0.0, 0.05)),
    *ports.shaft_parameters(damping=1.0),
    ports.fraction_parameter("restitution", 0.0, "Coefficient of restitution of pin and locking disc on the wheel"),
    Parameter("slot_friction", 0.0, "Coefficient of friction between pin and slot", "1", 0.0, 10.0),
    Parameter("locking_friction", 0.0, "Coefficient of friction between locking disc and arc", "1", 0.0, 10.0),
    ports.joint_friction_parameter(),
    *ports.settings_parameters(),
)


# How it is drawn from its variables: the arm of the wheel by points of its outline, the locking disc by two radii.

_WHEEL_HINGE, _DRIVER_HINGE = (0.0, 0.0), ("centre_distance", 0.0)

#: Points of half an arm: of which element, and how far on its way. Bottom, wall, mouth, land, locking arc.
_POINTS = (
    *((0, 0.0), (0, 0.35), (0, 0.7), (1, 0.0), (2, 0.0), (2, 0.5), (3, 0.0)),
    *((4, k / 10) for k in range(6)),
)

_NAMES = tuple(f"outline_arm_{k}" for k in range(len(_POINTS)))

_EDGE = math.pi / 2 - math.pi / SLOT_COUNT

SHAPES = (
    Wheel(
        "wheel",
        _WHEEL_HINGE,
        "wheel_angle",
        float(SLOT_COUNT),
        (
            *((f"{name}_radius", f"{name}_angle") for name in _NAMES),
            *((f"{name}_radius", f"{name}_mirrored") for name in _NAMES[-2::-1]),
        ),
    ),
    Wheel(
        "locking disc",
        _DRIVER_HINGE,
        "driver_angle",
        1,
        (
            *(("outline_relief_radius", _EDGE * k / 4) for k in range(-4, 5)),
            *(("outline_disc_radius", _EDGE + (2 * math.pi - 2 * _EDGE) * k / 30) for k in range(31)),
        ),
    ),
    Bar("driver", _DRIVER_HINGE, "driver_angle", "pin_radius"),
    Disc("pin", "driver", "outline_pin_radius"),
    Hinge(_WHEEL_HINGE),
    Hinge(_DRIVER_HINGE),
)


def calculated(values: SimpleNamespace, arm: Outline) -> tuple[Calculated, ...]:
    """Lengths, what is known in advance, and what drawings need.

    Args:
        values: of the parameters.
        arm: its outline in the frame of the wheel.
    """
    drive, (tau, speed, _) = lengths(values), entry(values)
    return (
        Calculated("indexing_angle", drive.pitch, "Angle of the wheel from station to station", "rad", "deg"),
        Calculated("pin_radius", drive.pin_radius, "Distance of the pin from the driver's hinge (a)", "m"),
        Calculated("slot_mouth_radius", drive.mouth_radius, "Distance of a slot's mouth from the wheel's hinge", "m"),
        Calculated(
            "entry_angle",
            tau,
            "Angle by which the driver turns from where the pin enters, in the middle, to where it strikes (tau)",
            "rad",
            "deg",
        ),
        Calculated("entry_speed_ratio", speed, "Closing speed of that blow over the driver's speed", "m"),
        Calculated("rest_play", rest_play(values), "Angle by which the resting wheel can turn to either side", "rad"),
        Calculated("outline_pin_radius", values.pin_diameter / 2, "Drawing: radius of the pin", "m"),
        Calculated("outline_disc_radius", drive.locking_radius, "Drawing: radius of the locking disc", "m"),
        Calculated("outline_relief_radius", relief_radius(values), "Drawing: radius of its relief", "m"),
        *_form(arm),
    )


def _form(arm: Outline) -> tuple[Calculated, ...]:
    """Polar points of half an arm, and the angles of their mirror images."""
    elements, found = arm.elements, []
    for name, (element, part) in zip(_NAMES, _POINTS, strict=True):
        x, y = elements[element].point(part)
        angle: Number = atan2(y, x)
        found += [
            Calculated(f"{name}_radius", sqrt(x * x + y * y), "Drawing: radius of a point of an arm", "m"),
            Calculated(f"{name}_angle", angle, "Drawing: angle of a point of an arm", "rad", "deg"),
        ]
        if name != _NAMES[-1]:
            mirrored = 2 * math.pi / SLOT_COUNT - angle
            found.append(Calculated(f"{name}_mirrored", mirrored, "Drawing: angle of its mirror image", "rad", "deg"))
    return tuple(found)
