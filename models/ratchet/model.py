"""The ratchet of Pennestrì, Valentini and Vita: guided along the slope of one tooth, or free on the whole wheel.

Frame: the wheel's hinge at the origin, the crank's hinge at (d, 0). The wheel's x axis passes through the
root of the tooth that is struck, so that its angle is psi. Equations and sources: README.md beside this file.
"""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    AngleStop,
    Arm,
    Bar,
    Body,
    CircularPattern,
    CompliantShaft,
    Contact,
    Damper,
    Hinge,
    ImpactStress,
    Mechanism,
    Member,
    Model,
    PointLineContact,
    Revolute,
    SawtoothWheel,
    Section,
    SeriesCompliance,
    Striker,
    Strut,
    Torque,
    TorsionSpring,
    WedgeTooth,
    Wheel,
)
from mechanism_fmu.model.body import Point, rotor_body
from mechanism_fmu.model.functions import Number, cos, sin

from .cases import CASES
from .ports import INPUTS, OUTPUTS, PARAMETERS, calculated
from .start import crank_pin, objections, pawl_angle, starts_on_slope, tooth, warnings

# How the ratchet is drawn from its variables: wheel, crank, pawl, hinges.

_WHEEL_HINGE, _CRANK_HINGE = (0.0, 0.0), ("hinge_distance", 0.0)

#: The wheel's x axis passes through the root that is struck; from a root the slope runs clockwise to its apex.
SHAPES = (
    Wheel(
        "wheel",
        _WHEEL_HINGE,
        "wheel_angle",
        "tooth_count",
        (("wheel_inner_radius", 0.0), ("tooth_apex_radius", "tooth_apex_offset")),
        clockwise=True,
    ),
    Bar("crank", _CRANK_HINGE, "crank_angle", "crank_length"),
    Bar("pawl", "crank", "pawl_angle", "pawl_length"),
    Hinge(_WHEEL_HINGE),
    Hinge(_CRANK_HINGE),
    Hinge("crank"),
    Striker("pawl"),
)


# What can be analysed of the ratchet: the stress in its teeth, and how far crank and pawl give way.

