"""Driver of a distance."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from ..check_curves import least_value
from ..conditions import positive
from ..findings import Finding, refuse_unless
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

    row: ClassVar = "distance_driver"

    def findings(self) -> Iterator[Finding]:
        """That the distance comes to nothing."""
        if not self.motion.pieces:
            return
        least = least_value(self.motion)
        text = (
            f"{self.label}: its motion comes to a distance of {{:.6g}} m, but it must stay above 0: where the two "
            "points meet, nothing says in which direction they part. Give another motion."
        )
        yield refuse_unless(positive(least), text, least)
