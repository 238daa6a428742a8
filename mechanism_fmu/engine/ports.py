"""Ports: inputs are written into table entries, outputs are read from the state. No model-specific code."""

from __future__ import annotations

from .room import Array
from .subset import jit
from .views import forces, ports


@jit
def inputs_changed(block: Array) -> bool:
    """Whether an input differs from what the motion has used so far."""
    table = ports(block)
    changed = False
    for k in range(table.inputs.shape[0]):
        changed = changed or table.inputs[k] != table.held_inputs[k]
    return changed


@jit
def take_inputs(block: Array) -> None:
    """Let the present inputs act from now on."""
    table = ports(block)
    for k in range(table.inputs.shape[0]):
        table.held_inputs[k] = table.inputs[k]
    feed(block, table.inputs)


@jit
def feed(block: Array, values: Array) -> None:
    """Write `values`, shape (inputs,), into the table entries that the inputs feed."""
    table = ports(block)
    data = forces(block).data
    for k in range(values.shape[0]):
        data[table.input_force[k], table.input_column[k]] = values[k]
