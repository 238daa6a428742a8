"""Force elements with first-order states of their own, which are integrated with the motion.

A clutch that slips has its twist, a motor its current and the integral of its controller. Their equations are
continuous: where torque or voltage reach a limit, only the slope changes, so that no event is needed and the step size
follows by itself.
"""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.parts import Forces
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small


@jit
def first_own(block: Array) -> int:
    """Where own states begin among the unknowns."""
    first: int = Sizes(block).y_own
    return first


@jit
def clutch_at(block: Array, clutch: int, y: Array, rate: float, dy: Array) -> tuple[float, float, float]:
    """Torque on a clutch's body [N m], powers given by its driven end and lost in it [W]; its twist's rate into `dy`.

    Spring and damper in series with a slider: T = k s + c (speed - rate), but never beyond the limit, and s' is what
    the damper then does, s' = (T - k s) / c. What is left of the difference of speeds is slip.

    Args:
        block: of the instance.
        clutch: number of the force element.
        y: shape (unknowns,).
        rate: of the body, relative to the reaction [rad/s].
        dy: shape (unknowns,).
    """
    data = Forces(block).data[clutch]
    place = first_own(block) + Forces(block).own[clutch]
    twist = y[place]
    torque = clutch_torque(block, clutch, y, rate)
    elastic = data[codes.CLUTCH_STIFFNESS] * twist
    twist_rate = (torque - elastic) / data[codes.CLUTCH_DAMPING]
    dy[place] = twist_rate
    speed = data[codes.CLUTCH_SPEED]
    return torque, torque * speed, torque * (speed - rate) - elastic * twist_rate


@jit
def clutch_torque(block: Array, clutch: int, y: Array, rate: float) -> float:
    """Torque of a clutch on its body [N m]; arguments as of `clutch_at`."""
    data = Forces(block).data[clutch]
    twist = y[first_own(block) + Forces(block).own[clutch]]
    torque = data[codes.CLUTCH_STIFFNESS] * twist
    torque += data[codes.CLUTCH_DAMPING] * (data[codes.CLUTCH_SPEED] - rate)
    return _limited(torque, data[codes.CLUTCH_LIMIT])


@jit
def motor_at(block: Array, motor: int, y: Array, rate: float, dy: Array) -> tuple[float, float, float]:
    """Torque on a motor's body [N m], powers given by its supply and lost in its winding [W]; own rates into `dy`.

    L i' = u - R i - K rate and z' = e + g (u - v), with the error e, and v and u as of `motor_voltage`: the integral
    stops where the voltage is at its limit. Arguments as of `clutch_at`.
    """
    data = Forces(block).data[motor]
    place = first_own(block) + Forces(block).own[motor]
    current = y[place + codes.MOTOR_CURRENT]
    wanted = _wanted_voltage(block, motor, y, rate)
    voltage = _limited(wanted, data[codes.MOTOR_VOLTAGE_LIMIT])
    drop = data[codes.MOTOR_RESISTANCE] * current
    back = data[codes.MOTOR_CONSTANT] * rate
    dy[place + codes.MOTOR_CURRENT] = (voltage - drop - back) / data[codes.MOTOR_INDUCTANCE]
    error = data[codes.MOTOR_SPEED] - rate
    dy[place + codes.MOTOR_INTEGRAL] = error + data[codes.MOTOR_ANTI_WINDUP] * (voltage - wanted)
    return data[codes.MOTOR_CONSTANT] * current, voltage * current, drop * current


@jit
def motor_voltage(block: Array, motor: int, y: Array, rate: float) -> float:
    """Voltage that the controller gives to a motor [V]: u = v = kp e + ki z within the limit; as of `motor_at`."""
    return _limited(_wanted_voltage(block, motor, y, rate), Forces(block).data[motor, codes.MOTOR_VOLTAGE_LIMIT])


@jit
def _wanted_voltage(block: Array, motor: int, y: Array, rate: float) -> float:
    data = Forces(block).data[motor]
    integral = y[first_own(block) + Forces(block).own[motor] + codes.MOTOR_INTEGRAL]
    error = data[codes.MOTOR_SPEED] - rate
    voltage: float = data[codes.MOTOR_GAIN] * error + data[codes.MOTOR_INTEGRAL_GAIN] * integral
    return voltage


@jit
def own_energy(block: Array, y: Array) -> float:
    """Energy in the twist of clutches and the windings of motors [J]."""
    keep_small()
    table = Forces(block)
    energy = 0.0
    for k in range(table.kind.shape[0]):
        if table.own[k] != codes.NONE:
            state = y[first_own(block) + table.own[k]]
            energy += 0.5 * _storage(block, k) * state * state
    return energy


@jit
def own_power(block: Array, y: Array, dy: Array) -> float:
    """Power that goes into the twist of clutches and the windings of motors [W]."""
    keep_small()
    table = Forces(block)
    power = 0.0
    for k in range(table.kind.shape[0]):
        if table.own[k] != codes.NONE:
            place = first_own(block) + table.own[k]
            power += _storage(block, k) * y[place] * dy[place]
    return power


@jit
def _storage(block: Array, element: int) -> float:
    """The stiffness of a clutch [N m/rad], the inductance of a motor [H]: energy is half of it times state squared."""
    table = Forces(block)
    column = codes.CLUTCH_STIFFNESS
    if table.kind[element] == codes.DC_MOTOR:
        column = codes.MOTOR_INDUCTANCE
    value: float = table.data[element, column]
    return value


@jit
def _limited(value: float, limit: float) -> float:
    """`value` within +-limit; a negative limit is none at all, 0."""
    most = max(limit, 0.0)
    return min(max(value, -most), most)
