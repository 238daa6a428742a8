"""How the four-bar linkage is drawn from its variables: links and hinges."""

from __future__ import annotations

from mechanism_fmu.model import Bar, Hinge

_CRANK_HINGE, _ROCKER_HINGE = (0.0, 0.0), ("ground_length", 0.0)

SHAPES = (
    Bar("crank", _CRANK_HINGE, "crank_angle", "crank_length"),
    Bar("coupler", "crank", "coupler_angle", "coupler_length"),
    Bar("rocker", _ROCKER_HINGE, "rocker_angle", "rocker_length"),
    Hinge(_CRANK_HINGE),
    Hinge(_ROCKER_HINGE),
    Hinge("crank"),
    Hinge("coupler"),
)
