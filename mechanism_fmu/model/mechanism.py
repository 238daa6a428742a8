"""The mechanism: all its parts in one frozen record."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from itertools import chain
from types import SimpleNamespace
from typing import Any, Literal

from .. import codes
from .body import Body
from .contacts import Contact
from .curves import Curve
from .errors import MechanismError
from .forces import Force, ForceElement, Marker, Oscillation
from .functions import Number, is_plain
from .joints import Joint
from .logic import LogicalFunction
from .members import LumpedMass, Member
from .patterns import CircularPattern
from .ports import Calculated, Input, Output
from .quantities import pair


@dataclass(frozen=True)
class Settings:
    """How the engine integrates.

    Attributes:
        relative_tolerance: of the step control [1], 1e-13..1e-3.
        baumgarte_alpha: gain on the rates [1/s], in gamma - 2 alpha Phi' - beta^2 Phi; 0 by default, because rows are
            projected after each step, whatever the mechanism's own time is. Pennestri et al. take 10.
        baumgarte_beta: gain on the rows [1/s], in the same; they take 1.
        max_internal_steps: greatest number of internal steps of one communication step, 10..1e9; a step that needs more
            ends early, with a message.
        integration_method: integer [1]; 0 goes over from Dormand-Prince 5(4) to Rodas5P and back as stiffness asks, 1
            is always Dormand-Prince, explicit, 2 always Rodas5P, linearly implicit.
    """

    relative_tolerance: Number = 1e-9
    baumgarte_alpha: Number = 0.0
    baumgarte_beta: Number = 0.0
    max_internal_steps: Number = 200_000
    integration_method: Number = codes.AUTOMATIC

    @classmethod
    def of(cls, values: SimpleNamespace) -> Settings:
        """The settings among a model's parameter values (`settings_parameters`); of others, the default.

        Args:
            values: of the parameters, by name.
        """
        return cls(**{name: getattr(values, name) for name in (f.name for f in fields(cls)) if hasattr(values, name)})


#: Those of a mechanism that gives none: a `Model` puts those among its parameters in their place.
DEFAULT_SETTINGS = Settings()

#: What can be read of anything that can rub, and the kind of output that it is.
OF_FRICTION = {
    "slip_speed": codes.SLIP_SPEED,
    "friction_force": codes.FRICTION_FORCE,
    "sticks": codes.STICKS_NOW,
    "slip_acceleration": codes.SLIP_ACCELERATION,
}


@dataclass(frozen=True)
class Mechanism:
    """A planar mechanism with its ports.

    Attributes:
        bodies, joints, forces, contacts, patterns, functions: the parts; names are unique over all of them.
        inputs, outputs, calculated: what the outside sees.
        held: coordinates, as "<body>.x|y|angle", that assembly must not move, nor their rates.
        settings: how the engine integrates; where none are given, a `Model` takes those among its parameters.
        gravity: acceleration (gx, gy) [m/s2], e.g. (0.0, -9.80665), or texts with units, that gives every body its
            weight, whose work counts as work done. None, and no weights, by default, as in Pennestri et al.
        members, lumped_masses: what bends and which lumps of mass it carries, for `mechanism_fmu.elastodynamics` and
            outputs that read them; the motion does without. The mechanism becomes a structure when its held and driven
            coordinates stand still.
        markers: points whose place and velocity outputs read.
        oscillations: bodies that swing, whose period, amplitude and rate outputs read.
        impact_law: of impacts where there is friction: "newton" (Moreau and Glocker), "poisson", or "stronge" (of one
            contact alone).
        energy_guard: whether an impact that would add energy, as it may by Newton's law with friction, is repeated
            by Poisson's.
        tangential_shock: whether an impact without approach ends a slip with which no finite force agrees (Painlevé).
        through_singularities: whether the motion goes on where the rank of the rows drops at one instant, as where a
            parallelogram lies flat: along the branch on which it is smooth. Otherwise it stops there.
        rubs: names of parts that have friction for some values of parameters, besides those that have some now; a
            `Model` gives them, so that for all values its FMU has the same tables, events and default outputs.

    Raises:
        MechanismError: gravity is no pair of accelerations.
    """

    bodies: tuple[Body, ...]
    joints: tuple[Joint, ...] = ()
    forces: tuple[ForceElement, ...] = ()
    contacts: tuple[Contact, ...] = ()
    patterns: tuple[CircularPattern, ...] = ()
    functions: tuple[LogicalFunction, ...] = ()
    inputs: tuple[Input, ...] = ()
    outputs: tuple[Output, ...] = ()
    calculated: tuple[Calculated, ...] = ()
    held: tuple[str, ...] = ()
    settings: Settings = DEFAULT_SETTINGS
    gravity: tuple[Number, Number] | None = None
    members: tuple[Member, ...] = ()
    lumped_masses: tuple[LumpedMass, ...] = ()
    markers: tuple[Marker, ...] = ()
    oscillations: tuple[Oscillation, ...] = ()
    impact_law: Literal["newton", "poisson", "stronge"] = "newton"
    energy_guard: bool = True
    tangential_shock: bool = False
    through_singularities: bool = False
    rubs: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Make numbers of the texts of gravity, and a contact of outlines for each place where they can touch."""
        object.__setattr__(self, "contacts", tuple(chain.from_iterable(c.places for c in self.contacts)))
        if self.gravity is not None:
            object.__setattr__(self, "gravity", pair(self.gravity, "m/s2", "gravity"))

    @cached_property
    def elements(self) -> tuple[ForceElement, ...]:
        """The force elements; behind them the weights of all bodies where there is gravity, and what is only read."""
        if self.gravity is None:
            return (*self.forces, *self.sensors)
        x, y = self.gravity
        weights = [Force(f"{body.name}.weight", body.name, (body.mass * x, body.mass * y)) for body in self.bodies]
        return (*self.forces, *weights, *self.sensors)

    @property
    def sensors(self) -> tuple[Marker | Oscillation, ...]:
        """What exerts nothing and is read: the markers, and behind them the oscillations."""
        return (*self.markers, *self.oscillations)

    @property
    def rubbing(self) -> tuple[Contact | Joint | ForceElement, ...]:
        """Contacts, joints and force elements, as the engine numbers their friction; none where nothing asks for it."""
        parts = (*self.contacts, *self.joints, *self.elements)
        read = any(output.source.rpartition(".")[2] in OF_FRICTION for output in self.outputs)
        return parts if read or self.impact_law != "newton" or self.rubs or any(map(may_rub, parts)) else ()

    @property
    def rubs_or_may(self) -> tuple[str, ...]:
        """Names of the contacts, joints and force elements that have friction, for these values or for others."""
        parts = (*self.contacts, *self.joints, *self.elements)
        return tuple(part.name for part in parts if may_rub(part) or part.name in self.rubs)

    def with_impacts(
        self,
        law: Literal["newton", "poisson", "stronge"],
        restitution: Number,
        friction: Number,
        contacts: Sequence[str] = (),
    ) -> Mechanism:
        """The mechanism with one law of impacts and one pair of numbers, as `mechanism-fmu identify impacts` prints it.

        Args:
            law: of impacts, for all contacts.
            restitution: e of the contacts [1], 0..1.
            friction: coefficient of their Coulomb friction [1], >= 0; what they have for sticking goes.
            contacts: names of those that take these numbers; none: all that can strike and rub.

        Raises:
            MechanismError: there is no such contact, or it cannot have both numbers.
        """
        able = [part.name for part in self.contacts if _strikes_and_rubs(part)]
        wrong = [name for name in contacts if name not in able]
        if wrong or not able:
            what = f"Contact {wrong[0]!r} is none that can" if wrong else "No contact of the mechanism can"
            raise MechanismError(f"{what} have restitution and friction; those that can: {', '.join(able) or 'none'}.")
        chosen = set(contacts or able)
        # of an outline contact, the first of its places makes the others anew
        numbers: dict[str, Any] = {"restitution": restitution, "friction": friction, "friction_static": None}
        parts = tuple(replace(part, **numbers) if part.name in chosen else part for part in self.contacts)
        return replace(self, contacts=parts, impact_law=law)