ANALYSIS = (
    ImpactStress(
        "face",
        WedgeTooth("tooth_length", "tooth_apex_angle"),
        "tooth",
        "teeth",
        slenderness="tooth_slenderness",
        strokes="clicks",
    ),
    SeriesCompliance(
        "face",
        Arm("crank", "crank_length", "crank_width", "crank_depth", "crank_stiffness", angle="crank_angle"),
        Strut(
            *("pawl", "pawl_length", "pawl_width", "pawl_depth", "pawl_stiffness"),
            angle="pawl_angle",
            deflection="pawl_tip_deflection",
            stress="pawl_bending_stress",
        ),
        SawtoothWheel(
            "wheel",
            "tooth",
            radius="wheel_inner_radius",
            pitch="tooth_pitch",
            slope_angle="tooth_slope_angle",
            apex_angle="tooth_apex_angle",
            angle="wheel_angle",
            index="tooth_index",
            struck="tooth",
            slope_force="slope_force",
            face_force="contact_force",
        ),
        restitution="restitution",
        source="models/ratchet/README.md",
    ),
)


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The ratchet for parameter values that raise no objection."""
    rubbing = values.joint_friction_radius
    crank, pawl = members = _members(values)
    return Mechanism(
        bodies=_bodies(values),
        joints=(
            Revolute("crank_hinge", "crank", crank.start, GROUND, (values.hinge_distance, 0.0), rubbing),
            Revolute("pin", "pawl", pawl.start, "crank", crank.end, rubbing),
            Revolute("wheel_hinge", "wheel", (0.0, 0.0), GROUND, (0.0, 0.0), rubbing),
        ),
        forces=(
            Torque("drive", "crank"),
            Torque("load", "wheel"),
            TorsionSpring(
                "spring",
                "wheel",
                stiffness=values.spring_stiffness,
                free_angle=values.spring_free_angle,
            ),
            CompliantShaft("shaft", "crank", stiffness=values.drive_stiffness, damping=values.drive_damping),
            Torque("pawl_spring", "pawl", "crank", torque=values.pawl_spring_torque),
            Damper("wheel_damper", "wheel", damping=values.wheel_damping),
        ),
        contacts=_contacts(values, pawl.end),
        patterns=(_teeth(values),),
        held=("crank.angle", "wheel.angle"),
        members=members,
    )


def _bodies(values: SimpleNamespace) -> tuple[Body, ...]:
    pin, phi, gamma = crank_pin(values), values.crank_angle_start, pawl_angle(values)
    half_crank, half_pawl = values.crank_length / 2, values.pawl_length / 2
    return (
        Body(
            "crank",
            values.crank_mass,
            values.crank_inertia,
            (values.hinge_distance + half_crank * cos(phi), half_crank * sin(phi), phi),
        ),
        Body(
            "pawl",
            values.pawl_mass,
            values.pawl_inertia,
            (pin.x + half_pawl * cos(gamma), pin.y + half_pawl * sin(gamma), gamma),
        ),
        replace(
            rotor_body(values, "wheel", (0.0, 0.0), values.wheel_angle_start), tooth_length=tooth(values).beam_length
        ),
    )


def _members(values: SimpleNamespace) -> tuple[Member, Member]:
    """Crank and pawl as bars from hinge to hinge and tip, of as much mass as the bodies."""
    half_crank, half_pawl = values.crank_length / 2, values.pawl_length / 2
    crank = Section.rectangle(values.crank_width, values.crank_depth)
    pawl = Section.rectangle(values.pawl_width, values.pawl_depth)
    return (
        Member(
            "crank_beam",
            "crank",
            (-half_crank, 0.0),
            (half_crank, 0.0),
            crank,
            values.elastic_modulus,
            values.crank_mass / (crank.area * values.crank_length),
        ),
        Member(
            "pawl_beam",
            "pawl",
            (-half_pawl, 0.0),
            (half_pawl, 0.0),
            pawl,
            values.elastic_modulus,
            values.pawl_mass / (pawl.area * values.pawl_length),
        ),
    )


def _contacts(values: SimpleNamespace, tip: Point) -> tuple[Contact, ...]:
    geometry = tooth(values)
    root = (values.wheel_inner_radius, 0.0)
    free = 1 - values.guided

    def flank(name: str, normal: Point, closed: Number = False) -> PointLineContact:
        return PointLineContact(
            name,
            "pawl",
            tip,
            "wheel",
            root,
            normal,
            closed=closed,
            restitution=values.restitution,
            friction=values.friction,
            guided=values.guided,
            pattern="teeth",
        )

    return (
        flank("slope", geometry.slope_normal, starts_on_slope(values)),
        flank("face", geometry.face_normal),
        AngleStop(
            "holding_pawl",
            "wheel",
            GROUND,
            values.wheel_angle_start,
            geometry.pitch,
            restitution=values.holding_pawl_restitution,
            enabled=free * values.holding_pawl,
        ),
    )


def _teeth(values: SimpleNamespace) -> CircularPattern:
    """The teeth, counted clockwise: as the wheel turns forwards, the pawl comes to teeth 1, 2, 3 ..."""
    geometry = tooth(values)
    return CircularPattern(
        "teeth",
        "pawl",
        (values.pawl_length / 2, 0.0),
        "wheel",
        -geometry.pitch,
        geometry.apex,
        geometry.boundary_normal,
        enabled=1 - values.guided,
    )


MODEL = Model(
    name="Ratchet",
    description="Ratchet of Pennestrì, Valentini and Vita: crank, pawl, toothed wheel with spring",
    author="The mechanism_fmu team",
    license="MIT",
    inputs=INPUTS,
    outputs=OUTPUTS,
    parameters=PARAMETERS,
    calculated=calculated,
    mechanism=mechanism,
    objections=objections,
    warnings=warnings,
    stop_time=6.0,
    step_size=1e-2,
    drawing=SHAPES,
    analysis=ANALYSIS,
    cases=CASES,
)
