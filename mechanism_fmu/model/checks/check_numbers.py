"""Validation of a mechanism's numbers, as findings: of plain numbers, and traced for native FMUs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields

from ...tables.sizes import MOST_IMPLICIT
from ..body import GROUND, Body
from ..contact_facts import static_findings
from ..contacts import Contact
from ..curves import Curve
from ..curves.check_curves import curve_findings
from ..findings import (
    Finding,
    finite,
    finite_not_negative,
    finite_positive,
    first,
    is_zero,
    length,
    literal,
    refuse_unless,
    within,
)
from ..forces import ForceElement
from ..joints import Joint
from ..mechanism import Mechanism, Settings, curve_owners
from ..members import LumpedMass, Member
from ..patterns import CircularPattern

# What cannot be right of elastic members and lumped masses: of their numbers, as findings; of what they are part of.


def member_findings(member: Member) -> Iterator[Finding]:
    """Every problem that the numbers of a member can have."""
    label = f"Member {literal(repr(member.name))}"
    section = member.section
    for what, value, unit in (
        ("area of its section", section.area, "m2"),
        ("second_moment of its section", section.second_moment, "m4"),
        ("depth of its section", section.depth, "m"),
        ("young", member.young, "Pa"),
    ):
        text = f"{label}: {what} = {{:g}} {unit}, but it must be positive and finite."
        yield refuse_unless(finite_positive(value), text, value)
    text = f"{label}: density = {{:g}} kg/m3, but it must be finite and not negative."
    yield refuse_unless(finite_not_negative(member.density), text, member.density)
    (x, y), (x_end, y_end) = member.start, member.end
    text = f"{label}: from ({{:g}}, {{:g}}) to ({{:g}}, {{:g}}) m it has no length; give it two different finite ends."
    yield refuse_unless(finite_positive(length((x_end - x, y_end - y))), text, x, y, x_end, y_end)


def lumped_mass_findings(lump: LumpedMass) -> Iterator[Finding]:
    """Every problem that the numbers of a lumped mass can have."""
    label = f"LumpedMass {literal(repr(lump.name))}"
    for what, value, unit in (("mass", lump.mass, "kg"), ("inertia", lump.inertia, "kg.m2")):
        text = f"{label}: {what} = {{:g}} {unit}, but it must be finite and not negative."
        yield refuse_unless(finite_not_negative(value), text, value)
    text = f"{label}: its point ({{:g}}, {{:g}}) m is not finite; give finite ones."
    yield refuse_unless(finite(*lump.point), text, *lump.point)


def check_members(mechanism: Mechanism) -> Iterator[str]:
    """Members and lumped masses of no body, one sentence each."""
    known = [body.name for body in mechanism.bodies]
    parts: tuple[Member | LumpedMass, ...] = (*mechanism.members, *mechanism.lumped_masses)
    for part in parts:
        label = f"{type(part).__name__} {part.name!r}"
        if part.body == GROUND:
            yield f"{label} is part of {GROUND!r}, which neither moves nor bends; make it part of a body."
        elif part.body not in known:
            yield f"{label} is part of unknown body {part.body!r}; there are {', '.join(known)}."


#: Numbers of parts of which each kind is asked by itself whether it is finite, and more.
_ASKED_FOR = ("restitution", "friction", "friction_radius", "enabled", "closed", "guided", "unilateral", "law")


def number_findings(mechanism: Mechanism) -> Iterator[Finding]:
    """Every problem that the numbers of a mechanism, plain or symbolic, can have: a finding each, applying or not."""
    for body in mechanism.bodies:
        yield from _body(body)
    for contact in mechanism.contacts:
        yield from contact.findings()
    for pattern in mechanism.patterns:
        yield from pattern.findings()
    for function in mechanism.functions:
        label = f"Logical function {literal(repr(function.name))}"
        text = f"{label}: its limit {{:g}} is not finite; give a finite one as below."
        yield refuse_unless(finite(function.below), text, function.below)
    for force in mechanism.elements:
        yield from force.findings()
    for joint in mechanism.joints:
        text = f"Joint {literal(repr(joint.name))}: {joint.friction_name} = {{:g}} must be finite and not negative."
        yield refuse_unless(finite_not_negative(joint.friction), text, joint.friction)
        yield from static_findings(joint, f"Joint {literal(repr(joint.name))}")
    for part in (*mechanism.joints, *mechanism.elements, *mechanism.contacts, *mechanism.patterns):
        yield from _not_finite(part)
    for port in mechanism.inputs:
        text = f"Input {literal(repr(port.name))}: start = {{:g}} is not finite."
        yield refuse_unless(finite(port.start), text, port.start)
        text = f"Input {literal(repr(port.name))}: factor {{:g}} and offset {{:g}} must be finite."
        yield refuse_unless(finite(port.factor, port.offset), text, port.factor, port.offset)
    for joint in mechanism.joints:
        yield from joint.findings()
    for contact in mechanism.contacts:
        yield from contact.shape_findings()
    for owner, curve in curve_owners(mechanism):
        yield from curve_findings(owner, curve)
    for member in mechanism.members:
        yield from member_findings(member)
    for lump in mechanism.lumped_masses:
        yield from lumped_mass_findings(lump)
    yield from _settings(mechanism.settings, len(mechanism.bodies))


def _not_finite(part: Joint | ForceElement | Contact | CircularPattern) -> tuple[Finding, ...]:
    """The first number of a part that is not finite, or else that what is made of them is not."""
    label = f"{type(part).__name__} {literal(repr(part.name))}"
    found = []
    for field in fields(part):
        value = getattr(part, field.name)
        numbers = value if isinstance(value, tuple) else (value,)
        asked = field.name in _ASKED_FOR or callable(value) or hasattr(value, "__dataclass_fields__")
        if not asked and not any(isinstance(n, str | Curve | None) for n in numbers):
            shown = "({:g}, {:g})" if isinstance(value, tuple) else "{:g}"
            text = f"{label}: {field.name} = {shown} is not finite; give finite numbers."
            found.append(refuse_unless(finite(*numbers), text, *numbers))
    text = f"{label} holds numbers whose products are too large; give smaller ones."
    return first(*found, refuse_unless(finite(*part.data()), text))


def _body(body: Body) -> Iterator[Finding]:
    label = f"Body {literal(repr(body.name))}"
    for what, value, unit in (("mass", body.mass, "kg"), ("inertia", body.inertia, "kg.m2")):
        text = f"{label}: {what} = {{:g}} {unit}, but it must be positive and finite."
        yield refuse_unless(finite_positive(value), text, value)
    if body.tooth_length is not None:
        text = f"{label}: tooth_length = {{:g}} m, but it must be positive and finite; None is a body without teeth."
        yield refuse_unless(finite_positive(body.tooth_length), text, body.tooth_length)
    start = (*body.start, *body.start_rate)
    text = f"{label}: start ({{:g}}, {{:g}}, {{:g}}) or start_rate ({{:g}}, {{:g}}, {{:g}}) is not finite."
    yield refuse_unless(finite(*start), text, *start)
    text = f"{label}: its centre ({{:g}}, {{:g}}) m or radius {{:g}} m is not finite; give finite ones."
    shape = (*body.centre, body.radius)
    yield refuse_unless(finite(*shape), text, *shape)


def _settings(settings: Settings, bodies: int) -> Iterator[Finding]:
    tolerance = settings.relative_tolerance
    text = "relative_tolerance = {:g} is outside 1e-13..1e-3."
    yield refuse_unless(within(tolerance, 1e-13, 1e-3), text, tolerance)
    most = settings.max_internal_steps
    yield refuse_unless(within(most, 10, 1e9), "max_internal_steps = {:g} is outside 10..1e9.", most)
    method = settings.integration_method
    text = "integration_method = {:g} is outside 0 (chosen by stiffness), 1 (explicit), 2 (implicit)."
    yield refuse_unless(is_zero(method * (1.0 - method) * (2.0 - method)), text, method)
    if bodies > MOST_IMPLICIT:
        text = (
            f"integration_method = 2, implicit, is for {MOST_IMPLICIT} bodies at most, because its matrix is full, and "
            f"this mechanism has {bodies}: take 0 or 1, which are explicit then."
        )
        yield refuse_unless(is_zero(method * (1.0 - method)), text)
    for name in ("baumgarte_alpha", "baumgarte_beta"):
        value = getattr(settings, name)
        yield refuse_unless(finite_not_negative(value), f"{name} = {{:g}} must be finite and not negative.", value)
