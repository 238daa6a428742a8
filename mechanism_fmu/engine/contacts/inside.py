"""Open contacts that stand inside the other body, from where no event leads on; outlines have `handover` for that."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Pose, Rows, Stages
from ...tables.parts import Contacts
from ...tables.sizes import Sizes
from ...tolerances import CLOSES_WITHIN, DEEPEST, ROOT_TOLERANCE
from ..compiler.subset import jit, keep_apart
from ..constraints.kinematics import place_bodies
from ..constraints.point_line import spare_row
from ..scales import contact_unit, length_scale, rate_scale
from .binding import is_outline
from .guards import gap, is_watched

#: What rounding leaves of a gap, in parts of what it is the difference of: a few times that of a number.
_ROUNDING = 1e-15


@jit
def is_too_deep(block: Array, at: Pose, contact: int, distance: float, rate: float) -> bool:
    """Whether a gap is farther below zero than where a contact may have been left.

    That is what touches, and more far from the origin, where the gap is a small difference of large numbers, and at
    high speed, because an impact is found within `ROOT_TOLERANCE` of the mechanism's time. Where logical functions
    close rows, mending moves bodies by as much as these may be off.
    """
    keep_apart()
    deepest = CLOSES_WITHIN if Sizes(block).functions > 0 else DEEPEST
    # boundaries and functions are passed by parts of the whole mechanism
    switches = Sizes(block).functions + Sizes(block).patterns > 0
    unit = max(contact_unit(block, contact), length_scale(block)) if switches else contact_unit(block, contact)
    i, j = Contacts(block).body_i[contact], Contacts(block).body_j[contact]
    far = unit * (abs(at.phi[i]) + abs(at.phi[j])) + abs(at.x[i]) + abs(at.y[i]) + abs(at.x[j]) + abs(at.y[j])
    deep: bool = distance < -deepest * unit - _ROUNDING * far - ROOT_TOLERANCE / rate_scale(block) * abs(rate)
    return deep


@jit
def is_one_inside(block: Array) -> bool:
    """Whether an open contact stands inside at y_end; the deepest one is blamed.

    One that a logical function switches is no one-sided contact, and one that is not enabled is none at all: a point
    may be behind its line. A line of a pattern is that of the present copy.
    """
    keep_apart()
    at = place_bodies(block, Course(block).y_end)
    found = codes.NONE
    least = 0.0
    for c in range(Contacts(block).mode.shape[0]):
        if is_watched(block, c) and not is_outline(block, c):  # of the first guards, each is the gap of a contact
            distance, rate = gap(block, at, c)
            if distance < least and is_too_deep(block, at, c, distance, rate):
                least = distance
                found = c
    if found == codes.NONE:
        return False
    blame(block, found, least)
    return True


@jit
def blame(block: Array, contact: int, distance: float) -> None:
    """Report which contact is inside in a motion, and its gap [m or rad]: `stages.stiffest`, spare row's residual."""
    keep_apart()
    Stages(block).stiffest[0] = contact
    Rows(block).residual[spare_row(block)] = distance
