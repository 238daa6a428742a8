"""How the motor is drawn from its variables: housing, and a rotor whose poles show how it turns."""

from __future__ import annotations

import math

from mechanism_fmu.model import Calculated, Disc, Hinge, Wheel

#: Radii as drawn [m]; the motor's equations know none.
HOUSING, POLE, CORE = 0.05, 0.042, 0.018
POLES = 4

_HALF, _GAP = 0.55 * math.pi / POLES, math.pi / POLES
#: One pole, about the x axis, from the middle of the gap before it to that behind it: radius [m], angle [rad].
OUTLINE = ((CORE, -_GAP), (CORE, -_HALF), (POLE, -_HALF), (POLE, _HALF), (CORE, _HALF), (CORE, _GAP))

SHAPES = (
    Disc("housing", (0.0, 0.0), "outline_housing_radius"),
    Wheel("rotor", (0.0, 0.0), "rotor_angle", POLES, OUTLINE),
    Hinge((0.0, 0.0)),
)


def form() -> tuple[Calculated, ...]:
    """The radius of the housing."""
    return (Calculated("outline_housing_radius", HOUSING, "Drawing: radius of the housing", "m"),)
