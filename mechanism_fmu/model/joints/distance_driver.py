"""Driver of a distance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ... import codes
from .point_driver import PointDriver


@dataclass(frozen=True)
class DistanceDriver(PointDriver):
    """Two points keep the distance that a function of time prescribes (ME451, absolute and relative distance driver).

    1. Allows: P_j moves on a circle about P_i whose radius is prescribed, and the bodies turn.
    2. Phi = d.d - C(t)^2 with d = r_j^P - r_i^P, one row [m2]. C must not pass 0, where the row has no gradient.
    3. Phi_q = 2 [-d, -d.R a, d, d.R b] with a = A_i s_i and b = A_j s_j.
    4. nu = 2 C C'.
    5. gamma = -2 d'.d' - 2 d.(a phi_i'^2 - b phi_j'^2) + 2 (C'^2 + C C'').

    Attributes: as of `PointDriver`, with C > 0.
    """

    kind: ClassVar[int] = codes.DISTANCE_DRIVER
