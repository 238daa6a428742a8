"""Tables of elastic members, of the structure that they make, and its scratch."""

from __future__ import annotations

from .. import codes
from .declare import Table, integer, real


class Members(Table, rows="members", prefix="member_"):
    """The elastic members: nodes at their two ends, and numbers by column (`codes.MEMBER_STRETCH` ...)."""

    start = integer()
    end = integer()
    data = real(codes.MEMBER_COLUMNS)


class Nodes(Table, rows="nodes", prefix="node_"):
    """Ends of members, and rigid bodies: body, place in its frame, and from its centre of mass in the global frame."""

    body = integer()
    point = real(2)
    place = real(2, work=True)


class Ties(Table, rows="ties", prefix="tie_"):
    """The sides of joints: at which node the rows of a joint act on a body."""

    joint = integer()
    node = integer()


class Couples(Table, rows="couples", prefix="couple_"):
    """The torques of force elements: which element's acts on which node, and with what sign."""

    force = integer()
    node = integer()
    sign = integer()


class Lumps(Table, rows="lumps", prefix="lump_"):
    """Lumps of mass: node, and mass, inertia and share of its body's mass by column."""

    node = integer()
    data = real(codes.LUMP_COLUMNS)


class Beams(Table, rows="beams", prefix="beam_"):
    """Members that hang on a hinge: body, first row of the hinge, and numbers by column (`codes.BEAM_SPAN` ...)."""

    body = integer()
    row = integer()
    data = real(codes.BEAM_COLUMNS)


class Structure(Table):
    """The structure at one instant: compatibility C (then its factors, with their order of rows), and what follows.

    `load`, `force`, `deformation` and `displacement` have an entry for each displacement, or for each row of C: three a
    member, then joints, then the displacements that are `locked`.
    """

    matrix = real("displacements", "displacements", work=True)
    matrix_order = integer("displacements", work=True)
    load = real("displacements", work=True)
    element_force = real("displacements", work=True)
    deformation = real("displacements", work=True)
    displacement = real("displacements", work=True)
    locked = integer("locked")
