"""A linkage with elastic members as a structure: which nodes it has, and what stands at them (`engine.elastic`).

Only topology and the numbers of the sections: where the nodes are and what loads them is found in motion.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from .body import GROUND, Point
from .conditions import length
from .errors import MechanismError
from .functions import Number, is_plain, where_positive
from .mechanism import Mechanism
from .members import Member

_COORDINATES = ("x", "y", "angle")


@dataclass(frozen=True)
class Structure:
    """What gives way and what holds it; a node has three displacements: x, y and rotation.

    A body with members has a node at each of their ends, any other body one at its centre of mass. What has no point
    of its own on a body with members (angle drivers, held coordinates, torques) acts at the start of its first member.

    Attributes:
        nodes: body and place in its frame [m].
        ends: nodes at start and end of each member.
        ties: joint and node, for each side of each joint that is not the ground.
        lumps: node, mass [kg], inertia [kg m2], and share of the mass of its body's lumps.
        locked: displacements that held coordinates keep at zero, numbered node by node; those of driven bodies are held
            by the rows of their drivers.
    """

    nodes: tuple[tuple[str, Point], ...] = ()
    ends: tuple[tuple[int, int], ...] = ()
    ties: tuple[tuple[int, int], ...] = ()
    lumps: tuple[tuple[int, Number, Number, Number], ...] = ()
    locked: tuple[int, ...] = ()

    def node(self, body: str, point: Point | None) -> int | None:
        """The node of a body at a point of it, or where things without a point act; None when there is none."""
        own = [k for k, (name, _) in enumerate(self.nodes) if name == body]
        if point is None or len(own) == 1:
            return own[0]
        return next((k for k in own if same_point(self.nodes[k][1], point)), None)


def structure(mechanism: Mechanism) -> Structure:
    """The structure that a mechanism with members is while its held and driven coordinates stand still.

    Raises:
        MechanismError: there are contacts, a joint or disk stands beside the ends of members, or the structure is not
            determinate.
    """
    if mechanism.contacts:
        raise MechanismError(
            f"Elastic members: contact {mechanism.contacts[0].name!r} opens and closes, but the structure must "
            f"stay the same; read elastic members of linkages without contacts."
        )
    nodes = Structure(nodes=tuple(_nodes(mechanism)))
    members = mechanism.members
    made = Structure(
        nodes.nodes,
        tuple((_at(nodes, m.body, m.start, m), _at(nodes, m.body, m.end, m)) for m in members),
        tuple(_ties(mechanism, nodes)),
        tuple(_shared(nodes, [*_lumps(mechanism, nodes)])),
        tuple(_locked(mechanism, nodes)),
    )
    rows = sum(joint.rows for joint in mechanism.joints)
    unknown, known = 3 * len(made.nodes), 3 * len(members) + rows + len(made.locked)
    if unknown != known:
        raise MechanismError(
            f"Elastic members: {len(made.nodes)} nodes have {unknown} displacements, but {len(members)} members, "
            f"{rows} rows of joints and {len(made.locked)} held coordinates give {known} conditions; the linkage must "
            f"be statically determinate once its held and driven coordinates stand still. "
            f"{_way_out(unknown - known)}"
        )
    return made


def member_data(member: Member) -> tuple[Number, ...]:
    """The member's row of the table `member_data`, in the order of the columns in `codes`."""
    section, long = member.section, span(member)
    stretch, bending = long / (member.young * section.area), long / (member.young * section.second_moment)
    return stretch, bending, section.area, 2 * section.second_moment / section.depth


def _way_out(missing: int) -> str:
    if missing > 0:
        return "Hold a coordinate for each degree of freedom, and let members of a body hang together."
    return "Take away joints that repeat each other, held coordinates that follow, or members that close a ring."


def _nodes(mechanism: Mechanism) -> Iterator[tuple[str, Point]]:
    for body in mechanism.bodies:
        points: list[Point] = []
        for member in mechanism.members:
            for point in (member.start, member.end) if member.body == body.name else ():
                if not any(same_point(point, other) for other in points):
                    points.append(point)
        yield from ((body.name, point) for point in points or [(0.0, 0.0)])


def _ties(mechanism: Mechanism, nodes: Structure) -> Iterator[tuple[int, int]]:
    for k, joint in enumerate(mechanism.joints):
        for side in ("i", "j"):
            body = getattr(joint, f"body_{side}")
            if body != GROUND:
                yield k, _at(nodes, body, getattr(joint, f"point_{side}", None), joint)


def _lumps(mechanism: Mechanism, nodes: Structure) -> Iterator[tuple[int, Number, Number]]:
    for member in mechanism.members:
        half = member.density * member.section.area * span(member) / 2
        for point in (member.start, member.end):
            yield _at(nodes, member.body, point, member), half, 0.0
    elastic = {member.body for member in mechanism.members}
    for disk in mechanism.disks:
        if disk.body in elastic:
            yield _at(nodes, disk.body, disk.point, disk), disk.mass, disk.inertia
    for body in mechanism.bodies:
        if body.name not in elastic:
            yield _at(nodes, body.name, None, body), body.mass, body.inertia


def _shared(nodes: Structure, lumps: list[tuple[int, Number, Number]]) -> Iterator[tuple[int, Number, Number, Number]]:
    for node, mass, inertia in lumps:
        body = nodes.nodes[node][0]
        own = [other for k, other, _ in lumps if nodes.nodes[k][0] == body]
        total = sum(own)
        yield node, mass, inertia, where_positive(total, mass / where_positive(total, total, 1.0), 1.0 / len(own))


def _locked(mechanism: Mechanism, nodes: Structure) -> Iterator[int]:
    driven = {joint.body_j for joint in mechanism.joints if joint.motion is not None}
    for held in mechanism.held:
        body, _, coordinate = held.rpartition(".")
        if body in driven:
            continue  # its driver holds it
        node = nodes.node(body, None)
        assert node is not None
        yield 3 * node + _COORDINATES.index(coordinate)


def _at(nodes: Structure, body: str, point: Point | None, part: Any) -> int:
    node = nodes.node(body, point)
    if node is None:
        raise MechanismError(
            f"{type(part).__name__} {part.name!r} stands at {point} of body {body!r}, where no member ends; let two "
            f"members meet there, written with the very same numbers."
        )
    return node


def span(member: Member) -> Number:
    """Length of a member [m]."""
    (x, y), (x_end, y_end) = member.start, member.end
    return length((x_end - x, y_end - y))


def same_point(a: Point, b: Point) -> bool:
    """Whether two points of a body are the same: as numbers, or as recorded expressions."""
    return all(_same(x, y) for x, y in zip(a, b, strict=True))


def _same(x: Number, y: Number) -> bool:
    """Whether two numbers are the same: as numbers, or as one recorded expression."""
    if is_plain(x) and is_plain(y):
        return bool(x == y)
    return type(x) is type(y) and hasattr(x, "number") and x.number == y.number
