"""Names of events: the quantity that reaches zero, or the logical function that changes.

"face.gap" and "slope.force" are also the names of these quantities in `Output.source`; a pattern, a stop with memory
and a declared logical function give the names of their functions: "teeth.next", "holding_pawl.click", "pin_in_slot".
"""

from __future__ import annotations

from collections.abc import Iterator

from .. import codes
from .mechanism import Mechanism

#: The event of inputs that have changed.
INPUT = "input"

_OF_CONTACT = {
    codes.GUARD_GAP: "gap",
    codes.GUARD_PUSH: "force",
    codes.GUARD_CLICK: "click",
    codes.GUARD_HANDOVER: "handover",
}
_OF_FRICTION = {
    codes.GUARD_STICK: "sticks",
    codes.GUARD_SLIP: "slips",
    codes.GUARD_SHOCK: "shock",
    codes.GUARD_SEVERAL: "several",
    codes.GUARD_UNDETERMINED: "undetermined",
}
_OF_PATTERN = {codes.GUARD_NEXT: "next", codes.GUARD_PREVIOUS: "previous"}


def event_name(mechanism: Mechanism, guard: int, subject: int) -> str:
    """The name of an event, from the engine's guard (`codes.GUARD_GAP` ...) and its contact, pattern or function."""
    if guard == codes.GUARD_INPUT:
        return INPUT
    if guard == codes.GUARD_FUNCTION:
        return mechanism.functions[subject].name
    if guard in _OF_FRICTION:
        return f"{mechanism.rubbing[subject].name}.{_OF_FRICTION[guard]}"
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
            contact = mechanism.contacts[subject] if guard in _OF_CONTACT else None
            only = {codes.GUARD_CLICK: "has_memory", codes.GUARD_HANDOVER: "has_outlines"}.get(guard)
            if only is None or getattr(contact, only):
                yield guard, subject, event_name(mechanism, guard, subject)
    may_rub = mechanism.rubs_or_may
    for guard in _OF_FRICTION:
        for subject, part in enumerate(mechanism.rubbing):
            if part.name in may_rub:
                yield guard, subject, event_name(mechanism, guard, subject)
    yield codes.GUARD_INPUT, codes.NONE, INPUT
