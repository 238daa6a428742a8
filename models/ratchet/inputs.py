"""Inputs of the ratchet."""

from __future__ import annotations

import math

from mechanism_fmu.model import Input, load_torque_input, shaft_inputs, torque_input

#: What the descriptions call the shaft.
SHAFT = "compliant drive shaft"

_speed, _angle = shaft_inputs(speed=0.0, angle=math.radians(77), shaft=SHAFT)

INPUTS = (
    torque_input("drive", "crank", 1e-3),
    Input(
        "spring_preload",
        "spring.preload",
        0.0,
        "Preload of the wheel's torsion spring: constant torque that opposes positive wheel rotation",
        "N.m",
        -1e6,
        1e6,
    ),
    load_torque_input("wheel"),
    _angle,
    _speed,
)
