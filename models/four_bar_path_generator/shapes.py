"""How the path generator is drawn from its variables: links, hinges and the path point, all as if they were rigid."""

from __future__ import annotations

from mechanism_fmu.model import Bar, Disc, Hinge, Wheel

_CRANK_HINGE, _ROCKER_HINGE = (0.0, 0.0), ("ground_length", 0.0)

#: Pin, pin and path point, in polar coordinates of the coupler.
_PLATE = ((0.0, 0.0), ("coupler_length", 0.0), ("arm_length", "arm_angle"))

SHAPES = (
    Bar("crank", _CRANK_HINGE, "crank_angle", "crank_length"),
    Wheel("coupler with arm", "crank", "coupler_angle", 1, _PLATE),
    Bar("coupler", "crank", "coupler_angle", "coupler_length"),
    Bar("rocker", _ROCKER_HINGE, "rocker_angle", "rocker_length"),
    Hinge(_CRANK_HINGE),
    Hinge(_ROCKER_HINGE),
    Hinge("crank"),
    Hinge("coupler"),
    Disc("path point", ("path_x", "path_y"), "outline_path_radius"),
)
