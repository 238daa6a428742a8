"""Inputs, outputs and parameters of the Geneva drive."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Calculated, Output, Parameter
from mechanism_fmu.model.port_builders import (
    JOINT_FRICTION,
    SETTINGS,
    angle_output,
    damping_parameter,
    drive_torque_input,
    energy_outputs,
    flag_output,
    impact_outputs,
    load_torque_input,
    rotor_parameters,
    shaft_inputs,
    shaft_parameters,
    shaft_torque_output,
    speed_output,
    start_parameters,
    whole_output,
)

from .geometry import geneva, ratios
from .shapes import form

INPUTS = (*shaft_inputs(speed=2 * math.pi), drive_torque_input("driver"), load_torque_input("wheel"))
_ALL_INPUTS = tuple(port.name for port in INPUTS)


def _torque(name: str, source: str, description: str) -> Output:
    return Output(name, source, description, "N.m", nominal=0.1, feedthrough=_ALL_INPUTS)


def _impact(prefix: str, source: str, of: str) -> tuple[Output, ...]:
    """What is known of an impact: of the driver on its backstop, for there is no other."""

    def speed(name: str, field: str, description: str) -> Output:
        return Output(f"{prefix}{name}", f"{source}{field}", f"{description}, {of}", "rad/s", "rpm", nominal=1.0)

    return (
        speed("closing_speed", "closing_speed", "Speed at which the driver runs back"),
        Output(f"{prefix}impulse", f"{source}impulse", f"Angular impulse, {of}", "N.m.s", nominal=0.01),
        speed("driver_speed", "speed:driver", "Driver speed just after"),
        speed("wheel_speed", "speed:wheel", "Wheel speed just after"),
        whole_output(f"{prefix}tooth", f"{source}tooth", f"Tooth of the backstop, {of}"),
    )


OUTPUTS = (
    angle_output("driver", "theta"),
    angle_output("wheel", "psi"),
    speed_output("driver"),
    speed_output("wheel"),
    Output(
        "pin_force",
        "slot.force",
        "Force of the slot on the pin, across the slot; positive: it turns the wheel clockwise; 0 outside the slot",
        "N",
        nominal=1.0,
        feedthrough=_ALL_INPUTS,
    ),
    _torque(
        "locking_torque",
        "locking_arc.force",
        "Torque of the locking arc on the wheel, counter-clockwise positive; 0 while the pin is in a slot",
    ),
    _torque("backstop_torque", "backstop.force", "Torque of the backstop on the driver, 0 when open"),
    shaft_torque_output("driver"),
    whole_output(
        "station",
        "slots.index",
        "Number of the slot that the pin is in, has left or comes to: it changes on the far side, forwards by +1",
    ),
    flag_output("slot_active", "slot.closed", "The pin is in a slot and moves the wheel"),
    flag_output("locking_arc_active", "locking_arc.closed", "The locking arc holds the wheel"),
    flag_output("backstop_active", "backstop.closed", "The backstop holds the driver"),
    whole_output("event_count", "event.count", "Events since the start: switched rows, changes of slot, impacts"),
    *impact_outputs("Impacts of the driver on its backstop", _impact),
    *energy_outputs(
        "Kinetic energy of driver and wheel",
        "Energy of springs within the drive: none, 0",
        "Work done by drive shaft, drive_torque and load_torque since the start",
        "Energy lost in impacts, friction and the damper since the start",
    ),
)

PARAMETERS = (
    Parameter("slot_count", 4, "Number of slots of the wheel (n)", "1", 3, 24, "Integer"),
    Parameter("centre_distance", 0.1, "Distance between the hinges of wheel and driver (c)", "m", 1e-6, 1e3),
    Parameter("pin_diameter", 0.008, "Diameter of the pin; it matters for nothing but the form", "m", 1e-9, 1e3),
    *rotor_parameters("driver", 1.0, 1e-2),
    *rotor_parameters("wheel", 0.5, 1e-3),
    *start_parameters(
        "driver",
        2 * math.pi,
        " (theta); 0: pin on the far side, 180 deg: pin in the middle of its way in the slot",
        "the wheel's follows",
    ),
    damping_parameter("wheel"),
    *shaft_parameters(damping=1.0),
    Parameter("slot_friction", 0.0, "Coefficient of friction between pin and slot", "1", 0.0, 1.0),
    JOINT_FRICTION,
    Parameter(
        "backstop",
        0.0,
        "Whether a ratchet on the driver's shaft keeps it from turning back",
        type="Boolean",
    ),
    Parameter("backstop_teeth", 12, "Teeth of the backstop's ratchet", "1", 1, 1000, "Integer"),
    Parameter("backstop_restitution", 0.0, "Coefficient of restitution of the backstop", "1", 0.0, 1.0),
    *SETTINGS,
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
