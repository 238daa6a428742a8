"""Logical functions of a mechanism, those of every contact, pattern and stop and the declared ones; names of events."""

from __future__ import annotations

from collections.abc import Iterator

from .. import codes
from ..statechart import Definition
from ..tolerances import (
    MARGIN,
    PUSHES_SHARE,
    PUSHES_WITHIN,
    RESTS_BELOW,
    ROOT_TOLERANCE,
    STICK_SPEED,
    TOUCHES_WITHIN,
)
from .contacts import AngleStop, Contact
from .mechanism import Mechanism
from .patterns import CircularPattern


def exists(part: Contact | CircularPattern) -> bool:
    """Whether a part is there at all, for plain numbers."""
    return bool(part.enabled > 0.5)


def is_kept(contact: Contact, mechanism: Mechanism) -> bool:
    """Whether a contact is closed from the start to the end: guided, closed, and on no pattern that could move it."""
    moved = any(p.name == contact.pattern and exists(p) for p in mechanism.patterns)
    return bool(contact.guided > 0.5 and contact.closed > 0.5 and contact.closed_while is None and not moved)


def definitions(mechanism: Mechanism) -> Iterator[Definition]:
    """The logical functions of what exists and can change, each with the event that it fires."""
    for contact in filter(exists, mechanism.contacts):
        if contact.closed_while is None and not is_kept(contact, mechanism):
            yield from _of_contact(contact)
        if isinstance(contact, AngleStop) and contact.pitch is not None:
            yield Definition(
                f"{contact.name}.click",
                "gap s >= pitch: the next latched angle is passed",
                "rad",
                f"{MARGIN:g} rad",
                f"{contact.name}.click",
            )
    for pattern in filter(exists, mechanism.patterns):
        for verb, copy in (("next", "k + 1"), ("previous", "k - 1")):
            yield Definition(
                f"{pattern.name}.{verb}",
                f"the point of {pattern.body_i} is beyond the boundary from copy k to copy {copy}",
                "m",
                f"{MARGIN:g} m",
                f"{pattern.name}.{verb}",
            )
    for function in mechanism.functions:
        unit = "rad" if function.of.endswith(".angle") else "m"
        meaning = f"{function.of} < {function.below:.9g}"
        yield Definition(function.name, meaning, unit, f"{MARGIN:g} {unit}", function.name)


def _of_contact(contact: Contact) -> Iterator[Definition]:
    name = contact.name
    length, force = ("rad", "N.m") if contact.angular else ("m", "N")
    speed = f"{length}/s"
    yield Definition(
        f"{name}.touches",
        "gap s <= 0",
        length,
        f"{TOUCHES_WITHIN:g} {length}; the instant to {ROOT_TOLERANCE:g} s",
        f"{name}.gap",
    )
    yield Definition(f"{name}.approaches", "gap rate s' < 0", speed, f"{RESTS_BELOW:g} {speed}")
    yield Definition(
        f"{name}.leaves",
        "gap rate s' > 0, after an impact at least the stick speed",
        speed,
        f"{RESTS_BELOW:g} {speed}; after an impact {STICK_SPEED:g} {speed}",
    )
    if not contact.guided > 0.5:
        yield Definition(
            f"{name}.pushes",
            "multiplier > 0",
            force,
            f"{PUSHES_WITHIN:g} {force} + {PUSHES_SHARE:g} of the largest",
            f"{name}.force",
        )


# Names of events: the quantity that reaches zero, or the logical function that changes.

#: The event of inputs that have changed.
INPUT = "input"

_OF_CONTACT = {codes.GUARD_GAP: "gap", codes.GUARD_PUSH: "force", codes.GUARD_CLICK: "click"}
_OF_PATTERN = {codes.GUARD_NEXT: "next", codes.GUARD_PREVIOUS: "previous"}


def event_name(mechanism: Mechanism, guard: int, subject: int) -> str:
    """The name of an event, from the engine's guard (`codes.GUARD_GAP` ...) and its contact, pattern or function."""
    if guard == codes.GUARD_INPUT:
        return INPUT
    if guard == codes.GUARD_FUNCTION:
        return mechanism.functions[subject].name
    if guard in _OF_PATTERN:
        return f"{mechanism.patterns[subject].name}.{_OF_PATTERN[guard]}"
    return f"{mechanism.contacts[subject].name}.{_OF_CONTACT[guard]}"


def event_names(mechanism: Mechanism) -> Iterator[tuple[int, int, str]]:
    """All (guard, subject, name) that the engine can report of a mechanism, in the order of the guards."""
    subjects = {
        **dict.fromkeys(_OF_CONTACT, len(mechanism.contacts)),
        **dict.fromkeys(_OF_PATTERN, len(mechanism.patterns)),
        codes.GUARD_FUNCTION: len(mechanism.functions),
    }
    for guard in sorted(subjects):
        for subject in range(subjects[guard]):
            if guard != codes.GUARD_CLICK or mechanism.contacts[subject].has_memory:
                yield guard, subject, event_name(mechanism, guard, subject)
    yield codes.GUARD_INPUT, codes.NONE, INPUT
