"""Applied forces: generalised forces, their power, the energy that they store, and what is read of them.

What an element does stands with its kind: a file of `ELEMENTS` for each family.
"""

from __future__ import annotations

from typing import Any

from ...tables.declare import Array
from ...tables.kinds import FORCES
from ...tables.motion import Loads, Pose
from ...tables.parts import Forces
from ..compiler.by_kind import by_kind
from ..compiler.subset import jit, keep_small
from ..vectors import clear
from . import bushing, own_states, point_forces, torsional
from .element import Element

#: Every force element of the engine, by the name of its kind.
ELEMENTS: dict[str, Element] = {
    **torsional.ELEMENTS,
    **point_forces.ELEMENTS,
    **bushing.ELEMENTS,
    **own_states.ELEMENTS,
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
    kind = Forces(block).kind
    given = 0.0
    lost = 0.0
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
