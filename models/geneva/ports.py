"""Inputs, outputs and parameters of the Geneva drive, and how it is drawn from them."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Bar, Calculated, Disc, Hinge, Output, Parameter, Wheel, port_builders as ports
from mechanism_fmu.model.four_bar import angle_between
from mechanism_fmu.model.functions import Number, atan2, cos, sin, sqrt

from .geometry import geneva, ratios

# How the Geneva drive is drawn from its variables: slotted wheel, driver with locking disc and pin, hinges.
#
# The form of the parts takes lengths and angles that follow from the parameters, `outline_*`; half of each outline is
# enough, because both are symmetric about the x axis of their body.

#: Where polar points stand, in the order from the x axis outwards.
_WHEEL_POINTS = ("slot_end", "slot_side", "mouth", "rim", "arc", "inner_arc", "arc_middle")
_RELIEF_POINTS = ("relief_bottom", "relief", "disc_edge", "disc")

_WHEEL_HINGE, _DRIVER_HINGE = (0.0, 0.0), ("centre_distance", 0.0)


def _polar(name: str) -> tuple[str, str]:
    return f"outline_{name}_radius", f"outline_{name}_angle"


def _mirrored(names: tuple[str, ...]) -> tuple[tuple[str, str], ...]:
    """An outline that is symmetric about the x axis, counter-clockwise, from its lower half to its upper half."""
    upper = [_polar(name) for name in names]
    return (*((radius, f"-{angle}") for radius, angle in upper[:0:-1]), *upper)


#: The locking disc beyond 90 deg from the pin, where its rim is a full circle for every number of slots.
_FAR_SIDE = tuple((_polar("disc")[0], math.radians(angle)) for angle in range(90, 271, 10))

SHAPES = (
    Wheel("wheel", _WHEEL_HINGE, "wheel_angle", "slot_count", _mirrored(_WHEEL_POINTS)),
    Wheel("locking disc", _DRIVER_HINGE, "driver_angle", 1, (*_mirrored(_RELIEF_POINTS), *_FAR_SIDE)),
    Bar("driver", _DRIVER_HINGE, "driver_angle", "pin_radius"),
    Disc("pin", "driver", "outline_pin_radius"),
    Hinge(_WHEEL_HINGE),
    Hinge(_DRIVER_HINGE),
)


def form(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """The polar points of the outlines, and the radius of the pin."""
    points = {**_wheel(values), **_disc(values)}
    return (
        Calculated("outline_pin_radius", values.pin_diameter / 2, "Drawing: radius of the pin", "m"),
        *(
            port
            for name, (radius, angle) in points.items()
            for port in (
                Calculated(_polar(name)[0], radius, f"Drawing: radius at which '{name}' lies", "m"),
                Calculated(_polar(name)[1], angle, f"Drawing: angle at which '{name}' lies", "rad", "deg"),
            )
        ),
    )


def _wheel(values: SimpleNamespace) -> dict[str, tuple[Number, Number]]:
    """Upper half of slot 0 and half of the locking arc beyond it: around the driver's hinge, seen half a pitch away."""
    geometry, c, half = geneva(values), values.centre_distance, values.pin_diameter / 2
    R, r, away = geometry.mouth_radius, geometry.locking_radius, geometry.pitch / 2
    inner = c - geometry.pin_radius
    opening = _opening(values)
    arc, inner_arc = _seen(c, r, 2 * opening / 3), _seen(c, r, opening / 3)
    return {
        "slot_end": (inner - half, 0.0),
        "slot_side": (sqrt(inner * inner + half * half), atan2(half, inner)),
        "mouth": (R, atan2(half, R)),
        "rim": (R, away - _seen(c, r, opening)[1]),
        "arc": (arc[0], away - arc[1]),
        "inner_arc": (inner_arc[0], away - inner_arc[1]),
        "arc_middle": (c - r, away),
    }


def _disc(values: SimpleNamespace) -> dict[str, tuple[Number, Number]]:
    """The locking disc on the side of the pin: cut away by the wheel's outer circle, full from phi_0 on."""
    geometry, c = geneva(values), values.centre_distance
    R, edge = geometry.mouth_radius, geometry.engagement
    s = c * sin(edge / 2)
    between = (edge + math.pi / 2) / 2
    return {
        "relief_bottom": (c - R, 0.0),
        "relief": (c * cos(edge / 2) - sqrt(R * R - s * s), edge / 2),
        "disc_edge": (geometry.locking_radius, edge),
        "disc": (geometry.locking_radius, between),
    }


