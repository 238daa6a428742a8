"""Rack and pinion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..body import Point
from ..curves import Curve
from ..functions import Number
from .base import Effort, JointFacts


@dataclass(frozen=True)
class RackAndPinion(JointFacts):
    """A rack, body i, on which the pitch circle of a pinion, body j, rolls (ME451, rack and pinion).

    1. Allows: rolling along the rack, one relative degree of freedom.
    2. Phi = (n.(r_j^P - r_i^P) - R_j, u.(r_j^P - r_i^Q) + R_j (phi_j + th_j - phi_i - th_u + pi/2)), two rows [m], with
       u = A_i (cos th_u, sin th_u) along the rack and n = R u towards the pinion.
    3. Phi_q: of both rows [-w, (R w).d - w.R a, w, w.R b] with w = n, then w = u; the second has R_j less in phi_i and
       R_j more in phi_j.
    4. nu = 0.
    5. gamma = w.d phi_i'^2 - 2 (R w).d' phi_i' - w.(a phi_i'^2 - b phi_j'^2) of either row.

    Outputs: `force` [N], on the pinion along the rack, and `normal_force` [N], on the pinion away from the rack.

    Traps: unlike the row of gears these rows do keep the distance, so that a guide and a pin beside them repeat it;
    angles must count turns, as those of bodies do: after a turn the pinion is 2 pi R_j further.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: names of the rack and the pinion (or `GROUND`).
        point_i: P, a point of the pitch line in the frame of the rack [m].
        origin_i: Q, the point of the pitch line that the pinion's marked point meets, in the frame of the rack [m].
        direction_i: th_u, angle of the rack in its own frame [rad]; the pinion is on its left.
        point_j: centre of the pinion in its own frame [m].
        radius_j: R_j, of the pitch circle [m], > 0.
        angle_j: th_j, direction of the marked point in the frame of the pinion [rad].
    """

    row: ClassVar = "rack_and_pinion"
    efforts: ClassVar = {"force": Effort(1), "normal_force": Effort(0)}
    sizes: ClassVar = ("radius_j",)
    rows: ClassVar = 2
    motion: ClassVar[Curve | None] = None
    friction: ClassVar[Number] = 0.0

    name: str
    body_i: str
    point_i: Point
    origin_i: Point
    direction_i: Number
    body_j: str
    radius_j: Number
    angle_j: Number = 0.0
    point_j: Point = (0.0, 0.0)

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: P, Q, th_u, point_j, R_j, th_j."""
        return (*self.point_i, *self.origin_i, self.direction_i, *self.point_j, self.radius_j, self.angle_j)
