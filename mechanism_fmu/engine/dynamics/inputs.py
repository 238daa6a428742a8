"""Inputs: factor * value + offset of each is written into an entry of the force table. No model-specific code.

An input may have a slope, which acts during one communication step only. The step's first value and slope are kept
(`held_inputs`, `held_slopes`, from RAMP_START on), and whoever moves the time calls `set_time` before forces or rows
are asked for.
"""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course
from ...tables.parts import Forces, Ports
from ..compiler.subset import jit, keep_small
from ..constraints.kinematics import set_instant


@jit
def inputs_changed(block: Array) -> bool:
    """Whether an input differs from what the motion has used so far, or has, or had until now, a slope."""
    table = Ports(block)
    changed: bool = Course(block).counters[codes.RAMPING] != 0
    for k in range(table.inputs.shape[0]):
        if table.inputs[k] != table.held_inputs[k] or table.input_slopes[k] != 0.0:
            changed = True
    return changed


@jit
def take_inputs(block: Array) -> None:
    """Let the present inputs act from TIME on, with their slopes, which are used up by that."""
    keep_small()
    table = Ports(block)
    now = Course(block)
    now.clock[codes.RAMP_START] = now.clock[codes.TIME]
    now.counters[codes.RAMPING] = 0
    for k in range(table.inputs.shape[0]):
        table.held_inputs[k] = table.inputs[k]
        table.held_slopes[k] = table.input_slopes[k]
        table.input_slopes[k] = 0.0
        if table.held_slopes[k] != 0.0:
            now.counters[codes.RAMPING] = 1
    feed(block, table.inputs)


@jit
def feed(block: Array, values: Array) -> None:
    """Write what `values`, shape (inputs,), stand for into the table entries that the inputs feed."""
    table = Ports(block)
    data = Forces(block).data
    for k in range(values.shape[0]):
        entry = table.input_factor[k] * values[k] + table.input_offset[k]
        data[table.input_force[k], table.input_column[k]] = entry


@jit
def set_time(block: Array, time: float) -> None:
    """Make `time` [s] the instant that drivers see, and feed the inputs' values there, if any has a slope."""
    set_instant(block, time)
    if Course(block).counters[codes.RAMPING] != 0:
        _feed_ramp(block, time)


@jit
def _feed_ramp(block: Array, time: float) -> None:
    keep_small()
    table = Ports(block)
    data = Forces(block).data
    for k in range(table.inputs.shape[0]):
        entry = table.input_factor[k] * _reached(block, k, time) + table.input_offset[k]
        data[table.input_force[k], table.input_column[k]] = entry


@jit
def show_reached(block: Array) -> None:
    """Make `inputs` the values that inputs with slopes have reached at TIME."""
    now = Course(block)
    table = Ports(block)
    if now.counters[codes.RAMPING] != 0:
        for k in range(table.inputs.shape[0]):
            table.inputs[k] = _reached(block, k, now.clock[codes.TIME])


@jit
def _reached(block: Array, k: int, time: float) -> float:
    """Value of input `k` at `time` [s]."""
    table = Ports(block)
    value: float = table.held_inputs[k] + table.held_slopes[k] * (time - Course(block).clock[codes.RAMP_START])
    return value
