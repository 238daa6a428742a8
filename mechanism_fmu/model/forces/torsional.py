"""Torques between two bodies: torque, springs, damper, and a shaft that is turned from outside."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..functions import Number
from .base import OneSided, Quantity, TorqueElement, angle_quantities


@dataclass(frozen=True, init=False)
class Torque(TorqueElement):
    """A torque on `body`, counter-clockwise positive, with its reaction on `reaction`.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
        torque: counter-clockwise on `body` [N m]; usually written by an `Input` with target "<name>.torque".

    Source: definition: the power of a couple is torque times the relative speed; docs/elements/torque.md.
    """

    row: ClassVar = "torque"
    writable: ClassVar = ("torque",)
    units: ClassVar = {"torque": "N.m"}

    torque: Number = 0.0


@dataclass(frozen=True, init=False)
class TorsionSpring(TorqueElement):
    """A torsion spring: torque on `body` = -(stiffness * (phi - phi_reaction - free_angle) + preload).

    The energy of the linear part counts as spring energy; the work of the preload, which an input may change at any
    time, counts as work done on the mechanism.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
        stiffness: of the spring [N m/rad], >= 0.
        free_angle: relative angle phi - phi_reaction [rad] at which the linear part vanishes.
        preload: constant part of the torque that opposes positive rotation of `body` [N m].

    Source: Hooke's law of an angle; docs/elements/torsion_spring.md.
    """

    row: ClassVar = "torsion_spring"
    writable: ClassVar = ("preload",)
    not_negative: ClassVar = {"stiffness": "N.m/rad"}
    units: ClassVar = {**not_negative, "free_angle": "rad", "preload": "N.m"}

    stiffness: Number = 0.0
    free_angle: Number = 0.0
    preload: Number = 0.0


@dataclass(frozen=True, init=False)
class Damper(TorqueElement):
    """A viscous damper: torque on `body` = -damping * (phi' - phi_reaction'). What it takes counts as energy lost.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
        damping: torque per relative speed [N m s/rad], >= 0.

    Source: linear viscous friction; docs/elements/torsion_spring.md.
    """

    row: ClassVar = "damper"
    not_negative: ClassVar = {"damping": "N.m.s/rad"}
    units: ClassVar = not_negative

    damping: Number = 0.0


@dataclass(frozen=True, init=False)
class CompliantShaft(TorqueElement):
    """A shaft whose other end is moved from outside.

    Torque on `body` = stiffness * (angle - (phi - phi_reaction)) + damping * (speed - (phi' - phi_reaction')). All of
    it counts as work done on the mechanism.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
        stiffness: of the shaft [N m/rad], >= 0.
        damping: of the shaft [N m s/rad], >= 0.
        angle: of the driven end [rad]; usually written by an `Input` with target "<name>.angle".
        speed: of the driven end [rad/s]; usually written by an `Input` with target "<name>.speed".

    Source: Hooke's law and linear viscous friction side by side; docs/elements/compliant_shaft.md.
    """

    row: ClassVar = "shaft"
    writable: ClassVar = ("angle", "speed")
    quantities: ClassVar = {"torque": Quantity("N.m", "Torque of the shaft on its body", ("angle", "speed"))}
    not_negative: ClassVar = {"stiffness": "N.m/rad", "damping": "N.m.s/rad"}
    units: ClassVar = {**not_negative, "angle": "rad", "speed": "rad/s"}

    stiffness: Number = 0.0
    damping: Number = 0.0
    angle: Number = 0.0
    speed: Number = 0.0


@dataclass(frozen=True, init=False)
class TorsionSpringDamper(TorqueElement):
    """A torsion spring, a damper and a constant torque side by side (ME451's RSDA); with an end stop's one side.

    With the angle phi - phi_reaction, the torque on `body` is -m,

        m = stiffness (angle - free_angle) + damping angle' + preload.

    One-sided "stretched", it is there only where angle > free_angle, and never negative: an elastic end stop, which
    does not hold back; "compressed" likewise, where angle < free_angle. The energy of the linear part counts as spring
    energy, the work of the preload as work done on the mechanism, and the rest as lost.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
        stiffness: of the spring [N m/rad], >= 0.
        free_angle: relative angle phi - phi_reaction [rad] at which the linear part vanishes.
        damping: of the damper [N m s/rad], >= 0.
        preload: constant part of m [N m], against positive rotation of `body`; an `Input` may write "<name>.preload".
        one_sided: "no", "stretched" or "compressed".

    Raises:
        MechanismError: `one_sided` is another word.
    """

    row: ClassVar = "torsion_spring_damper"
    writable: ClassVar = ("preload",)
    quantities: ClassVar = angle_quantities("preload")
    not_negative: ClassVar = {"stiffness": "N.m/rad", "damping": "N.m.s/rad"}
    units: ClassVar = {**not_negative, "free_angle": "rad", "preload": "N.m"}

    stiffness: Number = 0.0
    free_angle: Number = 0.0
    damping: Number = 0.0
    preload: Number = 0.0
    one_sided: OneSided = "no"
