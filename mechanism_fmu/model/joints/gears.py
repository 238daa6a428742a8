"""External and internal gears, rack and pinion."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from ..attached import Slot
from ..body import Point
from ..findings import Finding, plain, refuse_unless
from ..functions import Number
from .base import Effort, UndrivenJoint

# What external and internal gears have in common.


@dataclass(frozen=True, init=False)
class GearPair(UndrivenJoint):
    """Two gears, as of `Gears`."""

    efforts: ClassVar = {"force": Effort(0, -1.0)}
    sizes: ClassVar = ("radius_i", "radius_j")
    slots: ClassVar = (Slot("body_i", "point_i"), Slot("body_j", "point_j"))
    units: ClassVar = {"radius_i": "m", "angle_i": "rad", "radius_j": "m", "angle_j": "rad"}

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


# External gears.


@dataclass(frozen=True, init=False)
class Gears(GearPair):
    """Two external gears whose pitch circles roll on each other (ME451, gears, convex-convex).

    1. Allows: what keeps the rolling; two degrees of freedom remain of three (with the distance of the centres kept).
    2. Phi = d.n, one row [m], with d = r_j^P - r_i^P between the centres, n = (-sin th, cos th) and
       th = (R_i (phi_i + th_i) + R_j (phi_j + th_j - pi)) / (R_i + R_j): the line of centres has the angle th.
    3. Phi_q = [-n, -n.R a - k_i t.d, n, n.R b - k_j t.d] with t = (cos th, sin th), k = R / (R_i + R_j).
    4. nu = 0.
    5. gamma = n.d th'^2 + 2 t.d' th' - n.(a phi_i'^2 - b phi_j'^2).

    Outputs: `force` [N], tangential: positive when its torque on body i, force times R_i, is.

    Traps: the row does not keep the centres R_i + R_j apart (give each gear a pin on a carrier or the ground, or join
    the centres by a `Distance`); it also accepts centres that stand opposite, so start near the right side; angles must
    count turns, as those of bodies do: 2 pi more on one gear is another mesh.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: names of the two bodies (or `GROUND`).
        radius_i, radius_j: of the pitch circles [m], > 0.
        angle_i, angle_j: th_i and th_j, direction in each body's frame of the points that meet on the line of centres
            [rad].
        point_i, point_j: centres in the frame of each body [m].
    """

    row: ClassVar = "gears"


# A ring and a gear inside it.


@dataclass(frozen=True, init=False)
class InternalGears(GearPair):
    """A ring, body i, and a gear inside it, body j, whose pitch circles roll on each other (ME451, concave-convex).

    1. Allows: what keeps the rolling; two degrees of freedom remain of three (with the distance of the centres kept).
    2. Phi = d.n, one row [m], as of `Gears` but th = (R_i (phi_i + th_i) - R_j (phi_j + th_j)) / (R_i - R_j).
    3. Phi_q as of `Gears`, with k_i = R_i / (R_i - R_j) and k_j = -R_j / (R_i - R_j).
    4. nu = 0.
    5. gamma as of `Gears`.

    Outputs: `force` [N], as of `Gears`.

    Traps: as of `Gears`; here the centres must be kept R_i - R_j apart.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: names of the ring and the gear (or `GROUND`).
        radius_i, radius_j: of the pitch circles [m]; 0 < radius_j < radius_i.
        angle_i, angle_j: th_i and th_j, direction in each body's frame of the points that meet on the line of centres
            [rad].
        point_i, point_j: centres in the frame of each body [m].
    """

    row: ClassVar = "internal_gears"

    def findings(self) -> Iterator[Finding]:
        """Those of gears, and that the ring must be the larger one."""
        yield from super().findings()
        text = (
            f"{self.label}: the ring's radius_i = {{:g}} m must be larger than radius_j = {{:g}} m of the gear inside."
        )
        yield refuse_unless(plain(self.radius_i) - plain(self.radius_j), text, self.radius_i, self.radius_j)


# Rack and pinion.


@dataclass(frozen=True, init=False)
class RackAndPinion(UndrivenJoint):
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
    slots: ClassVar = (
        Slot("body_i", "point_i", "direction_i", "angle"),
        Slot("body_j", "point_j"),
        Slot("body_i", "origin_i", name="origin_i"),
    )
    units: ClassVar = {"direction_i": "rad", "radius_j": "m", "angle_j": "rad"}

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
