"""Contact of two outlines, wherever their segments, arcs and corners meet; and copies of one, as teeth of a wheel."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import ClassVar

from .. import codes
from .attached import Slot
from .body import Point
from .contact_facts import ContactFacts
from .errors import MechanismError
from .findings import Finding, positive, refuse_unless
from .functions import Number
from .outlines import Outline
from .outlines.features import around
from .quantities import pair


@dataclass(frozen=True)
class CircularCopies:
    """Copies of an outline around the centre of mass of its body, evenly over the whole turn: the teeth of a wheel.

    Copy 0 is the outline as it is given; they count counter-clockwise.

    Attributes:
        count: how many there are, at least 1.

    Raises:
        MechanismError: there is none.
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
        count: how many there are at most, half of them on either side; copy 0 is the outline as it is given.

    Raises:
        MechanismError: there is none, or a text is no such quantity.
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


@dataclass(frozen=True, init=False)
class OutlineContact(ContactFacts):
    """Two outlines that touch wherever their corners, segments and arcs meet, and go on from one feature to the next.

    The gap is the distance of the nearest features: a corner or a rounding, whose place on its body is fixed, against a
    segment, an arc or another corner. Where it reaches zero, it impacts by eq (7); closed, it is a row that only
    pushes. Where the place of contact comes to the end of a segment or arc, the next feature takes over without a blow
    if the outline goes on smoothly or a rounding goes around a corner, else the contact opens. A face on a face is two
    contacts, at the ends of what they have in common.

    In a mechanism it stands `points` times, as `name`, `name_2` ..., one for each place where the outlines touch at
    once; the first that is free stands for the nearest pair of features.

    Outputs: `force` [N], along the common normal, on body i away from body j; 0 when open. `gap` [m], of the nearest
    features that do not touch yet; 0 when closed.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: the bodies.
        outline_i, outline_j: their outlines, each in the frame of its body; material on the left.
        copies: how outline j repeats on its body, or None.
        restitution: e of eq (4) [1], 0..1. Below the engine's stick speed, and with 0, the contact stays closed.
        friction: coefficient of Coulomb friction along the common tangent [1], >= 0.
        friction_static: the same while it sticks [1], at least as large; None: as large.
        enabled: whether the contact exists; a number, so that a parameter can switch it off.
        points: at how many places the outlines can touch at once, 1..20.
        place: which of them this is, from 0; a `Mechanism` makes the others.

    Raises:
        MechanismError: as of all parts; or there are less than 1 or more than 20 points.

    Source: this project's: docs/decisions/052-outlines.md.
    """

    kind: ClassVar[int] = codes.OUTLINE
    has_outlines: ClassVar = True
    slots: ClassVar = (Slot("body_i"), Slot("body_j"))
    closed: ClassVar[Number] = False
    guided: ClassVar[Number] = False
    closed_while: ClassVar[str | None] = None

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
    points: int = 2
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
        if not 1 <= self.points <= 20:
            raise MechanismError(f"{self.label}: points = {self.points} is outside 1..20.")
        if self.place:
            return ()
        others = (replace(self, name=f"{self.name}_{k + 1}", place=k) for k in range(1, self.points + 1))
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
