"""How the cam drive is drawn from its variables: cam, follower arm, roller, hinges.

The cam's outline takes radii that follow from the parameters, `outline_cam_<degrees>`.
"""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Bar, Calculated, Disc, Hinge, Striker, Wheel

from .geometry import radius_at

#: Angles of the profile at which the outline is drawn [deg].
_DEGREES = tuple(range(0, 360, 10))

_CAM_HINGE, _FOLLOWER_HINGE = (0.0, 0.0), ("-hinge_distance", 0.0)


def _name(degrees: int) -> str:
    return f"outline_cam_{degrees:03d}"


SHAPES = (
    Wheel("cam", _CAM_HINGE, "cam_angle", 1, tuple((_name(d), math.radians(d)) for d in _DEGREES)),
    Bar("follower", _FOLLOWER_HINGE, "follower_angle", "follower_length"),
    Disc("roller", "follower", "roller_radius"),
    Hinge(_CAM_HINGE),
    Hinge(_FOLLOWER_HINGE),
    Striker("follower"),
)


def form(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """The radii of the outline."""
    return tuple(
        Calculated(
            _name(degrees),
            radius_at(values, math.radians(degrees)),
            f"Drawing: radius of the cam at {degrees} deg of its profile",
            "m",
        )
        for degrees in _DEGREES
    )
