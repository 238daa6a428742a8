"""Drives: a brake or clutch, and a motor with its controller."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..functions import Number
from .base import Quantity, TorqueElement


@dataclass(frozen=True, init=False)
class Brake(TorqueElement):
    """A brake or clutch with Coulomb friction: it holds two bodies together up to a torque, and slips beyond.

    While it holds nothing turns, as if the bodies were one; while it slips its torque is `limit` against the slip.
    Outputs: "<name>.friction_force" [N m], its torque on `body`, "<name>.slip_speed" [rad/s] and "<name>.sticks". In
    impacts it has no part: a torque is no impulse.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
        limit: largest torque [N m], >= 0; an `Input` may write "<name>.limit".

    Source: Coulomb friction, -torque in limit Sgn(slip): Glocker, Pfeiffer, Nonlinear Dynamics 7 (1995) 471.
    """

    row: ClassVar = "brake"
    rubs: ClassVar = True
    writable: ClassVar = ("limit",)
    not_negative: ClassVar = {"limit": "N.m"}
    units: ClassVar = {**not_negative}

    limit: Number = 0.0


@dataclass(frozen=True, init=False)
class DCMotor(TorqueElement):
    """A direct-current motor between two bodies, with a PI controller of its speed whose voltage is limited.

    With the speed w = phi' - phi_reaction' and e = speed - w: torque on `body` = constant * i,

        inductance i' = u - resistance i - constant w      v = gain e + integral_gain z      u = v, within +-voltage
        z' = e + anti_windup (u - v)

    i and z are 0 at the start. All of u i counts as work done, resistance i^2 as lost, inductance i^2 / 2 as spring
    energy.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies: rotor and housing.
        constant: of torque and of back electromotive force [N m/A = V s/rad].
        resistance: of the armature [ohm], >= 0.
        inductance: of the armature [H], > 0.
        voltage: the controller's limit [V], >= 0; an `Input` may write "<name>.voltage".
        gain: of the controller, on the error of speed [V s/rad], >= 0.
        integral_gain: of the controller, on the integral of that error [V/rad], >= 0.
        anti_windup: by how much the integral gives way to the limit [rad/(V s)], >= 0; within 1 / (anti_windup
            integral_gain) [s].
        speed: wanted, of the body from its reaction [rad/s]; usually written by an `Input` with target "<name>.speed".

    Source: textbook: voltage law of the armature, back electromotive force, PI control with tracking anti-windup;
        docs/decisions/021-motor.md.
    """

    row: ClassVar = "dc_motor"
    writable: ClassVar = ("voltage", "speed")
    quantities: ClassVar = {
        "torque": Quantity("N.m", "Torque of the motor on its body"),
        "current": Quantity("A", "Current in the armature"),
        "voltage": Quantity("V", "Voltage that the controller gives", ("voltage", "speed")),
    }
    positive: ClassVar = {"inductance": "H"}
    not_negative: ClassVar = {
        "resistance": "ohm",
        "voltage": "V",
        "gain": "V.s/rad",
        "integral_gain": "V/rad",
        "anti_windup": "rad/(V.s)",
    }
    own: ClassVar = 2
    units: ClassVar = {**positive, **not_negative, "constant": "N.m/A", "speed": "rad/s"}

    constant: Number = 1.0
    resistance: Number = 1.0
    inductance: Number = 1.0
    voltage: Number = 0.0
    gain: Number = 0.0
    integral_gain: Number = 0.0
    anti_windup: Number = 0.0
    speed: Number = 0.0
