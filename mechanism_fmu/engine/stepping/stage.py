"""A stage of a step, by any method: the derivative at its time, and what is noted of it."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Rows, Rubs, Stages
from ...tables.parts import Contacts
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..constraints.friction_rows import rubs, sticks
from ..constraints.rows import row_count
from ..contacts.complementarity import hold_ratio, push_ratio
from ..contacts.guards import can_open
from ..dynamics.acceleration import derivative
from ..dynamics.forces import set_time
from ..dynamics.rounding import note_level
from ..scales import largest_off
from ..vectors import largest
from .singular import independence


@jit
def evaluate_stage(block: Array, time: float, y: Array, dy: Array) -> None:
    """The derivative at one stage, with the inputs' values at its `time` [s]; y and dy of shape (unknowns,)."""
    keep_small()
    set_time(block, time)
    s = Stages(block)
    derivative(block, y, dy)
    lost = Sizes(block).y_loss
    if rubs(block) and Rubs(block).sense[0] != Course(block).counters[codes.SENSE]:
        dy[lost] = math.nan  # on the way here they have been infinite
    if math.isnan(dy[lost]) and not math.isnan(dy[0]):
        s.jams[0] = 1
    note_pushes(block)
    s.stage[0] += 1
    s.independence[s.stage[0]] = independence(block)


@jit
def note_pushes(block: Array) -> None:
    """After an acceleration: keep the least and the largest force of every closed contact that can open."""
    table = Contacts(block)
    is_noted = False
    for c in range(table.mode.shape[0]):
        if table.mode[c] == codes.CLOSED and can_open(block, c):
            if not is_noted:
                note_level(block, row_count(block))
                is_noted = True
            push = push_ratio(block, c)
            table.least_push[c] = min(table.least_push[c], push)
            table.most_push[c] = max(table.most_push[c], push)
    if not rubs(block):
        return
    if not is_noted:
        note_level(block, row_count(block))
    rub = Rubs(block)
    for k in range(rub.slip.shape[0]):
        if sticks(block, k):
            rub.least_hold[k] = min(rub.least_hold[k], hold_ratio(block, k))


@jit
def note_drift(block: Array) -> None:
    """Write `stages.drift` from the rows as they have just been evaluated."""
    rows = Rows(block)
    drift = Stages(block).drift
    count = row_count(block)
    drift[0] = largest_off(block, rows.residual, count)
    drift[1] = largest_off(block, rows.residual_rate, count)
    drift[2] = largest(rows.residual, count)
    drift[3] = largest(rows.residual_rate, count)
