"""What cannot be right of elastic members and disks: of their numbers, as findings, and of what they are part of."""

from __future__ import annotations

from collections.abc import Iterator

from .body import GROUND
from .conditions import finite, finite_not_negative, finite_positive, length
from .findings import Finding, literal, refuse_unless
from .mechanism import Mechanism
from .members import Disk, Member


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


def disk_findings(disk: Disk) -> Iterator[Finding]:
    """Every problem that the numbers of a disk can have."""
    label = f"Disk {literal(repr(disk.name))}"
    for what, value, unit in (("mass", disk.mass, "kg"), ("inertia", disk.inertia, "kg.m2")):
        text = f"{label}: {what} = {{:g}} {unit}, but it must be finite and not negative."
        yield refuse_unless(finite_not_negative(value), text, value)
    text = f"{label}: its point ({{:g}}, {{:g}}) m is not finite; give finite ones."
    yield refuse_unless(finite(*disk.point), text, *disk.point)


def check_members(mechanism: Mechanism) -> Iterator[str]:
    """Members and disks of no body, one sentence each."""
    known = [body.name for body in mechanism.bodies]
    parts: tuple[Member | Disk, ...] = (*mechanism.members, *mechanism.disks)
    for part in parts:
        label = f"{type(part).__name__} {part.name!r}"
        if part.body == GROUND:
            yield f"{label} is part of {GROUND!r}, which neither moves nor bends; make it part of a body."
        elif part.body not in known:
            yield f"{label} is part of unknown body {part.body!r}; there are {', '.join(known)}."
