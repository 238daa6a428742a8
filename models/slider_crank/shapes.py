"""How the slider-crank is drawn from its variables: guide, crank, rod, slider, hinges.

The slider's size follows from the crank's: its outline and the guide take calculated parameters, `outline_*`.
"""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Bar, Calculated, Hinge, Wheel

from .geometry import dead_positions

#: Half the length and half the height of the slider as drawn, in crank lengths.
HALF_LENGTH, HALF_HEIGHT = 0.4, 0.24

_CRANK_HINGE = (0.0, 0.0)
_CORNER = math.atan2(HALF_HEIGHT, HALF_LENGTH)
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
