"""Elastic members: of which beams a body is made where it may bend, and which lumps of mass it carries.

The motion is that of rigid bodies; what bends is read by outputs (`engine.elastic`) and `mechanism_fmu.elastodynamics`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

from .attached import Attached, Slot
from .body import Point
from .findings import length
from .functions import Number, is_plain
from .quantities import quantity


@dataclass(frozen=True)
class Section:
    """The cross section of a straight beam that bends in the plane of the mechanism.

    Attributes:
        area: A [m2], > 0.
        second_moment: I about the axis normal to the plane [m4], > 0.
        depth: h, in the plane and across the beam [m], > 0; the outer fibres lie at h/2 from the neutral axis.

    Source: definition: A = int dA, I = int y^2 dA; textbook: of a rectangle b h and b h^3/12.
    """

    area: Number
    second_moment: Number
    depth: Number

    @classmethod
    def rectangle(cls, width: Number, depth: Number) -> Section:
        """A rectangle: `width` b normal to the plane and `depth` h in it [m, m]: A = b h, I = b h^3/12.

        Args:
            width: across the plane of motion [m].
            depth: in it [m].

        Raises:
            MechanismError: a text is no length.
        """
        b, h = quantity(width, "m", "Section.rectangle: width"), quantity(depth, "m", "Section.rectangle: depth")
        return cls(b * h, b * h * h * h / 12, h)


@dataclass(frozen=True, init=False)
class Member(Attached):
    """A straight elastic beam of constant section, a part of a body.

    Members of one body that end in the same point are welded there; joints and lumped masses of a body with members
    stand at ends of members. A body without members is rigid.

    Attributes:
        name: unique within the mechanism.
        body: name of the body; not `GROUND`.
        start, end: its ends in the frame of the body [m].
        section: its cross section.
        young: modulus of elasticity E [Pa], > 0.
        density: [kg/m3], >= 0; 0 makes it massless.
    """

    slots: ClassVar = (Slot("body", "start", name="start"), Slot("body", "end", name="end"))
    units: ClassVar = {"young": "Pa", "density": "kg/m3"}

    name: str
    body: str
    start: Point
    end: Point
    section: Section
    young: Number
    density: Number


@dataclass(frozen=True, init=False)
class LumpedMass(Attached):
    """A point mass with rotary inertia on a body, whose mass and inertia it is a part of.

    Attributes:
        name: unique within the mechanism.
        body: name of the body; not `GROUND`.
        point: its centre in the frame of the body [m].
        mass: [kg], >= 0.
        inertia: about its own centre [kg m2], >= 0.
    """

    slots: ClassVar = (Slot("body", "point"),)
    units: ClassVar = {"mass": "kg", "inertia": "kg.m2"}

    name: str
    body: str
    point: Point
    mass: Number
    inertia: Number = 0.0


@dataclass(frozen=True)
class LumpedBody:
    """A body that is made of members and lumped masses, half of each member's mass at either end.

    Attributes:
        mass: [kg].
        inertia: about the centre of mass [kg m2].
        centre: of mass, in the frame in which the parts were given [m].
        members, lumped_masses: the parts in the body's own frame, from its centre of mass.
    """

    mass: Number
    inertia: Number
    centre: Point
    members: tuple[Member, ...]
    lumped_masses: tuple[LumpedMass, ...]


def lumped_body(members: tuple[Member, ...], lumped_masses: tuple[LumpedMass, ...] = ()) -> LumpedBody:
    """Mass, inertia and centre of mass of a body's members and lumped masses, in one frame; their sum must be > 0.

    Args:
        members: those of the body.
        lumped_masses: lumps of mass on it.

    Source: half of each member at either end: docs/explanation/elastodynamics.md, section Inertia, torque and power;
        textbook: centre of mass, and Steiner's theorem.
    """
    lumps: list[tuple[Number, Point]] = [(lump.mass, lump.point) for lump in lumped_masses]
    for member in members:
        x, y = member.end[0] - member.start[0], member.end[1] - member.start[1]
        half = member.density * member.section.area * length((x, y)) / 2
        lumps += [(half, member.start), (half, member.end)]
    mass: Number = sum(part for part, _ in lumps)
    centre = tuple(sum(part * point[k] for part, point in lumps) / mass for k in range(2))

    places: list[tuple[Point, Point]] = []

    def moved(point: Point) -> Point:
        # the same place for the same point: of symbolic numbers, equal ones calculated twice are two
        for known, place in places:
            if all(a is b or (is_plain(a) and is_plain(b) and a == b) for a, b in zip(known, point, strict=True)):
                return place
        places.append((point, (point[0] - centre[0], point[1] - centre[1])))
        return places[-1][1]

    inertia: Number = sum(lump.inertia for lump in lumped_masses)
    for part, point in lumps:
        x, y = moved(point)
        inertia = inertia + part * (x * x + y * y)
    return LumpedBody(
        mass,
        inertia,
        (centre[0], centre[1]),
        tuple(replace(member, start=moved(member.start), end=moved(member.end)) for member in members),
        tuple(replace(lump, point=moved(lump.point)) for lump in lumped_masses),
    )
