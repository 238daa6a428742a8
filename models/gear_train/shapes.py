"""How the gear train is drawn from its variables: pitch circles, and in each gear arms that show how it turns."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Calculated, Disc, Hinge, Wheel

#: Arms of a gear as drawn, and where their polygon turns in and out, in pitch radii.
ARMS, INNER, OUTER = 5, 0.25, 0.92

_PINION_HINGE, _WHEEL_HINGE = (0.0, 0.0), ("centre_distance", 0.0)
_HALF_ARM = 0.35 * math.pi / ARMS


def _arms(gear: str) -> tuple[tuple[str, float], ...]:
    """One arm, from the gap before it to the gap behind it; the first of the arms points along the x axis."""
    inner, outer = f"outline_{gear}_inner_radius", f"outline_{gear}_outer_radius"
    half = math.pi / ARMS
    return (
        (inner, -half),
        (inner, -_HALF_ARM),
        (outer, -_HALF_ARM),
        (outer, _HALF_ARM),
        (inner, _HALF_ARM),
        (inner, half),
    )


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
        for end, share in (("inner", INNER), ("outer", OUTER))
    )
