"""Inputs, outputs and parameters of the slider-crank."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Calculated, Input, Output, Parameter
from mechanism_fmu.model.port_builders import (
    JOINT_FRICTION,
    SETTINGS,
    angle_output,
    damping_parameter,
    drive_torque_input,
    energy_outputs,
    length_parameter,
    link_parameters,
    shaft_inputs,
    shaft_parameters,
    shaft_torque_output,
    speed_output,
    start_parameters,
)

from .geometry import dead_positions
from .shapes import form

INPUTS = (
    *shaft_inputs(speed=2 * math.pi),
    drive_torque_input("crank"),
    Input("load_force", "load.x", 0.0, "Force on the slider along its line, outwards positive", "N", -1e6, 1e6),
)

OUTPUTS = (
    angle_output("crank", "theta"),
    angle_output("rod", "phi"),
    speed_output("crank"),
    speed_output("rod"),
    Output("slider_position", "slider.x", "Position of the slider along its line (x)", "m", nominal=0.1),
    Output("slider_velocity", "slider.x_rate", "Rate of slider_position", "m/s", nominal=0.1),
    shaft_torque_output("crank"),
    *energy_outputs(
        "Kinetic energy of crank, rod and slider",
        "Energy of springs within the linkage: none, 0",
        "Work done by drive shaft, inputs and weights since the start",
        "Energy lost in friction and the damper since the start",
    ),
)

PARAMETERS = (
    *link_parameters("crank", 0.05, 1.0, 2e-3, 0.0, "its hinge"),
    *link_parameters("rod", 0.2, 0.5, 2e-3, 0.06, "the crank pin"),
    Parameter("slider_mass", 0.8, "Mass of the slider", "kg", 1e-12, 1e6),
    length_parameter("offset", 0.0, "Height of the slider's line above the crank's hinge (e)", -1e3),
    *start_parameters(
        "crank",
        2 * math.pi,
        " (theta); 0: the slider is outermost, if there is no offset",
        "those of rod and slider follow",
    ),
    Parameter(
        "gravity",
        0.0,
        "Gravitational acceleration, across the slider's line, downwards",
        "m/s2",
        -1e3,
        1e3,
    ),
    damping_parameter("crank"),
    *shaft_parameters(damping=0.1),
    JOINT_FRICTION,
    Parameter("slider_friction", 0.0, "Coefficient of friction between slider and guide", "1", 0.0, 1.0),
    *SETTINGS,
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
