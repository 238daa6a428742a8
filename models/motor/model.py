"""The motor: a rotor on a fixed hinge, its armature circuit, and a PI controller of its speed.

Frame: the rotor's hinge at the origin. Equations and source: README.md beside this file.
"""

from __future__ import annotations

from types import SimpleNamespace

from mechanism_fmu.model import GROUND, Damper, DCMotor, Mechanism, Model, Revolute, Settings, Torque
from mechanism_fmu.model.part_bodies import rotor_body

from .checks import objections
from .ports import INPUTS, OUTPUTS, PARAMETERS, calculated
from .shapes import SHAPES


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The motor for parameter values."""
    return Mechanism(
        bodies=(rotor_body(values, "rotor", (0.0, 0.0), values.rotor_angle_start, values.rotor_speed_start),),
        joints=(Revolute("hinge", "rotor", (0.0, 0.0), GROUND, (0.0, 0.0)),),
        forces=(
            DCMotor(
                "motor",
                "rotor",
                constant=values.motor_constant,
                resistance=values.resistance,
                inductance=values.inductance,
                voltage=values.voltage_limit,
                gain=values.speed_gain,
                integral_gain=values.integral_gain,
                anti_windup=values.anti_windup,
            ),
            Torque("load", "rotor"),
            Damper("rotor_damper", "rotor", damping=values.rotor_damping),
        ),
        inputs=INPUTS,
        outputs=OUTPUTS,
        calculated=calculated(values),
        held=("rotor.angle",),
        settings=Settings.of(values),
    )


MODEL = Model(
    name="Motor",
    description="Direct-current motor with a PI controller of its speed and limited voltage",
    parameters=PARAMETERS,
    mechanism=mechanism,
    objections=objections,
    stop_time=0.5,
    step_size=1e-3,
    drawing=SHAPES,
    author="The mechanism_fmu team",
    license="MIT",
)
