"""Logical functions of a mechanism: those of every contact, pattern and stop, and the declared ones."""

from __future__ import annotations

from collections.abc import Iterator

from ..statechart import Definition
from ..tolerances import (
    MARGIN,
    PUSHES_SHARE,
    PUSHES_WITHIN,
    RESTS_BELOW,
    ROOT_TOLERANCE,
    SLIPS_ABOVE,
    STICK_SPEED,
    TOUCHES_WITHIN,
)
from .contacts import AngleStop, Contact
from .forces import ForceElement
from .joints import Joint
from .mechanism import Mechanism, may_rub, turns
from .patterns import CircularPattern

#: What tolerances are parts of, by unit: the scales of the mechanism (`engine.scales`); angles are as they are.
_SCALES = {
    "m": "of the length scale",
    "rad": "rad",
    "m/s": "of the speed scale",
    "rad/s": "of the rate scale",
}
_OF_FORCES = f"{PUSHES_WITHIN:g} of what acts + {PUSHES_SHARE:g} of the largest, by the masses"


def exists(part: Contact | CircularPattern) -> bool:
    """Whether a part is there at all, for plain numbers."""
    return bool(part.enabled > 0.5)


def is_kept(contact: Contact, mechanism: Mechanism) -> bool:
    """Whether a contact is closed from the start to the end: guided, closed, and on no pattern that could move it."""
    moved = any(p.name == contact.pattern and exists(p) for p in mechanism.patterns)
    return bool(contact.guided > 0.5 and contact.closed > 0.5 and contact.closed_while is None and not moved)


def rubbing(mechanism: Mechanism) -> Iterator[Contact | Joint | ForceElement]:
    """The contacts, joints and brakes that have friction, for plain numbers."""
    return (part for part in mechanism.rubbing if may_rub(part) and getattr(part, "enabled", 1.0) > 0.5)


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
    for part in rubbing(mechanism):
        yield from _of_friction(part)
    for pattern in filter(exists, mechanism.patterns):
        for verb, copy in (("next", "k + 1"), ("previous", "k - 1")):
            yield Definition(
                f"{pattern.name}.{verb}",
                f"the point of {pattern.body_i} is beyond the boundary from copy k to copy {copy}",
                "m",
                _margin("m"),
                f"{pattern.name}.{verb}",
            )
    for function in mechanism.functions:
        unit = "rad" if function.of.endswith(".angle") else "m"
        meaning = f"{function.of} < {function.below:.9g}"
        yield Definition(function.name, meaning, unit, _margin(unit), function.name)


def _margin(unit: str) -> str:
    return f"{MARGIN:g} {_SCALES[unit]}"


def _of_friction(part: Contact | Joint | ForceElement) -> Iterator[Definition]:
    speed, force = ("rad/s", "N.m") if turns(part) else ("m/s", "N")
    yield Definition(
        f"{part.name}.rests", "slip speed = 0", speed, f"{SLIPS_ABOVE:g} {_SCALES[speed]}", f"{part.name}.sticks"
    )
    yield Definition(
        f"{part.name}.gives",
        "|friction| >= what holds while it sticks",
        force,
        _OF_FORCES,
        f"{part.name}.slips",
    )


def _of_contact(contact: Contact) -> Iterator[Definition]:
    name = contact.name
    length, force = ("rad", "N.m") if contact.angular else ("m", "N")
    speed = f"{length}/s"
    yield Definition(
        f"{name}.touches",
        "gap s <= 0",
        length,
        f"{TOUCHES_WITHIN:g} {_SCALES[length]}; the instant to {ROOT_TOLERANCE:g} of the time scale",
        f"{name}.gap",
    )
    yield Definition(f"{name}.approaches", "gap rate s' < 0", speed, f"{RESTS_BELOW:g} {_SCALES[speed]}")
    yield Definition(
        f"{name}.leaves",
        "gap rate s' > 0, after an impact at least the stick speed",
        speed,
        f"{RESTS_BELOW:g} {_SCALES[speed]}; after an impact {STICK_SPEED:g} {_SCALES[speed]}",
    )
    if not contact.guided > 0.5:
        yield Definition(
            f"{name}.pushes",
            "multiplier > 0",
            force,
            _OF_FORCES,
            f"{name}.force",
        )
