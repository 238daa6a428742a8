"""Force elements between the angles of two bodies: torque, springs, damper, compliant shaft, and a law."""

from __future__ import annotations

import math

from ...tables.declare import Array
from ...tables.kinds import FORCES
from ...tables.motion import Pose
from ...tables.parts import Forces
from ..compiler.subset import jit, keep_small
from .element import Element, acting, relative_angle, relative_speed, spring_force, turn
from .laws import by_law, law_energy

(TORQUE,) = FORCES.places("torque")
SPRING_STIFFNESS, FREE_ANGLE, PRELOAD = FORCES.places("torsion_spring")
(DAMPING,) = FORCES.places("damper")
SHAFT_STIFFNESS, SHAFT_DAMPING, SHAFT_ANGLE, SHAFT_SPEED = FORCES.places("shaft")
STIFFNESS, SPRING_DAMPING, RELAXED, CONSTANT, SIDE = FORCES.places("torsion_spring_damper")
_NONLINEAR = FORCES.number("nonlinear_torsion_spring")
#: What is read of an element between two angles; else its power.
ANGLE, SPEED, TORQUE_READ = range(3)


@jit
def _torque(block: Array, at: Pose, k: int, _y: Array, _dy: Array, given: float, lost: float) -> tuple[float, float]:
    torque = Forces(block).data[k, TORQUE]
    turn(block, k, torque)
    return given + torque * relative_speed(block, at, k), lost


@jit
def _spring(block: Array, at: Pose, k: int, _y: Array, _dy: Array, given: float, lost: float) -> tuple[float, float]:
    """Stores the energy of its linear part; the work of its preload is given."""
    data = Forces(block).data[k]
    turn(block, k, -(data[SPRING_STIFFNESS] * _stretch(block, at, k) + data[PRELOAD]))
    return given - data[PRELOAD] * relative_speed(block, at, k), lost


@jit
def _spring_energy(block: Array, at: Pose, k: int, _y: Array) -> float:
    stretch = _stretch(block, at, k)
    energy: float = 0.5 * Forces(block).data[k, SPRING_STIFFNESS] * stretch * stretch
    return energy


@jit
def _spring_power(block: Array, at: Pose, k: int, _y: Array, _dy: Array) -> float:
    stiffness = Forces(block).data[k, SPRING_STIFFNESS]
    power: float = stiffness * _stretch(block, at, k) * relative_speed(block, at, k)
    return power


@jit
def _stretch(block: Array, at: Pose, k: int) -> float:
    """By how much a torsion spring is wound up beyond its free angle [rad]."""
    stretch: float = relative_angle(block, at, k) - Forces(block).data[k, FREE_ANGLE]
    return stretch


@jit
def _damper(block: Array, at: Pose, k: int, _y: Array, _dy: Array, given: float, lost: float) -> tuple[float, float]:
    rate = relative_speed(block, at, k)
    torque = -Forces(block).data[k, DAMPING] * rate
    turn(block, k, torque)
    return given, lost - torque * rate


@jit
def _shaft(block: Array, at: Pose, k: int, y: Array, _dy: Array, given: float, lost: float) -> tuple[float, float]:
    torque = _shaft_torque(block, at, k, y, 0)
    turn(block, k, torque)
    return given + torque * relative_speed(block, at, k), lost


@jit
def _shaft_torque(block: Array, at: Pose, k: int, _y: Array, _which: int) -> float:
    """Torque of a compliant shaft on its body [N m]."""
    data = Forces(block).data[k]
    twist = data[SHAFT_ANGLE] - relative_angle(block, at, k)
    twist_rate = data[SHAFT_SPEED] - relative_speed(block, at, k)
    torque: float = data[SHAFT_STIFFNESS] * twist + data[SHAFT_DAMPING] * twist_rate
    return torque


@jit
def _between(block: Array, at: Pose, k: int, _y: Array, _dy: Array, given: float, lost: float) -> tuple[float, float]:
    """Stores the energy of its linear part, or of its table; the work of its preload, or of its law, is given."""
    keep_small()
    against, comes_in, goes = _against(block, at, k)
    turn(block, k, -against)
    return given + comes_in, lost + goes


@jit
def _against(block: Array, at: Pose, k: int) -> tuple[float, float, float]:
    """Torque against the relative angle [N m], and the powers that come in and are lost [W]."""
    angle = relative_angle(block, at, k)
    speed = relative_speed(block, at, k)
    if Forces(block).kind[k] == _NONLINEAR:
        return by_law(block, k, angle, speed)
    data = Forces(block).data[k]
    stretch = angle - data[RELAXED]
    return spring_force(block, k, data[STIFFNESS], data[SPRING_DAMPING], data[CONSTANT], data[SIDE], stretch, speed)


@jit
def _torsion_energy(block: Array, at: Pose, k: int, _y: Array) -> float:
    data = Forces(block).data[k]
    stretch = acting(data[SIDE], relative_angle(block, at, k) - data[RELAXED])
    energy: float = 0.5 * data[STIFFNESS] * stretch * stretch
    return energy


@jit
def _torsion_power(block: Array, at: Pose, k: int, _y: Array, _dy: Array) -> float:
    data = Forces(block).data[k]
    stretch = acting(data[SIDE], relative_angle(block, at, k) - data[RELAXED])
    power: float = data[STIFFNESS] * stretch * relative_speed(block, at, k)
    return power


@jit
def _table_energy(block: Array, at: Pose, k: int, _y: Array) -> float:
    energy: float = law_energy(block, k, relative_angle(block, at, k))[0]
    return energy


@jit
def _table_power(block: Array, at: Pose, k: int, _y: Array, _dy: Array) -> float:
    power: float = law_energy(block, k, relative_angle(block, at, k))[1] * relative_speed(block, at, k)
    return power


@jit
def _read_between(block: Array, at: Pose, k: int, _y: Array, which: int) -> float:
    keep_small()
    if which == ANGLE:
        return relative_angle(block, at, k)
    speed = relative_speed(block, at, k)
    if which == SPEED:
        return speed
    torque: float = -_against(block, at, k)[0]
    return torque if which == TORQUE_READ else torque * speed


@jit
def _read_between_rate(block: Array, at: Pose, k: int, _dy: Array, which: int) -> float:
    return relative_speed(block, at, k) if which == ANGLE else math.nan


ELEMENTS = {
    "torque": Element(_torque),
    "torsion_spring": Element(_spring, _spring_energy, _spring_power),
    "damper": Element(_damper),
    "shaft": Element(_shaft, read=_shaft_torque),
    "torsion_spring_damper": Element(_between, _torsion_energy, _torsion_power, _read_between, _read_between_rate),
    "nonlinear_torsion_spring": Element(_between, _table_energy, _table_power, _read_between, _read_between_rate),
}
