"""A mechanism as a structure: its elements with their flexibilities and stresses. No configuration yet."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ...model import Mechanism, Member
from ...model.body import Point
from ..elements import FloatArray, LinkageError, block_diagonal, cantilever, supported_beam, two_force_member
from .places import RELEASED, Freedoms, find_freedoms, place_of
from .pose import require_known

#: Element coordinates, in the order of an element's deformations.
_AXIAL, _TRANSVERSE, _ROTATION = "axial", "transverse", "rotation"


@dataclass(frozen=True)
class Element:
    """A member as an element of the structure.

    Attributes:
        member: it.
        start, end: numbers of the places of its ends.
        coordinates: which it has of "axial", "transverse" and "rotation".
        from_end: whether it is seen from its end: clamped there, or turned by a moment there.
    """

    member: Member
    start: int
    end: int
    coordinates: tuple[str, ...]
    from_end: bool

    @property
    def length(self) -> float:
        """Length l [m]."""
        return math.dist(self.member.start, self.member.end)

    @property
    def flexibility(self) -> FloatArray:
        """F, shape (coordinates, coordinates)."""
        of = self.length, self.member.section, self.member.young
        if self.coordinates == (_AXIAL,):
            return two_force_member(*of)
        if _TRANSVERSE in self.coordinates:
            size = len(self.coordinates)
            return cantilever(*of)[:size, :size]
        return supported_beam(*of)

    @property
    def deformation(self) -> FloatArray:
        """D of d = D e, shape (coordinates, 6), e = (u, v, theta) of start and end along and left of the element."""
        near, far, length = (3, 0, -self.length) if self.from_end else (0, 3, self.length)
        rows = np.zeros((3, 6))
        rows[0, 0], rows[0, 3] = -1.0, 1.0
        if _TRANSVERSE in self.coordinates:  # both seen along the element from the clamped end on
            side = math.copysign(1.0, length)
            rows[1, far + 1], rows[1, near + 1], rows[1, near + 2] = side, -side, -abs(length)
            rows[2, far + 2], rows[2, near + 2] = 1.0, -1.0
            return rows[: len(self.coordinates)]
        rows[1, near + 2] = 1.0  # against the chord, which turns by (v_end - v_start)/l
        rows[1, 1], rows[1, 4] = 1.0 / self.length, -1.0 / self.length
        return rows[: len(self.coordinates)]

    @property
    def section_forces(self) -> FloatArray:
        """S of (N, M_start, M_end) = S f, shape (3, coordinates): tension, and moments that bend it to the left."""
        forces = np.zeros((3, 3))
        forces[0, 0] = 1.0
        near, far = (2, 1) if self.from_end else (1, 2)
        side = -1.0 if self.from_end else 1.0
        if _TRANSVERSE in self.coordinates:
            forces[near, 1], forces[near, 2], forces[far, 2] = side * self.length, side, side
        else:
            forces[near, 1] = -side
        return forces[:, : len(self.coordinates)]


@dataclass(frozen=True)
class Linkage:
    """A mechanism as a structure, in any configuration.

    Attributes:
        mechanism: whose held or driven coordinates stand still.
        freedoms: the displacements of its places.
        elements: its members.
    """

    mechanism: Mechanism
    freedoms: Freedoms
    elements: tuple[Element, ...]

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the element coordinates x_i, "<member>.axial|transverse|rotation", one a deformation."""
        return tuple(f"{e.member.name}.{c}" for e in self.elements for c in e.coordinates)

    @cached_property
    def flexibility(self) -> FloatArray:
        """F of all elements, block diagonal, shape (n, n): it does not depend on the configuration."""
        return block_diagonal(element.flexibility for element in self.elements)


def linkage(mechanism: Mechanism, loaded: Iterable[str] = ()) -> Linkage:
    """The structure of a mechanism with members whose driven, or else held, coordinates stand still.

    Args:
        mechanism: `Mechanism.members` are its elements; bodies without members are rigid.
        loaded: names of places ("<member>.start|end") where a moment is to act although only a pin is there.

    Raises:
        LinkageError: it is no structure of members; the message says why.

    Source: Erdman, Sandor, Oakberg (1972), eqs (2), (4), (7); which element a member is follows from its ends:
        docs/decisions/022-elastodynamics.md.
    """
    require_known(mechanism)
    freedoms = find_freedoms(mechanism, loaded)
    return Linkage(mechanism, freedoms, tuple(_element(mechanism, freedoms, member) for member in mechanism.members))


def _element(mechanism: Mechanism, freedoms: Freedoms, member: Member) -> Element:
    """Which coordinates a member has: those that its ends can load.

    Both rotations known: cantilever with all three; one at the ground: cantilever without end moment; one elsewhere: a
    beam on two supports with a moment at that end; none: a two-force member.
    """
    label = f"Member {member.name!r}"
    start, end = (place_of(freedoms.places, mechanism, label, member.body, p) for p in (member.start, member.end))
    at_start, at_end = (freedoms.columns[place, 2] for place in (start, end))
    clamped = [rotation == freedoms.ground for rotation in (at_start, at_end)]
    if start == end:
        raise LinkageError(f"{label} is too short beside the others of its body; leave it out, or make it longer.")
    if at_start == RELEASED and at_end == RELEASED:
        return Element(member, start, end, (_AXIAL,), from_end=False)
    if at_start == RELEASED or at_end == RELEASED:
        coordinates = (_AXIAL, _TRANSVERSE) if any(clamped) else (_AXIAL, _ROTATION)
        return Element(member, start, end, coordinates, from_end=bool(at_start == RELEASED))
    from_end = clamped[1] or (not clamped[0] and _is_free(mechanism, freedoms, start))
    return Element(member, start, end, (_AXIAL, _TRANSVERSE, _ROTATION), from_end)


