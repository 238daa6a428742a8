"""Contacts that no longer touch."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course
from ...tables.parts import Contacts
from ...tolerances import GAP_NOISE, RESTS_BELOW
from ..compiler.subset import jit, keep_small
from ..constraints.kinematics import place_bodies
from .guards import gap


@jit
def release(block: Array, struck: int) -> None:
    """Contacts that touched at the step's start have come off by y_end, but for the one that strikes there.

    One that is open and comes back has been off, however low the hop: it strikes where its gap closes, not before.
    """
    keep_small()
    table = Contacts(block)
    at = place_bodies(block, Course(block).y_end)
    for c in range(table.mode.shape[0]):
        if table.touching[c] == 1 and table.mode[c] == codes.OPEN and c != struck:
            distance, rate = gap(block, at, c)
            if distance > GAP_NOISE or (distance > 0.0 and rate < -RESTS_BELOW):
                table.touching[c] = 0
