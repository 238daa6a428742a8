"""Properties of all contacts: what can be read of them, and what they refuse."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar

from .. import codes
from .attached import Attached
from .body import Point
from .curves import Curve
from .findings import (
    Finding,
    both,
    finite_not_negative,
    is_zero,
    length,
    literal,
    not_negative,
    refuse_unless,
    size,
    true_or_false,
    within,
)
from .functions import Number, where_positive

#: A normal must have unit length to this accuracy.
_UNIT_LENGTH = 1e-9


class ContactFacts(Attached):
    """What all contacts have.

    Attributes:
        angular: whether the gap is an angle, and the force a torque.
        has_memory: whether it clicks (see `AngleStop`).
        has_outlines: whether outlines touch, and hand over from feature to feature (see `OutlineContact`).
        wears: whether the work of its sliding is added up (see `ClearanceJoint`).
        holds: name of the number that says whether it also pulls.
        readings: what an `Output` may read, with the source "<contact>.<name>", as codes.
        rows, alphas: how many constraint rows and contact coordinates it has.
        friction, friction_static: coefficient of Coulomb friction [1], and that while it sticks.
        pattern: name of what repeats it, or None.
    """

    angular: ClassVar[bool] = False
    has_memory: ClassVar[bool] = False
    has_outlines: ClassVar[bool] = False
    wears: ClassVar[bool] = False
    holds: ClassVar[str] = "guided"
    readings: ClassVar[Mapping[str, int]] = {
        "force": codes.CONTACT_FORCE,
        "gap": codes.CONTACT_GAP,
        "closed": codes.CONTACT_CLOSED,
        "gap_acceleration": codes.GAP_ACCELERATION,
    }

    rows: ClassVar[int] = 1
    alphas: ClassVar[int] = 0
    friction: Number = 0.0
    friction_static: Number | None = None
    pattern: str | None = None

    name: str
    body_i: str
    body_j: str

    @property
    def places(self) -> tuple[Any, ...]:
        """The contacts that stand for it in a mechanism: itself."""
        return (self,)

    @property
    def profiles(self) -> tuple[Curve | None, Curve | None]:
        """The profiles of body i and body j, None of one that has none."""
        return getattr(self, "profile_i", None), getattr(self, "profile_j", None)

    def findings(self) -> Iterator[Finding]:
        """Every problem that its numbers can have, but for its shape and for those that are not finite."""
        contact = self._numbers()
        label = self.label
        text = f"{label}: restitution = {{:g}} is outside 0..1."
        yield refuse_unless(within(contact["restitution"], 0.0, 1.0), text, contact["restitution"])
        text = f"{label}: friction = {{:g}} must be finite and not negative."
        yield refuse_unless(finite_not_negative(contact["friction"]), text, contact["friction"])
        yield from static_findings(self, label)
        for what in ("enabled", self.holds, "closed"):
            switch = getattr(self, what)
            text = f"{label}: {what} = {{:g}} is neither true (1) nor false (0); give one of the two."
            yield refuse_unless(true_or_false(switch), text, switch)
        closed_while = getattr(self, "closed_while", None)
        if closed_while is not None:
            alone = both(is_zero(contact["closed"]), both(is_zero(contact["guided"]), is_zero(contact["restitution"])))
            text = f"{label} is closed while {literal(repr(closed_while))}; "
            yield refuse_unless(alone, text + "leave closed, guided and restitution alone there.")

    def shape_findings(self) -> Iterator[Finding]:
        """What the shapes in contact can have wrong, which is said behind all else."""
        yield from ()

    def factor(self, reading: str) -> Number:
        """By what a reading is multiplied where the engine knows less than the contact; else 0.

        Args:
            reading: its name, of those of `readings`.
        """
        return 0.0

    def too_deep(self) -> tuple[str, str]:
        """How to say that it starts inside the other body: what stands before and behind the depth."""
        return f"{self.body_i!r} reaches", f"m into {self.body_j!r}"

    @property
    def holding(self) -> Number:
        """The coefficient of friction while it sticks [1]."""
        return self.friction if self.friction_static is None else self.friction_static

    @property
    def label(self) -> str:
        """Its name, for messages."""
        return f"Contact {literal(repr(self.name))}"

    def _numbers(self) -> dict[str, Number]:
        return {name: getattr(self, name) for name in ("restitution", "friction", "closed", "guided")}


def static_findings(part: Any, label: str) -> Iterator[Finding]:
    """That friction while it sticks is less than while it slips, or all there is."""
    if part.friction_static is not None:
        slips = where_positive(part.friction_static, where_positive(part.friction, 1.0, -1.0), 1.0)
        text = f"{label}: friction_static = {{:g}} has no effect without friction while it slips: give friction, too."
        yield refuse_unless(slips, text, part.friction_static)
        text = f"{label}: friction_static = {{:g}} is less than the friction while it slips, {{:g}}."
        least = part.friction_static - part.friction
        yield refuse_unless(not_negative(least), text, part.friction_static, part.friction)


def no_unit_length(what: str, normal: Point) -> Finding:
    """The finding that a normal is no unit vector."""
    long = length(normal)
    text = f"{what} has length {{:g}}, but it must be a unit vector."
    return refuse_unless(_UNIT_LENGTH - size(long - 1.0), text, long)
