"""Ports: inputs are written into table entries, outputs are read from the state. No model-specific code."""

from __future__ import annotations

from .. import codes
from .room import Array
from .subset import jit, keep_small
from .views import course, forces, ports


@jit
def write_inputs(block: Array) -> bool:
    """Feed all inputs to the mechanism; True when one differs from what the motion has used."""
    keep_small()
    table = ports(block)
    changed = False
    for k in range(table.inputs.shape[0]):
        if table.inputs[k] != table.held_inputs[k]:
            changed = True
            table.held_inputs[k] = table.inputs[k]
    feed(block, table.inputs)
    return changed


@jit
def feed(block: Array, values: Array) -> None:
    """Write `values`, shape (inputs,), into the table entries that the inputs feed."""
    table = ports(block)
    data = forces(block).data
    for k in range(values.shape[0]):
        data[table.input_force[k], table.input_column[k]] = values[k]


@jit
def clear_impacts(block: Array) -> None:
    """Begin a communication step: empty the buffer of impacts."""
    now = course(block)
    for b in range(now.counters[codes.COUNT_IN_STEP]):
        clear_record(now.impacts[b])
    now.counters[codes.COUNT_IN_STEP] = 0


@jit
def clear_record(record: Array) -> None:
    """Make an impact record say that there was none: time, contact and tooth -1, all else 0."""
    for k in range(record.shape[0]):
        record[k] = 0.0
    record[codes.RECORD_TIME] = -1.0
    record[codes.RECORD_CONTACT] = -1.0
    record[codes.RECORD_TOOTH] = -1.0