def _is_free(mechanism: Mechanism, freedoms: Freedoms, place: int) -> bool:
    """Whether nothing else ends at a place that the end of one member is, so that it is the tip of a cantilever."""
    names = freedoms.places[place].names
    same = np.flatnonzero(freedoms.columns[:, 0] == freedoms.columns[place, 0])
    return len(names) == 1 and len(same) == 1 and freedoms.columns[place, 0] != freedoms.ground


# From element forces to the stress in the outer fibres.


def section_forces(linkage: Linkage, element_forces: FloatArray) -> FloatArray:
    """(N, M_start, M_end) of each element, shape (times, elements, 3) [N, N m].

    Tension N is positive, and so are moments that bend the element to its left, seen from its start; between the ends
    they change in proportion to the way.

    Args:
        linkage: the structure.
        element_forces: f, shape (times, n) [N, N m].

    Source: textbook: equilibrium of each element of Erdman, Sandor, Oakberg (1972), eqs (2), (4), (7).
    """
    matrix = block_diagonal(element.section_forces for element in linkage.elements)
    return (element_forces @ matrix.T).reshape(len(element_forces), -1, 3)


def largest_stress(linkage: Linkage, forces: FloatArray) -> FloatArray:
    """|N|/A + |M| (h/2)/I where the moment is largest, at an end: shape (times, elements) [Pa].

    Args:
        linkage: the structure.
        forces: those of `section_forces`, shape (times, elements, 3) [N, N m].

    Source: textbook law of tension and bending superposed; docs/explanation/elastodynamics.md, section Inertia, torque
        and power.
    """
    sections = [element.member.section for element in linkage.elements]
    areas = np.array([section.area for section in sections])
    moduli = np.array([2 * section.second_moment / section.depth for section in sections])
    stress: FloatArray = np.abs(forces[:, :, 0]) / areas + np.abs(forces[:, :, 1:]).max(axis=2) / moduli
    return stress


# Which members of a linkage have other sections than in another design of it, all else being the same.

#: Rounding of lengths and numbers, in parts of them.
_SAME = 1e-9


class Resized(NamedTuple):
    """Which members have other sections in another design.

    Attributes:
        members: names of members whose sections differ.
        depths: names of those among them whose depth in the plane does.
    """

    members: tuple[str, ...]
    depths: tuple[str, ...]


def resized_members(before: Mechanism, after: Mechanism) -> Resized | None:
    """Members that have other sections in the second design; None if anything else of the linkage differs, too.

    Lengths and directions of members, their material, lumped masses and joints must be the same. Where a body's frame
    stands, in its centre of mass, may differ: it moves with the masses, and the linkage does not.

    Args:
        before: the first design.
        after: the second one.
    """
    parts = [[(type(part), part.name) for part in (*m.members, *m.lumped_masses, *m.joints)] for m in (before, after)]
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
    for lump in mechanism.lumped_masses:
        add(lump.body, lump.point)
        found.extend([float(lump.mass), float(lump.inertia)])
    for joint in mechanism.joints:
        for body, end in ((joint.body_i, "point_i"), (joint.body_j, "point_j")):
            add(body, getattr(joint, end, origin.get(body, (0.0, 0.0))))
    return found


# Bodies whose mass is not that of their members and lumped masses: then what bends a linkage is not what moves it.

#: Mass and inertia may differ by this part, centres by it of the radius of gyration: rounded numbers pass, but not the
#: inertia of a bar whose mass is spread along it, a third of that of its lumps.
_WITHIN = 0.01


def unlike_bodies(mechanism: Mechanism) -> tuple[str, ...]:
    """A sentence for each body whose mass, centre or inertia is not that of its members and lumped masses, to 1 %.

    Deflections, stresses and vibration come from these lumps, half of each member's mass at either end; reactions and
    input torque, too. An FMU moves by the body's own numbers, and its inertia forces are those of the lumps.

    Args:
        mechanism: with members.
    """
    found = []
    for body in mechanism.bodies:
        members = [member for member in mechanism.members if member.body == body.name]
        if not members:
            continue
        own = [lump for lump in mechanism.lumped_masses if lump.body == body.name]
        lumps = [(lump.mass, lump.point) for lump in own]
        for member in members:
            half = member.density * member.section.area * np.hypot(*np.subtract(member.end, member.start)) / 2
            lumps += [(half, member.start), (half, member.end)]
        masses, points = np.array([mass for mass, _ in lumps]), np.array([point for _, point in lumps], dtype=float)
        mass, moment = masses.sum(), masses @ points
        inertia = masses @ (points**2).sum(axis=1) + sum(lump.inertia for lump in own)
        gyration = np.sqrt(body.inertia / body.mass)
        away = np.hypot(*moment) > _WITHIN * body.mass * gyration
        off = abs(mass - body.mass) > _WITHIN * body.mass or abs(inertia - body.inertia) > _WITHIN * body.inertia
        if off or away:
            beside = f", with their centre {1e3 * np.hypot(*moment) / mass:.4g} mm beside the body's" if away else ""
            found.append(
                f"Body {body.name!r} has {body.mass:.4g} kg and {body.inertia:.4g} kg.m2, its members and lumped "
                f"masses have {mass:.4g} kg and, about the body's centre of mass, {inertia:.4g} kg.m2{beside}: only "
                f"these bend the linkage. Take mass, inertia and points from lumped_body, or add a LumpedMass for what "
                f"they lack."
            )
    return tuple(found)
