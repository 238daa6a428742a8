"""Places: where members end and joints are attached, and which of them move as one.

A body with members has a place at every end of one. Around it the body is a small rigid frame that moves by (u_x, u_y,
theta). A body without members is rigid; its first place is the centre of mass.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from ..model import GROUND, AngleDriver, Mechanism, Revolute
from ..model.body import Point
from ..model.joints import Joint
from .errors import LinkageError

#: Points of a body are one when they are nearer to each other than this part of its longest member.
_SAME = 1e-9


@dataclass(frozen=True)
class Place:
    """A point of a body.

    Attributes:
        body: its name, or `GROUND`, of which one place stands for all.
        point: in the frame of the body [m].
        names: "<member>.start" and "<member>.end" of the ends that meet here, or "<body>", the centre of mass of a
            rigid body, or "<body>:<joint>" where one is attached to it elsewhere.
    """

    body: str
    point: Point
    names: tuple[str, ...]


def find_places(mechanism: Mechanism) -> tuple[Place, ...]:
    """All places: first the ground, then those of members in their order, then those of rigid bodies.

    Raises:
        LinkageError: the mechanism has no members.
    """
    if not mechanism.members:
        raise LinkageError("The mechanism has no members, so that nothing bends; give it some, e.g. `Member(...)`.")
    flexible = {member.body for member in mechanism.members}
    named: list[tuple[str, Point, str]] = [(GROUND, (0.0, 0.0), GROUND)]
    for member in mechanism.members:
        named += [(member.body, member.start, f"{member.name}.start"), (member.body, member.end, f"{member.name}.end")]
    for body in mechanism.bodies:
        if body.name not in flexible:
            named.append((body.name, (0.0, 0.0), body.name))
            named += [(body.name, point, f"{body.name}:{name}") for name, point in _attached(mechanism, body.name)]
    places: list[Place] = []
    for body_name, point, name in named:
        same = _find(places, body_name, point, _span(mechanism, body_name))
        if same is None:
            places.append(Place(body_name, point, (name,)))
        else:
            places[same] = Place(body_name, places[same].point, (*places[same].names, name))
    return tuple(places)


def place_of(places: tuple[Place, ...], mechanism: Mechanism, part: str, body: str, point: Point) -> int:
    """The number of the place where a part is attached to a body.

    Raises:
        LinkageError: no member of that body ends there.
    """
    found = _find(places, body, point, _span(mechanism, body))
    if found is None:
        ends = ", ".join(f"{p.names[0]} at ({p.point[0]:g}, {p.point[1]:g})" for p in places if p.body == body)
        raise LinkageError(
            f"{part} is attached to {body!r} at ({point[0]:g}, {point[1]:g}) m, where no member of it ends; there are "
            f"{ends}. Let a member end there, e.g. by making two of one."
        )
    return found


def named_place(places: tuple[Place, ...], name: str) -> int:
    """The number of a place by one of its names.

    Raises:
        LinkageError: there is none.
    """
    for number, place in enumerate(places):
        if name in place.names:
            return number
    known = ", ".join(name for place in places[1:] for name in place.names)
    raise LinkageError(f"There is no place {name!r}; there are {known}.")


def ends_of_joint(joint: Joint) -> tuple[tuple[str, Point], tuple[str, Point]]:
    """Body and point i, and body and point j, of a joint that has points."""
    return (joint.body_i, getattr(joint, "point_i", (0.0, 0.0))), (joint.body_j, getattr(joint, "point_j", (0.0, 0.0)))


def pin_between(mechanism: Mechanism, part: str, body_i: str, body_j: str) -> Revolute:
    """The one pin of two bodies: where a torque between them acts.

    Raises:
        LinkageError: they have none, or several.
    """
    pins = [j for j in mechanism.joints if isinstance(j, Revolute) and {j.body_i, j.body_j} == {body_i, body_j}]
    if len(pins) != 1:
        raise LinkageError(
            f"{part} turns {body_j!r} against {body_i!r}, which have {len(pins)} pins in common, so that it is not "
            "known at which place of a body that bends it acts; join them by one `Revolute`."
        )
    return pins[0]


def _attached(mechanism: Mechanism, body: str) -> Iterator[tuple[str, Point]]:
    for joint in mechanism.joints:
        if not isinstance(joint, AngleDriver):
            yield from ((joint.name, point) for name, point in ends_of_joint(joint) if name == body)


def _span(mechanism: Mechanism, body: str) -> float:
    """Length of the longest member of a body, or the largest distance of a joint from a rigid one's centre [m]."""
    lengths = [math.dist(member.start, member.end) for member in mechanism.members if member.body == body]
    return max(lengths or [math.hypot(*point) for _, point in _attached(mechanism, body)], default=0.0)


def _find(places: list[Place] | tuple[Place, ...], body: str, point: Point, span: float) -> int | None:
    for number, place in enumerate(places):
        if place.body == body and (body == GROUND or math.dist(place.point, point) <= _SAME * span):
            return number
    return None
