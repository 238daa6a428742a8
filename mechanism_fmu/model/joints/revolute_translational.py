"""Revolute-translational composite joint."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..body import Point
from ..curves import Curve
from ..functions import Number
from .base import Effort, JointFacts
from .unit_vector import unit_vector


@dataclass(frozen=True)
class RevoluteTranslational(JointFacts):
    """A pin of `body_j` in a straight guide of `body_i`, with a massless slider between (ME451, of that name).

    1. Allows: point P_j slides along a line fixed in body i, and body j turns; two degrees of freedom remain.
    2. Phi = (R u_i).d - c with d = r_j^P - r_i^P, one row [m]: P_j is c to the left of the line through P_i along u_i.
    3. Phi_q = [-n, -u.d - n.R a, n, n.R b] with u = A_i u_i, n = R u, a = A_i s_i, b = A_j s_j.
    4. nu = 0.
    5. gamma = n.d phi_i'^2 + 2 u.d' phi_i' - n.(a phi_i'^2 - b phi_j'^2).

    Outputs: `force` [N], of the guide on the pin (body j): positive along R u_i, to the left of the guide.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: names of the two bodies (or `GROUND`); the guide is on body i.
        point_i: a point of the guide in the frame of body i [m].
        axis_i: direction of the guide in the frame of body i (any length > 0; u_i is its unit vector).
        point_j: P in the frame of body j [m].
        distance: c [m], of any sign.
    """

    row: ClassVar = "revolute_translational"
    efforts: ClassVar = {"force": Effort(0)}
    axes: ClassVar = ("axis_i",)
    motion: ClassVar[Curve | None] = None
    friction: ClassVar[Number] = 0.0

    name: str
    body_i: str
    point_i: Point
    axis_i: Point
    body_j: str
    point_j: Point
    distance: Number = 0.0

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: point_i, point_j, R u_i, c."""
        x, y = unit_vector(self.axis_i)
        return (*self.point_i, *self.point_j, -y, x, self.distance)
