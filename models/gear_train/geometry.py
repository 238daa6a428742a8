"""What follows from the radii and inertias of a pair of external gears on fixed hinges."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace

from mechanism_fmu.model.functions import Number


@dataclass(frozen=True)
class GearPairing:
    """The pair.

    Attributes:
        centre_distance: R1 + R2, between the hinges [m].
        ratio: i = -R1/R2, of the wheel's speed over the pinion's.
        reduced_inertia: J1 + i^2 J2, of both gears seen at the pinion [kg m2].
    """

    centre_distance: Number
    ratio: Number
    reduced_inertia: Number


def pairing(values: SimpleNamespace) -> GearPairing:
    """The pair for parameter values."""
    ratio = -values.pinion_radius / values.wheel_radius
    return GearPairing(
        centre_distance=values.pinion_radius + values.wheel_radius,
        ratio=ratio,
        reduced_inertia=values.pinion_inertia + ratio * ratio * values.wheel_inertia,
    )
