"""What a failure of the engine is about: the parts, sizes and rates that its message names."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any

import numpy as np

from . import codes
from .engine import status
from .model import GROUND, Contact, Mechanism
from .model.compile import unknown_names
from .model.overlap_picture import Pose, overlap_picture
from .tables.layout import field_of
from .tables.sizes import MOST_IMPLICIT
from .tolerances import RATES_WITHIN

Array = np.ndarray[Any, np.dtype[Any]]

#: Of many contacts, a message has the names of so many.
MOST_NAMED = 24


def named(names: Sequence[str], between: str) -> str:
    """Names for a message: of many, the first, and how many more there are.

    Args:
        names: in their order.
        between: two of them.
    """
    more = (f"{len(names) - MOST_NAMED} more",) if len(names) > MOST_NAMED else ()
    return between.join((*names[:MOST_NAMED], *more))


# Failures of a motion.

#: Those that are about contacts.
_ABOUT_CONTACTS = (
    status.CHATTERING,
    status.NO_CHOICE,
    status.JAMMED,
    status.ROW_AWAY,
    status.NO_CONTACT_POINT,
    status.BRIDGED,
    status.FEW_POINTS,
)


def failure_details(mechanism: Mechanism, block: Array, outcome: int, contacts: Collection[str]) -> str:
    """What a motion that has ended is about, as what follows its advice.

    The contacts of an event, and what rubs where friction may be what failed; or the part that limited the steps,
    and their last size; or the driver that asks for too much.

    Args:
        mechanism: whose motion it is.
        block: its numbers, shape (words,).
        outcome: status of the engine.
        contacts: names of those that are closed, or were in the last events.
    """
    if outcome in (*status.OUT_OF_STEPS, status.STEP_TOO_SMALL):
        return _stiffest(mechanism, block)
    if outcome == status.PENETRATED:
        return _penetration(mechanism.contacts[_which_is_inside(block, outcome)], block, "")
    if outcome == status.OUT_OF_REACH:
        return _driven_too_far(mechanism, block)
    if outcome not in _ABOUT_CONTACTS:
        return ""
    about = f" Contacts: {named(sorted(contacts), ', ')}." if contacts else ""
    return about + (_friction(mechanism, block) if outcome in (status.JAMMED, status.NO_CHOICE) else "")


def _friction(mechanism: Mechanism, block: Array) -> str:
    """What rubs: coefficient, the angle of its bodies to each other, and Painlevé's criterion where it slips."""
    slip, criterion = field_of(block, "rub_slip").tolist(), field_of(block, "rub_criterion").tolist()
    values = [
        *field_of(block, "contact_value")[:, codes.FRICTION].tolist(),
        *field_of(block, "joint_friction").tolist(),
    ]
    ends = [
        [*field_of(block, f"contact_{end}").tolist(), *field_of(block, f"joint_{end}").tolist()]
        for end in ("body_i", "body_j")
    ]
    angles = [*field_of(block, "y_end")[2 : 3 * len(mechanism.bodies) : 3].tolist(), 0.0]  # codes.GROUND is the last
    found = []
    for k, (part, value) in enumerate(zip(mechanism.rubbing, values, strict=False)):
        if value > 0.0 and slip[k] != codes.APART:
            how = "sticks" if slip[k] == codes.STICKS else f"slips, A/G = {criterion[k]:.3g}"
            angle = angles[ends[0][k]] - angles[ends[1][k]]
            found.append(f"{part.name} ({value:.6g}, at {angle:.6g} rad, {how})")
    return f" Friction: {', '.join(found)}." if found else ""


def _stiffest(mechanism: Mechanism, block: Array) -> str:
    """How small the steps have become, and the part whose error limits them."""
    name = unknown_names(mechanism)[field_of(block, "stage_stiffest").item(0)]
    counters = field_of(block, "counters")
    steps, events = (counters.item(which) for which in (codes.STEPS_IN_STEP, codes.EVENTS_IN_STEP))
    more = " or more" if events == len(field_of(block, "events")) else ""
    size = field_of(block, "tried").item(1)
    text = f" Internal steps: {steps}, the last of {size:.3g} s, limited by {name}. Events: {events}{more}."
    if len(mechanism.bodies) > MOST_IMPLICIT:
        text += f" What is stiff takes short steps here: implicit ones are for {MOST_IMPLICIT} bodies at most."
    return text


def _driven_too_far(mechanism: Mechanism, block: Array) -> str:
    """Which driver is at the end of its range, and what it asks for there."""
    driver = mechanism.joints[field_of(block, "stage_stiffest").item(0)]
    asked = field_of(block, "residual").item(-1)
    return f" Driver {driver.name!r} asks for {asked:.6g} {driver.unit} here, and goes on."


