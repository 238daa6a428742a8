"""When a closed contact first pulls: legal in the paper's guided model, impossible in a real one, so worth knowing."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Stages
from ...tables.parts import Contacts
from ..compiler.subset import jit, keep_small
from ..dynamics.acceleration import derivative
from ..dynamics.inputs import set_time
from .interpolation import interpolate

#: A contact force below this pulls [N]; rounding leaves about 1e-13.
_PULLS_BELOW = -1e-9
_BISECTIONS = 50


@jit
def watch_at(block: Array, time: float) -> None:
    """Note `time` for every contact that pulls for the first time, by the multipliers of the last acceleration."""
    keep_small()
    table = Contacts(block)
    system = LinearSystem(block)
    for c in range(table.mode.shape[0]):
        held = table.mode[c] == codes.CLOSED and table.value[c, codes.GUIDED] > 0.5
        pulls = held and system.multiplier[table.row[c]] < _PULLS_BELOW
        if pulls and table.pull_time[c] == math.inf:
            table.pull_time[c] = time
            Course(block).counters[codes.COUNT_PULLS] += 1


@jit
def watch_step(block: Array) -> None:
    """After a step: note when contacts began to pull, located inside the step by bisection."""
    keep_small()
    table = Contacts(block)
    now = Course(block)
    end = now.clock[codes.STEP_END]
    watch_at(block, end)
    for c in range(table.mode.shape[0]):
        if table.mode[c] == codes.CLOSED and table.pull_time[c] == end:
            table.pull_time[c] = _locate(block, c)


@jit
def _locate(block: Array, contact: int) -> float:
    keep_small()
    table = Contacts(block)
    now = Course(block)
    s = Stages(block)
    before = 0.0
    after = 1.0
    for _ in range(_BISECTIONS):
        middle = 0.5 * (before + after)
        interpolate(now.dense, middle, s.y_at)
        set_time(block, now.clock[codes.STEP_START] + middle * now.clock[codes.STEP_SIZE])
        derivative(block, s.y_at, s.dy_at)
        if LinearSystem(block).multiplier[table.row[contact]] < _PULLS_BELOW:
            after = middle
        else:
            before = middle
    time: float = now.clock[codes.STEP_START] + after * now.clock[codes.STEP_SIZE]
    return time
