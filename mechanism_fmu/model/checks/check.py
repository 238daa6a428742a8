"""Validation of a mechanism's structure: what cannot be right is refused, by name and with the way out."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ..body import GROUND
from ..contacts import Contact, PointLineContact
from ..curves import Curve
from ..errors import MechanismError
from ..findings import messages
from ..forces import NonlinearSpring, SpringDamper
from ..joints import Revolute
from ..logic import resolve_function, switch
from ..mechanism import Mechanism, curve_owners
from ..ports import Calculated, Input, Output
from ..sources import resolve_output
from .check_numbers import check_members, number_findings

# What cannot be right of the structure of contacts and logical functions.


def check_contacts(mechanism: Mechanism) -> Iterator[str]:
    """Every problem of the contacts and logical functions of a mechanism but for their numbers, one sentence each."""
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


def check(mechanism: Mechanism) -> None:
    """Check a mechanism whose values are plain numbers.

    Raises:
        MechanismError: with every problem found, one sentence each.
    """
    misplaced = [*_misplaced(mechanism)]
    if misplaced:
        raise MechanismError(" ".join(misplaced))  # what else is asked of parts, these do not know
    problems = [
        *messages(number_findings(mechanism)),
        *_laws(mechanism),
        *_names(mechanism),
        *_references(mechanism),
        *_without_length(mechanism),
        *check_contacts(mechanism),
        *check_members(mechanism),
        *_curves(mechanism),
        *_ports(mechanism),
    ]
    if problems:
        raise MechanismError(" ".join(problems))


def _misplaced(mechanism: Mechanism) -> Iterator[str]:
    """Parts that stand among others, and drivers and pairs whose motion or profile is no curve."""
    joints: tuple[Any, ...] = mechanism.joints
    contacts: tuple[Any, ...] = mechanism.contacts
    for part, place, needed in [(j, "joints", "motion") for j in joints] + [
        (c, "contacts", "profiles") for c in contacts
    ]:
        label = f"{type(part).__name__} {getattr(part, 'name', '')!r}"
        if not hasattr(part, needed):
            other = (
                "contacts" if hasattr(part, "profiles") else "joints" if hasattr(part, "motion") else "another place"
            )
            yield f"{label} stands in {place}, but belongs in {other}."
            continue
        curves = (part.motion,) if place == "joints" else part.profiles
        for curve in curves:
            if curve is not None and not isinstance(curve, Curve):
                example = "polynomial_motion(start, speed)" if place == "joints" else "circle(radius)"
                yield f"{label}: its {needed.rstrip('s')} is {curve!r}, but must be a curve, e.g. {example}."


def _laws(mechanism: Mechanism) -> Iterator[str]:
    """Words that are no law."""
    known = ("newton", "poisson", "stronge")
    if mechanism.impact_law not in known:
        yield f"impact_law = {mechanism.impact_law!r} is none of {', '.join(known)}."


def _names(mechanism: Mechanism) -> Iterator[str]:
    if not mechanism.bodies:
        yield "The mechanism has no body; give at least one."
    seen: dict[str, str] = {GROUND: "the fixed frame"}
    parts = (*mechanism.bodies, *mechanism.joints, *mechanism.forces, *mechanism.sensors, *mechanism.contacts)
    for part in (*parts, *mechanism.patterns, *mechanism.functions, *mechanism.members, *mechanism.lumped_masses):
        what = type(part).__name__
        if not part.name or "." in part.name or ":" in part.name:
            yield f"{what} {part.name!r}: a name must not be empty or hold '.' or ':'; choose another."
        elif part.name in seen:
            yield f"{what} {part.name!r} has the name of {seen[part.name]}; every part needs a name of its own."
        seen[part.name] = f"another part ({what})"
    ports: tuple[Input | Output | Calculated, ...] = (*mechanism.inputs, *mechanism.outputs, *mechanism.calculated)
    taken: set[str] = set()
    for port in ports:
        if port.name == "time":
            yield f"{type(port).__name__} 'time': tables and FMUs have a column of time by that name; choose another."
        if port.name in taken:
            yield f"{type(port).__name__} {port.name!r} stands twice among the ports; rename one of the two."
        taken.add(port.name)


def _references(mechanism: Mechanism) -> Iterator[str]:
    known = [body.name for body in mechanism.bodies]
    pairs = (*mechanism.joints, *mechanism.contacts, *mechanism.patterns)
    users = [(p, (p.body_i, p.body_j)) for p in pairs]
    forces = [(f, (f.body, f.reaction)) for f in (*mechanism.forces, *mechanism.sensors)]
    for part, bodies in (*users, *forces):
        label = f"{type(part).__name__} {part.name!r}"
        for name in bodies:
            if name != GROUND and name not in known:
                yield f"{label} is attached to unknown body {name!r}; there are {', '.join(known)} and {GROUND!r}."
        if bodies[0] == bodies[1] and len(getattr(part, "slots", ())) == 1:
            yield f"{label} stands on {bodies[0]!r}, which does not move; attach it to a body."
        elif bodies[0] == bodies[1]:
            yield f"{label} joins {bodies[0]!r} to itself; attach it to two different bodies."


def _without_length(mechanism: Mechanism) -> Iterator[str]:
    """Springs between two points that a pin keeps together: rounding would decide where they pull."""
    pins = {}
    for joint in mechanism.joints:
        if isinstance(joint, Revolute):
            ends = (joint.body_i, tuple(joint.point_i)), (joint.body_j, tuple(joint.point_j))
            pins[frozenset(ends)] = joint.name
    for force in mechanism.forces:
        if isinstance(force, SpringDamper | NonlinearSpring):
            pair = frozenset(((force.body, tuple(force.point)), (force.reaction, tuple(force.reaction_point))))
            if pair in pins:
                yield (
                    f"{type(force).__name__} {force.name!r} acts between two points that Revolute {pins[pair]!r} keeps "
                    "together: it has no length, and so no direction. Attach it to other points, or take a torque or a "
                    "TorsionSpringDamper."
                )


def _curves(mechanism: Mechanism) -> Iterator[str]:
    for owner, curve in curve_owners(mechanism):
        if not curve.pieces:
            yield f"The curve of {owner!r} has no pieces; give at least one."


def _ports(mechanism: Mechanism) -> Iterator[str]:
    forces = {force.name: force for force in mechanism.forces}
    inputs = {i.name for i in mechanism.inputs}
    written: dict[str, str] = {}
    for port in mechanism.inputs:
        if port.target in written:
            yield f"Input {port.name!r} writes {port.target!r}, as {written[port.target]!r} does; remove one of them."
        written[port.target] = port.name
        force, _, entry = port.target.partition(".")
        if force not in forces or entry not in forces[force].columns:
            targets = [f"{name}.{column}" for name, f in forces.items() for column in f.columns]
            yield f"Input {port.name!r} writes {port.target!r}, which does not exist; choose {' or '.join(targets)}."
    for output in mechanism.outputs:
        try:
            resolve_output(output.source, mechanism)
        except MechanismError as error:
            yield f"Output {output.name!r}: {error}"
        for name in output.feedthrough:
            if name not in inputs:
                yield f"Output {output.name!r} depends on unknown input {name!r}."
    names = [f"{body.name}.{coordinate}" for body in mechanism.bodies for coordinate in ("x", "y", "angle")]
    for held in mechanism.held:
        if held not in names:
            yield f"Held coordinate {held!r} does not exist; choose among {', '.join(names)}."
