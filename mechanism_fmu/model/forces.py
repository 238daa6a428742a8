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


@dataclass(frozen=True)
class SlipClutch:
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
        speed: of the driven end [rad/s]; an `Input` may write "<name>.speed".
    """

    kind: ClassVar[int] = codes.SLIP_CLUTCH
    columns: ClassVar[dict[str, int]] = {"limit": codes.CLUTCH_LIMIT, "speed": codes.CLUTCH_SPEED}
    own: ClassVar[int] = 1

    name: str
    body: str
    reaction: str = GROUND
    stiffness: Number = 1.0
    damping: Number = 1.0
    limit: Number = 0.0
    speed: Number = 0.0

    def data(self) -> tuple[Number, ...]:
        """The element's row of the table `force_data`."""
        return (self.stiffness, self.damping, self.limit, self.speed)


@dataclass(frozen=True)
class DCMotor:
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
        gain: [V s/rad], >= 0.
        integral_gain: [V/rad], >= 0.
        anti_windup: by how much the integral gives way to the limit [rad/(V s)], >= 0; within 1 / (anti_windup
            integral_gain) [s].
        speed: wanted [rad/s]; usually written by an `Input` with target "<name>.speed".
    """

    kind: ClassVar[int] = codes.DC_MOTOR
    columns: ClassVar[dict[str, int]] = {"voltage": codes.MOTOR_VOLTAGE_LIMIT, "speed": codes.MOTOR_SPEED}
    own: ClassVar[int] = 2

    name: str
    body: str
    reaction: str = GROUND
    constant: Number = 1.0
    resistance: Number = 1.0
    inductance: Number = 1.0
    voltage: Number = 0.0
    gain: Number = 0.0
    integral_gain: Number = 0.0
    anti_windup: Number = 0.0
    speed: Number = 0.0

    def data(self) -> tuple[Number, ...]:
        """The element's row of the table `force_data`."""
        electric = (self.constant, self.resistance, self.inductance, self.voltage)
        return (*electric, self.gain, self.integral_gain, self.anti_windup, self.speed)


#: Any force element.
ForceElement = Torque | TorsionSpring | Damper | CompliantShaft | Force | SlipClutch | DCMotor


def own_states(force: ForceElement) -> int:
    """How many first-order states of its own an element has."""
    return getattr(force, "own", 0)
