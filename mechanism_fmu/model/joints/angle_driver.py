"""Driver of an angle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..body import GROUND
from ..curves import Curve
from ..functions import Number
from .base import Effort, JointFacts


@dataclass(frozen=True)
class AngleDriver(JointFacts):
    """A body turns as a function of time prescribes (ME451, absolute and relative angle driver).

    1. Allows: any motion of the points; prescribes one degree of freedom.
    2. Phi = phi_j - phi_i - C(t), one row [rad]; angles count turns.
    3. Phi_q = [0, 0, -1, 0, 0, 1].
    4. nu = C'.
    5. gamma = C''.

    Outputs: `torque` [N m], of the driver on body j.

    Attributes:
        name: unique within the mechanism.
        body_j: the body that is driven.
        motion: C(t) [rad], with two derivatives.
        body_i: what it is driven against: the ground unless given.
    """

    row: ClassVar = "angle_driver"
    efforts: ClassVar = {"torque": Effort(0, unit="N.m")}
    friction: ClassVar[Number] = 0.0

    name: str
    body_j: str
    motion: Curve
    body_i: str = GROUND

    def data(self) -> tuple[Number, ...]:
        """The joint's row of the table `joint_data`: nothing."""
        return ()
