"""Elastic linkage as a structure: its nodes, and what stands at them (`engine.elastic`).

Only topology and the numbers of the sections: where the nodes are and what loads them is found in motion.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from .body import GROUND, Point
from .errors import MechanismError
from .findings import length
from .functions import Number, is_plain, where_positive
from .joints import AngleDriver, Revolute
from .mechanism import Mechanism
from .members import Member
from .symbol import Symbol

_COORDINATES = ("x", "y", "angle")


@dataclass(frozen=True)
class Structure:
    """What gives way and what holds it; a node has three displacements: x, y and rotation.

    A body with members has a node at each of their ends, any other body one at its centre of mass. On a body with
    members, angle drivers, held angles and torques act at the pin with the body that they turn it against.

    Attributes:
        nodes: body and place in its frame [m].
        ends: nodes at start and end of each member.
        ties: joint and node, for each side of each joint that is not the ground.
        lumps: node, mass [kg], inertia [kg m2], and share of the mass of its body's lumps.
        couples: force element, node and sign, for each body on which its torque acts.
        locked: displacements that held coordinates keep at zero, numbered node by node; none where drivers hold.
    """

    nodes: tuple[tuple[str, Point], ...] = ()
    ends: tuple[tuple[int, int], ...] = ()
    ties: tuple[tuple[int, int], ...] = ()
    lumps: tuple[tuple[int, Number, Number, Number], ...] = ()
    couples: tuple[tuple[int, int, int], ...] = ()
    locked: tuple[int, ...] = ()

    def at(self, body: str, point: Point, part: Any) -> int:
        """The node of a body at a point of it.

        Raises:
            MechanismError: a member of that body would have to end there.
        """
        own = [k for k, (name, _) in enumerate(self.nodes) if name == body]
        found = next((k for k in own if same_point(self.nodes[k][1], point)), None)
        if found is None:
            raise MechanismError(
                f"{type(part).__name__} {part.name!r} stands at {point} of body {body!r}, where no member ends; let "
                f"two members meet there, e.g. by giving `member.start` to both."
            )
        return found


def structure(mechanism: Mechanism) -> Structure:
    """The structure that a mechanism with members is while its held and driven coordinates stand still.

    Raises:
        MechanismError: there are contacts, a joint or lumped mass stands beside the ends of members, or the structure
            is not determinate.
    """
    if mechanism.contacts:
        raise MechanismError(
            f"Elastic members: contact {mechanism.contacts[0].name!r} opens and closes, but the structure must "
            f"stay the same; read elastic members of linkages without contacts."
        )
    for force in mechanism.elements:
        if force.acts == "at points":
            raise MechanismError(
                f"Elastic members: {type(force).__name__} {force.name!r} acts at points of its bodies, which loads no "
                f"member yet; read elastic members of linkages without such elements."
            )
    nodes = nodes_of(mechanism)
    made = replace(
        nodes,
        ties=tuple(_ties(mechanism, nodes)),
        lumps=tuple(_shared(nodes, [*_lumps(mechanism, nodes)])),
        couples=tuple(_couples(mechanism, nodes)),
        locked=tuple(_locked(mechanism, nodes)),
    )
    _check(mechanism, made)
    return made


def nodes_of(mechanism: Mechanism) -> Structure:
    """The nodes of a mechanism with members, and which of them its members join; nothing else yet."""
    nodes = Structure(nodes=tuple(_nodes(mechanism)))
    members = mechanism.members
    return replace(nodes, ends=tuple((nodes.at(m.body, m.start, m), nodes.at(m.body, m.end, m)) for m in members))


def member_data(member: Member) -> tuple[Number, ...]:
    """The member's row of the table `member_data`, in the order of the columns in `codes`."""
    section, long = member.section, span(member)
    stretch, bending = long / (member.young * section.area), long / (member.young * section.second_moment)
    return stretch, bending, section.area, 2 * section.second_moment / section.depth


def span(member: Member) -> Number:
    """Length of a member [m]."""
    (x, y), (x_end, y_end) = member.start, member.end
    return length((x_end - x, y_end - y))


def same_point(a: Point, b: Point) -> bool:
    """Whether two points of a body are the same: as numbers, as recorded expressions, or as the same objects."""
    return all(_same(x, y) for x, y in zip(a, b, strict=True))


def _same(x: Number, y: Number) -> bool:
    if is_plain(x) and is_plain(y):
        return bool(x == y)
    return x is y or (isinstance(x, Symbol) and isinstance(y, Symbol) and x.number == y.number)


