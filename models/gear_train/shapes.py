"""How the gear train is drawn from its variables: pitch circles, and in each gear arms that show how it turns."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Calculated, Disc, Hinge, Wheel

#: Arms of a gear as drawn, and where they begin and end, in pitch radii.
ARMS = 5
ENDS = {"inner": 0.25, "outer": 0.92}

_HALF, _GAP = 0.35 * math.pi / ARMS, math.pi / ARMS
#: One arm, about the x axis, from the middle of the gap before it to that behind it: which end, and the angle [rad].
ARM = (
    ("inner", -_GAP),
    ("inner", -_HALF),
    ("outer", -_HALF),
    ("outer", _HALF),
    ("inner", _HALF),
    ("inner", _GAP),
)

_PINION_HINGE, _WHEEL_HINGE = (0.0, 0.0), ("centre_distance", 0.0)


def _arms(gear: str) -> tuple[tuple[str, float], ...]:
    return tuple((f"outline_{gear}_{end}_radius", angle) for end, angle in ARM)


SHAPES = (
    Disc("pinion", _PINION_HINGE, "pinion_radius"),
    Disc("wheel", _WHEEL_HINGE, "wheel_radius"),
    Wheel("pinion's arms", _PINION_HINGE, "pinion_angle", ARMS, _arms("pinion")),
    Wheel("wheel's arms", _WHEEL_HINGE, "wheel_angle", ARMS, _arms("wheel")),
    Hinge(_PINION_HINGE),
    Hinge(_WHEEL_HINGE),
)


def form(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """Where the arms begin and end."""
    radii = {"pinion": values.pinion_radius, "wheel": values.wheel_radius}
    return tuple(
        Calculated(f"outline_{gear}_{end}_radius", share * radius, f"Drawing: {end} end of the {gear}'s arms", "m")
        for gear, radius in radii.items()
        for end, share in ENDS.items()
    )
