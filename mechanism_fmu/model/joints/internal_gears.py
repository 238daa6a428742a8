"""A ring and a gear inside it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from ..conditions import plain
from ..findings import Finding, refuse_unless
from .gear_pair import GearPair


@dataclass(frozen=True)
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
