"""Sources of outputs: the little language of `Output.source`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches
from typing import get_args

from .. import codes
from ..tables.sizes import GIVEN_SIZES, complete
from .beams import OF_BEAM, beam_members, hinge
from .clearance_joints import ClearanceJoint
from .contacts import AngleStop
from .errors import MechanismError
from .forces import ForceElement
from .functions import Number
from .joints import Joint
from .mechanism import OF_FRICTION, Mechanism, can_rub
from .structure import nodes_of

_COORDINATES = {"x": 0, "y": 1, "angle": 2}
_RATES = {"x_rate": 0, "y_rate": 1, "speed": 2}
_ENERGIES = {
    "kinetic": codes.KINETIC_ENERGY,
    "spring": codes.SPRING_ENERGY,
    "work": codes.UNKNOWN,
    "lost": codes.ENERGY_LOST,
}
_COUNTERS = {
    "count": (codes.COUNTER, codes.COUNT_IMPACTS),
    "in_step": (codes.COUNTER, codes.COUNT_IN_STEP),
    "lost": (codes.COUNTER, codes.COUNT_LOST),
    "by_poisson": (codes.COUNTER, codes.COUNT_BY_POISSON),
    "any": (codes.IMPACT_FLAG, 0),
}
#: Of any contact, and of a stop with memory besides, for messages.
_OF_CONTACT = AngleStop.readings
#: Of joints with play besides.
_OF_PLAY = [name for name in ClearanceJoint.readings if name not in _OF_CONTACT]
_FIELDS = {
    "time": codes.RECORD_TIME,
    "contact": codes.RECORD_CONTACT,
    "tooth": codes.RECORD_TOOTH,
    "closing_speed": codes.RECORD_CLOSING_SPEED,
    "impulse": codes.RECORD_IMPULSE,
    "velocity": codes.RECORD_VELOCITY,
    "instant": codes.RECORD_INSTANT,
    "energy_lost": codes.RECORD_ENERGY,
}
_EVENT_FIELDS = {
    "time": codes.EVENT_TIME,
    "guard": codes.EVENT_GUARD,
    "subject": codes.EVENT_SUBJECT,
    "old_mode": codes.EVENT_OLD_MODE,
    "new_mode": codes.EVENT_NEW_MODE,
    "impulse": codes.EVENT_IMPULSE,
}
#: Of a member: kind and column.
_OF_MEMBER = {
    "axial_force": (codes.MEMBER_FORCE, 0),
    "start_moment": (codes.MEMBER_FORCE, 1),
    "end_moment": (codes.MEMBER_FORCE, 2),
    "stress": (codes.MEMBER_STRESS, 0),
}
#: Of an end of a member, behind "start." or "end.": kind, how many of it a node has, and which.
_OF_MEMBER_END = {
    "x": (codes.NODE_PLACE, 2, 0),
    "y": (codes.NODE_PLACE, 2, 1),
    "x_bent": (codes.NODE_BENT, 2, 0),
    "y_bent": (codes.NODE_BENT, 2, 1),
    "x_deflection": (codes.NODE_DEFLECTION, 3, 0),
    "y_deflection": (codes.NODE_DEFLECTION, 3, 1),
    "rotation": (codes.NODE_DEFLECTION, 3, 2),
    "deviation": (codes.NODE_DEVIATION, 1, 0),
}
#: A mode is a sum of 2^c over closed contacts c; as an Integer of FMI it has 31 bits.
MOST_CONTACTS_OF_A_MODE = 31


def resolve_output(source: str, mechanism: Mechanism) -> tuple[int, int, int]:
    """The (kind, index, slot) of an output's source (see `Output`); the factor of an effort is `output_factor`.

    Raises:
        MechanismError: the source names no such part or quantity.
    """
    part, _, quantity = source.partition(".")
    found = (
        _of_impact(part, quantity, mechanism)
        or _of_event(part, quantity, mechanism)
        or _of_body(part, quantity, mechanism)
        or _of_contact(part, quantity, mechanism)
        or _of_pattern(part, quantity, mechanism)
        or _of_force(part, quantity, mechanism)
        or _of_friction(part, quantity, mechanism)
        or _of_joint(part, quantity, mechanism)
        or _of_member(part, quantity, mechanism)
    )
    if part == "energy" and quantity in _ENERGIES:
        found = (_ENERGIES[quantity], _first_of_y(mechanism, "y_work") if quantity == "work" else 0, 0)
    if found is None:
        near = get_close_matches(source, list(_common_sources(mechanism)), 1)
        meant = f"; did you mean {near[0]!r}? There are " if near else "; use "
        raise MechanismError(
            f"output source {source!r} is unknown{meant}<body>.x|y|angle|x_rate|y_rate|speed, "
            f"<contact>.{'|'.join(_OF_CONTACT)}, <joint with play>.{'|'.join(_OF_PLAY)}, "
            f"<profile contact>.alpha_i|alpha_j, "
            f"<contact, joint or brake>.{'|'.join(OF_FRICTION)}, <pattern>.index, "
            f"{', '.join(_of_kinds())}, event.count|in_step, "
            f"<member>.{'|'.join([*_OF_MEMBER, *OF_BEAM])}, <member>.start|end.{'|'.join(_OF_MEMBER_END)}, "
            f"events[k].{'|'.join(_EVENT_FIELDS)}, energy.{'|'.join(_ENERGIES)}, "
            f"impact.{'|'.join([*_COUNTERS, *_FIELDS])} or impacts[k].<field>, with "
            f"bodies {', '.join(b.name for b in mechanism.bodies)} and contacts "
            f"{', '.join(c.name for c in mechanism.contacts) or '(none)'}."
        )
    return found


def _first_of_y(mechanism: Mechanism, part: str) -> int:
    """Where a part of the engine's unknowns begins, by the name of that size; those up to alpha follow the bodies."""
    return complete(dict.fromkeys(GIVEN_SIZES, 0) | {"bodies": len(mechanism.bodies)})[part]


