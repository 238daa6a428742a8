"""Force elements at points of bodies: forces, and springs between two points."""

from __future__ import annotations

import math
from typing import NamedTuple

from ...tables.declare import Array
from ...tables.kinds import FORCES
from ...tables.motion import Loads, Pose
from ...tables.parts import Forces
from ..compiler.subset import jit, keep_small
from ..vectors import turned
from .element import Element, acting, push, spring_force
from .laws import by_law, law_energy

X, Y = FORCES.places("force")
_FORCE = FORCES.number("force")
POINT_X, POINT_Y, REACTION_X, REACTION_Y, STIFFNESS, DAMPING, FREE_LENGTH, PRELOAD, SIDE = FORCES.places(
    "spring_damper"
)
FORCE_X, FORCE_Y, TURNS = FORCES.places("point_force")[2:]
_NONLINEAR = FORCES.number("nonlinear_spring")
#: What is read of an element along the line between two points; else its power.
LENGTH, RATE, FORCE = range(3)


class Line(NamedTuple):
    """Between the points of a spring, in the global frame.

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
    size = Loads(block).size
    size[3 * body] += abs(data[X])
    size[3 * body + 1] += abs(data[Y])
    return given, lost


@jit
def weight(block: Array, body: int) -> tuple[float, float]:
    """Sum of the forces on a body's centre of mass [N]."""
    keep_small()
    table = Forces(block)
    x = y = 0.0
    for k in range(table.kind.shape[0]):
        if table.kind[k] == _FORCE and table.body[k] == body:
            x += table.data[k, X]
            y += table.data[k, Y]
    return x, y


@jit
def _point_force(
    block: Array, at: Pose, k: int, _y: Array, _dy: Array, given: float, lost: float
) -> tuple[float, float]:
    keep_small()
    i = Forces(block).body[k]
    fx, fy, px, py = _applied(block, at, k)
    push(block, i, px, py, fx, fy)
    return given + _power_at(at, i, px, py, fx, fy), lost


@jit
def _applied(block: Array, at: Pose, k: int) -> tuple[float, float, float, float]:
    """Force of a point force, and where it acts from the centre of mass, in global directions."""
    data = Forces(block).data[k]
    i = Forces(block).body[k]
    px, py = turned(at, i, data[POINT_X], data[POINT_Y])
    fx, fy = data[FORCE_X], data[FORCE_Y]
    if data[TURNS] > 0.0:
        fx, fy = turned(at, i, fx, fy)
    return fx, fy, px, py


@jit
def _power_at(at: Pose, body: int, px: float, py: float, fx: float, fy: float) -> float:
    """Power of a force on a body at (px, py) from its centre of mass [W]."""
    rate = at.phi_rate[body]
    power: float = fx * (at.x_rate[body] - py * rate) + fy * (at.y_rate[body] + px * rate)
    return power


@jit
def _read_point_force(block: Array, at: Pose, k: int, _y: Array, _which: int) -> float:
    fx, fy, px, py = _applied(block, at, k)
    power: float = _power_at(at, Forces(block).body[k], px, py, fx, fy)
    return power


@jit
def _between(block: Array, at: Pose, k: int, _y: Array, _dy: Array, given: float, lost: float) -> tuple[float, float]:
    """Stores the energy of its linear part, or of its table; the work of its preload, or of its law, is given."""
    keep_small()
    table = Forces(block)
    i, j = table.body[k], table.reaction[k]
    line = line_between(block, at, k)
    pull, comes_in, goes = _pull(block, k, line)
    fx = pull * line.ux
    fy = pull * line.uy
    push(block, i, line.ax, line.ay, fx, fy)
    push(block, j, line.bx, line.by, -fx, -fy)
    return given + comes_in, lost + goes


@jit
def line_between(block: Array, at: Pose, k: int) -> Line:
    """The line between the points of a spring."""
    keep_small()
    table = Forces(block)
    data, i, j = table.data[k], table.body[k], table.reaction[k]
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
def _pull(block: Array, k: int, line: Line) -> tuple[float, float, float]:
    """Force that pulls the points together [N], and the powers that come in and are lost [W].

    Where the points rest in one place there is none, as it has no direction there.
    """
    keep_small()
    if line.ux == 0.0 and line.uy == 0.0:
        return 0.0, 0.0, 0.0
    if Forces(block).kind[k] == _NONLINEAR:
        return by_law(block, k, line.length, line.speed)
    data = Forces(block).data[k]
    stretch = line.length - data[FREE_LENGTH]
    return spring_force(block, k, data[STIFFNESS], data[DAMPING], data[PRELOAD], data[SIDE], stretch, line.speed)


@jit
def _spring_damper_energy(block: Array, at: Pose, k: int, _y: Array) -> float:
    data = Forces(block).data[k]
    stretch = acting(data[SIDE], line_between(block, at, k).length - data[FREE_LENGTH])
    energy: float = 0.5 * data[STIFFNESS] * stretch * stretch
    return energy


@jit
def _spring_damper_power(block: Array, at: Pose, k: int, _y: Array, _dy: Array) -> float:
    data = Forces(block).data[k]
    line = line_between(block, at, k)
    power: float = data[STIFFNESS] * acting(data[SIDE], line.length - data[FREE_LENGTH]) * line.speed
    return power


@jit
def _table_energy(block: Array, at: Pose, k: int, _y: Array) -> float:
    energy: float = law_energy(block, k, line_between(block, at, k).length)[0]
    return energy


@jit
def _table_power(block: Array, at: Pose, k: int, _y: Array, _dy: Array) -> float:
    line = line_between(block, at, k)
    power: float = law_energy(block, k, line.length)[1] * line.speed
    return power


@jit
def _read_between(block: Array, at: Pose, k: int, _y: Array, which: int) -> float:
    keep_small()
    line = line_between(block, at, k)
    if which == LENGTH:
        return line.length
    if which == RATE:
        return line.speed
    pull: float = _pull(block, k, line)[0]
    return pull if which == FORCE else -pull * line.speed


@jit
def _read_between_rate(block: Array, at: Pose, k: int, _dy: Array, which: int) -> float:
    return line_between(block, at, k).speed if which == LENGTH else math.nan


ELEMENTS = {
    "force": Element(_force),
    "point_force": Element(_point_force, read=_read_point_force),
    "spring_damper": Element(_between, _spring_damper_energy, _spring_damper_power, _read_between, _read_between_rate),
    "nonlinear_spring": Element(_between, _table_energy, _table_power, _read_between, _read_between_rate),
}
