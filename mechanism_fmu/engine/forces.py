"""Applied forces: generalised forces, their power, and the energy stored in springs."""

from __future__ import annotations

from .. import codes
from .room import Array
from .rows import clear
from .subset import jit, keep_small
from .views import forces, loads, sizes


@jit
def apply_forces(block: Array, y: Array) -> float:
    """Write the generalised forces F [N, N m] to `loads.force`; return the power of external torques [W].

    External are all torque elements and the preloads of springs; the linear part of a spring stores energy instead.
    """
    keep_small()
    n = sizes(block).coordinates
    force = loads(block).force
    clear(force)
    table = forces(block)
    power = 0.0
    for k in range(table.kind.shape[0]):
        on = 3 * table.body[k] + 2
        against = 3 * table.reaction[k] + 2
        rate = _relative(y[n:], on, against, n)
        if table.kind[k] == codes.TORQUE:
            torque = table.data[k, codes.TORQUE_VALUE]
            power += torque * rate
        else:
            preload = table.data[k, codes.SPRING_PRELOAD]
            stretch = _relative(y, on, against, n) - table.data[k, codes.SPRING_FREE_ANGLE]
            torque = -(table.data[k, codes.SPRING_STIFFNESS] * stretch + preload)
            power -= preload * rate
        force[on] += torque
        force[against] -= torque
    return power


@jit
def spring_energy(block: Array, y: Array) -> float:
    """Energy stored in the linear part of all springs [J]."""
    keep_small()
    n = sizes(block).coordinates
    table = forces(block)
    energy = 0.0
    for k in range(table.kind.shape[0]):
        if table.kind[k] == codes.TORSION_SPRING:
            on = 3 * table.body[k] + 2
            against = 3 * table.reaction[k] + 2
            stretch = _relative(y, on, against, n) - table.data[k, codes.SPRING_FREE_ANGLE]
            energy += 0.5 * table.data[k, codes.SPRING_STIFFNESS] * stretch * stretch
    return energy


@jit
def kinetic_energy(inverse_mass: Array, rate: Array, count: int) -> float:
    """Kinetic energy [J] of rates (count,) with inverse masses (count,)."""
    keep_small()
    energy = 0.0
    for k in range(count):
        energy += 0.5 * rate[k] * rate[k] / inverse_mass[k]
    return energy


@jit
def _relative(values: Array, on: int, against: int, n: int) -> float:
    """Difference of two entries; the ground's (index >= n) is zero."""
    difference = 0.0
    if on < n:
        difference += values[on]
    if against < n:
        difference -= values[against]
    return difference
