"""The cam drive: a cam, a follower arm with a roller, and the spring that holds the roller on the cam.

Frame: the cam's hinge at the origin, the follower's at (-d, 0), so that the cam lifts the roller counter-clockwise. The
follower's x axis passes through the roller's centre. Equations and sources: README.md beside this file.
"""

from __future__ import annotations

from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    CamFollower,
    CompliantShaft,
    Damper,
    Mechanism,
    Model,
    Revolute,
    Settings,
    Torque,
    TorsionSpring,
)
from mechanism_fmu.model.part_bodies import rotor_body
from mechanism_fmu.model.profiles import circle

from .checks import objections, warnings
from .geometry import profile, start_angle, timing
from .ports import INPUTS, OUTPUTS, PARAMETERS, calculated
from .shapes import SHAPES


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The cam drive for parameter values that raise no objection."""
    follower_hinge, rubbing = (-values.hinge_distance, 0.0), values.joint_friction_radius
    return Mechanism(
        bodies=(
            rotor_body(values, "cam", (0.0, 0.0), values.cam_angle_start, values.cam_speed_start),
            rotor_body(values, "follower", follower_hinge, start_angle(values)),
        ),
        joints=(
            Revolute("cam_hinge", "cam", (0.0, 0.0), GROUND, (0.0, 0.0), rubbing),
            Revolute("follower_hinge", "follower", (0.0, 0.0), GROUND, follower_hinge, rubbing),
        ),
        forces=(
            Torque("drive", "cam"),
            Torque("load", "follower"),
            CompliantShaft("shaft", "cam", stiffness=values.drive_stiffness, damping=values.drive_damping),
            TorsionSpring(
                "spring",
                "follower",
                stiffness=values.spring_stiffness,
                free_angle=timing(values).low,
                preload=values.spring_preload,
            ),
            Damper("follower_damper", "follower", damping=values.follower_damping),
        ),
        contacts=(
            CamFollower(
                "contact",
                "cam",
                profile(values),
                "follower",
                circle(values.roller_radius),
                centre_j=(values.follower_length, 0.0),
                unilateral=values.unilateral,
                restitution=values.restitution,
            ),
        ),
        inputs=INPUTS,
        outputs=OUTPUTS,
        calculated=calculated(values),
        held=("cam.angle",),
        settings=Settings.of(values),
    )


MODEL = Model(
    name="CamDrive",
    description="Cam with a roller follower on an arm: a steady rotation becomes a swing to and fro with dwells",
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
