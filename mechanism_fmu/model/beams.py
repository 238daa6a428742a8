"""Hinged flexible members, loaded at their tips (`engine.elastic`): their tables."""

from __future__ import annotations

from .. import codes
from .contacts import AngleLock, AngleStop, PointLineContact
from .errors import MechanismError
from .functions import Number
from .joints import Revolute
from .mechanism import Mechanism
from .members import Member
from .structure import same_point, span

#: Quantities of such a member, and what the engine calls them.
OF_BEAM = {"tip_deflection": codes.BEAM_DEFLECTION, "bending_stress": codes.BEAM_STRESS}


def beam_members(mechanism: Mechanism) -> list[Member]:
    """The members that outputs read in this way, in their order."""
    sources = [output.source.partition(".") for output in mechanism.outputs]
    read = {part for part, _, quantity in sources if quantity in OF_BEAM}
    return [member for member in mechanism.members if member.name in read]


def hinge(member: Member, mechanism: Mechanism) -> tuple[int, int]:
    """First row of the revolute joint at the start of a member, and 1 where its body is body i of it, else -1.

    Raises:
        MechanismError: there is none, the body has other joints or members, or contacts or lumped
            masses beside its ends.
    """
    row, found, joints = 0, None, 0
    for joint in mechanism.joints:
        for body, side in ((joint.body_i, "i"), (joint.body_j, "j")):
            if body == member.body:
                joints += 1
                if isinstance(joint, Revolute) and same_point(getattr(joint, f"point_{side}"), member.start):
                    found = row, 1 if side == "i" else -1
        row += joint.rows
    if found is None or joints > 1 or sum(other.body == member.body for other in mechanism.members) > 1:
        raise MechanismError(
            f"Member {member.name!r}: {' and '.join(OF_BEAM)} are those of a bar that hangs on one revolute joint at "
            f"its start (give `member.start` to both), with nothing else on its body {member.body!r}; read its stress "
            f"and its ends as parts of a linkage instead."
        )
    _check_beside(member, mechanism)
    return found


def _check_beside(member: Member, mechanism: Mechanism) -> None:
    """The bar's couple is found by moments about its tip, with all mass on it spread evenly or at its ends."""
    for contact in mechanism.contacts:
        if isinstance(contact, (AngleStop, AngleLock)):
            continue  # a couple, at the hinge as all others
        if isinstance(contact, PointLineContact) and contact.body_i == member.body:
            beside = not same_point(contact.point_i, member.end)
        else:
            beside = member.body in (contact.body_i, contact.body_j)
        if beside:
            raise MechanismError(
                f"{type(contact).__name__} {contact.name!r} pushes body {member.body!r} beside the end of member "
                f"{member.name!r}, where {' and '.join(OF_BEAM)} would be wrong; let the member end at the point of a "
                f"PointLineContact (give `member.end` to it)."
            )
    for force in mechanism.elements:
        if force.acts == "at points" and member.body in (force.body, force.reaction):
            raise MechanismError(
                f"{type(force).__name__} {force.name!r} acts at a point of body {member.body!r}, where "
                f"{' and '.join(OF_BEAM)} of member {member.name!r} would be wrong; attach it to another body."
            )
    for lump in mechanism.lumped_masses:
        if lump.body == member.body and not any(same_point(lump.point, end) for end in (member.start, member.end)):
            raise MechanismError(
                f"LumpedMass {lump.name!r} stands beside the ends of member {member.name!r}, where "
                f"{' and '.join(OF_BEAM)} would be wrong; give `member.start` or `member.end` to it."
            )


def beam_data(member: Member, mechanism: Mechanism) -> tuple[Number, ...]:
    """The member's row of the table `beam_data`, in the order of the columns in `codes`."""
    (x, y), (x_end, y_end) = member.start, member.end
    long, section = span(member), member.section
    along_x, along_y = (x_end - x) / long, (y_end - y) / long
    return (
        along_x,
        along_y,
        long,
        -(x * along_x + y * along_y),
        member.young * section.second_moment,
        2 * section.second_moment / section.depth,
        float(hinge(member, mechanism)[1]),
    )
