"""Inputs, outputs and parameters of the ratchet."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

from mechanism_fmu.model import EVENT_BUFFER_LENGTH, IMPACT_BUFFER_LENGTH, Calculated, Input, Output, Parameter
from mechanism_fmu.model.functions import atan2, sqrt

from .start import tooth

INPUTS = (
    Input(
        "drive_torque",
        "drive.torque",
        1e-3,
        "Torque on the crank, counter-clockwise positive",
        "N.m",
        -1e6,
        1e6,
    ),
    Input(
        "spring_preload",
        "spring.preload",
        0.0,
        "Preload of the wheel's torsion spring: constant torque that opposes positive wheel rotation",
        "N.m",
        -1e6,
        1e6,
    ),
    Input(
        "load_torque",
        "load.torque",
        0.0,
        "External torque on the wheel, counter-clockwise positive",
        "N.m",
        -1e6,
        1e6,
    ),
    Input(
        "drive_angle",
        "shaft.angle",
        math.radians(77),
        "Angle of the driven end of the compliant drive shaft (it acts when drive_stiffness > 0)",
        "rad",
        -1e6,
        1e6,
        "deg",
    ),
    Input(
        "drive_speed",
        "shaft.speed",
        0.0,
        "Speed of the driven end of the compliant drive shaft (it acts when drive_damping > 0)",
        "rad/s",
        -1e6,
        1e6,
        "rpm",
    ),
)
_ALL_INPUTS = tuple(port.name for port in INPUTS)


def _closed(name: str, contact: str, description: str) -> Output:
    return Output(f"{name}_active", f"{contact}.closed", description, type="Boolean")


def _angle(name: str, body: str, symbol: str) -> Output:
    return Output(
        name,
        f"{body}.angle",
        f"Absolute angle of the {body} ({symbol}), unwrapped",
        "rad",
        "deg",
        nominal=1.0,
    )


def _speed(name: str, source: str, description: str) -> Output:
    return Output(name, source, description, "rad/s", "rpm", nominal=0.1)


_CONTACTS = "Struck contact (0 slope, 1 face, 2 holding pawl)"


def _buffered_impact(k: int) -> tuple[Output, ...]:
    prefix, of = f"impacts[{k}]", f"of impact {k} of the last communication step"
    return (
        Output(f"{prefix}.time", f"{prefix}.time", f"Time {of}", "s"),
        Output(
            f"{prefix}.velocity",
            f"{prefix}.velocity",
            f"Stress-recovery velocity v_I {of}",
            "m/s",
            nominal=1e-3,
        ),
        Output(
            f"{prefix}.closing_speed",
            f"{prefix}.closing_speed",
            f"Normal closing speed {of}",
            "m/s",
            nominal=0.1,
        ),
        Output(
            f"{prefix}.impulse",
            f"{prefix}.impulse",
            f"Impulse on the struck contact {of} (holding pawl: N.m.s)",
            "N.s",
            nominal=0.01,
        ),
        _speed(f"{prefix}.wheel_speed", f"{prefix}.speed:wheel", f"Wheel speed just after {of[3:]}"),
        Output(f"{prefix}.tooth", f"{prefix}.tooth", f"Index of the tooth struck {of}", type="Integer"),
        Output(f"{prefix}.contact", f"{prefix}.contact", f"{_CONTACTS} {of}", type="Integer"),
    )


_GUARDS = "0 gap closed, 1 force gone, 2 next tooth, 3 previous tooth, 4 click, 6 inputs changed"
_MODE = "sum of 1 slope, 2 face, 4 holding pawl"


def _buffered_event(k: int) -> tuple[Output, ...]:
    """An event of the last communication step."""
    prefix, of = f"events[{k}]", f"of event {k} of the last communication step"

    def whole(field: str, what: str) -> Output:
        return Output(f"{prefix}.{field}", f"{prefix}.{field}", what, type="Integer")

    return (
        Output(f"{prefix}.time", f"{prefix}.time", f"Time {of}; -1 when there was none", "s"),
        whole("guard", f"What fired ({_GUARDS}; -1 none) {of}"),
        whole("subject", f"Number of the contact {_CONTACTS.removeprefix('Struck contact ')}, or 0 the teeth, {of}"),
        whole("old_mode", f"Closed contacts ({_MODE}) before {of[3:]}"),
        whole("new_mode", f"Closed contacts ({_MODE}) after {of[3:]}"),
        Output(
            f"{prefix}.impulse",
            f"{prefix}.impulse",
            f"Impulse of the contacts that struck {of} (of the holding pawl in N.m.s)",
            "N.s",
            nominal=0.01,
        ),
    )


OUTPUTS = (
    _angle("wheel_angle", "wheel", "psi"),
    _angle("crank_angle", "crank", "phi"),
    _angle("pawl_angle", "pawl", "gamma"),
    _speed("wheel_speed", "wheel.speed", "Rate of wheel_angle (omega)"),
    _speed("crank_speed", "crank.speed", "Rate of crank_angle"),
    _speed("pawl_speed", "pawl.speed", "Rate of pawl_angle"),
    Output(
        "contact_force",
        "face.force",
        "Normal force of the pawl on the tooth face, 0 when open",
        "N",
        nominal=0.1,
        feedthrough=_ALL_INPUTS,
    ),
    Output(
        "slope_force",
        "slope.force",
        "Normal force of the pawl on the tooth slope, 0 when open",
        "N",
        nominal=0.1,
        feedthrough=_ALL_INPUTS,
    ),
    Output(
        "holding_pawl_torque",
        "holding_pawl.force",
        "Torque of the holding pawl on the wheel, 0 when open",
        "N.m",
        nominal=0.01,
        feedthrough=_ALL_INPUTS,
    ),
    Output(
        "drive_shaft_torque",
        "shaft.torque",
        "Torque of the compliant drive shaft on the crank, added to drive_torque",
        "N.m",
        nominal=0.01,
        feedthrough=("drive_angle", "drive_speed"),
    ),
    Output("face_gap", "face.gap", "Distance of the pawl's tip from the tooth face", "m", nominal=0.01),
    Output("slope_gap", "slope.gap", "Distance of the pawl's tip from the tooth slope", "m", nominal=0.01),
    Output(
        "tooth_index", "teeth.index", "Index of the tooth at which the pawl stands, counted forwards", type="Integer"
    ),
    Output(
        "latched_angle",
        "holding_pawl.latched",
        "Wheel angle below which the holding pawl holds",
        "rad",
        "deg",
        nominal=1.0,
    ),
    Output("clicks", "holding_pawl.clicks", "Teeth that the holding pawl has passed since the start", type="Integer"),
    _closed("slope", "slope", "The pawl's tip slides on the tooth slope"),
    _closed("face", "face", "The pawl's tip stands on the tooth face"),
    _closed("holding_pawl", "holding_pawl", "The holding pawl holds the wheel"),
    Output(
        "event_count",
        "event.count",
        "Events since the start: impacts, openings, clicks, changes of tooth",
        type="Integer",
    ),
    Output("impact_count", "impact.count", "Impacts since the start", type="Integer"),
    Output("impact", "impact.any", "At least one impact in the last communication step", type="Boolean"),
    Output("impact_time", "impact.time", "Time of the last impact; -1 before the first", "s"),
    Output(
        "impact_velocity",
        "impact.velocity",
        "v_I of the stress recovery for the last impact: impact_wheel_speed times tooth_length",
        "m/s",
        nominal=1e-3,
    ),
    Output(
        "impact_closing_speed",
        "impact.closing_speed",
        "Normal closing speed just before the last impact",
        "m/s",
        nominal=0.1,
    ),
    Output(
        "impact_impulse",
        "impact.impulse",
        "Impulse on the struck contact at the last impact",
        "N.s",
        nominal=0.01,
    ),
    Output(
        "impact_slope_impulse",
        "impact.impulse:slope",
        "Impulse on the tooth slope at the last impact",
        "N.s",
        nominal=0.01,
    ),
    _speed("impact_wheel_speed", "impact.speed:wheel", "Wheel speed just after the last impact"),
    _speed("impact_crank_speed", "impact.speed:crank", "Crank speed just after the last impact"),
    _speed("impact_pawl_speed", "impact.speed:pawl", "Pawl speed just after the last impact"),
    _speed("impact_wheel_speed_before", "impact.speed_before:wheel", "Wheel speed just before the last impact"),
    _speed("impact_crank_speed_before", "impact.speed_before:crank", "Crank speed just before the last impact"),
    _speed("impact_pawl_speed_before", "impact.speed_before:pawl", "Pawl speed just before the last impact"),
    Output(
        "impact_tooth",
        "impact.tooth",
        "Index of the tooth struck at the last impact; -1 before the first",
        type="Integer",
    ),
    Output("impact_contact", "impact.contact", f"{_CONTACTS} at the last impact; -1 before the first", type="Integer"),
    Output(
        "impacts_in_step",
        "impact.in_step",
        f"Impacts of the last communication step held in impacts[1..{IMPACT_BUFFER_LENGTH}]",
        type="Integer",
    ),
    Output(
        "impacts_lost",
        "impact.lost",
        f"Impacts since the start that did not fit into impacts[1..{IMPACT_BUFFER_LENGTH}]",
        type="Integer",
    ),
    *(output for k in range(1, IMPACT_BUFFER_LENGTH + 1) for output in _buffered_impact(k)),
    Output(
        "events_in_step",
        "event.in_step",
        f"Events of the last communication step held in events[1..{EVENT_BUFFER_LENGTH}]",
        type="Integer",
    ),
    *(output for k in range(1, EVENT_BUFFER_LENGTH + 1) for output in _buffered_event(k)),
    Output("kinetic_energy", "energy.kinetic", "Kinetic energy of all bodies", "J", nominal=1e-4),
    Output("spring_energy", "energy.spring", "Energy of the wheel's spring, without preload", "J", nominal=1e-4),
    Output("work_done", "energy.work", "Work done by inputs and pawl spring since the start", "J", nominal=1e-4),
    Output(
        "energy_lost", "energy.lost", "Energy lost in impacts, friction and dampers since the start", "J", nominal=1e-4
    ),
)


def _length(name: str, start: float, description: str) -> Parameter:
    return Parameter(name, start, description, "m", 1e-6, 1e3)


def _mass(name: str, start: float, description: str) -> Parameter:
    return Parameter(name, start, description, "kg", 1e-12, 1e6)


def _inertia(name: str, start: float, description: str) -> Parameter:
    return Parameter(name, start, f"{description} about its centre of mass", "kg.m2", 1e-12, 1e6)


def _start_angle(name: str, degrees: float, description: str) -> Parameter:
    return Parameter(name, math.radians(degrees), description, "rad", -1e3, 1e3, display_unit="deg")


PARAMETERS = (
    Parameter("tooth_count", 10, "Number of teeth of the wheel (nt)", "1", 3, 1000, "Integer"),
    Parameter(
        "tooth_slope_angle",
        math.radians(90),
        "Angle between the slope of a tooth and the radius at its root (beta_0)",
        "rad",
        math.radians(30),
        math.radians(150),
        display_unit="deg",
    ),
    _length("hinge_distance", 0.130, "Distance between the fixed hinges of wheel and crank (d)"),
    _length("crank_length", 0.110, "Length of the crank (a)"),
    _length("pawl_length", 0.100, "Length of the pawl, the paper's follower (b)"),
    _length("wheel_inner_radius", 0.100, "Radius of the tooth roots (r)"),
    Parameter("slope_ratio", 1.115, "Slope length over distance between two roots (c_prop)", "1", 1e-3, 1e3),
    _mass("crank_mass", 0.1000, "Mass of the crank"),
    _inertia("crank_inertia", 0.0900e-3, "Moment of inertia of the crank"),
    _mass("pawl_mass", 0.0976, "Mass of the pawl"),
    _inertia("pawl_inertia", 0.0853e-3, "Moment of inertia of the pawl"),
    _mass("wheel_mass", 5.6264, "Mass of the wheel"),
    _inertia("wheel_inertia", 32.7948e-3, "Moment of inertia of the wheel"),
    Parameter("spring_stiffness", 15e-3, "Stiffness of the wheel's torsion spring", "N.m/rad", 0.0, 1e6),
    _start_angle("spring_free_angle", 75, "Wheel angle at which the torsion spring is relaxed"),
    Parameter(
        "restitution", 0.0, "Coefficient of restitution between pawl and tooth, face and slope (e)", "1", 0.0, 1.0
    ),
    _start_angle("crank_angle_start", 77, "Crank angle at the start (phi)"),
    _start_angle("wheel_angle_start", 75, "Wheel angle at the start (psi)"),
    Parameter("baumgarte_alpha", 10.0, "Baumgarte gain on the rates of the constraints", "1/s", 0.0, 1e4),
    Parameter("baumgarte_beta", 1.0, "Baumgarte gain on the constraints, squared in use", "1/s", 0.0, 1e4),
    Parameter("relative_tolerance", 1e-9, "Relative tolerance of the integration", "1", 1e-13, 1e-3),
    Parameter(
        "guided",
        1.0,
        "Whether the slope of one tooth guides the pawl's tip, as in the paper; false: a free pawl on all teeth",
        type="Boolean",
    ),
    Parameter(
        "holding_pawl", 1.0, "Whether a holding pawl keeps the wheel from turning back (free pawl)", type="Boolean"
    ),
    Parameter(
        "holding_pawl_restitution", 0.0, "Coefficient of restitution between holding pawl and wheel", "1", 0.0, 1.0
    ),
    Parameter(
        "pawl_angle_start",
        0.0,
        "Pawl angle at the start (gamma) of a free pawl; 0: solved, so that the tip rests on the teeth",
        "rad",
        -1e3,
        1e3,
        display_unit="deg",
    ),
    Parameter(
        "pawl_spring_torque", 0.0, "Torque of the pawl's spring, counter-clockwise on the pawl", "N.m", -1e6, 1e6
    ),
    Parameter("wheel_damping", 0.0, "Damping of the wheel's rotation", "N.m.s/rad", 0.0, 1e6),
    Parameter("drive_stiffness", 0.0, "Stiffness of the compliant drive shaft", "N.m/rad", 0.0, 1e9),
    Parameter("drive_damping", 0.0, "Damping of the compliant drive shaft", "N.m.s/rad", 0.0, 1e9),
    Parameter("friction", 0.0, "Coefficient of friction between pawl and teeth", "1", 0.0, 10.0),
    Parameter("joint_friction_radius", 0.0, "Coefficient of friction times pin radius, of every hinge", "m", 0.0, 1.0),
)


def calculated(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """The tooth geometry that stress recovery and drawings need."""
    geometry = tooth(values)
    x, y = geometry.apex
    lengths: tuple[tuple[str, Any, str], ...] = (
        ("tooth_length", geometry.beam_length, "Length of a tooth as a beam (l)"),
        ("tooth_slope_length", geometry.slope_length, "Length of a tooth's slope (L)"),
        ("tooth_face_length", geometry.face_length, "Length of a tooth's face (F)"),
        ("tooth_apex_radius", sqrt(x * x + y * y), "Distance of a tooth's apex from the wheel's hinge"),
    )
    return (
        Calculated("tooth_pitch", geometry.pitch, "Angle between two teeth (theta)", "rad", "deg"),
        Calculated("tooth_apex_angle", geometry.apex_angle, "Angle at a tooth's apex (alpha)", "rad", "deg"),
        Calculated(
            "tooth_apex_offset",
            atan2(y, x),
            "Angle from a tooth's root to its apex, seen from the wheel's hinge; clockwise negative",
            "rad",
            "deg",
        ),
        *(Calculated(name, length, description, "m") for name, length, description in lengths),
    )
