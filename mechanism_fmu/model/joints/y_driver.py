"""Driver of y."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from .base import Effort
from .point_driver import PointDriver


@dataclass(frozen=True)
class YDriver(PointDriver):
    """Point P_j moves in y as a function of time prescribes (ME451, absolute and relative y driver).

    1. Allows: any motion in x, and any angles; prescribes one degree of freedom.
    2. Phi = y_j^P - y_i^P - C(t), one row [m].
    3. Phi_q = [0, -1, -(A_i s_i)_x, 0, 1, (A_j s_j)_x].
    4. nu = C'.
    5. gamma = -(A_i s_i)_y phi_i'^2 + (A_j s_j)_y phi_j'^2 + C''.

    Outputs: `force` [N], of the driver on body j along y.

    Attributes: as of `PointDriver`.
    """

    row: ClassVar = "y_driver"
    efforts: ClassVar = {"force": Effort(0)}
