"""Force elements: each class says what it is, what may be written into it and read of it, and what it refuses.

What an element does is in `mechanism_fmu.engine.dynamics`; the two meet in a row of numbers (`tables.kinds.FORCES`).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, NamedTuple

from ..tables.kinds import FORCES
from .body import GROUND, Point
from .findings import Finding, finite_positive, literal, not_negative, refuse_unless
from .functions import Number

__all__ = ["CompliantShaft", "DCMotor", "Damper", "Force", "SlipClutch", "SpringDamper", "Torque", "TorsionSpring"]


class Quantity(NamedTuple):
    """What an `Output` can read of a part, with the source "<part>.<name of the quantity>".

    Attributes:
        unit: SI unit.
        description: one line for the user.
        feedthrough: entries of the part, as in `writable`, on which the value depends at the same instant.
    """

    unit: str
    description: str
    feedthrough: tuple[str, ...] = ()


class _Element:
    """What all force elements have.

    Attributes:
        row: name of the kind in `tables.kinds.FORCES`, whose columns are numbers of the element.
        writable: entries that an `Input` may write, with the target "<element>.<entry>".
        quantities: what an `Output` may read, by name, in the order of the engine's `Element.read`.
        own: how many first-order states of its own it has.
        acts: as a torque, at the centre of mass, or at points of the bodies; the last loads no elastic member.
        positive, not_negative: units of the numbers that must be so.
    """

    row: ClassVar[str]
    writable: ClassVar[tuple[str, ...]] = ()
    quantities: ClassVar[Mapping[str, Quantity]] = {}
    own: ClassVar = 0
    acts: ClassVar[Literal["torque", "at centre", "at points"]]
    positive: ClassVar[Mapping[str, str]] = {}
    not_negative: ClassVar[Mapping[str, str]] = {}

    name: str

    @property
    def kind(self) -> int:
        """The element's entry in the table `force_kind`."""
        return FORCES.number(self.row)

    @property
    def columns(self) -> dict[str, int]:
        """The columns of `force_data` that an `Input` may write, by entry."""
        return {entry: FORCES.columns(self.row).index(entry) for entry in self.writable}

    def data(self) -> tuple[Number, ...]:
        """The element's row of the table `force_data`."""
        return tuple(self._number(*column.split(".")) for column in FORCES.columns(self.row))

    def _number(self, field: str, axis: str = "") -> Number:
        value: Any = getattr(self, field)
        return value["xy".index(axis)] if axis else value

    def findings(self) -> Iterator[Finding]:
        """Every problem that its numbers can have, but for those that are not finite."""
        label = f"{type(self).__name__} {literal(repr(self.name))}"
        for what, unit in self.positive.items():
            text = f"{label}: {what} = {{:g}} {unit}, but it must be positive and finite."
            yield refuse_unless(finite_positive(getattr(self, what)), text, getattr(self, what))
        for what, unit in self.not_negative.items():
            text = f"{label}: {what} = {{:g}} {unit}, but it must not be negative."
            yield refuse_unless(not_negative(getattr(self, what)), text, getattr(self, what))


@dataclass(frozen=True)
class Torque(_Element):
    """A torque on `body`, counter-clockwise positive, with its reaction on `reaction`.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
        torque: [N m]; usually written by an `Input` with target "<name>.torque".
    """

    row: ClassVar = "torque"
    acts: ClassVar = "torque"
    writable: ClassVar = ("torque",)

    name: str
    body: str
    reaction: str = GROUND
    torque: Number = 0.0


@dataclass(frozen=True)
class TorsionSpring(_Element):
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

    row: ClassVar = "torsion_spring"
    acts: ClassVar = "torque"
    writable: ClassVar = ("preload",)
    not_negative: ClassVar = {"stiffness": "N.m/rad"}

    name: str
    body: str
    reaction: str = GROUND
    stiffness: Number = 0.0
    free_angle: Number = 0.0
    preload: Number = 0.0


