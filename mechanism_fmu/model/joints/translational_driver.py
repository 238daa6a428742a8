"""Driver along an axis."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..body import GROUND, Point
from ..curves import Curve
from ..functions import Number
from .base import Effort, JointFacts
from .unit_vector import unit_vector


@dataclass(frozen=True)
class TranslationalDriver(JointFacts):
    """Point P_j moves along an axis of body i as a function of time prescribes (ME451, translational driver).

    1. Allows: any motion across the axis, and any angles; prescribes one degree of freedom.
    2. Phi = u_i.d - C(t) with d = r_j^P - r_i^P, one row [m].
    3. Phi_q = [-u, (R u).d - u.R a, u, u.R b] with u = A_i u_i, a = A_i s_i, b = A_j s_j.
    4. nu = C'.
    5. gamma = u.d phi_i'^2 - 2 (R u).d' phi_i' - u.(a phi_i'^2 - b phi_j'^2) + C''.

    Outputs: `force` [N], of the driver on body j along u_i.

    Attributes:
        name: unique within the mechanism.
        body_j, point_j: body, and P in its frame [m], that are driven.
        axis_i: direction of the axis in the frame of body i (any length > 0; u_i is its unit vector).
        motion: C(t) [m], with two derivatives.
        body_i, point_i: what they are driven against: the ground at its origin unless given.
    """

    row: ClassVar = "translational_driver"
    efforts: ClassVar = {"force": Effort(0)}
    axes: ClassVar = ("axis_i",)
    friction: ClassVar[Number] = 0.0

    name: str
    body_j: str
    point_j: Point
    axis_i: Point
    motion: Curve
    body_i: str = GROUND
    point_i: Point = (0.0, 0.0)

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: point_i, point_j, u_i."""
        return (*self.point_i, *self.point_j, *unit_vector(self.axis_i))
