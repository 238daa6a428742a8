"""Circular patterns: repetition of contacts around a body."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from .attached import Attached, Slot
from .body import Point
from .contact_facts import no_unit_length
from .findings import Finding, both, finite, literal, not_zero, refuse_unless, true_or_false
from .functions import Number


@dataclass(frozen=True, init=False)
class CircularPattern(Attached):
    """Teeth or slots that repeat around the centre of a body; the engine keeps the copy that is near a point.

    Copy k of every contact of the pattern is the contact's own line, turned by k * pitch. Between the copies 0 and 1
    lies a straight boundary; when the point crosses it (or one of its copies), the contacts of the pattern open and
    stand at the next copy. The free space of one copy must be convex: for teeth, the boundary runs outwards from the
    apex.

    Attributes:
        name: unique within the mechanism.
        body_i: the body that carries the point.
        point_i: the point in its frame [m].
        body_j: the body around whose centre of mass the copies stand.
        pitch: from one copy to the next [rad], not 0; negative when the copies are counted clockwise.
        boundary_point: a point of the boundary between copies 0 and 1, in the frame of `body_j` [m].
        boundary_normal: unit normal of the boundary [1], towards copy 1.
        enabled: whether the contacts repeat; a number, so that a parameter can switch it off.

    Source: this project's: docs/decisions/005-one-sided-contacts.md; docs/elements/circular_pattern.md.
    """

    slots: ClassVar = (Slot("body_i", "point_i"), Slot("body_j", "boundary_point", "boundary_normal", "normal"))
    units: ClassVar = {"pitch": "rad"}

    name: str
    body_i: str
    point_i: Point
    body_j: str
    pitch: Number
    boundary_point: Point
    boundary_normal: Point
    enabled: Number = True

    def data(self) -> tuple[Number, ...]:
        """The pattern's row of the table `pattern_data`: point_i, boundary_point, boundary_normal."""
        return (*self.point_i, *self.boundary_point, *self.boundary_normal)

    def findings(self) -> Iterator[Finding]:
        """Every problem that its numbers can have."""
        label = f"Pattern {literal(repr(self.name))}"
        yield no_unit_length(f"{label}: its boundary normal", self.boundary_normal)
        text = f"{label}: enabled = {{:g}} is neither true (1) nor false (0)."
        yield refuse_unless(true_or_false(self.enabled), text, self.enabled)
        text = f"{label}: pitch = {{:g}} rad must be finite and not zero."
        yield refuse_unless(both(not_zero(self.pitch), finite(self.pitch)), text, self.pitch)
