"""The cam of the ME451 slides, and cams in general on a hinge at the origin, under a follower on the y axis."""

import math

from mechanism_fmu.model import (
    GROUND,
    Body,
    CamFlatFollower,
    CamFollower,
    Force,
    Mechanism,
    Output,
    PointFollower,
    Revolute,
    Settings,
    Torque,
    Translational,
)
from mechanism_fmu.model.curves import constant, cosine
from mechanism_fmu.model.curves.profiles import circle, harmonic_profile, piecewise_profile

#: rho = 5/4 - 1/4 cos(3 alpha) up to 120 deg, 1 elsewhere.
SLIDE_CAM = piecewise_profile((0.0, (constant(1.25), cosine(-0.25, 3.0))), (2 * math.pi / 3, (constant(1.0),)))
EGG = harmonic_profile(1.0, (0.1, 0.05), (0.02,))
ORIGIN, UP = (0.0, 0.0), (0.0, 1.0)
CAM_INERTIA, FOLLOWER_MASS, WEIGHT, TORQUE = 0.3, 0.5, 4.905, 0.7


def pair(kind, profile, roller=0.25, **options):
    if kind == "roller":
        return CamFollower("pair", "cam", profile, "follower", circle(roller), **options)
    if kind == "flat":
        return CamFlatFollower("pair", "cam", profile, "follower", ORIGIN, (-1.0, 0.0), **options)
    return PointFollower("pair", "follower", ORIGIN, "cam", profile, **options)


def cam_mechanism(kind, profile=SLIDE_CAM, angle=0.0, speed=0.0, height=1.6, x=0.0, centre=ORIGIN, **options):
    """A "roller", "flat" or "point" follower at (x, height), under its weight; a torque on the cam.

    `centre` is the middle of the profile on the cam.
    """
    where = {"centre_j" if kind == "point" else "centre_i": centre}
    return Mechanism(
        bodies=(
            Body("cam", 1.0, CAM_INERTIA, (0.0, 0.0, angle), (0.0, 0.0, speed)),
            Body("follower", FOLLOWER_MASS, 0.1, (x, height, 0.0)),
        ),
        joints=(
            Revolute("hinge", "cam", ORIGIN, GROUND, ORIGIN),
            Translational("guide", "follower", ORIGIN, UP, GROUND, (x, 0.0), UP),
        ),
        contacts=(pair(kind, profile, **where, **options),),
        forces=(Torque("drive", "cam", torque=TORQUE), Force("weight", "follower", (0.0, -WEIGHT))),
        held=("cam.angle",),
        outputs=(
            Output("angle", "cam.angle", ""),
            Output("speed", "cam.speed", ""),
            Output("height", "follower.y", ""),
            Output("rise", "follower.y_rate", ""),
            Output("force", "pair.force", ""),
            Output("gap", "pair.gap", ""),
            *(Output(name, f"energy.{name}", "") for name in ("kinetic", "work", "lost")),
        ),
        settings=Settings(1e-11),
    )
