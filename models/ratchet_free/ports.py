"""Inputs, parameters and outputs of the free ratchet, most of them as of `models.ratchet`, and how it is drawn."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace

from mechanism_fmu.model import Bar, Calculated, Disc, Hinge, Output, Striker, Wheel, port_builders as ports
from mechanism_fmu.model.functions import Number, atan2, sqrt

from ..ratchet import ports as ratchet
from .start import TOOTH_COUNT, sharp_tooth

INPUTS = ratchet.INPUTS

#: Not of this ratchet: the tooth count belongs to the structure, and there is no guide; its links are not analysed.
_NOT_HERE = (
    "tooth_count",
    "guided",
    *("elastic_modulus", "pawl_width", "pawl_depth", "crank_width", "crank_depth"),
)
_STARTS = {"tooth_slope_angle": math.radians(95), "baumgarte_alpha": 0.0, "baumgarte_beta": 0.0}

PARAMETERS = (
    *(replace(one, start=_STARTS.get(one.name, one.start)) for one in ratchet.PARAMETERS if one.name not in _NOT_HERE),
    ports.length_parameter("nose_radius", 1e-3, "Radius of the pawl's nose; its middle is pawl_length from the pin"),
    ports.length_parameter("tooth_tip_radius", 0.5e-3, "Radius of the rounded tips of the teeth"),
)


# What the free ratchet reports of an impact: of a tooth, and of the holding pawl.

_CONTACTS = "0, 1: nose on a tooth, first and second place; 3: holding pawl"

_IMPACT = (
    ports.whole_output("contact", "contact", f"What struck ({_CONTACTS}): {{impact}}"),
    ports.whole_output("tooth", "tooth", "Tooth that was struck, counted counter-clockwise from 0: {impact}"),
    Output(
        "closing_speed", "closing_speed", "Normal closing speed (holding pawl: rad/s): {impact}", "m/s", nominal=0.1
    ),
    Output("impulse", "impulse", "Impulse (holding pawl: N.m.s): {impact}", "N.s", nominal=0.01),
    *ports.impact_speed_fields("wheel", "crank", "pawl", nominal=0.1),
)

OUTPUTS = (
    *ports.body_motion_outputs({"wheel": "psi", "crank": "phi", "pawl": "gamma"}),
    ports.force_output(
        "tooth_force", "tooth.force", "Normal force on the nose where it touches first, 0 when apart", INPUTS, 0.1
    ),
    ports.force_output(
        "second_tooth_force",
        "tooth_2.force",
        "Normal force on the nose where it touches at the same time: in the notch, it stands on slope and face",
        INPUTS,
        0.1,
    ),
    Output("tooth_gap", "tooth.gap", "Distance of the nose from the teeth; 0 when it touches", "m", nominal=0.01),
    ports.torque_output(
        "holding_pawl_torque", "holding_pawl.force", "Torque of the holding pawl on the wheel, 0 when open", INPUTS
    ),
    ports.shaft_torque_output("crank", nominal=0.01, shaft=ratchet.SHAFT),
    *ports.friction_outputs("tooth", "the nose where it touches first", INPUTS),
    ports.angle_output("latched_angle", "holding_pawl.latched", "Wheel angle below which the holding pawl holds"),
    ports.angle_output("lost_motion", "holding_pawl.gap", "How far the wheel stands beyond the latched angle"),
    ports.whole_output("clicks", "holding_pawl.clicks", "Teeth that the holding pawl has passed since the start"),
    ports.active_output("tooth", "The nose touches a tooth"),
    ports.active_output("tooth_2", "The nose touches at a second place: it stands in a notch"),
    ports.active_output("holding_pawl", "The holding pawl holds the wheel"),
    ports.whole_output("event_count", "event.count", "Events since the start: impacts, hand-overs, openings, clicks"),
    *ports.impact_outputs("Impacts", _IMPACT),
    *ports.energy_outputs(
        kinetic="Kinetic energy of all bodies",
        spring="Energy of the wheel's spring, without preload",
        work="Work done by inputs and pawl spring since the start",
        lost="Energy lost in impacts, friction and dampers since the start",
        nominal=1e-4,
    ),
)


# How it is drawn from its variables.

_WHEEL_HINGE, _CRANK_HINGE = (0.0, 0.0), ("hinge_distance", 0.0)

#: Of a tooth, clockwise from its root: both ends of the rounded tip, in polar coordinates from the root.
_TIP = ("outline_tip_1", "outline_tip_2")

SHAPES = (
    Wheel(
        "wheel",
        _WHEEL_HINGE,
        "wheel_angle",
        float(TOOTH_COUNT),
        (("wheel_inner_radius", 0.0), *((f"{name}_radius", f"{name}_angle") for name in _TIP)),
        clockwise=True,
    ),
    Bar("crank", _CRANK_HINGE, "crank_angle", "crank_length"),
    Bar("pawl", "crank", "pawl_angle", "pawl_length"),
    Disc("nose", "pawl", "nose_radius"),
    Hinge(_WHEEL_HINGE),
    Hinge(_CRANK_HINGE),
    Hinge("crank"),
    Striker("pawl"),
)


def calculated(
    values: SimpleNamespace, tip: tuple[tuple[Number, Number], tuple[Number, Number]]
) -> tuple[Calculated, ...]:
    """Sizes of the teeth, and what drawings need.

    Args:
        values: of the parameters.
        tip: both ends of the rounding of a tooth's tip, the one at the slope first, in the frame of the wheel [m].
    """
    tooth = sharp_tooth(values)
    lengths = {
        "tooth_slope_length": (tooth.slope_length, "Length of a tooth's slope, up to its sharp tip (L)"),
        "tooth_face_length": (tooth.face_length, "Length of a tooth's face, up to its sharp tip (F)"),
    }
    return (
        Calculated("tooth_pitch", tooth.pitch, "Angle between two teeth (theta)", "rad", "deg"),
        *(Calculated(name, length, description, "m") for name, (length, description) in lengths.items()),
        *(
            port
            for name, (x, y) in zip(_TIP, tip, strict=True)
            for port in (
                Calculated(f"{name}_radius", sqrt(x * x + y * y), "Drawing: radius of an end of the tip", "m"),
                Calculated(f"{name}_angle", atan2(y, x), "Drawing: angle of an end of the tip", "rad", "deg"),
            )
        ),
    )
