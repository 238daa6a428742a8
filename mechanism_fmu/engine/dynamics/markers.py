"""Markers: place and velocity of a point of a body."""

from __future__ import annotations

from ...tables.declare import Array
from ...tables.kinds import FORCES
from ...tables.motion import Pose
from ...tables.parts import Forces
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..vectors import turned
from .element import Element

_X, _Y = FORCES.places("marker")
#: What is read: x and y, and their rates.
_PLACE_X, _PLACE_Y, _RATE_X = range(3)


@jit
def _read(block: Array, at: Pose, k: int, _y: Array, which: int) -> float:
    keep_small()
    i = Forces(block).body[k]
    px, py = turned(at, i, Forces(block).data[k, _X], Forces(block).data[k, _Y])
    value: float = at.y_rate[i] + px * at.phi_rate[i]
    if which == _PLACE_X:
        value = at.x[i] + px
    elif which == _PLACE_Y:
        value = at.y[i] + py
    elif which == _RATE_X:
        value = at.x_rate[i] - py * at.phi_rate[i]
    return value


@jit
def _read_rate(block: Array, at: Pose, k: int, dy: Array, which: int) -> float:
    keep_small()
    if which < _RATE_X:
        return _read(block, at, k, dy, which + _RATE_X)
    i = Forces(block).body[k]
    px, py = turned(at, i, Forces(block).data[k, _X], Forces(block).data[k, _Y])
    first = Sizes(block).coordinates + 3 * i
    turning = at.phi_rate[i] * at.phi_rate[i]
    rate: float = dy[first + 1] + px * dy[first + 2] - py * turning
    if which == _RATE_X:
        rate = dy[first] - py * dy[first + 2] - px * turning
    return rate


ELEMENTS = {"marker": Element(read=_read, read_rate=_read_rate)}