def _of_kinds() -> Iterator[str]:
    """What can be read of force elements and joints, by class."""
    for force in get_args(ForceElement):
        if force.quantities:
            yield f"<{force.__name__}>.{'|'.join(force.quantities)}"
    for joint in get_args(Joint):
        if joint.efforts:
            yield f"<{joint.__name__}>.{'|'.join(joint.efforts)}"


def _common_sources(mechanism: Mechanism) -> Iterator[str]:
    """The sources among which a misspelt one is looked for."""
    for body in mechanism.bodies:
        yield from (f"{body.name}.{quantity}" for quantity in (*_COORDINATES, *_RATES))
        yield from (f"impact.{field}:{body.name}" for field in ("speed", "speed_before"))
    for contact in mechanism.contacts:
        yield from (f"{contact.name}.{quantity}" for quantity in contact.readings)
        yield f"impact.impulse:{contact.name}"
    yield from (f"{pattern.name}.index" for pattern in mechanism.patterns)
    for force in mechanism.elements:
        yield from (f"{force.name}.{quantity}" for quantity in force.quantities)
    for joint in mechanism.joints:
        yield from (f"{joint.name}.{quantity}" for quantity in joint.efforts)
    for member in mechanism.members:
        yield from (f"{member.name}.{quantity}" for quantity in (*_OF_MEMBER, *OF_BEAM))
        yield from (f"{member.name}.{end}.{quantity}" for end in ("start", "end") for quantity in _OF_MEMBER_END)
    yield from (f"energy.{kind}" for kind in _ENERGIES)
    yield from (f"impact.{field}" for field in (*_COUNTERS, *_FIELDS))
    yield from (f"impacts[1].{field}" for field in _FIELDS)
    yield from ("event.count", "event.in_step", *(f"events[1].{field}" for field in _EVENT_FIELDS))