def _check(mechanism: Mechanism, made: Structure) -> None:
    rows = sum(joint.rows for joint in mechanism.joints)
    unknown, known = 3 * len(made.nodes), 3 * len(mechanism.members) + rows + len(made.locked)
    if unknown == known:
        return
    way_out = "Take away joints that repeat each other, held coordinates that follow, or members that close a ring."
    if unknown > known:
        way_out = "Hold a coordinate for each degree of freedom, and let the members of a body hang together."
    raise MechanismError(
        f"Elastic members: {len(made.nodes)} nodes have {unknown} displacements, but {len(mechanism.members)} members, "
        f"{rows} rows of joints and {len(made.locked)} held coordinates give {known} conditions; the linkage must be "
        f"statically determinate once its held and driven coordinates stand still. {way_out}"
    )


def _nodes(mechanism: Mechanism) -> Iterator[tuple[str, Point]]:
    for body in mechanism.bodies:
        points: list[Point] = []
        for member in mechanism.members:
            for point in (member.start, member.end) if member.body == body.name else ():
                if not any(same_point(point, other) for other in points):
                    points.append(point)
        yield from ((body.name, point) for point in points or [(0.0, 0.0)])


def _node(mechanism: Mechanism, nodes: Structure, body: str, point: Point, part: Any) -> int:
    """The node at a point of a body with members, or that of a rigid one."""
    flexible = any(member.body == body for member in mechanism.members)
    return nodes.at(body, point if flexible else (0.0, 0.0), part)


def _turned(mechanism: Mechanism, nodes: Structure, body: str, against: str, part: Any) -> int:
    """The node where a body is turned against another one: at their pin, where it has members."""
    if not any(member.body == body for member in mechanism.members):
        return nodes.at(body, (0.0, 0.0), part)
    pins = [j for j in mechanism.joints if isinstance(j, Revolute) and {j.body_i, j.body_j} == {body, against}]
    if len(pins) != 1:
        name = part if isinstance(part, str) else f"{type(part).__name__} {part.name!r}"
        raise MechanismError(
            f"{name} turns {body!r} against {against!r}, which have {len(pins)} pins in common, so that it is not "
            f"known at which place of a body with members it acts; join them by one Revolute."
        )
    return nodes.at(body, pins[0].point_i if pins[0].body_i == body else pins[0].point_j, pins[0])


def _ties(mechanism: Mechanism, nodes: Structure) -> Iterator[tuple[int, int]]:
    for k, joint in enumerate(mechanism.joints):
        for side, other in (("i", "j"), ("j", "i")):
            body = getattr(joint, f"body_{side}")
            if body == GROUND:
                continue
            if isinstance(joint, AngleDriver):
                yield k, _turned(mechanism, nodes, body, getattr(joint, f"body_{other}"), joint)
            else:
                yield k, _node(mechanism, nodes, body, getattr(joint, f"point_{side}"), joint)


def _lumps(mechanism: Mechanism, nodes: Structure) -> Iterator[tuple[int, Number, Number]]:
    for member in mechanism.members:
        half = member.density * member.section.area * span(member) / 2
        for point in (member.start, member.end):
            yield nodes.at(member.body, point, member), half, 0.0
    flexible = {member.body for member in mechanism.members}
    for lump in mechanism.lumped_masses:
        if lump.body in flexible:
            yield nodes.at(lump.body, lump.point, lump), lump.mass, lump.inertia
    for body in mechanism.bodies:
        if body.name not in flexible:
            yield nodes.at(body.name, (0.0, 0.0), body), body.mass, body.inertia


def _shared(nodes: Structure, lumps: list[tuple[int, Number, Number]]) -> Iterator[tuple[int, Number, Number, Number]]:
    for node, mass, inertia in lumps:
        body = nodes.nodes[node][0]
        own = [other for k, other, _ in lumps if nodes.nodes[k][0] == body]
        total = sum(own)
        yield node, mass, inertia, where_positive(total, mass / where_positive(total, total, 1.0), 1.0 / len(own))


def _couples(mechanism: Mechanism, nodes: Structure) -> Iterator[tuple[int, int, int]]:
    for k, force in enumerate(mechanism.elements):
        for body, against, sign in ((force.body, force.reaction, 1), (force.reaction, force.body, -1)):
            if force.acts == "torque" and body != GROUND:
                yield k, _turned(mechanism, nodes, body, against, force), sign


def _locked(mechanism: Mechanism, nodes: Structure) -> Iterator[int]:
    if any(joint.motion is not None for joint in mechanism.joints):
        return
    for held in mechanism.held:
        body, _, coordinate = held.rpartition(".")
        part = f"Held coordinate {held!r}"
        if coordinate == "angle":
            yield 3 * _turned(mechanism, nodes, body, GROUND, part) + 2
        elif any(member.body == body for member in mechanism.members):
            raise MechanismError(
                f"{part} is the centre of mass of a body with members, where none ends; hold its angle."
            )
        else:
            yield 3 * nodes.nodes.index((body, (0.0, 0.0))) + _COORDINATES.index(coordinate)
