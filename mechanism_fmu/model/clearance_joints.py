"""Joints with play: a pin in a hole, or in a straight slot, that is larger than the pin."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

from .. import codes
from .attached import Slot
from .body import Point
from .errors import MechanismError
from .findings import Finding, finite, finite_not_negative, finite_positive, first, length, positive, refuse_unless
from .functions import Number, where_positive
from .outline_contacts import OutlineContact, OutlineFacts
from .outlines import Outline

#: A clearance must be larger than this part of the pin's radius: nearer, outlines count as touching.
LEAST_CLEARANCE = 1e-7


class PlayFacts(OutlineFacts):
    """What joints with play have, whatever the shape of the hole.

    Attributes:
        clearance: the radial play: how far the pin's centre can move from the middle to the wall [m].
        centres: the middle of the hole, and from there to the other end of what the pin's centre can follow with equal
            play on both sides [m]; of a round hole, zero.
    """

    copies: ClassVar[None] = None
    points: ClassVar[int] = 1
    place: ClassVar[int] = 0
    wears: ClassVar[bool] = True
    readings: ClassVar[Mapping[str, int]] = {
        **OutlineFacts.readings,
        "eccentricity": codes.ECCENTRICITY,
        "contact_angle": codes.CONTACT_ANGLE,
        "sliding_work": codes.SLIDING_WORK,
        "wear_volume": codes.SLIDING_WORK,
    }

    point_i: Point
    point_j: Point
    pin_radius: Number
    hole_radius: Number | None
    clearance: Number | None
    restitution: Number
    friction: Number
    friction_static: Number | None
    enabled: Number
    wear_coefficient: Number

    @property
    def play(self) -> Number:
        """The radial clearance c [m], given or by the radius of the hole.

        Raises:
            MechanismError: neither or both of them are given.
        """
        if self.clearance is not None and self.hole_radius is None:
            return self.clearance
        if self.hole_radius is not None and self.clearance is None:
            return self.hole_radius - self.pin_radius
        given = "neither is given" if self.clearance is None else "both are given"
        raise MechanismError(f"{self.label}: it takes a hole_radius or a clearance, and {given}; give one of them.")

    @property
    def bore(self) -> Number:
        """The radius of the hole, or half the width of the slot [m]."""
        return self.pin_radius + self.play if self.hole_radius is None else self.hole_radius

    @property
    def centres(self) -> tuple[Point, Point]:
        """Where the pin is in the middle, from where, and how far that goes [m], in the frame of body j."""
        return self.point_j, (0.0, 0.0)

    @cached_property
    def outline_i(self) -> Outline:
        """The pin, from the centre of mass of its body."""
        return Outline.circle(self.pin_radius, self.point_i)

    @cached_property
    def outline_j(self) -> Outline:
        """The hole, from the centre of mass of its body."""
        return Outline.circle(self.bore, self.point_j, hole=True)

    @property
    def places(self) -> tuple[PlayFacts | OutlineContact, ...]:
        """The joint, and a contact that tells when one place where they touch does not suffice."""
        more = OutlineContact(
            f"{self.name}_2",
            self.body_i,
            self.body_j,
            outline_i=self.outline_i,
            outline_j=self.outline_j,
            restitution=self.restitution,
            friction=self.friction,
            friction_static=self.friction_static,
            enabled=self.enabled,
            points=1,
            place=1,
        )
        return (self, more)

    def data(self) -> tuple[Number, ...]:
        """Its row of `contact_data`: the pin's centre, and the middle of the hole or slot with what that goes on by."""
        start, way = self.centres
        return (*self.point_i, *start, *way)

    def factor(self, reading: str) -> Number:
        """By what a reading is multiplied: of the eccentricity, 1/c; of the worn volume, the coefficient of wear.

        Args:
            reading: its name, of those of `readings`.
        """
        if reading == "eccentricity":
            return 1.0 / where_positive(self.play, self.play, 1.0)
        return {"sliding_work": 1.0, "wear_volume": self.wear_coefficient}.get(reading, 0.0)

    def findings(self) -> Iterator[Finding]:
        """Those of all contacts, of the radii, and of the coefficient of wear.

        Args:
            reading: its name, of those of `readings`.
        """
        yield from super().findings()
        label, r, c = self.label, self.pin_radius, self.play
        text = f"{label}: pin_radius = {{:g}} m, but it must be positive and finite."
        radius = refuse_unless(finite_positive(r), text, r)
        if self.hole_radius is None:
            least = f"larger than {LEAST_CLEARANCE:g} pin_radius"
            text = f"{label}: clearance = {{:g}} m must be positive, finite, and {least}: "
            shown: tuple[Number, ...] = (c,)
        else:
            text = f"{label}: hole_radius = {{:g}} m must be positive, finite, and larger than pin_radius = {{:g}} m: "
            shown = (self.hole_radius, r)
        wide = where_positive(c - LEAST_CLEARANCE * r, finite(c), 0.0)
        yield from first(radius, refuse_unless(wide, text + self._instead, *shown))
        text = f"{label}: wear_coefficient = {{:g}} must be finite and not negative."
        yield refuse_unless(finite_not_negative(self.wear_coefficient), text, self.wear_coefficient)

    def shape_findings(self) -> Iterator[Finding]:
        """None: a circle in a hole is sound where its radii are."""
        yield from ()

    #: What to take instead without play.
    _instead: ClassVar[str] = "the pin has no play; use Revolute."


