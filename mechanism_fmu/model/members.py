"""Elastic members: of which beams a body is made where it may bend, and which lumps of mass it carries.

The engine moves rigid bodies and reads none of this; `mechanism_fmu.elastodynamics` does.
"""

from __future__ import annotations

from dataclasses import dataclass

from .body import Point
from .functions import Number


@dataclass(frozen=True)
class Section:
    """The cross section of a straight beam that bends in the plane of the mechanism.

    Attributes:
        area: A [m2], > 0.
        second_moment: I about the axis normal to the plane [m4], > 0.
        depth: h, in the plane and across the beam [m], > 0; the outer fibres lie at h/2 from the neutral axis.
    """

    area: Number
    second_moment: Number
    depth: Number

    @classmethod
    def rectangle(cls, width: Number, depth: Number) -> Section:
        """A rectangle: `width` b normal to the plane and `depth` h in it [m, m]: A = b h, I = b h^3/12."""
        return cls(width * depth, width * depth * depth * depth / 12, depth)


@dataclass(frozen=True)
class Member:
    """A straight elastic beam of constant section, a part of a body.

    Members of one body that end in the same point are welded there; joints and disks of a body with members stand at
    ends of members. A body without members is rigid.

    Attributes:
        name: unique within the mechanism.
        body: name of the body; not `GROUND`.
        start, end: its ends in the frame of the body [m].
        section: its cross section.
        young: modulus of elasticity E [Pa], > 0.
        density: [kg/m3], >= 0; 0 makes it massless.
    """

    name: str
    body: str
    start: Point
    end: Point
    section: Section
    young: Number
    density: Number


@dataclass(frozen=True)
class Disk:
    """A lump of mass that turns with a body, whose mass and inertia it is a part of.

    Attributes:
        name: unique within the mechanism.
        body: name of the body; not `GROUND`.
        point: its centre in the frame of the body [m].
        mass: [kg], >= 0.
        inertia: about its own centre [kg m2], >= 0.
    """

    name: str
    body: str
    point: Point
    mass: Number
    inertia: Number = 0.0
