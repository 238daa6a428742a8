"""Which members of a linkage have other sections than in another design of it, all else being the same."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..model import Mechanism, Member
from ..model.body import Point

#: Rounding of lengths and numbers, in parts of them.
_SAME = 1e-9


class Resized(NamedTuple):
    """Names of members whose sections differ, and of those among them whose depth in the plane does."""

    members: tuple[str, ...]
    depths: tuple[str, ...]


def resized_members(before: Mechanism, after: Mechanism) -> Resized | None:
    """Members that have other sections in the second design; None if anything else of the linkage differs, too.

    Lengths and directions of members, their material, the disks and the joints must be the same. Where a body's frame
    stands, in its centre of mass, may differ: it moves with the masses, and the linkage does not.
    """
    parts = [[(type(part), part.name) for part in (*m.members, *m.disks, *m.joints)] for m in (before, after)]
    if parts[0] != parts[1] or not np.allclose(_layout(before), _layout(after), rtol=_SAME, atol=_SAME):
        return None
    pairs = list(zip(before.members, after.members, strict=True))
    other = [one.name for one, two in pairs if not np.allclose(_section(one), _section(two), rtol=_SAME, atol=0.0)]
    depths = [one.name for one, two in pairs if not math.isclose(_depth(one), _depth(two), rel_tol=_SAME)]
    return Resized(tuple(other), tuple(depths))


def _depth(member: Member) -> float:
    return float(member.section.depth)


def _section(member: Member) -> list[float]:
    return [float(x) for x in (member.section.area, member.section.second_moment, member.section.depth)]


def _layout(mechanism: Mechanism) -> list[float]:
    """All numbers that sections do not change: what a body holds, seen from the start of its first member."""
    origin = {member.body: member.start for member in reversed(mechanism.members)}
    found: list[float] = []

    def add(body: str, point: Point) -> None:
        first = origin.get(body, (0.0, 0.0))
        found.extend(float(p) - float(o) for p, o in zip(point, first, strict=True))

    for member in mechanism.members:
        add(member.body, member.start)
        add(member.body, member.end)
        found.extend([float(member.young), float(member.density)])
    for disk in mechanism.disks:
        add(disk.body, disk.point)
        found.extend([float(disk.mass), float(disk.inertia)])
    for joint in mechanism.joints:
        for body, end in ((joint.body_i, "point_i"), (joint.body_j, "point_j")):
            add(body, getattr(joint, end, origin.get(body, (0.0, 0.0))))
    return found