@dataclass(frozen=True, init=False)
class ClearanceJoint(PlayFacts):
    """A pin in a round hole with play: it flies, strikes the wall, rolls and slides along it.

    It is one `OutlineContact` of a circle in a round hole, with its impacts and friction. d is the distance of the
    pin's centre from that of the hole, and c = hole_radius - pin_radius the clearance; the gap is c - d.

    Outputs: `force` [N], from the wall on the pin, 0 when open; `gap` [m]. `eccentricity` d/c [1], 0..1.
    `contact_angle` [rad], the direction from the centre of the hole to that of the pin, in the frame of body j,
    -pi..pi; closed, it is where the pin touches; 0 where they are concentric. `sliding_work` [J], the integral of
    force times |slip speed| since the start, and in an impact the impulse times the mean of |slip speed|; `wear_volume`
    [m3], that times `wear_coefficient`: Archard's law.

    Attributes:
        name: unique within the mechanism.
        body_i: the body with the pin.
        point_i: the pin's centre in its frame [m].
        body_j: the body with the hole.
        point_j: the centre of the hole in its frame [m].
        pin_radius: [m], > 0.
        hole_radius: [m], larger than that of the pin; or None, with a clearance.
        clearance: hole_radius - pin_radius [m], > 0, in place of the radius of the hole; or None.
        restitution: e of eq (4) [1], 0..1. Below the engine's stick speed, and with 0, the contact stays closed.
        friction: coefficient of Coulomb friction between pin and wall [1], >= 0.
        friction_static: the same while it sticks [1], at least as large; None: as large.
        wear_coefficient: volume worn off per work of sliding, of pin and hole together [1/Pa], >= 0.
        enabled: whether the contact exists; a number, so that a parameter can switch it off.

    Raises:
        MechanismError: as of all parts; neither or both of hole_radius and clearance are given.

    Source: textbook: J. F. Archard, Contact and rubbing of flat surfaces, J. Appl. Phys. 24 (1953) 981-988, for the
        wear; the contact is that of `OutlineContact`.
    """

    slots: ClassVar = (Slot("body_i", "point_i"), Slot("body_j", "point_j"))
    units: ClassVar = {"pin_radius": "m", "hole_radius": "m", "clearance": "m", "wear_coefficient": "1/Pa"}

    name: str
    body_i: str
    point_i: Point
    body_j: str
    point_j: Point
    pin_radius: Number = field(kw_only=True)
    hole_radius: Number | None = field(default=None, kw_only=True)
    clearance: Number | None = field(default=None, kw_only=True)
    restitution: Number = field(default=0.0, kw_only=True)
    friction: Number = field(default=0.0, kw_only=True)
    friction_static: Number | None = field(default=None, kw_only=True)
    wear_coefficient: Number = field(default=0.0, kw_only=True)
    enabled: Number = field(default=True, kw_only=True)


