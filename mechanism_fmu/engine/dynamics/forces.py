"""Applied forces: generalised forces, power, stored energy, readings; and inputs, which are written into their table.

What an element does stands with its kind: a file of `ELEMENTS` for each family.
"""

from __future__ import annotations

from typing import Any

from ... import codes
from ...tables.declare import Array
from ...tables.kinds import FORCES
from ...tables.motion import Course, Loads, Pose
from ...tables.parts import Forces, Ports
from ..compiler.by_kind import by_kind
from ..compiler.subset import jit, keep_small
from ..constraints.kinematics import set_instant
from ..vectors import clear
from . import bushing, markers, oscillation, own_states, point_forces, torsional
from .element import Element

#: Every force element of the engine, by the name of its kind.
ELEMENTS: dict[str, Element] = {
    **torsional.ELEMENTS,
    **point_forces.ELEMENTS,
    **bushing.ELEMENTS,
    **own_states.ELEMENTS,
    **markers.ELEMENTS,
    **oscillation.ELEMENTS,
}


def _function(role: str, arguments: str, otherwise: str) -> Any:
    """What all elements that have this role do."""
    functions = {kind: getattr(element, role) for kind, element in ELEMENTS.items() if getattr(element, role)}
    return by_kind(FORCES.numbered(functions), arguments, otherwise)


_act = _function("act", "block, at, k, y, dy, given, lost", "given, lost")
_stored = _function("stored", "block, at, k, y", "0.0")
_storing = _function("storing", "block, at, k, y, dy", "0.0")
_read = _function("read", "block, at, k, y, which", "math.nan")
_read_rate = _function("read_rate", "block, at, k, dy, which", "math.nan")


@jit
def apply_forces(block: Array, at: Pose, y: Array, dy: Array) -> tuple[float, float]:
    """Write the generalised forces F [N, N m] to `loads.force`; return the powers given and lost [W].

    Given: by torques, forces, shafts, the driven ends of clutches, the supplies of motors, the preloads of springs and
    laws of the user's own (the linear part of a spring stores energy instead). Lost: in dampers, clutches and windings.
    Derivatives of own states go to their place in `dy`, shape (unknowns,).
    """
    clear(Loads(block).force)
    clear(Loads(block).size)
    kind = Forces(block).kind
    given = lost = 0.0
    for k in range(kind.shape[0]):
        given, lost = _act(kind[k], block, at, k, y, dy, given, lost)
    return given, lost


@jit
def stored_energy(block: Array, at: Pose, y: Array) -> float:
    """Energy stored in the linear part of all springs, and in what has states of its own [J]."""
    keep_small()
    kind = Forces(block).kind
    energy = 0.0
    for k in range(kind.shape[0]):
        energy += _stored(kind[k], block, at, k, y)
    return energy


@jit
def stored_power(block: Array, at: Pose, y: Array, dy: Array) -> float:
    """Derivative of `stored_energy` [W]."""
    keep_small()
    kind = Forces(block).kind
    power = 0.0
    for k in range(kind.shape[0]):
        power += _storing(kind[k], block, at, k, y, dy)
    return power


@jit
def force_reading(block: Array, at: Pose, k: int, y: Array, which: int) -> float:
    """An output of force element `k`."""
    value: float = _read(Forces(block).kind[k], block, at, k, y, which)
    return value


@jit
def force_reading_rate(block: Array, at: Pose, k: int, dy: Array, which: int) -> float:
    """Derivative of an output of force element `k` with respect to time; not a number where it is not known."""
    rate: float = _read_rate(Forces(block).kind[k], block, at, k, dy, which)
    return rate


@jit
def kinetic_energy(inverse_mass: Array, rate: Array, count: int) -> float:
    """Kinetic energy [J] of rates (count,) with inverse masses (count,)."""
    keep_small()
    energy = 0.0
    for k in range(count):
        energy += 0.5 * rate[k] * rate[k] / inverse_mass[k]
    return energy


@jit
def kinetic_power(inverse_mass: Array, rate: Array, acceleration: Array, count: int) -> float:
    """Derivative of the kinetic energy [W] from rates and accelerations (count,) with inverse masses (count,)."""
    keep_small()
    power = 0.0
    for k in range(count):
        power += rate[k] * acceleration[k] / inverse_mass[k]
    return power


# Inputs: factor * value + offset of each is written into an entry of the force table. No model-specific code.
#
# An input may have a slope, which acts during one communication step only. The step's first value and slope are kept
# (`held_inputs`, `held_slopes`, from RAMP_START on), and whoever moves the time calls `set_time` before forces or rows
# are asked for.


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