def _strikes_and_rubs(part: Contact) -> bool:
    """Whether a contact can have restitution and friction: it has both, comes off, and no function switches it."""
    own = {field.name for field in fields(part)}
    comes_off = getattr(part, "unilateral", True)
    holds = is_plain(comes_off) and not comes_off
    return {"restitution", "friction"} <= own and not holds and getattr(part, "closed_while", None) is None


def can_rub(part: Contact | Joint | ForceElement) -> bool:
    """Whether a part is of a kind that can have friction."""
    own = {field.name for field in fields(part)}
    return getattr(part, "rubs", False) or bool(own & {"friction", "friction_radius"})


def turns(part: Contact | Joint | ForceElement) -> bool:
    """Whether what can rub is a pin or a brake: its slip is the rate of an angle, its friction a torque."""
    return getattr(part, "rubs", False) or hasattr(part, "friction_radius")


def may_rub(part: Contact | Joint | ForceElement) -> bool:
    """Whether a part has friction for some values of the parameters."""
    friction = getattr(part, "friction", 0.0)
    return getattr(part, "rubs", False) or not is_plain(friction) or friction > 0.0


def curve_owners(mechanism: Mechanism) -> list[tuple[str, Curve]]:
    """Motions of drivers, profiles of contacts, energies of springs, as the tables number them, each with its part."""
    motions = [(joint.name, joint.motion) for joint in mechanism.joints]
    profiles = [(contact.name, profile) for contact in mechanism.contacts for profile in contact.profiles]
    energies = [(force.name, force.energy()) for force in mechanism.elements]
    return [(name, curve) for name, curve in (*motions, *profiles, *energies) if curve is not None]
