"""Drives with states of their own: a clutch or brake, and a motor with its controller."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..functions import Number
from .base import Quantity, TorqueElement


@dataclass(frozen=True, init=False)
class SlipClutch(TorqueElement):
    """A clutch or brake with Coulomb friction: it holds up to a torque, and slips beyond.

    A spring and a damper in series with a slider: torque on `body` = stiffness * twist + damping * (speed - (phi' -
    phi_reaction')), but at most `limit` either way; twist' = (torque - stiffness * twist) / damping. Below the limit
    nothing slips: a brake holds without creeping. With `speed` 0 it is a brake between two bodies, or on the ground;
    with a speed, a friction drive by what turns so fast. The work of the driven end counts as work done, the energy of
    the twist as spring energy, what slip and damper take as lost.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
        stiffness: of clutch and lining while they hold [N m/rad], > 0.
        damping: of the same [N m s/rad], > 0; the twist follows the limit within damping / stiffness [s].
        limit: largest torque [N m], >= 0; usually written by an `Input` with target "<name>.limit".
        speed: of the driven end from the reaction [rad/s]; an `Input` may write "<name>.speed".

    Source: Coulomb friction behind a spring and damper: docs/decisions/021-motor.md; docs/elements/slip_clutch.md.
    """

    row: ClassVar = "slip_clutch"
    writable: ClassVar = ("limit", "speed")
    quantities: ClassVar = {"torque": Quantity("N.m", "Torque of the clutch on its body", ("limit", "speed"))}
    positive: ClassVar = {"stiffness": "N.m/rad", "damping": "N.m.s/rad"}
    not_negative: ClassVar = {"limit": "N.m"}
    own: ClassVar = 1
    units: ClassVar = {**positive, **not_negative, "speed": "rad/s"}

    stiffness: Number = 1.0
    damping: Number = 1.0
    limit: Number = 0.0
    speed: Number = 0.0


@dataclass(frozen=True, init=False)
class Brake(TorqueElement):
    """A brake or clutch with dry friction: it holds two bodies together up to a torque, and slips beyond.

    While it holds nothing turns, as if the bodies were one; while it slips its torque is `limit` against the slip. It
    needs `Mechanism(friction_law="coulomb")`. Outputs: "<name>.friction_force" [N m], its torque on `body`,
    "<name>.slip_speed" [rad/s] and "<name>.sticks". In impacts it has no part: a torque is no impulse.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
        limit: largest torque [N m], >= 0; an `Input` may write "<name>.limit".

    Source: Coulomb friction, -torque in limit Sgn(slip): Glocker, Pfeiffer, Nonlinear Dynamics 7 (1995) 471.
    """

    row: ClassVar = "brake"
    dry: ClassVar = True
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