# Failures of a start.


def start_details(mechanism: Mechanism, block: Array, outcome: int, closed: Collection[str]) -> str:
    """What a start that fails is about, as what follows its advice.

    Args:
        mechanism: that cannot begin.
        block: its numbers, shape (words,).
        outcome: status of the engine.
        closed: names of the closed contacts, in their order.
    """
    if outcome == status.NOT_ASSEMBLED:
        left = _off(mechanism, field_of(block, "residual"), closed)
        return f" Left open: {left} (m, or rad between directions)."
    if outcome == status.START_RATES:
        return _contradictions(mechanism, block, closed)
    if outcome not in (status.START_INSIDE, status.OVERLAP, status.AT_CENTRE):
        return ""
    contact = mechanism.contacts[_which_is_inside(block, outcome)]
    if outcome == status.AT_CENTRE:
        return f" Contact {contact.name!r}."
    return _penetration(contact, block, "; change the start angles or the lengths")


# Bodies inside each other, at the start or in a motion.


def picture_of_overlap(mechanism: Mechanism, block: Array, outcome: int) -> str:
    """An SVG picture of two bodies that have gone into each other, as text; "" of all other failures.

    Args:
        mechanism: whose motion it is.
        block: its numbers, shape (words,).
        outcome: status of the engine.
    """
    if outcome not in (status.PENETRATED, status.START_INSIDE, status.OVERLAP):
        return ""
    which = _which_is_inside(block, outcome)
    y = field_of(block, "y_end").tolist()
    poses: dict[str, Pose] = {GROUND: (0.0, 0.0, 0.0)}
    for i, body in enumerate(mechanism.bodies):
        poses[body.name] = (y[3 * i], y[3 * i + 1], y[3 * i + 2])
    line = field_of(block, "contact_line")[which].tolist()
    depth = -field_of(block, "residual").item(-1)
    time = field_of(block, "clock").item(codes.STEP_END)
    return overlap_picture(mechanism.contacts[which], poses, line, depth, time)


def _which_is_inside(block: Array, outcome: int) -> int:
    """The number of the contact that a penetration is about."""
    if outcome == status.PENETRATED:
        return int(field_of(block, "stage_stiffest").item(0))
    return int(field_of(block, "counters").item(codes.PENDING_SUBJECT))


def _penetration(contact: Contact, block: Array, way_out: str) -> str:
    """Which contact is inside, and how deep, by the spare row."""
    depth = -field_of(block, "residual").item(-1)
    before, behind = contact.too_deep()
    return f" Contact {contact.name!r}: {before} {depth:.6g} {behind}{way_out}."


def _contradictions(mechanism: Mechanism, block: Array, closed: Collection[str]) -> str:
    """The bodies to which the joints give other rates than the start rates; where there are none, the joints."""
    length, _, _, rate = field_of(block, "scales").tolist()
    within = RATES_WITHIN * min(1.0, length) * (rate or 1.0)  # be they in m/s or rad/s
    left = _off(mechanism, field_of(block, "residual_rate"), closed, within)
    if left:
        return (
            f" No rates near them do; what is left: {left} (m/s, or rad/s). Drivers or closed contacts contradict "
            "each other."
        )
    given = field_of(block, "body_start_rate")
    asked = field_of(block, "y_end")[given.size : 2 * given.size].reshape(given.shape)
    bodies = [
        f"body {body.name!r} ({_shown(asked[i], within)}), not ({_shown(given[i], within)})"
        for i, body in enumerate(mechanism.bodies)
        if np.abs(asked[i] - given[i]).max() > within
    ]
    return (
        f" They ask for other ones: {', '.join(bodies)} (of its centre of mass in m/s, and rad/s). Name in held "
        "the coordinate whose rate you mean, as 'crank.angle', and leave out the rates that should follow; those "
        "of driven bodies follow without held."
    )


def _shown(rates: Array, within: float) -> str:
    """Three rates, each as nothing where rounding is all there is."""
    return ", ".join(f"{0.0 if abs(rate) <= within else rate:.6g}" for rate in rates.tolist())


def _off(mechanism: Mechanism, left: Array, closed: Collection[str], more_than: float = -1.0) -> str:
    """By how much joints and closed contacts are off, of those that are so by more than a limit."""
    parts, row = [], 0
    joints = ((joint.name, joint.rows) for joint in mechanism.joints)
    for name, rows in (*joints, *((contact, 1) for contact in closed)):
        worst = np.abs(left[row : row + rows]).max()
        if not worst <= more_than:
            parts.append(f"{name} by {worst:.6g}")
        row += rows
    return ", ".join(parts)
