"""How the Geneva drive is drawn from its variables: slotted wheel, driver with locking disc and pin, hinges.

The form of the parts takes lengths and angles that follow from the parameters, `outline_*`; half of each outline is
enough, because both are symmetric about the x axis of their body.
"""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Bar, Calculated, Disc, Hinge, Wheel
from mechanism_fmu.model.functions import Number, atan2, cos, sin, sqrt
from mechanism_fmu.model.triangles import angle_between

from .geometry import geneva

#: Where polar points stand, in the order from the x axis outwards.
_WHEEL_POINTS = ("slot_end", "slot_side", "mouth", "rim", "arc", "inner_arc", "arc_middle")
_RELIEF_POINTS = ("relief_bottom", "relief", "disc_edge", "disc")

_WHEEL_HINGE, _DRIVER_HINGE = (0.0, 0.0), ("centre_distance", 0.0)


def _polar(name: str) -> tuple[str, str]:
    return f"outline_{name}_radius", f"outline_{name}_angle"


def _mirrored(names: tuple[str, ...]) -> tuple[tuple[str, str], ...]:
    """An outline that is symmetric about the x axis, counter-clockwise, from its lower half to its upper half."""
    upper = [_polar(name) for name in names]
    return (*((radius, f"-{angle}") for radius, angle in upper[:0:-1]), *upper)


#: The locking disc beyond 90 deg from the pin, where its rim is a full circle for every number of slots.
_FAR_SIDE = tuple((_polar("disc")[0], math.radians(angle)) for angle in range(90, 271, 10))

SHAPES = (
    Wheel("wheel", _WHEEL_HINGE, "wheel_angle", "slot_count", _mirrored(_WHEEL_POINTS)),
    Wheel("locking disc", _DRIVER_HINGE, "driver_angle", 1, (*_mirrored(_RELIEF_POINTS), *_FAR_SIDE)),
    Bar("driver", _DRIVER_HINGE, "driver_angle", "pin_radius"),
    Disc("pin", "driver", "outline_pin_radius"),
    Hinge(_WHEEL_HINGE),
    Hinge(_DRIVER_HINGE),
)


def form(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """The polar points of the outlines, and the radius of the pin."""
    points = {**_wheel(values), **_disc(values)}
    return (
        Calculated("outline_pin_radius", values.pin_diameter / 2, "Drawing: radius of the pin", "m"),
        *(
            port
            for name, (radius, angle) in points.items()
            for port in (
                Calculated(_polar(name)[0], radius, f"Drawing: radius at which '{name}' lies", "m"),
                Calculated(_polar(name)[1], angle, f"Drawing: angle at which '{name}' lies", "rad", "deg"),
            )
        ),
    )


def _wheel(values: SimpleNamespace) -> dict[str, tuple[Number, Number]]:
    """Upper half of slot 0 and half of the locking arc beyond it: around the driver's hinge, seen half a pitch away."""
    geometry, c, half = geneva(values), values.centre_distance, values.pin_diameter / 2
    R, r, away = geometry.mouth_radius, geometry.locking_radius, geometry.pitch / 2
    inner = c - geometry.pin_radius
    opening = _opening(values)
    arc, inner_arc = _seen(c, r, 2 * opening / 3), _seen(c, r, opening / 3)
    return {
        "slot_end": (inner - half, 0.0),
        "slot_side": (sqrt(inner * inner + half * half), atan2(half, inner)),
        "mouth": (R, atan2(half, R)),
        "rim": (R, away - _seen(c, r, opening)[1]),
        "arc": (arc[0], away - arc[1]),
        "inner_arc": (inner_arc[0], away - inner_arc[1]),
        "arc_middle": (c - r, away),
    }


def _disc(values: SimpleNamespace) -> dict[str, tuple[Number, Number]]:
    """The locking disc on the side of the pin: cut away by the wheel's outer circle, full from phi_0 on."""
    geometry, c = geneva(values), values.centre_distance
    R, edge = geometry.mouth_radius, geometry.engagement
    s = c * sin(edge / 2)
    between = (edge + math.pi / 2) / 2
    return {
        "relief_bottom": (c - R, 0.0),
        "relief": (c * cos(edge / 2) - sqrt(R * R - s * s), edge / 2),
        "disc_edge": (geometry.locking_radius, edge),
        "disc": (geometry.locking_radius, between),
    }


def _opening(values: SimpleNamespace) -> Number:
    """Half the angle [rad] over which the locking arc surrounds the driver's hinge: out to the wheel's outer circle."""
    geometry, c = geneva(values), values.centre_distance
    a, r = geometry.pin_radius, geometry.locking_radius
    cosine = (a * a + r * r) / (2 * c * r)
    return angle_between(cosine)


def _seen(c: Number, r: Number, angle: Number) -> tuple[Number, Number]:
    """Polar place, seen from the wheel, of the point at `r` and `angle` around the driver's hinge at the distance c."""
    x, y = c - r * cos(angle), r * sin(angle)
    return sqrt(x * x + y * y), atan2(y, x)
