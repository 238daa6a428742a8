"""Inputs, outputs and parameters of the Geneva drive."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import IMPACT_BUFFER_LENGTH, Calculated, Input, Output, Parameter

from .geometry import geneva, ratios
from .shapes import form

INPUTS = (
    Input(
        "drive_speed",
        "shaft.speed",
        2 * math.pi,
        "Speed of the driven end of the drive shaft (it acts when drive_damping > 0)",
        "rad/s",
        -1e6,
        1e6,
        "rpm",
    ),
    Input(
        "drive_angle",
        "shaft.angle",
        0.0,
        "Angle of the driven end of the drive shaft (it acts when drive_stiffness > 0)",
        "rad",
        -1e6,
        1e6,
        "deg",
    ),
    Input("drive_torque", "drive.torque", 0.0, "Torque on the driver, counter-clockwise positive", "N.m", -1e6, 1e6),
    Input(
        "load_torque", "load.torque", 0.0, "External torque on the wheel, counter-clockwise positive", "N.m", -1e6, 1e6
    ),
)
_ALL_INPUTS = tuple(port.name for port in INPUTS)


def _angle(body: str, symbol: str) -> Output:
    return Output(
        f"{body}_angle",
        f"{body}.angle",
        f"Absolute angle of the {body} ({symbol}), unwrapped",
        "rad",
        "deg",
        nominal=1.0,
    )


def _speed(name: str, source: str, description: str) -> Output:
    return Output(name, source, description, "rad/s", "rpm", nominal=1.0)


def _whole(name: str, source: str, description: str) -> Output:
    return Output(name, source, description, type="Integer")


def _flag(name: str, source: str, description: str) -> Output:
    return Output(name, source, description, type="Boolean")


def _torque(name: str, source: str, description: str, feedthrough: tuple[str, ...]) -> Output:
    return Output(name, source, description, "N.m", nominal=0.1, feedthrough=feedthrough)


def _energy(name: str, description: str) -> Output:
    source = {"work_done": "work", "energy_lost": "lost"}.get(name, name.removesuffix("_energy"))
    return Output(name, f"energy.{source}", description, "J", nominal=0.1)


def _impact(prefix: str, of: str) -> tuple[Output, ...]:
    """What is known of an impact: of the driver on its backstop, for there is no other."""
    return (
        _speed(
            f"{prefix}closing_speed", f"{_source(prefix)}.closing_speed", f"Speed at which the driver runs back, {of}"
        ),
        Output(f"{prefix}impulse", f"{_source(prefix)}.impulse", f"Angular impulse, {of}", "N.m.s", nominal=0.01),
        _speed(f"{prefix}driver_speed", f"{_source(prefix)}.speed:driver", f"Driver speed just after, {of}"),
        _speed(f"{prefix}wheel_speed", f"{_source(prefix)}.speed:wheel", f"Wheel speed just after, {of}"),
        _whole(f"{prefix}tooth", f"{_source(prefix)}.tooth", f"Tooth of the backstop, {of}"),
    )


def _source(prefix: str) -> str:
    return prefix.rstrip("._")


def _buffered_impact(k: int) -> tuple[Output, ...]:
    of = f"impact {k} of the last communication step"
    return (Output(f"impacts[{k}].time", f"impacts[{k}].time", f"Time, {of}", "s"), *_impact(f"impacts[{k}].", of))


OUTPUTS = (
    _angle("driver", "theta"),
    _angle("wheel", "psi"),
    _speed("driver_speed", "driver.speed", "Rate of driver_angle"),
    _speed("wheel_speed", "wheel.speed", "Rate of wheel_angle"),
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
        _ALL_INPUTS,
    ),
    _torque("backstop_torque", "backstop.force", "Torque of the backstop on the driver, 0 when open", _ALL_INPUTS),
    _torque(
        "drive_shaft_torque",
        "shaft.torque",
        "Torque of the drive shaft on the driver, added to drive_torque",
        ("drive_angle", "drive_speed"),
    ),
    _whole(
        "station",
        "slots.index",
        "Number of the slot that the pin is in, has left or comes to: it changes on the far side, forwards by +1",
    ),
    _flag("slot_active", "slot.closed", "The pin is in a slot and moves the wheel"),
    _flag("locking_arc_active", "locking_arc.closed", "The locking arc holds the wheel"),
    _flag("backstop_active", "backstop.closed", "The backstop holds the driver"),
    _whole("event_count", "event.count", "Events since the start: switched rows, changes of slot, impacts"),
    _whole("impact_count", "impact.count", "Impacts of the driver on its backstop since the start"),
    _flag("impact", "impact.any", "At least one impact in the last communication step"),
    Output("impact_time", "impact.time", "Time of the last impact; -1 before the first", "s"),
    *_impact("impact_", "last impact"),
    _whole(
        "impacts_in_step",
        "impact.in_step",
        f"Impacts of the last communication step held in impacts[1..{IMPACT_BUFFER_LENGTH}]",
    ),
    _whole(
        "impacts_lost",
        "impact.lost",
        f"Impacts since the start that did not fit into impacts[1..{IMPACT_BUFFER_LENGTH}]",
    ),
    *(output for k in range(1, IMPACT_BUFFER_LENGTH + 1) for output in _buffered_impact(k)),
    _energy("kinetic_energy", "Kinetic energy of driver and wheel"),
    _energy("spring_energy", "Energy of springs within the drive: none, 0"),
    _energy("work_done", "Work done by drive shaft, drive_torque and load_torque since the start"),
    _energy("energy_lost", "Energy lost in impacts, friction and the damper since the start"),
)


def _of_body(body: str, mass: float, inertia: float) -> tuple[Parameter, ...]:
    return (
        Parameter(f"{body}_mass", mass, f"Mass of the {body}; it matters for nothing but friction", "kg", 1e-12, 1e6),
        Parameter(f"{body}_inertia", inertia, f"Moment of inertia of the {body} about its hinge", "kg.m2", 1e-12, 1e6),
    )


PARAMETERS = (
    Parameter("slot_count", 4, "Number of slots of the wheel (n)", "1", 3, 24, "Integer"),
    Parameter("centre_distance", 0.1, "Distance between the hinges of wheel and driver (c)", "m", 1e-6, 1e3),
    Parameter("pin_diameter", 0.008, "Diameter of the pin; it matters for nothing but the form", "m", 1e-9, 1e3),
    *_of_body("driver", 1.0, 1e-2),
    *_of_body("wheel", 0.5, 1e-3),
    Parameter(
        "driver_angle_start",
        0.0,
        "Driver angle at the start (theta); 0: pin on the far side, 180 deg: pin in the middle of its way in the slot",
        "rad",
        -1e3,
        1e3,
        display_unit="deg",
    ),
    Parameter(
        "driver_speed_start",
        2 * math.pi,
        "Driver speed at the start; the wheel's follows",
        "rad/s",
        -1e6,
        1e6,
        display_unit="rpm",
    ),
    Parameter("wheel_damping", 0.0, "Damping of the wheel's rotation", "N.m.s/rad", 0.0, 1e6),
    Parameter("drive_stiffness", 0.0, "Stiffness of the drive shaft", "N.m/rad", 0.0, 1e9),
    Parameter("drive_damping", 1.0, "Damping of the drive shaft: torque per lag of speed", "N.m.s/rad", 0.0, 1e9),
    Parameter("slot_friction", 0.0, "Coefficient of friction between pin and slot", "1", 0.0, 1.0),
    Parameter("joint_friction_radius", 0.0, "Coefficient of friction times pin radius, of both hinges", "m", 0.0, 1.0),
    Parameter(
        "backstop",
        0.0,
        "Whether a ratchet on the driver's shaft keeps it from turning back",
        type="Boolean",
    ),
    Parameter("backstop_teeth", 12, "Teeth of the backstop's ratchet", "1", 1, 1000, "Integer"),
    Parameter("backstop_restitution", 0.0, "Coefficient of restitution of the backstop", "1", 0.0, 1.0),
    Parameter("baumgarte_alpha", 10.0, "Baumgarte gain on the rates of the constraints", "1/s", 0.0, 1e4),
    Parameter("baumgarte_beta", 1.0, "Baumgarte gain on the constraints, squared in use", "1/s", 0.0, 1e4),
    Parameter("relative_tolerance", 1e-9, "Relative tolerance of the integration", "1", 1e-13, 1e-3),
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
