"""Revolute-revolute composite joint."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..body import Point
from ..curves import Curve
from ..functions import Number
from .base import Effort, JointFacts


@dataclass(frozen=True)
class Distance(JointFacts):
    """A massless rod with a pin at either end (ME451, revolute-revolute composite).

    1. Allows: both bodies turn freely and point P_j moves on a circle about P_i; two degrees of freedom remain.
    2. Phi = d.d - C^2 with d = r_j^P - r_i^P, one row [m2]. C > 0: at C = 0 the row has no gradient (that is a pin).
    3. Phi_q = 2 [-d, -d.R a, d, d.R b] with a = A_i s_i and b = A_j s_j.
    4. nu = 0.
    5. gamma = -2 d'.d' - 2 d.(a phi_i'^2 - b phi_j'^2).

    Outputs: `force` [N], the tension of the rod: positive when it pulls.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: names of the two bodies (or `GROUND`).
        point_i, point_j: P in the frame of each body [m].
        distance: C [m], > 0.
    """

    row: ClassVar = "distance"
    efforts: ClassVar = {"force": Effort(0, "effort_factor")}
    sizes: ClassVar = ("distance",)
    motion: ClassVar[Curve | None] = None
    friction: ClassVar[Number] = 0.0

    name: str
    body_i: str
    point_i: Point
    body_j: str
    point_j: Point
    distance: Number

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: point_i, point_j, C."""
        return (*self.point_i, *self.point_j, self.distance)

    @property
    def effort_factor(self) -> Number:
        """From the multiplier [N/m] to the tension: |Phi_q| is twice the distance."""
        return -2 * self.distance
