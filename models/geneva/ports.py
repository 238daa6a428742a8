"""Inputs, outputs and parameters of the Geneva drive."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import (
    Calculated,
    Output,
    Parameter,
    active_output,
    angle_parameter,
    body_angle_output,
    body_speed_output,
    damping_parameter,
    energy_outputs,
    flag_parameter,
    force_output,
    fraction_parameter,
    impact_outputs,
    impact_speed_fields,
    joint_friction_parameter,
    length_parameter,
    load_torque_input,
    rotor_parameters,
    settings_parameters,
    shaft_inputs,
    shaft_parameters,
    shaft_torque_output,
    speed_output,
    speed_parameter,
    torque_input,
    torque_output,
    whole_output,
)

from .geometry import geneva, ratios
from .shapes import form

INPUTS = (
    *shaft_inputs(speed=2 * math.pi),
    torque_input("drive", "driver"),
    load_torque_input("wheel"),
)

#: What is known of an impact: of the driver on its backstop, for there is no other.
_IMPACT = (
    speed_output("closing_speed", "closing_speed", "Speed at which the driver runs back, {impact}"),
    Output("impulse", "impulse", "Angular impulse, {impact}", "N.m.s", nominal=0.01),
    *impact_speed_fields("driver", "wheel"),
    whole_output("tooth", "tooth", "Tooth of the backstop, {impact}"),
)

OUTPUTS = (
    body_angle_output("driver", "theta"),
    body_angle_output("wheel", "psi"),
    body_speed_output("driver"),
    body_speed_output("wheel"),
    force_output(
        "pin_force",
        "slot.force",
        "Force of the slot on the pin, across the slot; positive: it turns the wheel clockwise; 0 outside the slot",
        INPUTS,
    ),
    torque_output(
        "locking_torque",
        "locking_arc.force",
        "Torque of the locking arc on the wheel, counter-clockwise positive; 0 while the pin is in a slot",
        INPUTS,
    ),
    torque_output("backstop_torque", "backstop.force", "Torque of the backstop on the driver, 0 when open", INPUTS),
    shaft_torque_output("driver"),
    whole_output(
        "station",
        "slots.index",
        "Number of the slot that the pin is in, has left or comes to: it changes on the far side, forwards by +1",
    ),
    active_output("slot", "The pin is in a slot and moves the wheel"),
    active_output("locking_arc", "The locking arc holds the wheel"),
    active_output("backstop", "The backstop holds the driver"),
    whole_output("event_count", "event.count", "Events since the start: switched rows, changes of slot, impacts"),
    *impact_outputs("Impacts of the driver on its backstop", _IMPACT),
    *energy_outputs(
        kinetic="Kinetic energy of driver and wheel",
        spring="Energy of springs within the drive: none, 0",
        work="Work done by drive shaft, drive_torque and load_torque since the start",
        lost="Energy lost in impacts, friction and the damper since the start",
    ),
)

PARAMETERS = (
    Parameter("slot_count", 4, "Number of slots of the wheel (n)", "1", 3, 24, "Integer"),
    length_parameter("centre_distance", 0.1, "Distance between the hinges of wheel and driver (c)"),
    length_parameter("pin_diameter", 0.008, "Diameter of the pin; it matters for nothing but the form", minimum=1e-9),
    *rotor_parameters("driver", 1.0, 1e-2),
    *rotor_parameters("wheel", 0.5, 1e-3),
    angle_parameter(
        "driver_angle_start",
        0.0,
        "Driver angle at the start (theta); 0: pin on the far side, 180 deg: pin in the middle of its way in the slot",
    ),
    speed_parameter("driver_speed_start", 2 * math.pi, "Driver speed at the start; the wheel's follows"),
    damping_parameter("wheel"),
    *shaft_parameters(damping=1.0),
    fraction_parameter("slot_friction", 0.0, "Coefficient of friction between pin and slot"),
    joint_friction_parameter(),
    flag_parameter("backstop", False, "Whether a ratchet on the driver's shaft keeps it from turning back"),
    Parameter("backstop_teeth", 12, "Teeth of the backstop's ratchet", "1", 1, 1000, "Integer"),
    fraction_parameter("backstop_restitution", 0.0, "Coefficient of restitution of the backstop"),
    *settings_parameters(),
)


def calculated(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """Lengths, the known ratios of the motion, and what drawings need."""
    geometry, known = geneva(values), ratios(values)
    return (
        Calculated("indexing_angle", geometry.pitch, "Angle of the wheel from station to station", "rad", "deg"),
        Calculated("pin_radius", geometry.pin_radius, "Distance of the pin from the driver's hinge (a)", "m"),
        Calculated("slot_mouth_radius", geometry.mouth_radius, "Outer radius of the wheel (R)", "m"),
        Calculated(
            "engagement_angle",
            geometry.engagement,
            "The driver's angle from the line of centres at which its pin enters and leaves (phi_0)",
            "rad",
            "deg",
        ),
        Calculated("motion_to_rest_ratio", known.motion_to_rest, "Time of motion over time of rest, steady driver"),
        Calculated("peak_speed_ratio", known.peak_speed, "Largest wheel speed over driver speed, steady driver"),
        Calculated(
            "peak_acceleration_ratio",
            known.peak_acceleration,
            "Largest wheel acceleration over driver speed squared, steady driver",
        ),
        Calculated(
            "peak_acceleration_angle",
            known.peak_angle,
            "The driver's angle from the line of centres at which that occurs, on either side",
            "rad",
            "deg",
        ),
        Calculated(
            "entry_acceleration_ratio",
            known.entry_acceleration,
            "Wheel acceleration at entry over driver speed squared, steady driver",
        ),
        *form(values),
    )
