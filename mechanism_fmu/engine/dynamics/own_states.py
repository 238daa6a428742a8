"""Force elements with first-order states of their own, which are integrated with the motion.

A motor has its current and the integral of its controller. Their equations are continuous: where the voltage reaches
its limit, only the slope changes, so that no event is needed and the step size follows by itself.
"""

from __future__ import annotations

import math

from ...tables.declare import Array
from ...tables.kinds import FORCES
from ...tables.motion import Pose
from ...tables.parts import Forces
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from .element import Element, relative_speed, turn

CONSTANT, RESISTANCE, INDUCTANCE, VOLTAGE_LIMIT, GAIN, INTEGRAL_GAIN, ANTI_WINDUP, SPEED = FORCES.places("dc_motor")
_MOTOR = FORCES.number("dc_motor")
#: States of a motor's own: current [A], and the integral of the error of speed [rad].
CURRENT, INTEGRAL = range(2)


@jit
def winding_rate(block: Array) -> float:
    """One over the shortest time in which the current of a motor settles [1/s]; 0 where there is none."""
    keep_small()
    table = Forces(block)
    rate = 0.0
    for k in range(table.kind.shape[0]):
        if table.kind[k] == _MOTOR:
            rate = max(rate, table.data[k, RESISTANCE] / table.data[k, INDUCTANCE])
    return rate


@jit
def _place(block: Array, k: int) -> int:
    """Where the own states of element `k` begin among the unknowns."""
    place: int = Sizes(block).y_own + Forces(block).own[k]
    return place


@jit
def _motor(block: Array, at: Pose, k: int, y: Array, dy: Array, given: float, lost: float) -> tuple[float, float]:
    """L i' = u - R i - K rate and z' = e + g (u - v), with the error e and the wanted voltage v = kp e + ki z.

    The integral stops where the voltage u is at its limit. Powers are given by the supply and lost in the winding.
    """
    keep_small()
    data = Forces(block).data[k]
    place = _place(block, k)
    current = y[place + CURRENT]
    rate = relative_speed(block, at, k)
    wanted = _wanted_voltage(block, at, k, y)
    voltage = _limited(wanted, data[VOLTAGE_LIMIT])
    drop = data[RESISTANCE] * current
    back = data[CONSTANT] * rate
    dy[place + CURRENT] = (voltage - drop - back) / data[INDUCTANCE]
    error = data[SPEED] - rate
    dy[place + INTEGRAL] = error + data[ANTI_WINDUP] * (voltage - wanted)
    turn(block, k, data[CONSTANT] * current)
    return given + voltage * current, lost + drop * current


@jit
def _wanted_voltage(block: Array, at: Pose, k: int, y: Array) -> float:
    data = Forces(block).data[k]
    error = data[SPEED] - relative_speed(block, at, k)
    voltage: float = data[GAIN] * error + data[INTEGRAL_GAIN] * y[_place(block, k) + INTEGRAL]
    return voltage


@jit
def _read_motor(block: Array, at: Pose, k: int, y: Array, which: int) -> float:
    """Torque on its body [N m], current [A], or the voltage that the controller gives to it [V]."""
    keep_small()
    data = Forces(block).data[k]
    if which == 2:
        return _limited(_wanted_voltage(block, at, k, y), data[VOLTAGE_LIMIT])
    return _of_current(block, k, y, which)


@jit
def _read_motor_rate(block: Array, _at: Pose, k: int, dy: Array, which: int) -> float:
    return math.nan if which == 2 else _of_current(block, k, dy, which)


@jit
def _of_current(block: Array, k: int, y: Array, which: int) -> float:
    """Torque and current, or with rates instead of states their derivatives."""
    value: float = y[_place(block, k) + CURRENT]
    if which == 0:
        value *= Forces(block).data[k, CONSTANT]
    return value


@jit
def _motor_energy(block: Array, _at: Pose, k: int, y: Array) -> float:
    return _stored(y[_place(block, k) + CURRENT], Forces(block).data[k, INDUCTANCE])


@jit
def _motor_power(block: Array, _at: Pose, k: int, y: Array, dy: Array) -> float:
    place = _place(block, k) + CURRENT
    power: float = Forces(block).data[k, INDUCTANCE] * y[place] * dy[place]
    return power


@jit
def _stored(state: float, storage: float) -> float:
    """Half of a stiffness or inductance times the square of a twist or current [J]."""
    return 0.5 * storage * state * state


@jit
def _limited(value: float, limit: float) -> float:
    """`value` within +-limit; a negative limit is none at all, 0."""
    most = max(limit, 0.0)
    return min(max(value, -most), most)


ELEMENTS = {
    "brake": Element(),  # it rubs: see `sliding`
    "dc_motor": Element(_motor, _motor_energy, _motor_power, _read_motor, _read_motor_rate),
}
