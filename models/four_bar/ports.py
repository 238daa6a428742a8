"""Inputs, outputs and parameters of the four-bar linkage."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Calculated, Input, Output, Parameter

from .geometry import form

INPUTS = (
    Input(
        "drive_speed",
        "shaft.speed",
        2 * math.pi,
        "Speed of the driven end of the drive shaft (it acts when drive_damping > 0)",
        "rad/s",
        -1e6,
        1e6,
        "rpm",
    ),
    Input(
        "drive_angle",
        "shaft.angle",
        0.0,
        "Angle of the driven end of the drive shaft (it acts when drive_stiffness > 0)",
        "rad",
        -1e6,
        1e6,
        "deg",
    ),
    Input("drive_torque", "drive.torque", 0.0, "Torque on the crank, counter-clockwise positive", "N.m", -1e6, 1e6),
    Input(
        "load_torque", "load.torque", 0.0, "External torque on the rocker, counter-clockwise positive", "N.m", -1e6, 1e6
    ),
)


def _angle(body: str, symbol: str) -> Output:
    description = f"Absolute angle of the {body} ({symbol}), unwrapped"
    return Output(f"{body}_angle", f"{body}.angle", description, "rad", "deg", nominal=1.0)


def _speed(body: str) -> Output:
    return Output(f"{body}_speed", f"{body}.speed", f"Rate of {body}_angle", "rad/s", "rpm", nominal=1.0)


def _energy(name: str, source: str, description: str) -> Output:
    return Output(name, f"energy.{source}", description, "J", nominal=0.1)


OUTPUTS = (
    _angle("crank", "theta"),
    _angle("coupler", "phi"),
    _angle("rocker", "psi"),
    _speed("crank"),
    _speed("coupler"),
    _speed("rocker"),
    Output(
        "drive_shaft_torque",
        "shaft.torque",
        "Torque of the drive shaft on the crank, added to drive_torque",
        "N.m",
        nominal=0.1,
        feedthrough=("drive_angle", "drive_speed"),
    ),
    _energy("kinetic_energy", "kinetic", "Kinetic energy of crank, coupler and rocker"),
    _energy("spring_energy", "spring", "Energy of the rocker's spring"),
    _energy("work_done", "work", "Work done by drive shaft, inputs and weights since the start"),
    _energy("energy_lost", "lost", "Energy lost in friction and the damper since the start"),
)


def _length(name: str, start: float, description: str, least: float = 1e-6) -> Parameter:
    return Parameter(name, start, description, "m", least, 1e3)


def _link(body: str, length: float, mass: float, inertia: float, centre: float, origin: str) -> tuple[Parameter, ...]:
    return (
        _length(f"{body}_length", length, f"Length of the {body}"),
        Parameter(f"{body}_mass", mass, f"Mass of the {body}", "kg", 1e-12, 1e6),
        Parameter(
            f"{body}_inertia", inertia, f"Moment of inertia of the {body} about its centre of mass", "kg.m2", 1e-12, 1e6
        ),
        _length(f"{body}_centre", centre, f"Distance of the {body}'s centre of mass from {origin}, along it", -1e3),
    )


PARAMETERS = (
    _length("ground_length", 0.2, "Distance between the fixed hinges of crank and rocker (d)"),
    *_link("crank", 0.05, 0.2, 1e-3, 0.025, "its hinge"),
    *_link("coupler", 0.18, 0.5, 1.35e-3, 0.09, "the crank pin"),
    *_link("rocker", 0.12, 0.4, 4.8e-4, 0.06, "its hinge"),
    Parameter(
        "crossed",
        0.0,
        "Whether coupler and rocker are assembled on the other side of the line from crank pin to rocker hinge",
        type="Boolean",
    ),
    Parameter("crank_angle_start", 0.0, "Crank angle at the start (theta)", "rad", -1e3, 1e3, display_unit="deg"),
    Parameter(
        "crank_speed_start",
        2 * math.pi,
        "Crank speed at the start; those of coupler and rocker follow",
        "rad/s",
        -1e6,
        1e6,
        display_unit="rpm",
    ),
    Parameter("gravity", 0.0, "Gravitational acceleration, downwards", "m/s2", -1e3, 1e3),
    Parameter("crank_damping", 0.0, "Damping of the crank's rotation", "N.m.s/rad", 0.0, 1e6),
    Parameter("spring_stiffness", 0.0, "Stiffness of the rocker's torsion spring", "N.m/rad", 0.0, 1e6),
    Parameter(
        "spring_free_angle",
        math.radians(90),
        "Rocker angle at which the torsion spring is relaxed",
        "rad",
        -1e3,
        1e3,
        display_unit="deg",
    ),
    Parameter("drive_stiffness", 0.0, "Stiffness of the drive shaft", "N.m/rad", 0.0, 1e9),
    Parameter("drive_damping", 0.1, "Damping of the drive shaft: torque per lag of speed", "N.m.s/rad", 0.0, 1e9),
    Parameter("joint_friction_radius", 0.0, "Coefficient of friction times pin radius, of all hinges", "m", 0.0, 1.0),
    Parameter("baumgarte_alpha", 10.0, "Baumgarte gain on the rates of the constraints", "1/s", 0.0, 1e4),
    Parameter("baumgarte_beta", 1.0, "Baumgarte gain on the constraints, squared in use", "1/s", 0.0, 1e4),
    Parameter("relative_tolerance", 1e-9, "Relative tolerance of the integration", "1", 1e-13, 1e-3),
)


def calculated(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """The extreme transmission angles."""
    known = form(values)
    between = "Transmission angle, between coupler and rocker, with the crank pointing"
    return (
        Calculated("folded_transmission_angle", known.folded, f"{between} to the rocker's hinge", "rad", "deg"),
        Calculated("stretched_transmission_angle", known.stretched, f"{between} away from it", "rad", "deg"),
    )
