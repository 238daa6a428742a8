"""Ports: inputs are written into table entries, outputs are read from the state. No model-specific code."""

from __future__ import annotations

from .room import Array
from .subset import jit, keep_small
from .views import forces, ports


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
