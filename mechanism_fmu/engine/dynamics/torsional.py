"""Force elements between the angles of two bodies: torque, torsion spring, damper and compliant shaft."""

from __future__ import annotations

from ...tables.declare import Array
from ...tables.kinds import FORCES
from ...tables.motion import Pose
from ...tables.parts import Forces
from ..compiler.subset import jit
from .element import Element, relative_angle, relative_speed, turn

(TORQUE,) = FORCES.places("torque")
SPRING_STIFFNESS, FREE_ANGLE, PRELOAD = FORCES.places("torsion_spring")
(DAMPING,) = FORCES.places("damper")
SHAFT_STIFFNESS, SHAFT_DAMPING, SHAFT_ANGLE, SHAFT_SPEED = FORCES.places("shaft")


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


ELEMENTS = {
    "torque": Element(_torque),
    "torsion_spring": Element(_spring, _spring_energy, _spring_power),
    "damper": Element(_damper),
    "shaft": Element(_shaft, read=_shaft_torque),
}
