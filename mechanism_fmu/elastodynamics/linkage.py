"""A mechanism as a structure: its elements, what of them is unknown, and their flexibilities. No configuration yet."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..model import Mechanism, Member
from .elements import FloatArray, block_diagonal, cantilever, supported_beam, two_force_member
from .errors import LinkageError
from .freedoms import RELEASED, Freedoms, find_freedoms
from .places import place_of
from .rows import require_known

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
