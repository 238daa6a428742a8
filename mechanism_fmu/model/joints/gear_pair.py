"""What external and internal gears have in common."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..body import Point
from ..curves import Curve
from ..functions import Number
from .base import Effort, JointFacts


@dataclass(frozen=True)
class GearPair(JointFacts):
    """Two gears, as of `Gears`."""

    efforts: ClassVar = {"force": Effort(0, -1.0)}
    sizes: ClassVar = ("radius_i", "radius_j")
    motion: ClassVar[Curve | None] = None
    friction: ClassVar[Number] = 0.0

    name: str
    body_i: str
    radius_i: Number
    angle_i: Number
    body_j: str
    radius_j: Number
    angle_j: Number
    point_i: Point = (0.0, 0.0)
    point_j: Point = (0.0, 0.0)

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: point_i, point_j, R_i, th_i, R_j, th_j."""
        return (*self.point_i, *self.point_j, self.radius_i, self.angle_i, self.radius_j, self.angle_j)
