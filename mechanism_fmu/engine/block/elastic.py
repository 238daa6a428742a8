"""Views of an instance's block: elastic members, the structure that they make, and its scratch."""

from __future__ import annotations

from typing import NamedTuple

from .layout import Array
from .room import room


class Members(NamedTuple):
    """The elastic members: nodes at their two ends, and numbers by column (`codes.MEMBER_STRETCH` ...)."""

    start: Array
    end: Array
    data: Array


members = room(Members, "member_")


class Nodes(NamedTuple):
    """Ends of members, and rigid bodies: body, place in its frame, and from its centre of mass in the global frame."""

    body: Array
    point: Array
    place: Array


nodes = room(Nodes, "node_")


class Ties(NamedTuple):
    """The sides of joints: at which node the rows of a joint act on a body."""

    joint: Array
    node: Array


ties = room(Ties, "tie_")


class Couples(NamedTuple):
    """The torques of force elements: which element's acts on which node, and with what sign."""

    force: Array
    node: Array
    sign: Array


couples = room(Couples, "couple_")


class Lumps(NamedTuple):
    """Lumps of mass: node, and mass, inertia and share of its body's mass by column."""

    node: Array
    data: Array


lumps = room(Lumps, "lump_")


class Beams(NamedTuple):
    """Members that hang on a hinge: body, first row of the hinge, and numbers by column (`codes.BEAM_SPAN` ...)."""

    body: Array
    row: Array
    data: Array


beams = room(Beams, "beam_")


class Structure(NamedTuple):
    """The structure at one instant: compatibility C (then its factors, with their order of rows), and what follows.

    `load`, `force`, `deformation` and `displacement` have an entry for each displacement, or for each row of C: three a
    member, then joints, then the displacements that are `locked`.
    """

    matrix: Array
    matrix_order: Array
    load: Array
    element_force: Array
    deformation: Array
    displacement: Array
    locked: Array


structure = room(Structure)
