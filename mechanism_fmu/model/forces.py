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


@dataclass(frozen=True)
class Damper:
    """A viscous damper: torque on `body` = -damping * (phi' - phi_reaction'). What it takes counts as energy lost.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
        damping: [N m s/rad], >= 0.
    """

    kind: ClassVar[int] = codes.DAMPER
    columns: ClassVar[dict[str, int]] = {}

    name: str
    body: str
    reaction: str = GROUND
    damping: Number = 0.0

    def data(self) -> tuple[Number, ...]:
        """The element's row of the table `force_data`."""
        return (self.damping,)


@dataclass(frozen=True)
class CompliantShaft:
    """A shaft whose other end is moved from outside.

    Torque on `body` = stiffness * (angle - (phi - phi_reaction)) + damping * (speed - (phi' - phi_reaction')). All of
    it counts as work done on the mechanism.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
        stiffness: [N m/rad], >= 0.
        damping: [N m s/rad], >= 0.
        angle: of the driven end [rad]; usually written by an `Input` with target "<name>.angle".
        speed: of the driven end [rad/s]; usually written by an `Input` with target "<name>.speed".
    """

    kind: ClassVar[int] = codes.SHAFT
    columns: ClassVar[dict[str, int]] = {"angle": codes.SHAFT_ANGLE, "speed": codes.SHAFT_SPEED}

    name: str
    body: str
    reaction: str = GROUND
    stiffness: Number = 0.0
    damping: Number = 0.0
    angle: Number = 0.0
    speed: Number = 0.0

    def data(self) -> tuple[Number, ...]:
        """The element's row of the table `force_data`."""
        return (self.stiffness, self.damping, self.angle, self.speed)


@dataclass(frozen=True)
class Force:
    """A force at the centre of mass of `body`, constant in the global frame, e.g. its weight.

    Attributes:
        name: unique within the mechanism.
        body: name of the body.
        force: (fx, fy) [N]; an `Input` may write "<name>.x" and "<name>.y". Its work counts as work done.
    """

    kind: ClassVar[int] = codes.FORCE
    columns: ClassVar[dict[str, int]] = {"x": codes.FORCE_X, "y": codes.FORCE_Y}
    reaction: ClassVar[str] = GROUND

    name: str
    body: str
    force: tuple[Number, Number] = (0.0, 0.0)

    def data(self) -> tuple[Number, ...]:
        """The element's row of the table `force_data`."""
        return self.force


#: Any force element.
ForceElement = Torque | TorsionSpring | Damper | CompliantShaft | Force