def _opening(values: SimpleNamespace) -> Number:
    """Half the angle [rad] over which the locking arc surrounds the driver's hinge: out to the wheel's outer circle."""
    geometry, c = geneva(values), values.centre_distance
    a, r = geometry.pin_radius, geometry.locking_radius
    cosine = (a * a + r * r) / (2 * c * r)
    return angle_between(cosine)


def _seen(c: Number, r: Number, angle: Number) -> tuple[Number, Number]:
    """Polar place, seen from the wheel, of the point at `r` and `angle` around the driver's hinge at the distance c."""
    x, y = c - r * cos(angle), r * sin(angle)
    return sqrt(x * x + y * y), atan2(y, x)


INPUTS = (
    *ports.shaft_inputs(speed=2 * math.pi),
    ports.torque_input("drive", "driver", usual=(-0.5, 0.5)),
    ports.load_torque_input("wheel", usual=(-0.1, 0.1)),
)

#: What is known of an impact: of the driver on its backstop, for there is no other.
_IMPACT = (
    ports.speed_output("closing_speed", "closing_speed", "Speed at which the driver runs back, {impact}"),
    Output("impulse", "impulse", "Angular impulse, {impact}", "N.m.s", nominal=0.01),
    *ports.impact_speed_fields("driver", "wheel"),
    ports.whole_output("tooth", "tooth", "Tooth of the backstop, {impact}"),
)

OUTPUTS = (
    *ports.body_motion_outputs({"driver": "theta", "wheel": "psi"}),
    ports.force_output(
        "pin_force",
        "slot.force",
        "Force of the slot on the pin, across the slot; positive: it turns the wheel clockwise; 0 outside the slot",
        INPUTS,
    ),
    ports.torque_output(
        "locking_torque",
        "locking_arc.force",
        "Torque of the locking arc on the wheel, counter-clockwise positive; 0 while the pin is in a slot",
        INPUTS,
    ),
    ports.torque_output(
        "backstop_torque", "backstop.force", "Torque of the backstop on the driver, 0 when open", INPUTS
    ),
    ports.shaft_torque_output("driver"),
    ports.whole_output(
        "station",
        "slots.index",
        "Number of the slot that the pin is in, has left or comes to: it changes on the far side, forwards by +1",
    ),
    *ports.friction_outputs("slot", "the pin in the slot", INPUTS, "away from the wheel's hinge"),
    ports.active_output("slot", "The pin is in a slot and moves the wheel"),
    ports.active_output("locking_arc", "The locking arc holds the wheel"),
    ports.active_output("backstop", "The backstop holds the driver"),
    ports.whole_output("event_count", "event.count", "Events since the start: switched rows, changes of slot, impacts"),
    *ports.impact_outputs("Impacts of the driver on its backstop", _IMPACT),
    *ports.energy_outputs(
        kinetic="Kinetic energy of driver and wheel",
        spring="Energy of springs within the drive: none, 0",
        work="Work done by drive shaft, drive_torque and load_torque since the start",
        lost="Energy lost in impacts, friction and the damper since the start",
    ),
)

PARAMETERS = (
    Parameter("slot_count", 4, "Number of slots of the wheel (n)", "1", 3, 24, "Integer", usual=(3, 12)),
    ports.length_parameter("centre_distance", 0.1, "Distance between the hinges of wheel and driver (c)"),
    ports.length_parameter(
        "pin_diameter", 0.008, "Diameter of the pin; it matters for nothing but the form", minimum=1e-9
    ),
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
    ports.fraction_parameter("slot_friction", 0.0, "Coefficient of friction between pin and slot"),
    ports.joint_friction_parameter(),
    ports.flag_parameter("backstop", False, "Whether a ratchet on the driver's shaft keeps it from turning back"),
    Parameter("backstop_teeth", 12, "Teeth of the backstop's ratchet", "1", 1, 1000, "Integer"),
    ports.fraction_parameter("backstop_restitution", 0.0, "Coefficient of restitution of the backstop"),
    *ports.settings_parameters(),
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
