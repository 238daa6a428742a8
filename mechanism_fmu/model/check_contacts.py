"""What cannot be right of contacts, patterns and logical functions."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from .contacts import AngleLock, AngleStop, Contact, PointLineContact
from .errors import MechanismError
from .logic import resolve_function, switch

if TYPE_CHECKING:
    from .mechanism import Mechanism

#: A normal must have unit length to this accuracy.
_UNIT_LENGTH = 1e-9
#: Most contacts of a mechanism: their modes are written as one number.
MOST_CONTACTS = 50


def check_contacts(mechanism: Mechanism) -> Iterator[str]:
    """Every problem of the contacts, patterns and logical functions of a mechanism, one sentence each."""
    if len(mechanism.contacts) > MOST_CONTACTS:
        yield f"The mechanism has {len(mechanism.contacts)} contacts; there may be at most {MOST_CONTACTS}."
    for contact in mechanism.contacts:
        yield from _contact(contact)
        yield from _links(contact, mechanism)
    for pattern in mechanism.patterns:
        yield from _normal(f"Pattern {pattern.name!r}: its boundary normal", pattern.boundary_normal)
        if pattern.enabled not in (0, 1):
            yield f"Pattern {pattern.name!r}: enabled = {pattern.enabled:g} is neither true (1) nor false (0)."
        if not (math.isfinite(pattern.pitch) and pattern.pitch != 0):
            yield f"Pattern {pattern.name!r}: pitch = {pattern.pitch:g} rad must be finite and not zero."
    yield from _functions(mechanism)


def _normal(what: str, normal: tuple[float, float]) -> Iterator[str]:
    length = math.hypot(*normal)
    if not abs(length - 1) < _UNIT_LENGTH:
        yield f"{what} has length {length:g}, but it must be a unit vector."


def _contact(contact: Contact) -> Iterator[str]:
    label = f"Contact {contact.name!r}"
    if isinstance(contact, PointLineContact):
        yield from _normal(f"{label}: its normal", contact.normal)
    if not 0 <= contact.restitution <= 1:
        yield f"{label}: restitution = {contact.restitution:g} is outside 0..1."
    for what, value, unit in (("beam_length", contact.beam_length, " m"), ("friction", contact.friction, "")):
        if not (math.isfinite(value) and value >= 0):
            yield f"{label}: {what} = {value:g}{unit} must be finite and not negative."
    for what, switch_value in (("enabled", contact.enabled), ("guided", contact.guided), ("closed", contact.closed)):
        if switch_value not in (0, 1):
            yield f"{label}: {what} = {switch_value:g} is neither true (1) nor false (0); give one of the two."
    if contact.closed_while is not None and (contact.closed or contact.guided or contact.restitution):
        yield f"{label} is closed while {contact.closed_while!r}; leave closed, guided and restitution alone there."
    if isinstance(contact, (AngleStop, AngleLock)) and contact.pitch is not None and not contact.pitch > 0:
        yield f"{label}: pitch = {contact.pitch:g} rad must be positive."


def _links(contact: Contact, mechanism: Mechanism) -> Iterator[str]:
    patterns = {pattern.name: pattern for pattern in mechanism.patterns}
    functions = [function.name for function in mechanism.functions]
    function, _ = switch(contact.closed_while)
    if function is not None and function not in functions:
        known = ", ".join(functions) or "none"
        yield f"Contact {contact.name!r} is closed while {contact.closed_while!r}; logical functions: {known}."
    if contact.pattern is None:
        return
    if contact.pattern not in patterns:
        known = ", ".join(patterns) or "none"
        yield f"Contact {contact.name!r} names pattern {contact.pattern!r}, which does not exist; patterns: {known}."
    elif patterns[contact.pattern].body_j != contact.body_j:
        body = patterns[contact.pattern].body_j
        yield f"Contact {contact.name!r} lies on {contact.body_j!r}, but its pattern repeats around {body!r}."


def _functions(mechanism: Mechanism) -> Iterator[str]:
    lines = {c.name: i for i, c in enumerate(mechanism.contacts) if isinstance(c, PointLineContact)}
    bodies = {body.name: i for i, body in enumerate(mechanism.bodies)}
    for function in mechanism.functions:
        if not math.isfinite(function.below):
            yield f"Logical function {function.name!r}: its limit {function.below} is not finite."
        try:
            resolve_function(function, lines, bodies)
        except MechanismError as error:
            yield str(error)
