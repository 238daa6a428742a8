"""Forces at points of bodies: a force at the centre of mass or anywhere, a spring-damper and a bushing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from ..attached import Slot
from ..body import GROUND, Point
from ..errors import MechanismError
from ..functions import Number
from .base import Element, OneSided, PointElement, Quantity, length_quantities


@dataclass(frozen=True, init=False)
class Force(Element):
    """A force at the centre of mass of `body`, constant in the global frame, e.g. its weight.

    Attributes:
        name: unique within the mechanism.
        body: name of the body.
        force: (fx, fy) [N]; an `Input` may write "<name>.x" and "<name>.y". Its work counts as work done.

    Source: definition: the power of a force is force times the velocity of its point; docs/elements/force.md.
    """

    row: ClassVar = "force"
    writable: ClassVar = ("x", "y")
    acts: ClassVar = "at centre"
    reaction: ClassVar[str] = GROUND
    units: ClassVar = {"force": "N"}
    slots: ClassVar = (Slot("body"),)

    name: str
    body: str
    force: tuple[Number, Number] = (0.0, 0.0)

    def data(self) -> tuple[Number, ...]:
        """The element's row of the table `force_data`."""
        return self.force


@dataclass(frozen=True, init=False)
class SpringDamper(PointElement):
    """A spring, a damper and a constant force side by side between two points (ME451's TSDA).

    With the distance l of the points, the force that pulls them together is

        f = stiffness (l - free_length) + damping l' + preload.

    One-sided "stretched", it is there only where l > free_length, and only pulls: a rope. One-sided "compressed", it is
    there only where l < free_length, and only pushes: a bumper. The energy of the linear part counts as spring energy,
    the work of the preload as work done on the mechanism, and the rest as lost. Where the points meet, the force acts
    along their relative velocity; where they rest there, it has no direction and vanishes. Where joints keep them
    together but for rounding, its direction is made of rounding: between the points of a `Revolute` it is refused.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies (or `GROUND`).
        point, reaction_point: the points, in the frame of each body [m].
        stiffness: of the spring [N/m], >= 0.
        free_length: distance at which the linear part vanishes [m], >= 0.
        damping: of the damper [N s/m], >= 0.
        preload: constant part of the force [N], pulling positive; an actuator where an `Input` writes
            "<name>.preload".
        one_sided: "no", "stretched" or "compressed".

    Raises:
        MechanismError: `one_sided` is another word.
    """

    row: ClassVar = "spring_damper"
    writable: ClassVar = ("preload",)
    quantities: ClassVar = length_quantities("preload")
    not_negative: ClassVar = {"stiffness": "N/m", "free_length": "m", "damping": "N.s/m"}
    units: ClassVar = {**not_negative, "preload": "N"}

    stiffness: Number = 0.0
    free_length: Number = 0.0
    damping: Number = 0.0
    preload: Number = 0.0
    one_sided: OneSided = "no"


@dataclass(frozen=True, init=False)
class PointForce(Element):
    """A force at any point of `body`, with directions that are global or turn with the body.

    Attributes:
        name: unique within the mechanism.
        body: name of the body.
        point: where it acts, in the frame of the body [m].
        force: (fx, fy) [N]; an `Input` may write "<name>.x" and "<name>.y". Its work counts as work done.
        frame: "global" or "body": the frame of its directions.

    Raises:
        MechanismError: `frame` is another word.

    Source: definition: the power of a force is force times the velocity of its point; docs/elements/force.md.
    """

    row: ClassVar = "point_force"
    writable: ClassVar = ("x", "y")
    quantities: ClassVar = {"power": Quantity("W", "Power that the body gets", ("x", "y"))}
    acts: ClassVar = "at points"
    reaction: ClassVar[str] = GROUND
    units: ClassVar = {"force": "N"}
    slots: ClassVar = (Slot("body", "point"),)

    name: str
    body: str
    point: Point = (0.0, 0.0)
    force: tuple[Number, Number] = (0.0, 0.0)
    frame: Literal["global", "body"] = "global"

    def data(self) -> tuple[Number, ...]:
        """The element's row of the table `force_data`.

        Raises:
            MechanismError: `frame` is another word than those two.
        """
        if self.frame not in ("global", "body"):
            raise MechanismError(f"PointForce {self.name!r}: frame = {self.frame!r} is neither global nor body.")
        return (*self.point, *self.force, float(self.frame == "body"))


@dataclass(frozen=True, init=False)
class Bushing(PointElement):
    """A rubber bushing: a spring and a damper for each direction of the frame of `reaction`, and for the angle.

    With the point of `body` at (x, y) from that of `reaction`, in the frame of `reaction`, and the relative angle a
    less `free_angle`, the bushing acts on `body` at its point with (-stiffness_x x - damping_x x', -stiffness_y y -
    damping_y y') and the torque -torsional_stiffness a - torsional_damping a'. Its reaction acts at the same place, so
    that momenta are kept however far it gives way.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies (or `GROUND`).
        point, reaction_point: the points, in the frame of each body [m].
        stiffness_x, stiffness_y: along the axes of the frame of `reaction` [N/m], >= 0.
        damping_x, damping_y: along the same [N s/m], >= 0.
        torsional_stiffness: against the relative angle [N m/rad], >= 0.
        torsional_damping: against its rate [N m s/rad], >= 0.
        free_angle: relative angle phi - phi_reaction without torque [rad].

    Source: Hooke's law and linear viscous friction, for each direction and the angle; docs/elements/bushing.md.
    """

    row: ClassVar = "bushing"
    quantities: ClassVar = {
        "x": Quantity("m", "Deflection along x of the reaction's frame"),
        "y": Quantity("m", "Deflection along y of the reaction's frame"),
        "angle": Quantity("rad", "Twist"),
        "force_x": Quantity("N", "Force on the body along x of the reaction's frame"),
        "force_y": Quantity("N", "Force on the body along y of the reaction's frame"),
        "torque": Quantity("N.m", "Torque on the body"),
        "power": Quantity("W", "Power that the bodies get"),
    }
    not_negative: ClassVar = {
        "stiffness_x": "N/m",
        "stiffness_y": "N/m",
        "damping_x": "N.s/m",
        "damping_y": "N.s/m",
        "torsional_stiffness": "N.m/rad",
        "torsional_damping": "N.m.s/rad",
    }
    units: ClassVar = {**not_negative, "free_angle": "rad"}

    stiffness_x: Number = 0.0
    stiffness_y: Number = 0.0
    damping_x: Number = 0.0
    damping_y: Number = 0.0
    torsional_stiffness: Number = 0.0
    torsional_damping: Number = 0.0
    free_angle: Number = 0.0
