"""Directional derivatives: how outputs and derivatives of the states change with inputs and states, modes unchanged.

By central differences of the whole evaluation, extrapolated to a step of zero (C. Ridders, Advances in Engineering
Software 4, 1982). Accelerations and forces are linear in the forces that inputs give, also while contacts push, stick
and slip: there the first difference is exact, however large its step is, and the second one, which agrees with it, ends
the search. What is not linear (friction in joints, laws of the user's own, states) is extrapolated until the best of
all estimates is found, for each number by itself.

Where inputs alone change and nothing rubs, all of it comes from one factorisation of the constraints; what is not asked
for is not waited for.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import LEVELS, Course, LinearSystem, Sensitivity, Stages
from ...tables.parts import Ports
from ...tables.sizes import Sizes
from ..compiler.subset import entry, jit, keep_apart, keep_small
from ..constraints.friction_rows import rubs
from ..dynamics.linear_solve import KEEP
from ..outputs import read_outputs
from ..scales import rate_scale, write_scales
from ..vectors import copy
from .indicators import evaluate

#: Each step is so much smaller than the last.
_SHRINKS = 4.0
#: Estimates agree where they are so near to each other, in parts of their size.
_AGREE = 1e-13
#: The first step: inputs move by this part of their size, at least by this; states by so much, in their scales.
_PART, _LEAST_INPUT, _OF_STATES = 0.5, 1e-2, 1e-2


@entry
def respond(block: Array) -> None:
    """Write `sensitivity.response`: outputs, then derivatives of the states, along `input_seed` and `state_seed`.

    Only what is `asked` for is to be read. Where the outside has reached TIME; states may have seeds only where that is
    the end of the engine's own step. The motion is not touched.
    """
    keep_small()
    now = Course(block)
    ports = Ports(block)
    table = Sensitivity(block)
    copy(ports.inputs, table.inputs)
    copy(now.y_end, table.states)
    copy(now.dy_end, table.rates)
    step, moved = _first_step(block)
    if not (moved or rubs(block)):  # the limit of a brake, at 0 of which it has no row, may be an input
        LinearSystem(block).kept[0] = KEEP
    for k in range(table.response.shape[0]):
        table.error[k] = math.inf
        table.response[k] = math.nan
    for level in range(LEVELS):
        _difference(block, step)
        if _extrapolate(block, level):
            break
        step /= _SHRINKS
    LinearSystem(block).kept[0] = 0
    _move(block, 0.0)
    copy(table.states, now.y_end)
    copy(table.inputs, ports.inputs)
    read_outputs(block)
    copy(table.rates, now.dy_end)


@jit
def _first_step(block: Array) -> tuple[float, bool]:
    """By how much of the seeds inputs and states move at first, and whether a state does."""
    keep_small()
    table = Sensitivity(block)
    step = math.inf
    moved = False
    write_scales(block, rate_scale(block), 0.0)
    for k in range(table.inputs.shape[0]):
        if table.input_seed[k] != 0.0:
            step = min(step, (_PART * abs(table.inputs[k]) + _LEAST_INPUT) / abs(table.input_seed[k]))
    for k in range(table.states.shape[0]):
        if table.state_seed[k] != 0.0:
            step = min(step, _OF_STATES * Stages(block).scale[k] / abs(table.state_seed[k]))
            moved = True
    return step if step < math.inf else 1.0, moved


@jit
def _move(block: Array, part: float) -> None:
    """Inputs and states are moved by `part` of the seeds."""
    keep_small()
    table = Sensitivity(block)
    inputs = Ports(block).inputs
    y = Course(block).y_end
    for k in range(inputs.shape[0]):
        inputs[k] = table.inputs[k] + part * table.input_seed[k]
    for k in range(y.shape[0]):
        y[k] = table.states[k] + part * table.state_seed[k]


@jit
def _difference(block: Array, step: float) -> None:
    """The central difference quotients of one step, into `sensitivity.quotient`."""
    keep_apart()
    quotient = Sensitivity(block).quotient
    outputs = Ports(block).outputs
    rates = Course(block).dy_end
    count = Sizes(block).outputs
    clock = Course(block).clock
    for side in range(2):
        sign = 1.0 if side == 0 else -1.0
        _move(block, sign * step)
        read_outputs(block)
        if not clock[codes.TIME] < clock[codes.STEP_END]:  # else derivatives of states are not to be had
            evaluate(block)
        for k in range(quotient.shape[0]):
            value = outputs[k] if k < count else rates[k - count]
            if side == 0:
                quotient[k] = 0.0
            quotient[k] += 0.5 * sign * value / step


@jit
def _extrapolate(block: Array, level: int) -> bool:
    """Neville's scheme for each number, whose best estimate is kept; whether all agree with what was there before.

    `tableau` holds the last estimates, of rising order.
    """
    keep_apart()
    table = Sensitivity(block)
    settled = level > 0
    for k in range(table.response.shape[0]):
        estimate = table.quotient[k]
        factor = 1.0
        for order in range(level):
            before = table.tableau[order, k]
            factor *= _SHRINKS * _SHRINKS
            better = estimate + (estimate - before) / (factor - 1.0)
            error = max(abs(better - estimate), abs(better - before))
            if error <= table.error[k]:
                table.error[k] = error
                table.response[k] = better
            table.tableau[order, k] = estimate
            estimate = better
        table.tableau[level, k] = estimate
        if table.asked[k] == 1 and not table.error[k] <= _AGREE * abs(table.response[k]):
            settled = False
    return settled
