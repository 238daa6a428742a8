"""Force elements at points of bodies: a force at the centre of mass, and a spring-damper between two points."""

from __future__ import annotations

import math
from typing import NamedTuple

from ...tables.declare import Array
from ...tables.kinds import FORCES
from ...tables.motion import Loads, Pose
from ...tables.parts import Forces
from ..compiler.subset import jit, keep_small
from ..vectors import turned
from .element import Element

X, Y = FORCES.places("force")
_FORCE = FORCES.number("force")
POINT_X, POINT_Y, REACTION_X, REACTION_Y, STIFFNESS, DAMPING, FREE_LENGTH, PRELOAD = FORCES.places("spring_damper")
#: What is read of a spring-damper.
LENGTH, RATE, FORCE = range(3)


class Line(NamedTuple):
    """Between the points of a spring-damper, in the global frame.

    a and b from the centres of mass to the points [m]; the unit vector from the point of the body to that of the
    reaction; the length [m] and its rate [m/s]. Where the points meet, the vector is that of their relative velocity,
    and zero where they rest there.
    """

    ax: float
    ay: float
    bx: float
    by: float
    ux: float
    uy: float
    length: float
    speed: float


@jit
def _force(block: Array, at: Pose, k: int, _y: Array, _dy: Array, given: float, lost: float) -> tuple[float, float]:
    body = Forces(block).body[k]
    data = Forces(block).data[k]
    force = Loads(block).force
    force[3 * body] += data[X]
    given += data[X] * at.x_rate[body]
    force[3 * body + 1] += data[Y]
    given += data[Y] * at.y_rate[body]
    return given, lost


@jit
def weight(block: Array, body: int) -> tuple[float, float]:
    """Sum of the forces on a body's centre of mass [N]."""
    keep_small()
    table = Forces(block)
    x = 0.0
    y = 0.0
    for k in range(table.kind.shape[0]):
        if table.kind[k] == _FORCE and table.body[k] == body:
            x += table.data[k, X]
            y += table.data[k, Y]
    return x, y


@jit
def _spring_damper(
    block: Array, at: Pose, k: int, _y: Array, _dy: Array, given: float, lost: float
) -> tuple[float, float]:
    """Stores the energy of its linear part; the work of its preload is given."""
    keep_small()
    table = Forces(block)
    data = table.data[k]
    i = table.body[k]
    j = table.reaction[k]
    line = _line(block, at, k)
    pull = _pull(data, line)
    fx = pull * line.ux
    fy = pull * line.uy
    force = Loads(block).force
    force[3 * i] += fx
    force[3 * i + 1] += fy
    force[3 * i + 2] += line.ax * fy - line.ay * fx
    force[3 * j] -= fx
    force[3 * j + 1] -= fy
    force[3 * j + 2] -= line.bx * fy - line.by * fx
    return given - data[PRELOAD] * line.speed, lost + data[DAMPING] * line.speed * line.speed


@jit
def _line(block: Array, at: Pose, k: int) -> Line:
    """The line between the points of a spring-damper."""
    keep_small()
    table = Forces(block)
    data = table.data[k]
    i = table.body[k]
    j = table.reaction[k]
    ax, ay = turned(at, i, data[POINT_X], data[POINT_Y])
    bx, by = turned(at, j, data[REACTION_X], data[REACTION_Y])
    x = at.x[j] + bx - at.x[i] - ax
    y = at.y[j] + by - at.y[i] - ay
    x_rate = at.x_rate[j] - by * at.phi_rate[j] - at.x_rate[i] + ay * at.phi_rate[i]
    y_rate = at.y_rate[j] + bx * at.phi_rate[j] - at.y_rate[i] - ax * at.phi_rate[i]
    length = math.sqrt(x * x + y * y)
    if length > 0.0:
        ux = x / length
        uy = y / length
        return Line(ax, ay, bx, by, ux, uy, length, ux * x_rate + uy * y_rate)
    speed = math.sqrt(x_rate * x_rate + y_rate * y_rate)
    ux = 0.0
    uy = 0.0
    if speed > 0.0:
        ux = x_rate / speed
        uy = y_rate / speed
    return Line(ax, ay, bx, by, ux, uy, length, speed)


@jit
def _pull(data: Array, line: Line) -> float:
    """Force that pulls the points together [N]; none where they rest in one place, as it has no direction there."""
    if line.ux == 0.0 and line.uy == 0.0:
        return 0.0
    pull: float = data[STIFFNESS] * (line.length - data[FREE_LENGTH]) + data[DAMPING] * line.speed + data[PRELOAD]
    return pull


@jit
def _spring_damper_energy(block: Array, at: Pose, k: int, _y: Array) -> float:
    data = Forces(block).data[k]
    stretch = _line(block, at, k).length - data[FREE_LENGTH]
    energy: float = 0.5 * data[STIFFNESS] * stretch * stretch
    return energy


@jit
def _spring_damper_power(block: Array, at: Pose, k: int, _y: Array, _dy: Array) -> float:
    data = Forces(block).data[k]
    line = _line(block, at, k)
    power: float = data[STIFFNESS] * (line.length - data[FREE_LENGTH]) * line.speed
    return power


@jit
def _read_spring_damper(block: Array, at: Pose, k: int, _y: Array, which: int) -> float:
    keep_small()
    data = Forces(block).data[k]
    line = _line(block, at, k)
    if which == LENGTH:
        return line.length
    if which == RATE:
        return line.speed
    return _pull(data, line)


@jit
def _read_spring_damper_rate(block: Array, at: Pose, k: int, _dy: Array, which: int) -> float:
    if which == LENGTH:
        return _line(block, at, k).speed
    return math.nan


ELEMENTS = {
    "force": Element(_force),
    "spring_damper": Element(
        _spring_damper,
        _spring_damper_energy,
        _spring_damper_power,
        _read_spring_damper,
        _read_spring_damper_rate,
    ),
}