def _of_body(part: str, quantity: str, mechanism: Mechanism) -> tuple[int, int, int] | None:
    names = [b.name for b in mechanism.bodies]
    if part not in names:
        return None
    first = 3 * names.index(part)
    if quantity in _COORDINATES:
        return codes.UNKNOWN, first + _COORDINATES[quantity], 0
    if quantity in _RATES:
        return codes.UNKNOWN, _first_of_y(mechanism, "coordinates") + first + _RATES[quantity], 0
    return None


def _of_contact(part: str, quantity: str, mechanism: Mechanism) -> tuple[int, int, int] | None:
    names = [c.name for c in mechanism.contacts]
    if part in names and quantity in ("alpha_i", "alpha_j"):
        return _of_profiles(names.index(part), int(quantity == "alpha_j"), mechanism)
    if part not in names or quantity not in mechanism.contacts[names.index(part)].readings:
        return None
    return mechanism.contacts[names.index(part)].readings[quantity], names.index(part), 0


def _of_profiles(contact: int, which: int, mechanism: Mechanism) -> tuple[int, int, int] | None:
    """A contact coordinate: of profile i or j of a contact, where it has one."""
    profiles = mechanism.contacts[contact].profiles
    if profiles[which] is None:
        return None
    before = sum(other.alphas for other in mechanism.contacts[:contact])
    return codes.UNKNOWN, _first_of_y(mechanism, "y_alpha") + before + which * (profiles[0] is not None), 0


def _of_joint(part: str, quantity: str, mechanism: Mechanism) -> tuple[int, int, int] | None:
    row = 0
    for joint in mechanism.joints:
        if joint.name == part:
            found = joint.effort(quantity)
            return None if found is None else (codes.JOINT_FORCE, row + found[0], 0)
        row += joint.rows
    return None


def output_factor(source: str, mechanism: Mechanism) -> Number:
    """The factor of what an output reads, 0 for sources without: of a joint's multiplier, a member, a joint with play.

    The moment on a member's start bends it against the sense in which it turns it.
    """
    part, _, quantity = source.partition(".")
    if quantity in _OF_MEMBER and any(member.name == part for member in mechanism.members):
        return -1.0 if quantity == "start_moment" else 1.0
    for joint in mechanism.joints:
        if joint.name == part:
            found = joint.effort(quantity)
            return 0.0 if found is None else found[1]
    for contact in mechanism.contacts:
        if contact.name == part:
            return contact.factor(quantity)
    return 0.0


def _of_pattern(part: str, quantity: str, mechanism: Mechanism) -> tuple[int, int, int] | None:
    names = [p.name for p in mechanism.patterns]
    return (codes.PATTERN_INDEX, names.index(part), 0) if part in names and quantity == "index" else None


def _of_friction(part: str, quantity: str, mechanism: Mechanism) -> tuple[int, int, int] | None:
    for place, one in enumerate((*mechanism.contacts, *mechanism.joints, *mechanism.elements)):
        if one.name == part and quantity in OF_FRICTION and can_rub(one):
            return OF_FRICTION[quantity], place, 0
    return None


def _of_force(part: str, quantity: str, mechanism: Mechanism) -> tuple[int, int, int] | None:
    for place, force in enumerate(mechanism.elements):
        if force.name == part and quantity in force.quantities:
            return codes.FORCE_READING, place, list(force.quantities).index(quantity)
    return None


def _of_member(part: str, quantity: str, mechanism: Mechanism) -> tuple[int, int, int] | None:
    names = [member.name for member in mechanism.members]
    end, _, wanted = quantity.rpartition(".")
    if part not in names:
        return None
    place = names.index(part)
    if quantity in OF_BEAM:
        hinge(mechanism.members[place], mechanism)
        return OF_BEAM[quantity], beam_members(mechanism).index(mechanism.members[place]), 0
    if quantity in _OF_MEMBER:
        kind, column = _OF_MEMBER[quantity]
        return kind, 3 * place + column if kind == codes.MEMBER_FORCE else place, 0
    if end not in ("start", "end") or wanted not in _OF_MEMBER_END:
        return None
    kind, each, column = _OF_MEMBER_END[wanted]
    return kind, each * nodes_of(mechanism).ends[place][end == "end"] + column, 0


