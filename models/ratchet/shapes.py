"""How the ratchet is drawn from its variables: wheel, crank, pawl, hinges."""

from __future__ import annotations

from mechanism_fmu.model import Bar, Hinge, Striker, Wheel

_WHEEL_HINGE, _CRANK_HINGE = (0.0, 0.0), ("hinge_distance", 0.0)

#: The wheel's x axis passes through the root that is struck; from a root the slope runs clockwise to its apex.
SHAPES = (
    Wheel(
        "wheel",
        _WHEEL_HINGE,
        "wheel_angle",
        "tooth_count",
        (("wheel_inner_radius", 0.0), ("tooth_apex_radius", "tooth_apex_offset")),
        clockwise=True,
    ),
    Bar("crank", _CRANK_HINGE, "crank_angle", "crank_length"),
    Bar("pawl", "crank", "pawl_angle", "pawl_length"),
    Hinge(_WHEEL_HINGE),
    Hinge(_CRANK_HINGE),
    Hinge("crank"),
    Striker("pawl"),
)
