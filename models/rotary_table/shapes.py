"""How the rotary table is drawn from its variables: the table with its stations, and the brake's disc."""

from __future__ import annotations

import math

from mechanism_fmu.model import Calculated, Disc, Hinge, Wheel

#: Radii as drawn [m]; the table's equations know none.
RIM, STATION, BRAKE = 0.13, 0.115, 0.05
STATIONS = 10

_HALF, _GAP = 0.6 * math.pi / STATIONS, math.pi / STATIONS
#: One station, about the x axis, from the middle of the gap before it to that behind it: radius [m], angle [rad].
OUTLINE = ((RIM, -_GAP), (RIM, -_HALF), (STATION, -_HALF), (STATION, _HALF), (RIM, _HALF), (RIM, _GAP))

SHAPES = (
    Wheel("table", (0.0, 0.0), "table_angle", STATIONS, OUTLINE),
    Disc("brake", (0.0, 0.0), "outline_brake_radius"),
    Hinge((0.0, 0.0)),
)


def form() -> tuple[Calculated, ...]:
    """The radius of the brake's disc."""
    return (Calculated("outline_brake_radius", BRAKE, "Drawing: radius of the brake's disc", "m"),)
