"""Contacts: one-sided constraints that open and close.

Here stands how near two bodies are to each other (the gap and what it takes to compute it), and the numbers that the
impact law and friction need; the law itself is one for all contacts: eq (7) with inequalities, in
`mechanism_fmu.engine.contacts.impact`.

Under Outputs: what an `Output` can have as its source "<name>.<output>". All have `closed`, whether the contact is
closed, and `gap`, which is 0 then; the notation is that of `joints`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import ClassVar

from .. import codes
from .attached import Slot
from .body import Point
from .clearance_joints import ClearanceJoint, SlotClearanceJoint
from .contact_facts import ContactFacts, no_unit_length
from .findings import Finding, positive, refuse_unless
from .functions import Number
from .joints import HigherPair
from .outline_contacts import OutlineContact


@dataclass(frozen=True, init=False)
class PointLineContact(ContactFacts):
    """A point of one body against a straight line fixed in another (Pennestrì et al., Fig. 1).

    The gap is s = normal . (A_j^T (r_i^P - r_j) - line_point), positive when open. An open contact whose gap reaches
    zero impacts by eq (7); one that is closed is a constraint row that can only push, and opens when it would pull.
    With `closed_while` it is no one-sided contact but a row that a logical function switches on and off.

    Outputs: `force` [N], on body i along the normal: positive when it pushes; 0 when open. `gap` [m].

    Attributes:
        name: unique within the mechanism.
        body_i: the body that carries the point.
        point_i: the point in its frame [m].
        body_j: the body that carries the line.
        line_point: a point of the line in its frame [m].
        normal: unit normal of the line in the frame of `body_j` [1], towards the open side.
        closed: whether assembly puts the point on the line.
        restitution: e of eq (4) [1], 0..1. Below the engine's stick speed, and with 0, the contact stays closed.
        friction: coefficient of Coulomb friction along the line [1], >= 0.
        friction_static: the same while it sticks [1], at least as large; None: as large.
        guided: whether the contact, once closed, also pulls and never opens, as in the paper.
        enabled: whether the contact exists; a number, so that a parameter can switch it off.
        pattern: name of the `CircularPattern` that repeats the line around `body_j`, or None.
        closed_while: "<function>" or "not <function>": the logical function that closes and opens it, or None. With it,
            `closed`, `guided` and `restitution` have no meaning and must be left alone.
    """

    kind: ClassVar[int] = codes.POINT_LINE
    slots: ClassVar = (Slot("body_i", "point_i"), Slot("body_j", "line_point", "normal", "normal"))

    name: str
    body_i: str
    point_i: Point
    body_j: str
    line_point: Point
    normal: Point
    closed: Number = False
    restitution: Number = 0.0
    friction: Number = 0.0
    friction_static: Number | None = field(default=None, kw_only=True)
    guided: Number = False
    enabled: Number = True
    pattern: str | None = None
    closed_while: str | None = None

    def data(self) -> tuple[Number, ...]:
        """The contact's row of the table `contact_data`: point_i, line_point, normal."""
        return (*self.point_i, *self.line_point, *self.normal)

    def findings(self) -> Iterator[Finding]:
        """Those of all contacts, and that the normal is a unit vector."""
        yield no_unit_length(f"{self.label}: its normal", self.normal)
        yield from super().findings()

    def too_deep(self) -> tuple[str, str]:
        """As of all contacts."""
        return f"the point of {self.body_i!r} is", f"m behind the line on {self.body_j!r}"


@dataclass(frozen=True, init=False)
class _OfAngles(ContactFacts):
    """A contact whose gap is an angle."""

    angular: ClassVar = True
    closed: ClassVar[Number] = False
    guided: ClassVar[Number] = False
    slots: ClassVar = (Slot("body_i"), Slot("body_j"))
    units: ClassVar = {"angle": "rad", "pitch": "rad"}

    name: str
    body_i: str
    body_j: str
    angle: Number
    pitch: Number | None

    def findings(self) -> Iterator[Finding]:
        """Those of all contacts, and of the pitch."""
        yield from super().findings()
        if self.pitch is not None:
            yield refuse_unless(positive(self.pitch), f"{self.label}: pitch = {{:g}} rad must be positive.", self.pitch)

    def too_deep(self) -> tuple[str, str]:
        """As of all contacts."""
        return f"{self.body_i!r} is", f"rad beyond its stop on {self.body_j!r}"


@dataclass(frozen=True, init=False)
class AngleStop(_OfAngles):
    """A stop for the relative angle of two bodies, with the memory of a ratchet: gap s = phi_i - phi_j - latched angle.

    The latched angle is `angle` at first. Each time the relative angle has gone one pitch beyond it, the stop clicks:
    the latched angle grows by one pitch, as when a holding pawl drops behind the next tooth. It never goes back.

    Outputs: `force` [N m], the torque on body i: positive when it pushes; 0 when open. `gap` [rad].
    `latched` [rad], the latched angle, and `clicks`, how often it has grown.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: the bodies.
        angle: latched angle at the start [rad].
        pitch: from one latched angle to the next [rad], > 0; None for a plain stop.
        restitution: e of eq (4) [1], 0..1.
        enabled: whether it exists; a number, so that a parameter can switch it off.

    Source: Pennestrì, Valentini, Vita, eqs (4), (6) and (7); clicks: docs/decisions/005-one-sided-contacts.md.
    """

    kind: ClassVar[int] = codes.ANGLE_STOP
    has_memory: ClassVar = True
    readings: ClassVar = {**ContactFacts.readings, "clicks": codes.STOP_CLICKS, "latched": codes.STOP_REFERENCE}
    closed_while: ClassVar[str | None] = None

    pitch: Number | None = None
    restitution: Number = 0.0
    enabled: Number = True

    def data(self) -> tuple[Number, ...]:
        """The contact's row of the table `contact_data`: angle, pitch (0: none)."""
        return (self.angle, 0.0 if self.pitch is None else self.pitch)


@dataclass(frozen=True, init=False)
class AngleLock(_OfAngles):
    """A lock that a logical function closes, as the locking arc of a Geneva drive.

    While closed, it holds the relative angle at the nearest of `angle` + k `pitch`, in both directions.

    Outputs: `force` [N m], the torque on body i; 0 when open. `gap` [rad], phi_i - phi_j from the angle held.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: the bodies.
        angle: one of the locked relative angles [rad].
        pitch: between neighbouring locked angles [rad], > 0.
        closed_while: "<function>" or "not <function>", the logical function that closes it.
        enabled: whether it exists; a number, so that a parameter can switch it off.

    Source: Pennestrì, Valentini, Vita, section 3, a row that a logical function switches, and eq (7) where it closes.
    """

    kind: ClassVar[int] = codes.ANGLE_LOCK
    restitution: ClassVar[Number] = 0.0

    pitch: Number
    closed_while: str
    enabled: Number = True

    def data(self) -> tuple[Number, ...]:
        """The contact's row of the table `contact_data`: angle, pitch."""
        return (self.angle, self.pitch)


#: Any contact.
Contact = PointLineContact | AngleStop | AngleLock | OutlineContact | ClearanceJoint | SlotClearanceJoint | HigherPair
