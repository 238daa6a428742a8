"""A bushing: springs and dampers along both directions of the frame of its reaction, and for the relative angle."""

from __future__ import annotations

import math
from typing import NamedTuple

from ...tables.declare import Array
from ...tables.kinds import FORCES
from ...tables.motion import Pose
from ...tables.parts import Forces
from ..compiler.subset import jit, keep_small
from ..vectors import turned
from .element import Element, push, relative_angle, relative_speed, turn

POINT_X, POINT_Y, REACTION_X, REACTION_Y = FORCES.places("bushing")[:4]
STIFFNESS_X, STIFFNESS_Y, DAMPING_X, DAMPING_Y, TORSION, TORSION_DAMPING, FREE_ANGLE = FORCES.places("bushing")[4:]
#: What is read of it; else its power.
X, Y, ANGLE, FORCE_X, FORCE_Y, TORQUE = range(6)


class Give(NamedTuple):
    """How a bushing gives way: x, y [m] and angle [rad] in the frame of its reaction, and their rates.

    And where the point of the body is, from the centres of mass of body (ax, ay) and reaction (bx, by), in global
    directions [m].
    """

    x: float
    y: float
    angle: float
    x_rate: float
    y_rate: float
    angle_rate: float
    ax: float
    ay: float
    bx: float
    by: float


@jit
def _give(block: Array, at: Pose, k: int) -> Give:
    keep_small()
    table = Forces(block)
    data, i, j = table.data[k], table.body[k], table.reaction[k]
    ax, ay = turned(at, i, data[POINT_X], data[POINT_Y])
    bx = at.x[i] + ax - at.x[j]
    by = at.y[i] + ay - at.y[j]
    c = at.cosine[j]
    s = at.sine[j]
    turning = at.phi_rate[j]
    # velocity of the body's point from that of the reaction's matter at the same place
    u = at.x_rate[i] - ay * at.phi_rate[i] - at.x_rate[j] + by * turning
    v = at.y_rate[i] + ax * at.phi_rate[i] - at.y_rate[j] - bx * turning
    return Give(
        c * bx + s * by - data[REACTION_X],
        c * by - s * bx - data[REACTION_Y],
        relative_angle(block, at, k) - data[FREE_ANGLE],
        c * u + s * v,
        c * v - s * u,
        relative_speed(block, at, k),
        ax,
        ay,
        bx,
        by,
    )


@jit
def _bushing(block: Array, at: Pose, k: int, _y: Array, _dy: Array, given: float, lost: float) -> tuple[float, float]:
    keep_small()
    table = Forces(block)
    data, i, j = table.data[k], table.body[k], table.reaction[k]
    give = _give(block, at, k)
    x = -data[STIFFNESS_X] * give.x - data[DAMPING_X] * give.x_rate
    y = -data[STIFFNESS_Y] * give.y - data[DAMPING_Y] * give.y_rate
    fx, fy = turned(at, j, x, y)
    push(block, i, give.ax, give.ay, fx, fy)
    push(block, j, give.bx, give.by, -fx, -fy)
    turn(block, k, -data[TORSION] * give.angle - data[TORSION_DAMPING] * give.angle_rate)
    lost += data[DAMPING_X] * give.x_rate * give.x_rate + data[DAMPING_Y] * give.y_rate * give.y_rate
    return given, lost + data[TORSION_DAMPING] * give.angle_rate * give.angle_rate


@jit
def _bushing_energy(block: Array, at: Pose, k: int, _y: Array) -> float:
    data = Forces(block).data[k]
    give = _give(block, at, k)
    energy: float = data[STIFFNESS_X] * give.x * give.x + data[STIFFNESS_Y] * give.y * give.y
    energy += data[TORSION] * give.angle * give.angle
    return 0.5 * energy


@jit
def _bushing_power(block: Array, at: Pose, k: int, _y: Array, _dy: Array) -> float:
    data = Forces(block).data[k]
    give = _give(block, at, k)
    power: float = data[STIFFNESS_X] * give.x * give.x_rate + data[STIFFNESS_Y] * give.y * give.y_rate
    power += data[TORSION] * give.angle * give.angle_rate
    return power


@jit
def _read_bushing(block: Array, at: Pose, k: int, _y: Array, which: int) -> float:
    keep_small()
    data = Forces(block).data[k]
    give = _give(block, at, k)
    force_x = -data[STIFFNESS_X] * give.x - data[DAMPING_X] * give.x_rate
    force_y = -data[STIFFNESS_Y] * give.y - data[DAMPING_Y] * give.y_rate
    torque = -data[TORSION] * give.angle - data[TORSION_DAMPING] * give.angle_rate
    value: float = force_x * give.x_rate + force_y * give.y_rate + torque * give.angle_rate
    if which == X:
        value = give.x
    elif which == Y:
        value = give.y
    elif which == ANGLE:
        value = give.angle
    elif which == FORCE_X:
        value = force_x
    elif which == FORCE_Y:
        value = force_y
    elif which == TORQUE:
        value = torque
    return value


@jit
def _read_bushing_rate(block: Array, at: Pose, k: int, _dy: Array, which: int) -> float:
    give = _give(block, at, k)
    value: float = math.nan
    if which == X:
        value = give.x_rate
    elif which == Y:
        value = give.y_rate
    elif which == ANGLE:
        value = give.angle_rate
    return value


ELEMENTS = {"bushing": Element(_bushing, _bushing_energy, _bushing_power, _read_bushing, _read_bushing_rate)}
