"""What cannot be right of the numbers of joints, and of contacts of profiles, as findings."""

from __future__ import annotations

from collections.abc import Iterator

from .body import Point
from .check_curves import least_value
from .conditions import finite_positive, length, plain, positive
from .contacts import Contact
from .findings import Finding, literal, refuse_unless
from .functions import Number
from .joints import (
    CamFlatFollower,
    Distance,
    DistanceDriver,
    Gears,
    InternalGears,
    Joint,
    RackAndPinion,
    RevoluteTranslational,
    Translational,
    TranslationalDriver,
)


def joint_findings(joint: Joint) -> Iterator[Finding]:
    """Every problem that the numbers of a joint can have, but for its friction and for numbers that are not finite."""
    label = f"{type(joint).__name__} {literal(repr(joint.name))}"
    if isinstance(joint, Translational):
        yield _axis(f"{label}: axis_i", joint.axis_i)
        yield _axis(f"{label}: axis_j", joint.axis_j)
    elif isinstance(joint, (RevoluteTranslational, TranslationalDriver)):
        yield _axis(f"{label}: axis_i", joint.axis_i)
    elif isinstance(joint, Distance):
        yield _size(f"{label}: distance", joint.distance)
    elif isinstance(joint, DistanceDriver) and joint.motion.pieces:
        least = least_value(joint.motion)
        text = (
            f"{label}: its motion comes to a distance of {{:.6g}} m, but it must stay above 0: where the two points "
            "meet, nothing says in which direction they part. Give another motion."
        )
        yield refuse_unless(positive(least), text, least)
    elif isinstance(joint, RackAndPinion):
        yield _size(f"{label}: radius_j", joint.radius_j)
    elif isinstance(joint, (Gears, InternalGears)):
        yield _size(f"{label}: radius_i", joint.radius_i)
        yield _size(f"{label}: radius_j", joint.radius_j)
    if isinstance(joint, InternalGears):
        text = f"{label}: the ring's radius_i = {{:g}} m must be larger than radius_j = {{:g}} m of the gear inside."
        ring, gear = joint.radius_i, joint.radius_j
        yield refuse_unless(plain(ring) - plain(gear), text, ring, gear)


def pair_findings(contact: Contact) -> Iterator[Finding]:
    """What the numbers of a contact of profiles can have wrong, besides what those of any contact can."""
    if isinstance(contact, CamFlatFollower):
        yield _axis(f"Contact {literal(repr(contact.name))}: direction_j", contact.direction_j)


def _axis(what: str, axis: Point) -> Finding:
    text = f"{what} = ({{:g}}, {{:g}}) has no direction; give it a length that is finite and not zero."
    return refuse_unless(finite_positive(length(axis)), text, *axis)


def _size(what: str, value: Number) -> Finding:
    text = f"{what} = {{:g}} m, but it must be positive and finite."
    return refuse_unless(finite_positive(value), text, value)
