"""Force elements at points of bodies: a force at the centre of mass."""

from __future__ import annotations

from ...tables.declare import Array
from ...tables.kinds import FORCES
from ...tables.motion import Loads, Pose
from ...tables.parts import Forces
from ..compiler.subset import jit, keep_small
from .element import Element

X, Y = FORCES.places("force")
_FORCE = FORCES.number("force")


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


ELEMENTS = {"force": Element(_force)}