def reads_members(mechanism: Mechanism) -> bool:
    """Whether an output reads an elastic member: only then does the engine see the structure that they make."""
    names = {member.name for member in mechanism.members}
    sources = [output.source.partition(".") for output in mechanism.outputs]
    return any(part in names and quantity not in OF_BEAM for part, _, quantity in sources)


def kept(what: str, mechanism: Mechanism, usual: int) -> int:
    """How many impacts or events of a communication step are kept: as many as there are outputs for, or `usual`.

    Args:
        what: "impacts" or "events".
        mechanism: whose outputs with the source "<what>[k].<field>" say it: the largest k.
        usual: the least number.
    """
    places = [re.match(rf"{what}\[(\d+)\]\.", output.source) for output in mechanism.outputs]
    return max([usual, *(int(place[1]) for place in places if place)])


def _of_impact(part: str, quantity: str, mechanism: Mechanism) -> tuple[int, int, int] | None:
    if part == "impact":
        if quantity in _COUNTERS:
            return *_COUNTERS[quantity], 0
        column = _record_column(quantity, mechanism)
        return None if column is None else (codes.LAST_IMPACT, column, 0)
    match = re.fullmatch(r"impacts\[(\d+)\]", part)
    if match and 1 <= int(match[1]) <= codes.MOST_KEPT:
        column = _record_column(quantity, mechanism)
        return None if column is None else (codes.BUFFERED_IMPACT, column, int(match[1]) - 1)
    return None


def _of_event(part: str, quantity: str, mechanism: Mechanism) -> tuple[int, int, int] | None:
    if part == "event":
        columns = {"count": codes.COUNT_EVENTS, "in_step": codes.EVENTS_IN_STEP}
        return (codes.COUNTER, columns[quantity], 0) if quantity in columns else None
    match = re.fullmatch(r"events\[(\d+)\]", part)
    if match is None or quantity not in _EVENT_FIELDS or not 1 <= int(match[1]) <= codes.MOST_KEPT:
        return None
    if quantity.endswith("_mode") and len(mechanism.contacts) > MOST_CONTACTS_OF_A_MODE:
        raise MechanismError(
            f"output source {part}.{quantity} needs a bit for each of {len(mechanism.contacts)} contacts, and an "
            f"Integer of FMI has {MOST_CONTACTS_OF_A_MODE}; leave this output out."
        )
    return codes.BUFFERED_EVENT, _EVENT_FIELDS[quantity], int(match[1]) - 1


def _record_column(field: str, mechanism: Mechanism) -> int | None:
    if field == "velocity":
        _require_teeth(mechanism)
    if field in _FIELDS:
        return _FIELDS[field]
    what, _, part = field.partition(":")
    contacts = [c.name for c in mechanism.contacts]
    bodies = [b.name for b in mechanism.bodies]
    before = codes.RECORD_CONTACT_IMPULSES + len(contacts)
    if what == "impulse" and part in contacts:
        return codes.RECORD_CONTACT_IMPULSES + contacts.index(part)
    if what == "speed_before" and part in bodies:
        return before + 3 * bodies.index(part) + 2
    if what == "speed" and part in bodies:
        return before + 3 * len(bodies) + 3 * bodies.index(part) + 2
    return None


def _require_teeth(mechanism: Mechanism) -> None:
    """An impact has one v_I, so that one body must have teeth."""
    toothed = [body.name for body in mechanism.bodies if body.tooth_length is not None]
    if len(toothed) != 1:
        has = f"several bodies have teeth ({', '.join(toothed)})" if toothed else "no body has teeth"
        raise MechanismError(
            f"output source impact.velocity is v_I of the body with teeth, but {has}; give Body(tooth_length=...) "
            "to one body, or take the speeds of each body, impact.speed:<body> and impact.speed_before:<body>."
        )
