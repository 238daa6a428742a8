"""Inputs, outputs and parameters of the slider-crank."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Calculated, Input, Output, Parameter

from .geometry import dead_positions
from .shapes import form

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
    Input("load_force", "load.x", 0.0, "Force on the slider along its line, outwards positive", "N", -1e6, 1e6),
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
    _angle("rod", "phi"),
    _speed("crank"),
    _speed("rod"),
    Output("slider_position", "slider.x", "Position of the slider along its line (x)", "m", nominal=0.1),
    Output("slider_velocity", "slider.x_rate", "Rate of slider_position", "m/s", nominal=0.1),
    Output(
        "drive_shaft_torque",
        "shaft.torque",
        "Torque of the drive shaft on the crank, added to drive_torque",
        "N.m",
        nominal=0.1,
        feedthrough=("drive_angle", "drive_speed"),
    ),
    _energy("kinetic_energy", "kinetic", "Kinetic energy of crank, rod and slider"),
    _energy("spring_energy", "spring", "Energy of springs within the linkage: none, 0"),
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
    *_link("crank", 0.05, 1.0, 2e-3, 0.0, "its hinge"),
    *_link("rod", 0.2, 0.5, 2e-3, 0.06, "the crank pin"),
    Parameter("slider_mass", 0.8, "Mass of the slider", "kg", 1e-12, 1e6),
    _length("offset", 0.0, "Height of the slider's line above the crank's hinge (e)", -1e3),
    Parameter(
        "crank_angle_start",
        0.0,
        "Crank angle at the start (theta); 0: the slider is outermost, if there is no offset",
        "rad",
        -1e3,
        1e3,
        display_unit="deg",
    ),
    Parameter(
        "crank_speed_start",
        2 * math.pi,
        "Crank speed at the start; those of rod and slider follow",
        "rad/s",
        -1e6,
        1e6,
        display_unit="rpm",
    ),
    Parameter(
        "gravity",
        0.0,
        "Gravitational acceleration, across the slider's line, downwards",
        "m/s2",
        -1e3,
        1e3,
    ),
    Parameter("crank_damping", 0.0, "Damping of the crank's rotation", "N.m.s/rad", 0.0, 1e6),
    Parameter("drive_stiffness", 0.0, "Stiffness of the drive shaft", "N.m/rad", 0.0, 1e9),
    Parameter("drive_damping", 0.1, "Damping of the drive shaft: torque per lag of speed", "N.m.s/rad", 0.0, 1e9),
    Parameter("joint_friction_radius", 0.0, "Coefficient of friction times pin radius, of all hinges", "m", 0.0, 1.0),
    Parameter("slider_friction", 0.0, "Coefficient of friction between slider and guide", "1", 0.0, 1.0),
    Parameter("baumgarte_alpha", 10.0, "Baumgarte gain on the rates of the constraints", "1/s", 0.0, 1e4),
    Parameter("baumgarte_beta", 1.0, "Baumgarte gain on the constraints, squared in use", "1/s", 0.0, 1e4),
    Parameter("relative_tolerance", 1e-9, "Relative tolerance of the integration", "1", 1e-13, 1e-3),
)


def calculated(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """Where the slider turns back, and what drawings need."""
    dead = dead_positions(values)
    return (
        Calculated("outer_dead_position", dead.outer, "Position at which the slider turns back inwards", "m"),
        Calculated(
            "inner_dead_position",
            dead.inner,
            "Position at which the slider turns back outwards; 0: there is none, the crank cannot turn fully",
            "m",
        ),
        Calculated("stroke", dead.stroke, "Distance between the slider's dead positions", "m"),
        *form(values),
    )
