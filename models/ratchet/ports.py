"""Inputs, parameters and outputs of the ratchet, impacts and events among them."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

from mechanism_fmu.model import Calculated, Input, Output, Parameter, port_builders as ports
from mechanism_fmu.model.functions import atan2, cos, sin, sqrt

from .start import locking_friction, tooth

# Inputs of the ratchet.

#: What the descriptions call the shaft.
SHAFT = "compliant drive shaft"

_speed, _angle = ports.shaft_inputs(speed=0.0, angle=math.radians(77), shaft=SHAFT)

INPUTS = (
    ports.torque_input("drive", "crank", 1e-3, usual=(0.0, 5e-3)),
    Input(
        "spring_preload",
        "spring.preload",
        0.0,
        "Preload of the wheel's torsion spring: constant torque that opposes positive wheel rotation",
        "N.m",
        -1e6,
        1e6,
        usual=(0.0, 1e-2),
    ),
    ports.load_torque_input("wheel", usual=(-1e-2, 1e-2)),
    _angle,
    _speed,
)


# Parameters of the ratchet, and what follows from them.

#: The wheel whose mass is that of Table 2: steel [kg/m3], thickness and radius of the bore [m].
_DENSITY, _THICKNESS, _BORE = 7850.0, 0.02, 6.5e-3

PARAMETERS = (
    Parameter("tooth_count", 10, "Number of teeth of the wheel (nt)", "1", 3, 1000, "Integer", usual=(6, 30)),
    ports.angle_parameter(
        "tooth_slope_angle",
        math.radians(90),
        "Angle between the slope of a tooth and the radius at its root (beta_0)",
        math.radians(30),
        math.radians(150),
        usual=(math.radians(70), math.radians(110)),
    ),
    ports.length_parameter("hinge_distance", 0.130, "Distance between the fixed hinges of wheel and crank (d)"),
    ports.length_parameter("crank_length", 0.110, "Length of the crank (a)"),
    ports.length_parameter("pawl_length", 0.100, "Length of the pawl, the paper's follower (b)"),
    ports.length_parameter("wheel_inner_radius", 0.100, "Radius of the tooth roots (r)"),
    Parameter("slope_ratio", 1.115, "Slope length over distance between two roots (c_prop)", "1", 1e-3, 1e3),
    *ports.body_parameters("crank", 0.1000, 0.0900e-3),
    *ports.body_parameters("pawl", 0.0976, 0.0853e-3),
    *ports.body_parameters("wheel", 5.6264, 32.7948e-3),
    ports.stiffness_parameter("spring_stiffness", 15e-3, "Stiffness of the wheel's torsion spring"),
    ports.angle_parameter("spring_free_angle", math.radians(75), "Wheel angle at which the torsion spring is relaxed"),
    ports.fraction_parameter(
        "restitution", 0.0, "Coefficient of restitution between pawl and tooth, face and slope (e)"
    ),
    ports.angle_parameter("crank_angle_start", math.radians(77), "Crank angle at the start (phi)"),
    ports.angle_parameter("wheel_angle_start", math.radians(75), "Wheel angle at the start (psi)"),
    *ports.settings_parameters(alpha=10.0, beta=1.0),
    ports.flag_parameter(
        "guided",
        True,
        "Whether the slope of one tooth guides the pawl's tip, as in the paper; false: a free pawl on all teeth",
    ),
    ports.flag_parameter("holding_pawl", True, "Whether a holding pawl keeps the wheel from turning back (free pawl)"),
    ports.fraction_parameter(
        "holding_pawl_restitution", 0.0, "Coefficient of restitution between holding pawl and wheel"
    ),
    ports.angle_parameter(
        "pawl_angle_start",
        0.0,
        "Pawl angle at the start (gamma) of a free pawl; 0: solved, so that the tip rests on the teeth",
    ),
    ports.torque_parameter(
        "pawl_spring_torque", 0.0, "Torque of the pawl's spring, counter-clockwise on the pawl", usual=(0.0, 0.02)
    ),
    ports.damping_parameter("wheel", usual=(0.0, 0.5)),
    Parameter("drive_stiffness", 0.0, f"Stiffness of the {SHAFT}", "N.m/rad", 0.0, 1e9, usual=(0.0, 10.0)),
    Parameter("drive_damping", 0.0, f"Damping of the {SHAFT}", "N.m.s/rad", 0.0, 1e9, usual=(0.0, 0.5)),
    Parameter("friction", 0.0, "Coefficient of friction between pawl and teeth", "1", 0.0, 10.0),
    ports.joint_friction_parameter("every hinge"),
    Parameter("elastic_modulus", 2.06e11, "Modulus of elasticity of pawl and crank (E)", "Pa", 1.0, 1e15),
    ports.length_parameter("pawl_width", 5.6e-3, "Width of the pawl's section, along the axis of its hinge"),
    ports.length_parameter(
        "pawl_depth", 22e-3, "Depth of the pawl's section, in the plane of the motion and across the pawl"
    ),
    ports.length_parameter("crank_width", 5.6e-3, "Width of the crank's section, along the axis of its hinge"),
    ports.length_parameter(
        "crank_depth", 22e-3, "Depth of the crank's section, in the plane of the motion and across the crank"
    ),
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
        *_solid_wheel(values),
        *_stiffnesses(values),
        Calculated(
            "self_locking_friction",
            locking_friction(values),
            "Coefficient of friction from which on the pawl does not slide down the slope, as it stands at the start",
        ),
        Calculated(
            "tooth_slenderness",
            cos(geometry.apex_angle) / sin(geometry.apex_angle),
            "Length over root height of a tooth as a beam; beam theory wants 5 or more",
        ),
    )


def _stiffnesses(values: SimpleNamespace) -> tuple[Calculated, Calculated]:
    """Of the crank as a cantilever, 3 E I / a^3, and of the pawl along it, E A / b."""
    crank, a = (
        values.crank_width * values.crank_depth * values.crank_depth * values.crank_depth / 12,
        values.crank_length,
    )
    pawl = values.pawl_width * values.pawl_depth
    return (
        Calculated(
            "crank_stiffness",
            3 * values.elastic_modulus * crank / (a * a * a),
            "Stiffness of the crank across it, as a cantilever from its hinge to its pin",
            "N/m",
        ),
        Calculated(
            "pawl_stiffness",
            values.elastic_modulus * pawl / values.pawl_length,
            "Stiffness of the pawl along it",
            "N/m",
        ),
    )


def _solid_wheel(values: SimpleNamespace) -> tuple[Calculated, Calculated]:
    """Mass and inertia of a wheel of one piece: a sum over the triangles from the hinge to slope and face of a tooth.

    Its inertia is rho b A / 6 (p.p + p.q + q.q) for a triangle of area A with the corners 0, p, q.
    """
    geometry, r = tooth(values), values.wheel_inner_radius
    x, y = geometry.apex
    next_x, next_y = r * cos(geometry.pitch), -r * sin(geometry.pitch)
    areas, seconds = [], []
    for (px, py), (qx, qy) in (((r, 0.0), (x, y)), ((x, y), (next_x, next_y))):
        area = (py * qx - px * qy) / 2  # the teeth follow each other clockwise
        areas.append(area)
        seconds.append(area / 6 * (px * px + py * py + px * qx + py * qy + qx * qx + qy * qy))
    bore = math.pi * _BORE * _BORE
    each = _DENSITY * _THICKNESS
    what = "solid steel wheel with these teeth (7850 kg/m3, 0.02 m thick, bore of 6.5 mm radius)"
    return (
        Calculated("solid_wheel_mass", each * (values.tooth_count * sum(areas) - bore), f"Mass of a {what}", "kg"),
        Calculated(
            "solid_wheel_inertia",
            each * (values.tooth_count * sum(seconds) - bore * _BORE * _BORE / 2),
            f"Moment of inertia of a {what}, about its hinge",
            "kg.m2",
        ),
    )


# What the ratchet reports of an impact and of an event, as fields of `mechanism_fmu.model.port_builders`.

_NUMBERS = "(0 slope, 1 face, 2 holding pawl)"
_CONTACTS = f"Struck contact {_NUMBERS}"
_GUARDS = "0 gap closed, 1 force gone, 2 next tooth, 3 previous tooth, 4 click, 6 inputs changed"
_MODE = "sum of 1 slope, 2 face, 4 holding pawl"


_SPEEDS = ports.impact_speed_fields("wheel", "crank", "pawl", nominal=0.1)
_VELOCITY = "v_I of the stress recovery, tooth_length times the jump of the wheel's speed"


#: Of the last impact. What all impacts of one instant share stands behind what is the contact's own.
LAST_IMPACT = (
    ports.whole_output("tooth", "tooth", "Index of the tooth struck at the {impact}; -1 before the first"),
    ports.whole_output("contact", "contact", f"{_CONTACTS} at the {{impact}}; -1 before the first"),
    Output(
        "closing_speed",
        "closing_speed",
        "Normal closing speed just before the {impact} (holding pawl: rad/s)",
        "m/s",
        nominal=0.1,
    ),
    Output(
        "impulse", "impulse", "Impulse on the struck contact at the {impact} (holding pawl: N.m.s)", "N.s", nominal=0.01
    ),
    Output("slope_impulse", "impulse:slope", "Impulse on the tooth slope at the {impact}", "N.s", nominal=0.01),
    Output("energy_lost", "energy_lost", "Energy lost at the instant of the {impact}", "J", nominal=1e-4),
    *_SPEEDS,
    Output("velocity", "velocity", f"{_VELOCITY} at the {{impact}}", "m/s", nominal=1e-3),
)

#: Of each impact of the last communication step.
IMPACT = (
    Output("time", "time", "Time of {impact}", "s"),
    ports.whole_output("instant", "instant", "Number of the instant (the same for all its impacts): {impact}"),
    ports.whole_output("tooth", "tooth", "Index of the tooth struck: {impact}"),
    ports.whole_output("contact", "contact", f"{_CONTACTS}: {{impact}}"),
    Output(
        "closing_speed", "closing_speed", "Normal closing speed of {impact} (holding pawl: rad/s)", "m/s", nominal=0.1
    ),
    Output(
        "impulse",
        "impulse",
        "Impulse on the struck contact of {impact} (holding pawl: N.m.s)",
        "N.s",
        nominal=0.01,
    ),
    Output("energy_lost", "energy_lost", "Energy lost at the instant of {impact}", "J", nominal=1e-4),
    *_SPEEDS,
    Output("velocity", "velocity", f"{_VELOCITY} at the instant of {{impact}}", "m/s", nominal=1e-3),
)

#: Of each event of the last communication step.
EVENT = (
    Output("time", "time", "Time of {event}; -1 when there was none", "s"),
    ports.whole_output("guard", "guard", f"What fired ({_GUARDS}; -1 none) of {{event}}"),
    ports.whole_output("subject", "subject", f"Number of the contact {_NUMBERS}, or 0 the teeth, of {{event}}"),
    ports.whole_output("old_mode", "old_mode", f"Closed contacts ({_MODE}) before {{event}}"),
    ports.whole_output("new_mode", "new_mode", f"Closed contacts ({_MODE}) after {{event}}"),
    Output(
        "impulse",
        "impulse",
        "Impulse of the contacts that struck of {event} (of the holding pawl in N.m.s)",
        "N.s",
        nominal=0.01,
    ),
)


# Outputs of the ratchet.

OUTPUTS = (
    ports.body_angle_output("wheel", "psi"),
    ports.body_angle_output("crank", "phi"),
    ports.body_angle_output("pawl", "gamma"),
    ports.body_speed_output("wheel", "omega", nominal=0.1),
    ports.body_speed_output("crank", nominal=0.1),
    ports.body_speed_output("pawl", nominal=0.1),
    ports.force_output(
        "contact_force", "face.force", "Normal force of the pawl on the tooth face, 0 when open", INPUTS, nominal=0.1
    ),
    ports.force_output(
        "slope_force", "slope.force", "Normal force of the pawl on the tooth slope, 0 when open", INPUTS, nominal=0.1
    ),
    ports.torque_output(
        "holding_pawl_torque",
        "holding_pawl.force",
        "Torque of the holding pawl on the wheel, 0 when open",
        INPUTS,
        nominal=0.01,
    ),
    ports.shaft_torque_output("crank", nominal=0.01, shaft=SHAFT),
    Output("face_gap", "face.gap", "Distance of the pawl's tip from the tooth face", "m", nominal=0.01),
    Output("slope_gap", "slope.gap", "Distance of the pawl's tip from the tooth slope", "m", nominal=0.01),
    *ports.friction_outputs("slope", "the pawl's tip on the tooth slope", INPUTS, "away from the root"),
    *ports.friction_outputs("face", "the pawl's tip on the tooth face", INPUTS, "towards the root"),
    ports.whole_output("tooth_index", "teeth.index", "Index of the tooth at which the pawl stands, counted forwards"),
    ports.angle_output("latched_angle", "holding_pawl.latched", "Wheel angle below which the holding pawl holds"),
    ports.angle_output(
        "lost_motion",
        "holding_pawl.gap",
        "How far the wheel stands beyond the latched angle: what it goes back when the pawl leaves it",
    ),
    ports.whole_output("clicks", "holding_pawl.clicks", "Teeth that the holding pawl has passed since the start"),
    ports.active_output("slope", "The pawl's tip slides on the tooth slope"),
    ports.active_output("face", "The pawl's tip stands on the tooth face"),
    ports.active_output("holding_pawl", "The holding pawl holds the wheel"),
    ports.whole_output(
        "event_count", "event.count", "Events since the start: impacts, openings, clicks, changes of tooth"
    ),
    *ports.last_impact_outputs("Impacts", LAST_IMPACT),
    *ports.impact_buffer_outputs(IMPACT),
    *ports.event_buffer_outputs(EVENT),
    *ports.energy_outputs(
        kinetic="Kinetic energy of all bodies",
        spring="Energy of the wheel's spring, without preload",
        work="Work done by inputs and pawl spring since the start",
        lost="Energy lost in impacts, friction and dampers since the start",
        nominal=1e-4,
    ),
    *ports.hinged_beam_outputs("pawl", "pawl_beam", "pawl", INPUTS, deflection=1e-9, stress=1e3),
)
