"""What drivers between two points have in common."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..body import GROUND, Point
from ..curves import Curve
from ..functions import Number
from .base import JointFacts


@dataclass(frozen=True)
class PointDriver(JointFacts):
    """A driver of point P of body j against point P of body i.

    Attributes:
        name: unique within the mechanism.
        body_j, point_j: body, and P in its frame [m], that are driven.
        motion: C(t) [m], with two derivatives.
        body_i, point_i: what they are driven against: the ground at its origin unless given.
    """

    friction: ClassVar[Number] = 0.0

    name: str
    body_j: str
    point_j: Point
    motion: Curve
    body_i: str = GROUND
    point_i: Point = (0.0, 0.0)

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: point_i, point_j."""
        return (*self.point_i, *self.point_j)
