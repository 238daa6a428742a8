"""The slider-crank: crank, connecting rod and slider, with an offset if wanted.

Frame: the crank's hinge at the origin, the slider's line parallel to the x axis at the height e. The x axis of a link
runs along it, from its hinge or the crank pin on. Equations and sources: README.md beside this file.
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
    Translational,
)
from mechanism_fmu.model.part_bodies import MovingPoint, link_body

from .checks import objections, warnings
from .geometry import start
from .ports import INPUTS, OUTPUTS, PARAMETERS, calculated
from .shapes import SHAPES


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The slider-crank for parameter values that raise no objection."""
    on_crank, on_rod, rubbing = values.crank_centre, values.rod_centre, values.joint_friction_radius
    along = (1.0, 0.0)
    return Mechanism(
        bodies=_bodies(values),
        joints=(
            Revolute("crank_hinge", "crank", (-on_crank, 0.0), GROUND, (0.0, 0.0), rubbing),
            Revolute("crank_pin", "rod", (-on_rod, 0.0), "crank", (values.crank_length - on_crank, 0.0), rubbing),
            Revolute("slider_pin", "slider", (0.0, 0.0), "rod", (values.rod_length - on_rod, 0.0), rubbing),
            Translational(
                "guide",
                GROUND,
                (0.0, values.offset),
                along,
                "slider",
                (0.0, 0.0),
                along,
                friction=values.slider_friction,
            ),
        ),
        forces=(
            Torque("drive", "crank"),
            Force("load", "slider"),
            CompliantShaft("shaft", "crank", stiffness=values.drive_stiffness, damping=values.drive_damping),
            Damper("crank_damper", "crank", damping=values.crank_damping),
            Force("crank_weight", "crank", (0.0, -values.crank_mass * values.gravity)),
            Force("rod_weight", "rod", (0.0, -values.rod_mass * values.gravity)),
            Force("slider_weight", "slider", (0.0, -values.slider_mass * values.gravity)),
        ),
        inputs=INPUTS,
        outputs=OUTPUTS,
        calculated=calculated(values),
        held=("crank.angle",),
        settings=Settings.of(values),
    )


def _bodies(values: SimpleNamespace) -> tuple[Body, ...]:
    r, theta, speed, at = values.crank_length, values.crank_angle_start, values.crank_speed_start, start(values)
    origin = MovingPoint(0.0, 0.0)
    return (
        link_body(values, "crank", origin, theta, speed),
        link_body(values, "rod", origin.along(r, theta, speed), at.rod_angle, at.rod_speed),
        # The slider does not turn: its inertia matters for nothing, and is of the size of the others.
        Body(
            "slider",
            values.slider_mass,
            values.slider_mass * r * r,
            (at.slider_position, values.offset, 0.0),
            (at.slider_velocity, 0.0, 0.0),
        ),
    )


MODEL = Model(
    name="SliderCrank",
    description="Slider-crank: a crank moves a slider through a connecting rod, or the slider the crank",
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
