"""Contact of two outlines, wherever their segments, arcs and corners meet; and copies of one, as teeth of a wheel."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, NamedTuple

from .. import codes
from .attached import Slot
from .body import Point
from .contact_facts import ContactFacts
from .errors import MechanismError
from .findings import Finding, length, positive, refuse_unless
from .functions import Number
from .outlines import Outline
from .outlines.features import Feature, around, features
from .outlines.places import MOST_PLACES, places_at_once
from .quantities import pair


@dataclass(frozen=True)
class CircularCopies:
    """Copies of an outline around the centre of mass of its body, evenly over the whole turn: the teeth of a wheel.

    Copy 0 is the outline as it is given; they count counter-clockwise.

    Attributes:
        count: how many there are, at least 1.

    Raises:
        MechanismError: there is none.

    Source: definition: copies k of a tooth stand at k times 2 pi over their number.
    """

    count: int

    def __post_init__(self) -> None:
        if self.count < 1:
            raise MechanismError(f"CircularCopies: count = {self.count}, but it must be at least 1.")

    def data(self) -> tuple[Number, Number, Number]:
        """Pitch [rad], and step in x and y [m], of which one is 0."""
        return 2.0 * math.pi / self.count, 0.0, 0.0


@dataclass(frozen=True)
class LinearCopies:
    """Copies of an outline in a row, on both sides of it: the teeth of a rack, or of a crown wheel seen from the side.

    Attributes:
        step: from one copy to the next, in the frame of the body [m].
        count: how many there are, half of them on either side (of an even number, one more in the direction of the
            step); copy 0 is the outline as it is given.

    Raises:
        MechanismError: there is none, or a text is no such quantity.

    Source: definition: copies k of a tooth stand k steps further.
    """

    step: Point
    count: int = 1_000_000

    def __post_init__(self) -> None:
        object.__setattr__(self, "step", pair(self.step, "m", "step of LinearCopies"))
        if self.count < 1:
            raise MechanismError(f"LinearCopies: count = {self.count}, but it must be at least 1.")

    def data(self) -> tuple[Number, Number, Number]:
        """Pitch [rad], and step in x and y [m], of which one is 0."""
        return 0.0, *self.step


class OutlineFacts(ContactFacts):
    """What all contacts of outlines have.

    Attributes:
        outline_i, outline_j: the outlines, from the centres of mass of their bodies.
        copies: how outline j repeats on its body, or None.
        place: which of the places where the outlines touch at once this is, from 0.
    """

    kind: ClassVar[int] = codes.OUTLINE
    has_outlines: ClassVar = True
    closed: ClassVar[Number] = False
    guided: ClassVar[Number] = False
    closed_while: ClassVar[str | None] = None


@dataclass(frozen=True, init=False)
class OutlineContact(OutlineFacts):
    """Two outlines that touch wherever their corners, segments and arcs meet, and go on from one feature to the next.

    The gap is the distance of the nearest features: a corner or a rounding, whose place on its body is fixed, against a
    segment, an arc or another corner. Where it reaches zero, it impacts by eq (7); closed, it is a row that only
    pushes. Where the place of contact comes to the end of a segment or arc, the next feature takes over without a blow
    if the outline goes on smoothly or a rounding goes around a corner, else the contact opens. A face on a face is two
    contacts, at the ends of what they have in common.

    In a mechanism it stands as often as there are places where the outlines can touch at once, as `name`, `name_2` ...;
    the first that is free stands for the nearest pair of features.

    Outputs: `force` [N], along the common normal, on body i away from body j; 0 when open. `gap` [m], of the nearest
    features that do not touch yet; 0 when closed.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: the bodies.
        outline_i, outline_j: their outlines, each in the frame in which its body is drawn (of a body given by its name,
            from its centre of mass); material on the left.
        copies: how outline j repeats on its body, or None.
        restitution: e of eq (4) [1], 0..1. Below the engine's stick speed, and with 0, the contact stays closed.
        friction: coefficient of Coulomb friction along the common tangent [1], >= 0.
        friction_static: the same while it sticks [1], at least as large; None: as large.
        enabled: whether the contact exists; a number, so that a parameter can switch it off.
        points: a bound of the places where the outlines can touch at once, 1..20; None: as many as their shapes allow.
        place: which of them this is, from 0; a `Mechanism` makes the others.

    Raises:
        MechanismError: as of all parts; or there are less than 1 or more than 20 points.

    Source: this project's: docs/decisions/052-outlines.md.
    """

    slots: ClassVar = (Slot("body_i", outline="outline_i"), Slot("body_j", outline="outline_j"))

    name: str
    body_i: str
    body_j: str
    outline_i: Outline = field(kw_only=True)
    outline_j: Outline = field(kw_only=True)
    copies: CircularCopies | LinearCopies | None = None
    restitution: Number = 0.0
    friction: Number = 0.0
    friction_static: Number | None = None
    enabled: Number = True
    points: int | None = None
    place: int = 0

    def data(self) -> tuple[Number, ...]:
        """The contact has no numbers of its own in `contact_data`; those of its outlines are `features`."""
        return ()

    @property
    def places(self) -> tuple[OutlineContact, ...]:
        """One for each place where the outlines can touch at once, and one more that tells when these do not suffice.

        Raises:
            MechanismError: there are less than 1 or more than 20 points.
        """
        if self.points is not None and not 1 <= self.points <= MOST_PLACES:
            raise MechanismError(f"{self.label}: points = {self.points} is outside 1..{MOST_PLACES}.")
        if self.place:
            return ()
        points = self.points
        if points is None:
            step, count = (None, 1) if self.copies is None else (self.copies.data(), self.copies.count)
            points = places_at_once(self.outline_i, self.outline_j, step, count)
        others = (replace(self, name=f"{self.name}_{k + 1}", place=k) for k in range(1, points + 1))
        return (self, *others)

    def shape_findings(self) -> Iterator[Finding]:
        """What the numbers of the outlines can be wrong in."""
        if self.place:
            return
        for side, outline in (("i", self.outline_i), ("j", self.outline_j)):
            yield from outline.findings(f"{self.label}: outline_{side}")
            reach = around(outline)[2]
            text = f"{self.label}: outline_{side} reaches {{:g}} m, which is no length."
            yield refuse_unless(positive(reach), text, reach)
        if isinstance(self.copies, LinearCopies):
            step = length(self.copies.step)
            text = f"{self.label}: its copies are {{:g}} m apart; give LinearCopies a step that is not zero."
            yield refuse_unless(positive(step), text, step)


#: Of a row of copies, so many are drawn on either side of the first.
_DRAWN_IN_A_ROW = 5


def drawn_outline(
    outline: Outline, copies: CircularCopies | LinearCopies | None
) -> tuple[list[Point], list[tuple[Number, Number, Number]]]:
    """A closed chain of points that shows an outline in a drawing [m], and where its copies are: x, y [m], angle [rad].

    Open teeth around a wheel are one chain.

    Args:
        outline: in the frame of its body.
        copies: how it repeats there.
    """
    others: list[tuple[Number, Number, Number]] = []
    if isinstance(copies, CircularCopies):
        angles = [2.0 * math.pi * k / copies.count for k in range(copies.count)]
        if not outline.closed:
            return [point for angle in angles for point in _open(outline.moved(angle=angle))], []
        others = [(0.0, 0.0, angle) for angle in angles[1:]]
    elif isinstance(copies, LinearCopies):
        (x, y), half = copies.step, min(copies.count // 2, _DRAWN_IN_A_ROW)
        others = [(k * x, k * y, 0.0) for k in range(-half, half + 1) if k]
    there = outline.drawn() if outline.closed else _open(outline)
    return (there if outline.closed else [*there, *there[-2:0:-1]]), others  # there and back


def _open(outline: Outline) -> list[Point]:
    return [*outline.drawn(), outline.elements[-1].end]


class NumberedOutlines(NamedTuple):
    """The outlines of contacts as the tables number them: each once, with its copies, and its features.

    Attributes:
        all: outlines and how they repeat.
        owners: name of the first contact of each.
        numbers: of outline i and j of each contact; `codes.NONE` of one that has none.
        features: of each outline, in the order of its chain.
    """

    all: list[tuple[Outline, CircularCopies | LinearCopies | None]]
    owners: list[str]
    numbers: list[tuple[int, int]]
    features: list[list[Feature]]


def numbered_outlines(contacts: Sequence[Any]) -> NumberedOutlines:
    """The outlines of contacts, of any kind, in their order.

    Args:
        contacts: of a mechanism.
    """
    found = NumberedOutlines([], [], [], [])

    def number(contact: Any, outline: Outline, copies: CircularCopies | LinearCopies | None) -> int:
        for place, (other, of_other) in enumerate(found.all):
            if other is outline and of_other is copies:
                return place
        found.all.append((outline, copies))
        found.owners.append(contact.name)
        found.features.append([*features(outline, None if copies is None else copies.data())])
        return len(found.all) - 1

    for contact in contacts:
        if contact.has_outlines:
            first = number(contact, contact.outline_i, None)
            found.numbers.append((first, number(contact, contact.outline_j, contact.copies)))
        else:
            found.numbers.append((codes.NONE, codes.NONE))
    return found
