"""The four-bar linkage: crank, coupler and rocker between two fixed hinges, open or crossed.

Frame: the crank's hinge at the origin, the rocker's hinge at (d, 0). The x axis of a link runs along it: of crank and
rocker from the fixed hinge on, of the coupler from the crank pin on. Equations and sources: README.md beside this file.
"""

from __future__ import annotations

from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    Body,
    CompliantShaft,
    Damper,
    Force,
    Mechanism,
    Model,
    Revolute,
    Settings,
    Torque,
    TorsionSpring,
)
from mechanism_fmu.model.four_bar import start
from mechanism_fmu.model.four_bar_checks import objections, warnings
from mechanism_fmu.model.part_bodies import MovingPoint, link_body

from .ports import INPUTS, OUTPUTS, PARAMETERS, calculated
from .shapes import SHAPES


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The four-bar linkage for parameter values that raise no objection."""
    a, b, c, d = values.crank_length, values.coupler_length, values.rocker_length, values.ground_length
    on_crank, on_coupler, on_rocker = values.crank_centre, values.coupler_centre, values.rocker_centre
    rubbing = values.joint_friction_radius
    return Mechanism(
        bodies=_bodies(values),
        joints=(
            Revolute("crank_hinge", "crank", (-on_crank, 0.0), GROUND, (0.0, 0.0), rubbing),
            Revolute("crank_pin", "coupler", (-on_coupler, 0.0), "crank", (a - on_crank, 0.0), rubbing),
            Revolute("rocker_pin", "rocker", (c - on_rocker, 0.0), "coupler", (b - on_coupler, 0.0), rubbing),
            Revolute("rocker_hinge", "rocker", (-on_rocker, 0.0), GROUND, (d, 0.0), rubbing),
        ),
        forces=(
            Torque("drive", "crank"),
            Torque("load", "rocker"),
            CompliantShaft("shaft", "crank", stiffness=values.drive_stiffness, damping=values.drive_damping),
            Damper("crank_damper", "crank", damping=values.crank_damping),
            TorsionSpring("spring", "rocker", stiffness=values.spring_stiffness, free_angle=values.spring_free_angle),
            Force("crank_weight", "crank", (0.0, -values.crank_mass * values.gravity)),
            Force("coupler_weight", "coupler", (0.0, -values.coupler_mass * values.gravity)),
            Force("rocker_weight", "rocker", (0.0, -values.rocker_mass * values.gravity)),
        ),
        inputs=INPUTS,
        outputs=OUTPUTS,
        calculated=calculated(values),
        held=("crank.angle",),
        settings=Settings.of(values),
    )


def _bodies(values: SimpleNamespace) -> tuple[Body, ...]:
    theta, speed, at = values.crank_angle_start, values.crank_speed_start, start(values)
    origin = MovingPoint(0.0, 0.0)
    pin = origin.along(values.crank_length, theta, speed)
    return (
        link_body(values, "crank", origin, theta, speed),
        link_body(values, "coupler", pin, at.coupler_angle, at.coupler_speed),
        link_body(values, "rocker", MovingPoint(values.ground_length, 0.0), at.rocker_angle, at.rocker_speed),
    )


MODEL = Model(
    name="FourBar",
    description="Four-bar linkage: a crank moves a rocker through a coupler, open or crossed",
    parameters=PARAMETERS,
    mechanism=mechanism,
    objections=objections,
    warnings=warnings,
    stop_time=2.0,
    step_size=5e-3,
    drawing=SHAPES,
    author="The mechanism_fmu team",
    license="MIT",
)
