"""External gears."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from .gear_pair import GearPair


@dataclass(frozen=True)
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