@dataclass(frozen=True, init=False)
class SlotClearanceJoint(PlayFacts):
    """A pin in a straight slot with round ends and play on both sides.

    It is one `OutlineContact` of a circle in the outline of the slot, its sides and its ends, with its impacts and
    friction. d is the distance of the pin's centre from the middle line of the slot, which goes from the centre of one
    round end to that of the other, and c = hole_radius - pin_radius the clearance; the gap is c - d.

    Outputs: those of `ClearanceJoint`; the contact angle is the direction from the nearest point of the middle line.

    Attributes:
        name: unique within the mechanism.
        body_i: the body with the pin.
        point_i: the pin's centre in its frame [m].
        body_j: the body with the slot.
        point_j: the centre of the slot's first round end in its frame [m].
        axis_j: direction from there to the other end, of any length.
        travel: from the centre of one round end to that of the other [m], > 0.
        pin_radius: [m], > 0.
        hole_radius: half the width of the slot [m], larger than the radius of the pin; or None, with a clearance.
        clearance: hole_radius - pin_radius [m], > 0, in place of hole_radius; or None.
        restitution: e of eq (4) [1], 0..1. Below the engine's stick speed, and with 0, the contact stays closed.
        friction: coefficient of Coulomb friction between pin and wall [1], >= 0.
        friction_static: the same while it sticks [1], at least as large; None: as large.
        wear_coefficient: volume worn off per work of sliding, of pin and slot together [1/Pa], >= 0.
        enabled: whether the contact exists; a number, so that a parameter can switch it off.

    Raises:
        MechanismError: as of all parts; neither or both of hole_radius and clearance are given.

    Source: as of `ClearanceJoint`.
    """

    slots: ClassVar = (Slot("body_i", "point_i"), Slot("body_j", "point_j", "axis_j"))
    units: ClassVar = {**ClearanceJoint.units, "travel": "m"}
    _instead: ClassVar[str] = "the pin has no play; use RevoluteTranslational."

    name: str
    body_i: str
    point_i: Point
    body_j: str
    point_j: Point
    axis_j: Point
    travel: Number = field(kw_only=True)
    pin_radius: Number = field(kw_only=True)
    hole_radius: Number | None = field(default=None, kw_only=True)
    clearance: Number | None = field(default=None, kw_only=True)
    restitution: Number = field(default=0.0, kw_only=True)
    friction: Number = field(default=0.0, kw_only=True)
    friction_static: Number | None = field(default=None, kw_only=True)
    wear_coefficient: Number = field(default=0.0, kw_only=True)
    enabled: Number = field(default=True, kw_only=True)

    @property
    def _along(self) -> Point:
        """Unit vector along the slot; of no direction, none."""
        long = length(self.axis_j)
        size: Number = where_positive(long, long, 1.0)
        return self.axis_j[0] / size, self.axis_j[1] / size

    @property
    def centres(self) -> tuple[Point, Point]:
        """Where the middle line of the slot begins, and how far it goes [m], in the frame of body j."""
        x, y = self._along
        return self.point_j, (self.travel * x, self.travel * y)

    @cached_property
    def outline_j(self) -> Outline:
        """The slot, from the centre of mass of its body, clockwise."""
        (x, y), (u, v), r = self.point_j, self._along, self.bore
        a, b = self.centres[1]
        vertices = (
            (x - r * v, y + r * u, 0.0),
            (x + a - r * v, y + b + r * u, -1.0),
            (x + a + r * v, y + b - r * u, 0.0),
            (x + r * v, y - r * u, -1.0),
        )
        return Outline(vertices, hole=True)

    def findings(self) -> Iterator[Finding]:
        """Those of all joints with play, and of the slot's direction and length."""
        yield from super().findings()
        text = f"{self.label}: travel = {{:g}} m, but it must be positive and finite; a round hole is a ClearanceJoint."
        yield refuse_unless(finite_positive(self.travel), text, self.travel)
        long = length(self.axis_j)
        text = f"{self.label}: its axis_j has length {{:g}}, so that it has no direction; it must be positive."
        yield refuse_unless(positive(long), text, long)
