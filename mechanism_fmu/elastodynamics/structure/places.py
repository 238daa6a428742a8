"""Places: where members end and joints are attached; which of them move as one, stand still, or are unknown.

A body with members has a place at every end of one. Around it the body is a small rigid frame that moves by (u_x,
u_y, theta). A body without members is rigid; its first place is the centre of mass.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...model import (
    GROUND,
    AngleDriver,
    Damper,
    Mechanism,
    Revolute,
    RevoluteTranslational,
    Translational,
    TranslationalDriver,
)
from ...model.body import Point
from ...model.joints import Joint
from ..elements import LinkageError

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


# What makes a structure of a mechanism: which coordinates stand still, and where torques act on bodies that bend.


def is_driver(joint: Joint) -> bool:
    """Whether a joint prescribes a motion."""
    return joint.motion is not None


def held_coordinates(mechanism: Mechanism) -> tuple[tuple[str, str], ...]:
    """Body and coordinate of what is held; nothing where drivers hold the mechanism."""
    if any(is_driver(joint) for joint in mechanism.joints):
        return ()
    return tuple((held.rpartition(".")[0], held.rpartition(".")[2]) for held in mechanism.held)


def angle_locks(mechanism: Mechanism) -> tuple[tuple[str, str, str], ...]:
    """Angles that stand still: name of the driver or the held coordinate, body i and body j."""
    drivers = [(j.name, j.body_i, j.body_j) for j in mechanism.joints if isinstance(j, AngleDriver)]
    held = [(f"{body}.{what}", GROUND, body) for body, what in held_coordinates(mechanism) if what == "angle"]
    return (*drivers, *held)


def welds(mechanism: Mechanism, places: tuple[Place, ...]) -> tuple[tuple[int, int], ...]:
    """Pairs of places whose rotations are the same: of locked angles at the pin, of sliders, within rigid bodies.

    Raises:
        LinkageError: a locked angle is of a body that bends and has no pin, or several, with the other body.
    """
    pairs = []
    flexible = {member.body for member in mechanism.members}
    for name, body_i, body_j in angle_locks(mechanism):
        if {body_i, body_j} & flexible:
            pairs.append(attachments(mechanism, places, pin_between(mechanism, repr(name), body_i, body_j)))
        else:
            pairs.append((_first(places, body_i), _first(places, body_j)))
    for joint in mechanism.joints:
        if isinstance(joint, Translational):
            pairs.append(attachments(mechanism, places, joint))
    for number, place in enumerate(places):
        if place.body not in flexible:
            pairs.append((_first(places, place.body), number))
    return tuple(pairs)


def rubbing_pins(mechanism: Mechanism) -> tuple[tuple[Revolute, float, float], ...]:
    """Pins with friction: joint, coefficient times radius [m], and damping [N m s/rad] of the dampers of its bodies.

    Raises:
        LinkageError: a damper's bodies have no pin in common, or several.
    """
    damping: dict[str, float] = {}
    for damper in mechanism.forces:
        if isinstance(damper, Damper) and damper.damping > 0.0:
            pin = pin_between(mechanism, f"Damper {damper.name!r}", damper.body, damper.reaction)
            damping[pin.name] = damping.get(pin.name, 0.0) + damper.damping
    pins = [(j, float(j.friction), damping.get(j.name, 0.0)) for j in mechanism.joints if isinstance(j, Revolute)]
    return tuple(pin for pin in pins if pin[1] > 0.0 or pin[2] > 0.0)


def attachments(mechanism: Mechanism, places: tuple[Place, ...], joint: Joint) -> tuple[int, int]:
    """The places of a joint's two points.

    Raises:
        LinkageError: a body that bends has no place there.
    """
    (body_i, point_i), (body_j, point_j) = ends_of_joint(joint)
    part = f"{type(joint).__name__} {joint.name!r}"
    return place_of(places, mechanism, part, body_i, point_i), place_of(places, mechanism, part, body_j, point_j)


def fixed_points(mechanism: Mechanism) -> Iterator[tuple[str, str]]:
    """Body and axis ("x" or "y") of centres of mass that are held.

    Raises:
        LinkageError: the body bends, so that its centre of mass is no place.
    """
    flexible = {member.body for member in mechanism.members}
    for body, what in held_coordinates(mechanism):
        if what != "angle" and body in flexible:
            raise LinkageError(
                f"Held coordinate '{body}.{what}' is the centre of mass of a body that bends, which is no place of it; "
                "hold its angle, or put a driver, e.g. an `XDriver`, where a member ends."
            )
        if what != "angle":
            yield body, what


def _first(places: tuple[Place, ...], body: str) -> int:
    return next(number for number, place in enumerate(places) if place.body == body)


# Which displacement of which place is which unknown of the structure.

IntArray = np.ndarray[Any, np.dtype[np.int64]]

#: In `Freedoms.columns`, of a rotation that no other part asks for: a pinned end of a member, where no moment acts.
RELEASED = -1
_FIXED = -2

#: The place of the ground, and so the group of what is fixed to it.
_GROUND = 0


@dataclass(frozen=True)
class Freedoms:
    """The displacements w of all places that are left when pins, welds and the ground have made some of them equal.

    Attributes:
        places: of the mechanism; the first is the ground.
        names: of the unknowns w, "<place>.x|y|angle" by the first place that has them.
        columns: shape (places, 3), the numbers in w of (u_x, u_y, theta) of each place; `len(names)` is the ground,
            which does not move; `RELEASED` stands for a rotation that is no unknown.
    """

    places: tuple[Place, ...]
    names: tuple[str, ...]
    columns: IntArray

    @property
    def ground(self) -> int:
        """The number behind the last unknown: what it would be of the ground."""
        return len(self.names)


def find_freedoms(mechanism: Mechanism, loaded: Iterable[str] = ()) -> Freedoms:
    """The unknowns of a mechanism whose driven, or else held, coordinates stand still.

    A rotation is one where members are welded, at free ends, and where something can act on it: an inertia,
    a slider, a locked angle, friction, or a moment on one of the places `loaded`.

    Raises:
        LinkageError: a part is attached where no member ends, or there is no place as in `loaded`.
    """
    places = find_places(mechanism)
    pins = [attachments(mechanism, places, j) for j in mechanism.joints if isinstance(j, Revolute)]
    welded = welds(mechanism, places)
    translation, rotation = _groups(len(places), pins), _groups(len(places), welded)
    kept = _kept(mechanism, places, welded, loaded)
    names: list[str] = []
    numbers: dict[tuple[str, int], int] = {}
    columns = []
    for number, place in enumerate(places):
        row = []
        for axis, group in (("x", translation), ("y", translation), ("angle", rotation)):
            if axis == "angle" and number not in kept:
                row.append(RELEASED)
            elif group[number] == _GROUND:
                row.append(_FIXED)
            else:
                if (axis, group[number]) not in numbers:
                    numbers[axis, group[number]] = len(names)
                    names.append(f"{place.names[0]}.{axis}")
                row.append(numbers[axis, group[number]])
        columns.append(row)
    table = np.array(columns, dtype=np.int64)
    return Freedoms(places, tuple(names), np.where(table == _FIXED, len(names), table))


def _groups(count: int, pairs: Iterable[tuple[int, int]]) -> list[int]:
    """For each of `count` places the first one that it is connected with by pairs."""
    group = [*range(count)]
    for pair in pairs:
        joined = {group[number] for number in pair}
        group = [min(joined) if number in joined else number for number in group]
    return group


def _kept(
    mechanism: Mechanism, places: tuple[Place, ...], welded: Iterable[tuple[int, int]], loaded: Iterable[str]
) -> set[int]:
    """Places whose rotation is an unknown, or stands still with the ground."""
    kept = {number for pair in welded for number in pair}
    jointed: set[int] = set()
    for joint in mechanism.joints:
        if isinstance(joint, AngleDriver):
            continue  # acts at the pin of its bodies
        i, j = attachments(mechanism, places, joint)
        jointed |= {i, j}
        if isinstance(joint, (Translational, RevoluteTranslational, TranslationalDriver)):
            kept.add(i)
    for pin, _, _ in rubbing_pins(mechanism):
        kept.update(attachments(mechanism, places, pin))
    for lump in mechanism.lumped_masses:
        if any(member.body == lump.body for member in mechanism.members):
            number = place_of(places, mechanism, f"LumpedMass {lump.name!r}", lump.body, lump.point)
            if lump.inertia > 0.0:
                kept.add(number)
    kept |= {n for n, place in enumerate(places) if len(place.names) > 1 or n not in jointed}
    return kept | {named_place(places, name) for name in loaded}