@dataclass(frozen=True)
class Damper(_Element):
    """A viscous damper: torque on `body` = -damping * (phi' - phi_reaction'). What it takes counts as energy lost.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
        damping: [N m s/rad], >= 0.
    """

    row: ClassVar = "damper"
    acts: ClassVar = "torque"
    not_negative: ClassVar = {"damping": "N.m.s/rad"}

    name: str
    body: str
    reaction: str = GROUND
    damping: Number = 0.0


@dataclass(frozen=True)
class CompliantShaft(_Element):
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

    row: ClassVar = "shaft"
    acts: ClassVar = "torque"
    writable: ClassVar = ("angle", "speed")
    quantities: ClassVar = {"torque": Quantity("N.m", "Torque of the shaft on its body", ("angle", "speed"))}
    not_negative: ClassVar = {"stiffness": "N.m/rad", "damping": "N.m.s/rad"}

    name: str
    body: str
    reaction: str = GROUND
    stiffness: Number = 0.0
    damping: Number = 0.0
    angle: Number = 0.0
    speed: Number = 0.0


@dataclass(frozen=True)
class Force(_Element):
    """A force at the centre of mass of `body`, constant in the global frame, e.g. its weight.

    Attributes:
        name: unique within the mechanism.
        body: name of the body.
        force: (fx, fy) [N]; an `Input` may write "<name>.x" and "<name>.y". Its work counts as work done.
    """

    row: ClassVar = "force"
    writable: ClassVar = ("x", "y")
    acts: ClassVar = "at centre"
    reaction: ClassVar[str] = GROUND

    name: str
    body: str
    force: tuple[Number, Number] = (0.0, 0.0)

    def data(self) -> tuple[Number, ...]:
        """The element's row of the table `force_data`."""
        return self.force


@dataclass(frozen=True)
class SlipClutch(_Element):
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

    row: ClassVar = "slip_clutch"
    acts: ClassVar = "torque"
    writable: ClassVar = ("limit", "speed")
    quantities: ClassVar = {"torque": Quantity("N.m", "Torque of the clutch on its body", ("limit", "speed"))}
    positive: ClassVar = {"stiffness": "N.m/rad", "damping": "N.m.s/rad"}
    not_negative: ClassVar = {"limit": "N.m"}
    own: ClassVar = 1

    name: str
    body: str
    reaction: str = GROUND
    stiffness: Number = 1.0
    damping: Number = 1.0
    limit: Number = 0.0
    speed: Number = 0.0


@dataclass(frozen=True)
class DCMotor(_Element):
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

    row: ClassVar = "dc_motor"
    acts: ClassVar = "torque"
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


@dataclass(frozen=True)
class SpringDamper(_Element):
    """A spring, a damper and a constant force side by side between two points (ME451's TSDA).

    With the distance l of the points, the force that pulls them together is

        f = stiffness (l - free_length) + damping l' + preload.

    The energy of the linear part counts as spring energy, the work of the preload as work done on the mechanism, and
    what the damper takes as lost. Where the points meet, the force acts along their relative velocity; where they rest
    there, it has no direction and vanishes.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies (or `GROUND`).
        point, reaction_point: the points, in the frame of each body [m].
        stiffness: [N/m], >= 0.
        free_length: [m], >= 0: at which the linear part vanishes.
        damping: [N s/m], >= 0.
        preload: constant part of the force [N], pulling positive; an actuator where an `Input` writes
            "<name>.preload".
    """

    row: ClassVar = "spring_damper"
    writable: ClassVar = ("preload",)
    quantities: ClassVar = {
        "length": Quantity("m", "Distance of the points"),
        "speed": Quantity("m/s", "Rate of the distance of the points"),
        "force": Quantity("N", "Force that pulls the points together", ("preload",)),
    }
    acts: ClassVar = "at points"
    not_negative: ClassVar = {"stiffness": "N/m", "free_length": "m", "damping": "N.s/m"}

    name: str
    body: str
    point: Point
    reaction: str
    reaction_point: Point
    stiffness: Number = 0.0
    free_length: Number = 0.0
    damping: Number = 0.0
    preload: Number = 0.0


#: Any force element.
ForceElement = Torque | TorsionSpring | Damper | CompliantShaft | Force | SlipClutch | DCMotor | SpringDamper
