"""Inputs, outputs and parameters of the slider-crank, what follows from them, and how it is drawn."""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import SimpleNamespace

from mechanism_fmu.model import Bar, Calculated, Hinge, Input, Output, Parameter, Wheel, port_builders as ports
from mechanism_fmu.model.four_bar import root
from mechanism_fmu.model.functions import Number, atan2, cos, sin

# Where the parts of a slider-crank are and how fast, in closed form from the crank; and its known dead positions.
#
# With the crank r, the rod l, the offset e, the crank's angle theta and the rod's angle phi:
#
#     r cos(theta) + l cos(phi) = x        r sin(theta) + l sin(phi) = e        cos(phi) > 0


@dataclass(frozen=True)
class Start:
    """The linkage at the start.

    Attributes:
        rod_angle, rod_speed: phi [rad] and its rate [rad/s].
        slider_position, slider_velocity: x [m] and its rate [m/s].
    """

    rod_angle: Number
    rod_speed: Number
    slider_position: Number
    slider_velocity: Number


def start(values: SimpleNamespace) -> Start:
    """The start from the crank's angle and speed; it needs `rise(values)` between -l and l."""
    r, theta, speed = values.crank_length, values.crank_angle_start, values.crank_speed_start
    up = rise(values)
    along = root(values.rod_length * values.rod_length - up * up)
    rod_speed = -r * cos(theta) * speed / along
    return Start(
        rod_angle=atan2(up, along),
        rod_speed=rod_speed,
        slider_position=r * cos(theta) + along,
        slider_velocity=-r * sin(theta) * speed - up * rod_speed,
    )


def rise(values: SimpleNamespace) -> Number:
    """From the crank pin up to the slider's line at the start: e - r sin(theta) = l sin(phi) [m]."""
    return values.offset - values.crank_length * sin(values.crank_angle_start)


@dataclass(frozen=True)
class DeadPositions:
    """Where the slider turns back: crank and rod in line.

    Attributes:
        outer, inner: x of the slider [m]; 0 where the linkage does not reach that position.
    """

    outer: Number
    inner: Number

    @property
    def stroke(self) -> Number:
        """Distance between the two [m]."""
        return self.outer - self.inner


def dead_positions(values: SimpleNamespace) -> DeadPositions:
    """The slider at sqrt((l + r)^2 - e^2) and sqrt((l - r)^2 - e^2)."""
    far, near = values.rod_length + values.crank_length, values.rod_length - values.crank_length
    square = values.offset * values.offset
    return DeadPositions(root(far * far - square), root(near * near - square))


# How the slider-crank is drawn from its variables: guide, crank, rod, slider, hinges.
#
# The slider's size follows from the crank's: its outline and the guide take calculated parameters, `outline_*`.

#: Half the length and half the height of the slider as drawn, in crank lengths.
HALF_LENGTH, HALF_HEIGHT = 0.4, 0.24

_CRANK_HINGE = (0.0, 0.0)
_CORNER = atan2(HALF_HEIGHT, HALF_LENGTH)
_CORNERS = (_CORNER, math.pi - _CORNER, math.pi + _CORNER, -_CORNER + 2 * math.pi)

SHAPES = (
    Bar("guide", ("outline_guide_start", "offset"), 0.0, "outline_guide_length"),
    Wheel("slider", ("slider_position", "offset"), 0.0, 1, tuple(("outline_slider_radius", a) for a in _CORNERS)),
    Bar("crank", _CRANK_HINGE, "crank_angle", "crank_length"),
    Bar("rod", "crank", "rod_angle", "rod_length"),
    Hinge(_CRANK_HINGE),
    Hinge("crank"),
    Hinge("rod"),
)


def form(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """The slider's corners, and the guide: as long as the slider needs."""
    r, dead = values.crank_length, dead_positions(values)
    return (
        Calculated("outline_slider_radius", math.hypot(HALF_LENGTH, HALF_HEIGHT) * r, "Drawing: slider's corners", "m"),
        Calculated("outline_guide_start", dead.inner - HALF_LENGTH * r, "Drawing: where the guide begins", "m"),
        Calculated("outline_guide_length", dead.stroke + 2 * HALF_LENGTH * r, "Drawing: length of the guide", "m"),
    )


INPUTS = (
    *ports.shaft_inputs(speed=2 * math.pi),
    ports.torque_input("drive", "crank", usual=(-1.0, 1.0)),
    Input(
        "load_force",
        "load.x",
        0.0,
        "Force on the slider along its line, outwards positive",
        "N",
        -1e6,
        1e6,
        usual=(-20.0, 20.0),
    ),
)

OUTPUTS = (
    *ports.body_motion_outputs({"crank": "theta", "rod": "phi"}),
    Output("slider_position", "slider.x", "Position of the slider along its line (x)", "m", nominal=0.1),
    Output("slider_velocity", "slider.x_rate", "Rate of slider_position", "m/s", nominal=0.1),
    ports.shaft_torque_output("crank"),
    *ports.friction_outputs("guide", "the slider on its guide", INPUTS, "outwards"),
    *ports.energy_outputs(
        kinetic="Kinetic energy of crank, rod and slider",
        spring="Energy of springs within the linkage: none, 0",
        work="Work done by drive shaft, inputs and weights since the start",
        lost="Energy lost in friction and the damper since the start",
    ),
)

PARAMETERS = (
    *ports.link_parameters("crank", 0.05, 1.0, 2e-3, 0.0, "its hinge"),
    *ports.link_parameters("rod", 0.2, 0.5, 2e-3, 0.06, "the crank pin"),
    ports.mass_parameter("slider_mass", 0.8, "Mass of the slider"),
    ports.length_parameter(
        "offset", 0.0, "Height of the slider's line above the crank's hinge (e)", -1e3, usual=(-0.05, 0.05)
    ),
    ports.angle_parameter(
        "crank_angle_start",
        0.0,
        "Crank angle at the start (theta); 0: the slider is outermost, if there is no offset",
    ),
    ports.speed_parameter("crank_speed_start", 2 * math.pi, "Crank speed at the start; those of rod and slider follow"),
    Parameter("gravity", 0.0, "Gravitational acceleration, across the slider's line, downwards", "m/s2", -1e3, 1e3),
    ports.damping_parameter("crank", usual=(0.0, 0.05)),
    *ports.shaft_parameters(damping=0.1),
    ports.joint_friction_parameter(),
    ports.fraction_parameter("slider_friction", 0.0, "Coefficient of friction between slider and guide"),
    *ports.settings_parameters(),
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
