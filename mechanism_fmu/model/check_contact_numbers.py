"""What cannot be right of the numbers of contacts and patterns, as findings."""

from __future__ import annotations

from collections.abc import Iterator

from .body import Point
from .conditions import (
    both,
    finite,
    finite_not_negative,
    is_zero,
    length,
    not_zero,
    positive,
    size,
    true_or_false,
    within,
)
from .contacts import AngleLock, AngleStop, Contact, PointLineContact
from .findings import Finding, literal, refuse_unless
from .joints import HigherPair
from .patterns import CircularPattern

#: A normal must have unit length to this accuracy.
_UNIT_LENGTH = 1e-9


def contact_findings(contact: Contact) -> Iterator[Finding]:
    """Every problem that the numbers of a contact can have."""
    label = f"Contact {literal(repr(contact.name))}"
    if isinstance(contact, PointLineContact):
        yield _unit(f"{label}: its normal", contact.normal)
    text = f"{label}: restitution = {{:g}} is outside 0..1."
    yield refuse_unless(within(contact.restitution, 0.0, 1.0), text, contact.restitution)
    text = f"{label}: friction = {{:g}} must be finite and not negative."
    yield refuse_unless(finite_not_negative(contact.friction), text, contact.friction)
    holds = ("guided", contact.guided)
    if isinstance(contact, HigherPair):
        holds = ("unilateral", contact.unilateral)
    for what, switch in (("enabled", contact.enabled), holds, ("closed", contact.closed)):
        text = f"{label}: {what} = {{:g}} is neither true (1) nor false (0); give one of the two."
        yield refuse_unless(true_or_false(switch), text, switch)
    if contact.closed_while is not None:
        alone = both(is_zero(contact.closed), both(is_zero(contact.guided), is_zero(contact.restitution)))
        function = literal(repr(contact.closed_while))
        text = f"{label} is closed while {function}; leave closed, guided and restitution alone there."
        yield refuse_unless(alone, text)
    if isinstance(contact, (AngleStop, AngleLock)) and contact.pitch is not None:
        text = f"{label}: pitch = {{:g}} rad must be positive."
        yield refuse_unless(positive(contact.pitch), text, contact.pitch)


def pattern_findings(pattern: CircularPattern) -> Iterator[Finding]:
    """Every problem that the numbers of a pattern can have."""
    label = f"Pattern {literal(repr(pattern.name))}"
    yield _unit(f"{label}: its boundary normal", pattern.boundary_normal)
    text = f"{label}: enabled = {{:g}} is neither true (1) nor false (0)."
    yield refuse_unless(true_or_false(pattern.enabled), text, pattern.enabled)
    text = f"{label}: pitch = {{:g}} rad must be finite and not zero."
    yield refuse_unless(both(not_zero(pattern.pitch), finite(pattern.pitch)), text, pattern.pitch)


def _unit(what: str, normal: Point) -> Finding:
    long = length(normal)
    text = f"{what} has length {{:g}}, but it must be a unit vector."
    return refuse_unless(_UNIT_LENGTH - size(long - 1.0), text, long)
