"""Applied forces: generalised forces, their power, and the energy stored in springs."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Loads
from ...tables.parts import Forces
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..vectors import clear
from .own_states import clutch_at, motor_at, own_energy, own_power


@jit
def apply_forces(block: Array, y: Array, dy: Array) -> tuple[float, float]:
    """Write the generalised forces F [N, N m] to `loads.force`; return the powers given and lost [W].

    Given: by torques, forces, shafts, the driven ends of clutches, the supplies of motors, and the preloads of springs
    (the linear part of a spring stores energy instead). Lost: in dampers, clutches and the windings of motors.
    Derivatives of own states go to their place in `dy`, shape (unknowns,).
    """
    n = Sizes(block).coordinates
    force = Loads(block).force
    clear(force)
    table = Forces(block)
    rates = y[n:]
    given = 0.0
    lost = 0.0
    for k in range(table.kind.shape[0]):
        kind = table.kind[k]
        first = 3 * table.body[k]
        if kind == codes.FORCE:
            for axis in range(2):
                force[first + axis] += table.data[k, axis]
                given += table.data[k, axis] * _entry(rates, first + axis, n)
            continue
        on = first + 2
        against = 3 * table.reaction[k] + 2
        rate = _relative(rates, on, against, n)
        if kind == codes.TORSION_SPRING:
            preload = table.data[k, codes.SPRING_PRELOAD]
            stretch = _stretch(block, k, y)
            torque = -(table.data[k, codes.SPRING_STIFFNESS] * stretch + preload)
            given -= preload * rate
        elif kind == codes.DAMPER:
            torque = -table.data[k, codes.DAMPING] * rate
            lost -= torque * rate
        elif kind == codes.SLIP_CLUTCH:
            torque, power, loss = clutch_at(block, k, y, rate, dy)
            given += power
            lost += loss
        elif kind == codes.DC_MOTOR:
            torque, power, loss = motor_at(block, k, y, rate, dy)
            given += power
            lost += loss
        else:
            torque = table.data[k, codes.TORQUE_VALUE]
            if kind == codes.SHAFT:
                torque = shaft_torque(block, y, k)
            given += torque * rate
        Loads(block).torque[k] = torque
        force[on] += torque
        force[against] -= torque
    return given, lost


@jit
def weight(block: Array, body: int) -> tuple[float, float]:
    """Sum of the forces on a body's centre of mass [N]."""
    keep_small()
    table = Forces(block)
    x = 0.0
    y = 0.0
    for k in range(table.kind.shape[0]):
        if table.kind[k] == codes.FORCE and table.body[k] == body:
            x += table.data[k, codes.FORCE_X]
            y += table.data[k, codes.FORCE_Y]
    return x, y


@jit
def shaft_torque(block: Array, y: Array, shaft: int) -> float:
    """Torque of a compliant shaft on its body [N m]."""
    n = Sizes(block).coordinates
    table = Forces(block)
    data = table.data[shaft]
    on = 3 * table.body[shaft] + 2
    against = 3 * table.reaction[shaft] + 2
    twist = data[codes.SHAFT_ANGLE] - _relative(y, on, against, n)
    twist_rate = data[codes.SHAFT_SPEED] - _relative(y[n:], on, against, n)
    torque: float = data[codes.SHAFT_STIFFNESS] * twist + data[codes.SHAFT_DAMPING] * twist_rate
    return torque


@jit
def body_speed(block: Array, y: Array, element: int) -> float:
    """Rate of a force element's body relative to its reaction [rad/s]."""
    n = Sizes(block).coordinates
    table = Forces(block)
    return _relative(y[n:], 3 * table.body[element] + 2, 3 * table.reaction[element] + 2, n)


@jit
def spring_energy(block: Array, y: Array) -> float:
    """Energy stored in the linear part of all springs, and in what has states of its own [J]."""
    keep_small()
    table = Forces(block)
    energy = own_energy(block, y)
    for k in range(table.kind.shape[0]):
        if table.kind[k] == codes.TORSION_SPRING:
            stretch = _stretch(block, k, y)
            energy += 0.5 * table.data[k, codes.SPRING_STIFFNESS] * stretch * stretch
    return energy


@jit
def spring_power(block: Array, y: Array, dy: Array) -> float:
    """Derivative of `spring_energy` [W]."""
    keep_small()
    n = Sizes(block).coordinates
    table = Forces(block)
    power = own_power(block, y, dy)
    for k in range(table.kind.shape[0]):
        if table.kind[k] == codes.TORSION_SPRING:
            on = 3 * table.body[k] + 2
            against = 3 * table.reaction[k] + 2
            power += table.data[k, codes.SPRING_STIFFNESS] * _stretch(block, k, y) * _relative(y[n:], on, against, n)
    return power


@jit
def _stretch(block: Array, spring: int, y: Array) -> float:
    """By how much a torsion spring is wound up beyond its free angle [rad]."""
    table = Forces(block)
    on = 3 * table.body[spring] + 2
    against = 3 * table.reaction[spring] + 2
    free: float = table.data[spring, codes.SPRING_FREE_ANGLE]
    return _relative(y, on, against, Sizes(block).coordinates) - free


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


@jit
def _relative(values: Array, on: int, against: int, n: int) -> float:
    """Difference of two entries; the ground's is zero."""
    return _entry(values, on, n) - _entry(values, against, n)


@jit
def _entry(values: Array, index: int, n: int) -> float:
    """One entry; the ground's (index >= n) is zero."""
    if index < n:
        value: float = values[index]
        return value
    return 0.0
