"""A four-bar linkage whose crank is driven, further than it reaches unless the coupler is long; nothing is held."""

import math
from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Mechanism,
    Model,
    Parameter,
    PointLineContact,
    Revolute,
    bar,
    four_bar_points,
    polynomial_motion,
)

CRANK, ROCKER, GROUND_LENGTH, START = 0.15, 0.12, 0.2, 1.0
_ALONG = (math.cos(START), math.sin(START))


def end_of_range(reach: float) -> float:
    """The crank's angle [rad] at which its pin is at a distance `reach` [m] from the rocker's hinge.

    It is at the end of its range with coupler and rocker stretched or folded in line: their sum, or difference.
    """
    return math.acos((CRANK**2 + GROUND_LENGTH**2 - reach**2) / (2 * CRANK * GROUND_LENGTH))


def mechanism(values: SimpleNamespace) -> Mechanism:
    a, b, c, d = four_bar_points(
        (0.0, 0.0), (GROUND_LENGTH, 0.0), crank=CRANK, coupler=values.coupler, rocker=ROCKER, angle=START
    )
    crank = bar("crank", a, b, mass=1.0, speed=values.crank_speed)
    coupler, rocker = bar("coupler", b, c, mass=1.0), bar("rocker", d, c, mass=1.0)
    return Mechanism(
        bodies=(crank, coupler, rocker),
        joints=(
            Revolute("A", crank.a, GROUND.at(0.0, 0.0)),
            Revolute("B", crank.b, coupler.a),
            Revolute("C", coupler.b, rocker.b),
            Revolute("D", rocker.a, GROUND.at(GROUND_LENGTH, 0.0)),
            AngleDriver("drive", crank, motion=polynomial_motion(START, values.drive_speed)),
        ),
        contacts=(
            PointLineContact("wall", crank.b, GROUND.line(b, _ALONG), closed=True, guided=True, enabled=values.blocked),
        ),
    )


MODEL = Model(
    "Driven",
    "A driven four-bar linkage",
    (
        Parameter("coupler", 0.18, "Length of the coupler", "m", minimum=1e-3),
        Parameter("crank_speed", 0.0, "Speed that the crank is given", "rad/s"),
        Parameter("drive_speed", 3.0, "Speed that its driver asks for", "rad/s"),
        Parameter("blocked", 0.0, "Whether a wall holds the crank", type="Boolean"),
    ),
    mechanism,
)
