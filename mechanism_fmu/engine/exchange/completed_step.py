"""A step that an importer has completed: what may have happened within it unseen, and what swings in it.

An importer sees an event where an indicator has another sign at the end of its step. A gap that has closed and opened
again within the step is found by the cubic through gaps and rates at both ends, and refused with its name.
"""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Exchange, Pose, Rubs, Stages
from ...tables.parts import Contacts, Thresholds
from ...tables.sizes import Sizes
from ...tolerances import TOUCHES_WITHIN
from .. import status
from ..compiler.subset import jit, keep_small
from ..constraints.friction_rows import touches
from ..contacts.binding import deepest_overlap, is_outline
from ..contacts.guards import gap
from ..contacts.inside import blame
from ..dynamics.oscillation import observe
from ..scales import contact_unit
from ..stepping.step import watch_at
from ..vectors import copy
from .indicators import can_happen, evaluate, measure, unseen, what_forbids
from .thresholds import passed_threshold, write_cubic

#: A dip of the cubic through gaps and rates at two steps counts that is deeper than this part of the gaps there: it is
#: no more accurate.
_DIP_SHARE = 0.01


@jit
def set_clock(block: Array, time: float) -> None:
    """There is no step of the engine's own."""
    clock = Course(block).clock
    clock[codes.TIME] = time
    clock[codes.STEP_START] = time
    clock[codes.STEP_END] = time
    clock[codes.STEP_SIZE] = 0.0


@jit
def note(block: Array, at: Pose) -> None:
    """What the next completed step is compared with: gaps, gap rates, unknowns and their derivatives."""
    keep_small()
    now = Course(block)
    table = Exchange(block)
    now.clock[codes.COMPLETED] = now.clock[codes.TIME]
    copy(now.y_end, table.seen_y)
    copy(now.dy_end, table.seen_rates)
    for c in range(table.leaves.shape[0]):
        if _is_looked_at(block, c):
            table.seen[c, 0], table.seen[c, 1] = gap(block, at, c)
    measure(block, at)


@jit
def _is_looked_at(block: Array, contact: int) -> bool:
    """Whether it is the gap of a contact that its indicator is of; distances of outlines have no rate."""
    keep_small()
    opened: bool = Contacts(block).mode[contact] == codes.OPEN and can_happen(block, contact)
    return opened and not is_outline(block, contact) and Exchange(block).leaves[contact] == 0


@jit
def look_through(block: Array) -> int:
    """Look for a gap that was zero within the step, and time what swings; return a status."""
    keep_small()
    now = Course(block)
    table = Exchange(block)
    at = evaluate(block)
    outcome = what_forbids(block)
    if outcome != status.OK:
        return outcome
    size = now.clock[codes.TIME] - now.clock[codes.COMPLETED]
    for c in range(table.leaves.shape[0]):
        if size > 0.0 and _is_looked_at(block, c):
            distance, rate = gap(block, at, c)
            depth = _deepest(table.seen[c, 0], table.seen[c, 1], distance, rate, size, contact_unit(block, c))
            if depth > 0.0:
                blame(block, c, -depth)
                return status.PASSED_OVER
    if Sizes(block).outlines > 0:
        contact, overlap = deepest_overlap(block, at, 0.0)
        if contact != codes.NONE and overlap > 2.0 * unseen(block, contact):
            blame(block, contact, -overlap)
            return status.PASSED_OVER
    if Sizes(block).thresholds > 0:
        threshold = passed_threshold(block)
        if threshold != codes.NONE:
            Stages(block).stiffest[0] = Thresholds(block).force[threshold]
            return status.FORCE_PASSED_OVER
    if size > 0.0:
        now.clock[codes.STEP_START] = now.clock[codes.COMPLETED]
        now.clock[codes.STEP_SIZE] = write_cubic(block, now.dense)
        observe(block)
        set_clock(block, now.clock[codes.TIME])
    watch_at(block, now.clock[codes.TIME])
    note(block, at)
    table.wants_events[0] = 1 if _begins_to_rub(block) else 0
    return status.OK


@jit
def _begins_to_rub(block: Array) -> bool:
    """Whether friction that was none has become some, as of a brake that an input applies between events."""
    keep_small()
    begins = False
    for k in range(Sizes(block).rubs):
        begins = begins or (Rubs(block).slip[k] == codes.APART and touches(block, k))
    return begins


@jit
def _deepest(before: float, rate_before: float, after: float, rate_after: float, size: float, unit: float) -> float:
    """How far below zero a gap has been that nothing has said, or 0: within the step, or since the step before.

    A gap that is below zero at the end of this step is what an importer without a root finder goes into event mode for.
    """
    keep_small()
    touches_within = TOUCHES_WITHIN * unit
    if before < -touches_within and after < -touches_within:
        return -after
    shallow = touches_within + _DIP_SHARE * (abs(before) + abs(after))
    if not (before > 0.0 and after > 0.0 and rate_before < 0.0 < rate_after):
        return 0.0
    left = 0.0
    right = 1.0
    for _ in range(50):  # where the rate of the cubic is zero
        middle = 0.5 * (left + right)
        slope = _slope(before, rate_before * size, after, rate_after * size, middle)
        if slope < 0.0:
            left = middle
        else:
            right = middle
    lowest = _cubic(before, rate_before * size, after, rate_after * size, left)
    return -lowest if lowest < -shallow else 0.0


@jit
def _cubic(before: float, slope_before: float, after: float, slope_after: float, x: float) -> float:
    change = after - before
    bend = slope_before - change
    return before + x * (change + (1.0 - x) * (bend + x * (change - slope_after - bend)))


@jit
def _slope(before: float, slope_before: float, after: float, slope_after: float, x: float) -> float:
    change = after - before
    bend = slope_before - change
    last = change - slope_after - bend
    return change + (1.0 - 2.0 * x) * bend + x * (2.0 - 3.0 * x) * last
