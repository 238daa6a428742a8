"""The ratchet with a free pawl whose nose is round, on teeth that end: an outline of a tooth, and its copies.

Frame and symbols: those of `models.ratchet`. Equations and sources: README.md beside this file.
"""

from __future__ import annotations

from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    AngleStop,
    Body,
    Case,
    CircularCopies,
    CompliantShaft,
    Contact,
    Damper,
    Mechanism,
    Model,
    Outline,
    OutlineContact,
    Revolute,
    Torque,
    TorsionSpring,
    ratchet_tooth,
)
from mechanism_fmu.model.body import rotor_body
from mechanism_fmu.model.functions import cos, sin

from ..ratchet import cases as ratchet_cases
from ..ratchet.start import crank_pin
from .ports import INPUTS, OUTPUTS, PARAMETERS, SHAPES, calculated
from .start import TOOTH_COUNT, objections, pawl_angle, sharp_tooth


def tooth_outline(values: SimpleNamespace) -> Outline:
    """One tooth, open: face, rounded tip, slope, from root to root."""
    return ratchet_tooth(
        TOOTH_COUNT,
        values.tooth_slope_angle,
        values.wheel_inner_radius,
        values.slope_ratio,
        tip_radius=values.tooth_tip_radius,
    )


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The ratchet for parameter values that raise no objection."""
    rubbing, outline = values.joint_friction_radius, tooth_outline(values)
    half_crank, half_pawl = values.crank_length / 2, values.pawl_length / 2
    _, at_face, at_slope, _ = outline.points
    return Mechanism(
        bodies=_bodies(values),
        joints=(
            Revolute("crank_hinge", "crank", (-1.0 * half_crank, 0.0), GROUND, (values.hinge_distance, 0.0), rubbing),
            Revolute("pin", "pawl", (-1.0 * half_pawl, 0.0), "crank", (half_crank, 0.0), rubbing),
            Revolute("wheel_hinge", "wheel", (0.0, 0.0), GROUND, (0.0, 0.0), rubbing),
        ),
        forces=(
            Torque("drive", "crank"),
            Torque("load", "wheel"),
            TorsionSpring("spring", "wheel", stiffness=values.spring_stiffness, free_angle=values.spring_free_angle),
            CompliantShaft("shaft", "crank", stiffness=values.drive_stiffness, damping=values.drive_damping),
            Torque("pawl_spring", "pawl", "crank", torque=values.pawl_spring_torque),
            Damper("wheel_damper", "wheel", damping=values.wheel_damping),
        ),
        contacts=_contacts(values, outline),
        calculated=calculated(values, (at_slope, at_face)),
        held=("crank.angle", "wheel.angle"),
    )


def _bodies(values: SimpleNamespace) -> tuple[Body, ...]:
    pin, phi, gamma = crank_pin(values), values.crank_angle_start, pawl_angle(values)
    half_crank, half_pawl = values.crank_length / 2, values.pawl_length / 2
    crank = (values.hinge_distance + half_crank * cos(phi), half_crank * sin(phi), phi)
    pawl = (pin.x + half_pawl * cos(gamma), pin.y + half_pawl * sin(gamma), gamma)
    return (
        Body("crank", values.crank_mass, values.crank_inertia, crank),
        Body("pawl", values.pawl_mass, values.pawl_inertia, pawl),
        rotor_body(values, "wheel", (0.0, 0.0), values.wheel_angle_start),
    )


def _contacts(values: SimpleNamespace, outline: Outline) -> tuple[Contact, ...]:
    return (
        OutlineContact(
            "tooth",
            "pawl",
            "wheel",
            outline_i=Outline.circle(values.nose_radius, (values.pawl_length / 2, 0.0)),
            outline_j=outline,
            copies=CircularCopies(TOOTH_COUNT),
            restitution=values.restitution,
            friction=values.friction,
        ),
        AngleStop(
            "holding_pawl",
            "wheel",
            GROUND,
            values.wheel_angle_start,
            sharp_tooth(values).pitch,
            restitution=values.holding_pawl_restitution,
            enabled=values.holding_pawl,
        ),
    )


def _case(name: str) -> Case:
    """A case of `models.ratchet`, without what is no parameter here."""
    (case,) = (one for one in ratchet_cases.CASES if one.name == name)
    names = {parameter.name for parameter in (*PARAMETERS, *INPUTS)}
    values = {key: value for key, value in case.values.items() if key in names}
    return Case(name, case.description, values, case.signals, case.stop_time, case.step_size)


CASES = (_case("indexing"), _case("jam"))

MODEL = Model(
    name="RatchetFree",
    description="Ratchet with a free pawl: a round nose on a wheel whose teeth end",
    author="The mechanism_fmu team",
    license="MIT",
    inputs=INPUTS,
    outputs=OUTPUTS,
    parameters=PARAMETERS,
    mechanism=mechanism,
    objections=objections,
    stop_time=6.0,
    step_size=1e-2,
    drawing=SHAPES,
    cases=CASES,
)
