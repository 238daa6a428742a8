"""The slider-crank: crank, connecting rod and slider, with an offset if wanted.

Frame: the crank's hinge at the origin, the slider's line parallel to the x axis at the height e. The x axis of a link
runs along it, from its hinge or the crank pin on. Equations and sources: README.md beside this file.
"""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    Body,
    Case,
    CompliantShaft,
    Damper,
    Finding,
    Force,
    Mechanism,
    Model,
    Revolute,
    Torque,
    Translational,
)
from mechanism_fmu.model.body import MovingPoint, link_body
from mechanism_fmu.model.findings import at_most, first, size

from .ports import INPUTS, OUTPUTS, PARAMETERS, SHAPES, calculated, rise, start

# What is wrong, or odd, with parameter values that are each within their limits.

#: A rod that is at a right angle to the slider's line to this fraction of its length cannot say where the slider goes.
_UPRIGHT = 1e-9
#: Lengths are those of a change point when they are off by less than this fraction of their sum.
_CHANGES_WITHIN = 1e-6


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the linkage cannot be assembled at the start: value, limit and way out."""
    distance = size(rise(values))
    return (
        Finding(
            at_most(values.rod_length * (1 - _UPRIGHT), distance),
            "rod_length = {:.6g} m does not reach the slider's line: at crank_angle_start = {:.6g} deg, with "
            "crank_length = {:.6g} m and offset = {:.6g} m, the crank pin is {:.6g} m away from it. Give more than "
            "{:.6g} m, or change crank_angle_start.",
            (
                values.rod_length,
                values.crank_angle_start * (180 / math.pi),
                values.crank_length,
                values.offset,
                distance,
                distance,
            ),
        ),
    )


def warnings(values: SimpleNamespace) -> tuple[Finding, ...]:
    """What the crank cannot do; it means something only where nothing is objected to."""
    crank, rod, offset = values.crank_length, values.rod_length, size(values.offset)
    needed = crank + offset
    flat = _CHANGES_WITHIN * (rod + needed)
    return first(
        *(
            Finding(
                flat - size(excess),
                "Change point: with rod_length = {:.6g} m, crank_length = {:.6g} m and |offset| = {:.6g} m, crank and "
                "rod can both stand at a right angle to the slider's line. There the constraints lose a rank, and "
                f"whether crank and slider go on together or apart is undetermined. Give a rod {way} by more than "
                "{:.3g} m, or keep the motion away from there.",
                (rod, crank, offset, flat),
            )
            for excess, way in ((rod - needed, "longer"), (crank - offset - rod, "longer or shorter"))
        ),
        Finding(
            needed - rod,
            "The crank cannot turn fully: rod_length = {:.6g} m is shorter than crank_length + |offset| = {:.6g} m. It "
            "swings between positions where the rod is at a right angle to the slider's line. For full turns give "
            "a rod_length of more than {:.6g} m.",
            (rod, needed, needed),
        ),
    )


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The slider-crank for parameter values that raise no objection."""
    on_crank, on_rod, rubbing = values.crank_centre, values.rod_centre, values.joint_friction_radius
    along = (1.0, 0.0)
    crank, rod, slider = bodies = _bodies(values)
    return Mechanism(
        bodies=bodies,
        joints=(
            Revolute("crank_hinge", crank.at(-on_crank, 0.0), GROUND.at(0.0, 0.0), friction_radius=rubbing),
            Revolute(
                "crank_pin",
                rod.at(-on_rod, 0.0),
                crank.at(values.crank_length - on_crank, 0.0),
                friction_radius=rubbing,
            ),
            Revolute("slider_pin", slider, rod.at(values.rod_length - on_rod, 0.0), friction_radius=rubbing),
            Translational(
                "guide",
                GROUND.line((0.0, values.offset), along),
                slider.line((0.0, 0.0), along),
                friction=values.slider_friction,
            ),
        ),
        forces=(
            Torque("drive", crank),
            Force("load", slider),
            CompliantShaft("shaft", crank, stiffness=values.drive_stiffness, damping=values.drive_damping),
            Damper("crank_damper", crank, damping=values.crank_damping),
            Force("crank_weight", crank, force=(0.0, -values.crank_mass * values.gravity)),
            Force("rod_weight", rod, force=(0.0, -values.rod_mass * values.gravity)),
            Force("slider_weight", slider, force=(0.0, -values.slider_mass * values.gravity)),
        ),
        held=(crank.angle,),
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


CASES = (
    Case(
        "runs_down",
        "No drive: friction between slider and guide brakes the crank until it stands",
        {"drive_damping": 0.0, "slider_friction": 0.2, "gravity": 9.81, "crank_speed_start": "60 rpm"},
    ),
)

MODEL = Model(
    name="SliderCrank",
    description="Slider-crank: a crank moves a slider through a connecting rod, or the slider the crank",
    author="The mechanism_fmu team",
    license="MIT",
    inputs=INPUTS,
    outputs=OUTPUTS,
    parameters=PARAMETERS,
    calculated=calculated,
    mechanism=mechanism,
    objections=objections,
    warnings=warnings,
    stop_time=2.0,
    step_size=5e-3,
    drawing=SHAPES,
    cases=CASES,
)
