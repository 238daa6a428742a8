"""What makes a structure of a mechanism: which coordinates stand still, and where torques act on bodies that bend."""

from __future__ import annotations

from collections.abc import Iterator

from ..model import GROUND, AngleDriver, Damper, Mechanism, Revolute, Translational
from ..model.joints import Joint
from .errors import LinkageError
from .places import Place, ends_of_joint, pin_between, place_of


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
