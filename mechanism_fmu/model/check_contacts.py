"""What cannot be right of the structure of contacts and logical functions."""

from __future__ import annotations

from collections.abc import Iterator

from .contacts import Contact, PointLineContact
from .errors import MechanismError
from .logic import resolve_function, switch
from .mechanism import Mechanism

#: Most contacts of a mechanism: their modes are written as one number.
MOST_CONTACTS = 50


def check_contacts(mechanism: Mechanism) -> Iterator[str]:
    """Every problem of the contacts and logical functions of a mechanism but for their numbers, one sentence each."""
    if len(mechanism.contacts) > MOST_CONTACTS:
        yield f"The mechanism has {len(mechanism.contacts)} contacts; there may be at most {MOST_CONTACTS}."
    for contact in mechanism.contacts:
        yield from _links(contact, mechanism)
    yield from _functions(mechanism)


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
        try:
            resolve_function(function, lines, bodies)
        except MechanismError as error:
            yield str(error)
