"""The beginning: from the start guess to a mechanism that is assembled and ready to move."""

from __future__ import annotations

from ...tables.declare import Array
from .. import status
from ..compiler.subset import entry, jit, keep_small
from ..dynamics.inputs import set_time
from ..profiles.shape import examine_profiles
from .assembly import assemble
from .guess import find_copies, is_inside, start_guess
from .start import start

#: Copies of a pattern that are tried: the one where the point is, and four on either side.
_MOST_ASSEMBLIES = 9


@entry
def begin(block: Array, time: float) -> int:
    """Assemble the mechanism from its start guess and make ready to begin at `time` [s]; return a status.

    When the mechanism cannot be assembled, y_end and `rows.residual` hold the closest position and what is left of
    Phi. When it starts inside, PENDING_SUBJECT and the last entry of `rows.residual` hold the contact and its gap [m].
    """
    keep_small()
    outcome = status.NOT_ASSEMBLED
    set_time(block, time)
    seen = examine_profiles(block)
    if seen != status.OK:
        return seen
    for k in range(_MOST_ASSEMBLIES + 1):
        start_guess(block, _neighbour(k))
        outcome = assemble(block)
        if k == _MOST_ASSEMBLIES:
            break
        if outcome == status.OK and not find_copies(block) and not is_inside(block):
            return start(block, time)
    if outcome == status.OK:  # nowhere: say what is wrong with the nearest place
        outcome = start(block, time)
    if outcome == status.OK:
        outcome = status.NO_PLACE
    return outcome


@entry
def assemble_at(block: Array, time: float) -> int:
    """Close the position rows from the start guess at `time` [s], whatever the rates; return a status (see `begin`)."""
    keep_small()
    set_time(block, time)
    start_guess(block, 0)
    return assemble(block)


@jit
def _neighbour(k: int) -> int:
    """0, -1, 1, -2, 2 ... for k = 0, 1, 2 ...: copies near the guess first, and at last the guess once more."""
    if k == _MOST_ASSEMBLIES:
        return 0
    if k % 2 == 1:
        return -((k + 1) // 2)
    return k // 2
