"""What all force elements have: a class says what it is, what may be written into it or read of it, what it refuses.

What an element does is in `mechanism_fmu.engine.dynamics`; the two meet in a row of numbers (`tables.kinds.FORCES`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, NamedTuple

from ... import codes
from ...tables.kinds import CHOICES, FORCES
from ..attached import Attached, Slot
from ..body import GROUND, Point
from ..curves import Curve
from ..errors import MechanismError
from ..findings import Finding, finite_positive, literal, not_negative, refuse_unless
from ..functions import Number
from ..laws import LawOperation, law_operations, potential


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


#: Whether a spring acts on both sides of its free length or angle, or only where it is longer or shorter.
OneSided = Literal["no", "stretched", "compressed"]

_SIDES: Mapping[str, float] = {"no": 0.0, "stretched": 1.0, "compressed": -1.0}


class Element(Attached):
    """What all force elements have.

    Attributes:
        row: name of the kind in `tables.kinds.FORCES`, whose columns are numbers of the element.
        writable: entries that an `Input` may write, with the target "<element>.<entry>".
        quantities: what an `Output` may read, by name, in the order of the engine's `Element.read`.
        own: how many first-order states of its own it has.
        acts: as a torque, at the centre of mass, at points of the bodies, which loads no elastic member, or nowhere.
        positive, not_negative: units of the numbers that must be so.
        rubs: whether it has friction.
        law: how its force follows from its length and rate: a function of both, a curve over the length, or None.
        one_sided: of a spring that can be so.
    """

    row: ClassVar[str]
    writable: ClassVar[tuple[str, ...]] = ()
    quantities: ClassVar[Mapping[str, Quantity]] = {}
    own: ClassVar = 0
    acts: ClassVar[Literal["torque", "at centre", "at points", "nowhere"]]
    positive: ClassVar[Mapping[str, str]] = {}
    not_negative: ClassVar[Mapping[str, str]] = {}
    rubs: ClassVar = False
    law: Callable[[Number, Number], Number] | Curve | None = None
    one_sided: OneSided = "no"

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

    def operations(self) -> tuple[LawOperation, ...]:
        """What its law does, where that is a function; () else.

        Raises:
            MechanismError: it cannot be recorded.
        """
        law = self.law
        return () if law is None or isinstance(law, Curve) else law_operations(law, self._label)

    def energy(self) -> Curve | None:
        """The energy of its law over the length or angle, where that is a curve.

        Raises:
            MechanismError: the curve has none.
        """
        return potential(self.law, self._label) if isinstance(self.law, Curve) else None

    def thresholds(self) -> list[tuple[int, int]]:
        """Where its force begins, ends or changes its formula: kinds, and the operation or piece of its law.

        Raises:
            MechanismError: its law cannot be recorded, or `one_sided` is no such word.
        """
        if self.side != 0.0:
            return [(codes.THRESHOLD_SIDE, 0), (codes.THRESHOLD_PULL, 0)]
        if isinstance(self.law, Curve):
            return [(codes.THRESHOLD_PIECE, piece) for piece in range(1, len(self.law.pieces))]
        choices = [k for k, operation in enumerate(self.operations()) if operation.code in CHOICES]
        return [(codes.THRESHOLD_CONDITION, k) for k in choices]

    @property
    def side(self) -> float:
        """Of a spring, its column `side`: 0, or the sign of the stretches and forces that there are.

        Raises:
            MechanismError: `one_sided` is no such word.
        """
        if self.one_sided not in _SIDES:
            raise MechanismError(f"{self._label}: one_sided = {self.one_sided!r} is none of {', '.join(_SIDES)}.")
        return _SIDES[self.one_sided]

    @property
    def _label(self) -> str:
        return f"{type(self).__name__} {self.name!r}"

    def findings(self) -> Iterator[Finding]:
        """Every problem that its numbers can have, but for those that are not finite."""
        label = f"{type(self).__name__} {literal(repr(self.name))}"
        for what, unit in self.positive.items():
            text = f"{label}: {what} = {{:g}} {unit}, but it must be positive and finite."
            yield refuse_unless(finite_positive(getattr(self, what)), text, getattr(self, what))
        for what, unit in self.not_negative.items():
            text = f"{label}: {what} = {{:g}} {unit}, but it must not be negative."
            yield refuse_unless(not_negative(getattr(self, what)), text, getattr(self, what))


@dataclass(frozen=True, init=False)
class TorqueElement(Element):
    """A torque between two bodies.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies.
    """

    acts: ClassVar = "torque"
    slots: ClassVar = (Slot("body"), Slot("reaction"))

    name: str
    body: str
    reaction: str = GROUND


@dataclass(frozen=True, init=False)
class PointElement(Element):
    """A force between points of two bodies.

    Attributes:
        name: unique within the mechanism.
        body, reaction: names of the two bodies (or `GROUND`).
        point, reaction_point: the points, in the frame of each body [m].
    """

    acts: ClassVar = "at points"
    slots: ClassVar = (Slot("body", "point"), Slot("reaction", "reaction_point"))

    name: str
    body: str
    point: Point
    reaction: str
    reaction_point: Point


def angle_quantities(*written: str) -> dict[str, Quantity]:
    """What can be read of a torque that follows from the relative angle; the entries `written` act at once."""
    return {
        "angle": Quantity("rad", "Relative angle of the bodies"),
        "speed": Quantity("rad/s", "Rate of the relative angle"),
        "torque": Quantity("N.m", "Torque on the body", written),
        "power": Quantity("W", "Power that the bodies get", written),
    }


def length_quantities(*written: str) -> dict[str, Quantity]:
    """What can be read of a force that follows from the distance; the entries `written` act at once."""
    return {
        "length": Quantity("m", "Distance of the points"),
        "speed": Quantity("m/s", "Rate of the distance of the points"),
        "force": Quantity("N", "Force that pulls the points together", written),
        "power": Quantity("W", "Power that the bodies get", written),
    }
