"""Driver of x."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from .base import Effort
from .point_driver import PointDriver


@dataclass(frozen=True)
class XDriver(PointDriver):
    """Point P_j moves in x as a function of time prescribes (ME451, absolute and relative x driver).

    1. Allows: any motion in y, and any angles; prescribes one degree of freedom.
    2. Phi = x_j^P - x_i^P - C(t), one row [m].
    3. Phi_q = [-1, 0, (A_i s_i)_y, 1, 0, -(A_j s_j)_y].
    4. nu = C'.
    5. gamma = -(A_i s_i)_x phi_i'^2 + (A_j s_j)_x phi_j'^2 + C''.

    Outputs: `force` [N], of the driver on body j along x.

    Attributes: as of `PointDriver`.
    """

    row: ClassVar = "x_driver"
    efforts: ClassVar = {"force": Effort(0)}
