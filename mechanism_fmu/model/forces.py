"""Force elements."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from .. import codes
from .body import GROUND
from .functions import Number


@dataclass(frozen=True)
class Torque:
    """A torque on `body`, counter-clockwise positive, with its reaction on `reaction`.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
        torque: [N m]; usually written by an `Input` with target "<name>.torque".
    """

    kind: ClassVar[int] = codes.TORQUE
    columns: ClassVar[dict[str, int]] = {"torque": codes.TORQUE_VALUE}

    name: str
    body: str
    reaction: str = GROUND
    torque: Number = 0.0

    def data(self) -> tuple[Number, ...]:
        """The element's row of the table `force_data`."""
        return (self.torque,)


@dataclass(frozen=True)
class TorsionSpring:
    """A torsion spring: torque on `body` = -(stiffness * (phi - phi_reaction - free_angle) + preload).

    The energy of the linear part counts as spring energy; the work of the preload, which an input may change at any
    time, counts as work done on the mechanism.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
        stiffness: [N m/rad], >= 0.
        free_angle: relative angle [rad] at which the linear part vanishes.
        preload: constant part of the torque that opposes positive rotation of `body` [N m].
    """

    kind: ClassVar[int] = codes.TORSION_SPRING
    columns: ClassVar[dict[str, int]] = {"preload": codes.SPRING_PRELOAD}

    name: str
    body: str
    reaction: str = GROUND
    stiffness: Number = 0.0
    free_angle: Number = 0.0
    preload: Number = 0.0

    def data(self) -> tuple[Number, ...]:
        """The element's row of the table `force_data`."""
        return (self.stiffness, self.free_angle, self.preload)


#: Any force element.
Force = Torque | TorsionSpring
