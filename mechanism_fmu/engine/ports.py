"""Ports: inputs are written into table entries, outputs are read from the state. No model-specific code."""

from __future__ import annotations

from .. import codes
from .room import Array
from .subset import jit
from .views import course, forces, ports


@jit
def write_inputs(block: Array) -> bool:
    """Write all inputs into the table entries that they feed; True when one differs from what the motion has used."""
    table = ports(block)
    data = forces(block).data
    changed = False
    for k in range(table.inputs.shape[0]):
        if table.inputs[k] != table.held_inputs[k]:
            changed = True
            table.held_inputs[k] = table.inputs[k]
        data[table.input_force[k], table.input_column[k]] = table.inputs[k]
    return changed


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
