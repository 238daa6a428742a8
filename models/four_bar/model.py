"""The four-bar linkage: crank, coupler and rocker between two fixed hinges, open or crossed.

Frame: the crank's hinge at the origin, the rocker's hinge at (d, 0). The x axis of a link runs along it: of crank and
rocker from the fixed hinge on, of the coupler from the crank pin on. Equations and sources: README.md beside this
file.
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
    Force,
    Mechanism,
    Model,
    Parameter,
    Revolute,
    SineSignal,
    Torque,
    TorsionSpring,
    port_builders as ports,
)
from mechanism_fmu.model.body import MovingPoint, link_body
from mechanism_fmu.model.four_bar import (
    CROSSED,
    MOTIONS,
    SHAPES,
    objections,
    start,
    transmission_angles as calculated,
    warnings,
)

# Inputs, outputs and parameters of the four-bar linkage.

INPUTS = (
    *ports.shaft_inputs(speed=2 * math.pi),
    ports.torque_input("drive", "crank", usual=(-0.5, 0.5)),
    ports.load_torque_input("rocker", usual=(-0.5, 0.5)),
)

OUTPUTS = (
    *MOTIONS,
    ports.shaft_torque_output("crank"),
    *ports.energy_outputs(
        kinetic="Kinetic energy of crank, coupler and rocker",
        spring="Energy of the rocker's spring",
        work="Work done by drive shaft, inputs and weights since the start",
        lost="Energy lost in friction and the damper since the start",
    ),
)

PARAMETERS = (
    ports.length_parameter("ground_length", 0.2, "Distance between the fixed hinges of crank and rocker (d)"),
    *ports.link_parameters("crank", 0.05, 0.2, 1e-3, 0.025, "its hinge"),
    *ports.link_parameters("coupler", 0.18, 0.5, 1.35e-3, 0.09, "the crank pin"),
    *ports.link_parameters("rocker", 0.12, 0.4, 4.8e-4, 0.06, "its hinge"),
    CROSSED,
    ports.angle_parameter("crank_angle_start", 0.0, "Crank angle at the start (theta)"),
    ports.speed_parameter(
        "crank_speed_start", 2 * math.pi, "Crank speed at the start; those of coupler and rocker follow"
    ),
    Parameter("gravity", 0.0, "Gravitational acceleration, downwards", "m/s2", -1e3, 1e3),
    ports.damping_parameter("crank", usual=(0.0, 0.05)),
    ports.stiffness_parameter("spring_stiffness", 0.0, "Stiffness of the rocker's torsion spring", usual=(0.0, 2.0)),
    ports.angle_parameter("spring_free_angle", math.radians(90), "Rocker angle at which the torsion spring is relaxed"),
    *ports.shaft_parameters(damping=0.1),
    ports.joint_friction_parameter(),
    *ports.settings_parameters(),
)


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The four-bar linkage for parameter values that raise no objection."""
    a, b, c, d = values.crank_length, values.coupler_length, values.rocker_length, values.ground_length
    on_crank, on_coupler, on_rocker = values.crank_centre, values.coupler_centre, values.rocker_centre
    rubbing = values.joint_friction_radius
    crank, coupler, rocker = bodies = _bodies(values)
    return Mechanism(
        bodies=bodies,
        joints=(
            Revolute("crank_hinge", crank.at(-on_crank, 0.0), GROUND.at(0.0, 0.0), friction_radius=rubbing),
            Revolute("crank_pin", coupler.at(-on_coupler, 0.0), crank.at(a - on_crank, 0.0), friction_radius=rubbing),
            Revolute(
                "rocker_pin", rocker.at(c - on_rocker, 0.0), coupler.at(b - on_coupler, 0.0), friction_radius=rubbing
            ),
            Revolute("rocker_hinge", rocker.at(-on_rocker, 0.0), GROUND.at(d, 0.0), friction_radius=rubbing),
        ),
        forces=(
            Torque("drive", crank),
            Torque("load", rocker),
            CompliantShaft("shaft", crank, stiffness=values.drive_stiffness, damping=values.drive_damping),
            Damper("crank_damper", crank, damping=values.crank_damping),
            TorsionSpring("spring", rocker, stiffness=values.spring_stiffness, free_angle=values.spring_free_angle),
            Force("crank_weight", crank, force=(0.0, -values.crank_mass * values.gravity)),
            Force("coupler_weight", coupler, force=(0.0, -values.coupler_mass * values.gravity)),
            Force("rocker_weight", rocker, force=(0.0, -values.rocker_mass * values.gravity)),
        ),
        held=(crank.angle,),
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


CASES = (
    Case(
        "pendulum",
        "No drive: let go under gravity, with little damping",
        {"drive_damping": 0.0, "crank_speed_start": 0.0, "gravity": 9.81, "crank_damping": 2e-3},
        stop_time=4.0,
    ),
    Case(
        "load",
        "A load on the rocker that comes and goes twice a second",
        signals={"load_torque": SineSignal(0.0, 0.2, 0.5)},
    ),
)

MODEL = Model(
    name="FourBar",
    description="Four-bar linkage: a crank moves a rocker through a coupler, open or crossed",
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
