"""Poses and rates of all bodies at one instant."""

from __future__ import annotations

from ...tables.declare import Array
from ...tables.motion import Pose
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..elementary import sine_cosine


@jit
def set_instant(block: Array, time: float) -> None:
    """Make `time` [s] the instant that drivers see."""
    Pose(block).instant[0] = time


@jit
def _place(at: Pose, y: Array, body: int, bodies: int) -> None:
    k = 3 * body
    at.x[body] = y[k]
    at.y[body] = y[k + 1]
    at.phi[body] = y[k + 2]
    at.sine[body], at.cosine[body] = sine_cosine(y[k + 2])
    k += 3 * bodies
    at.x_rate[body] = y[k]
    at.y_rate[body] = y[k + 1]
    at.phi_rate[body] = y[k + 2]


@jit
def place_bodies(block: Array, y: Array) -> Pose:
    """Poses and rates of y = (q, qd, work, loss, alpha, ...).

    q and qd are (x, y, phi) of each body in turn, shape (3 bodies,); alpha are the contact coordinates.
    """
    keep_small()
    bodies = Sizes(block).bodies
    at = Pose(block)
    for i in range(bodies):
        _place(at, y, i, bodies)
    at.x[bodies] = 0.0
    at.y[bodies] = 0.0
    at.phi[bodies] = 0.0
    at.cosine[bodies] = 1.0
    at.sine[bodies] = 0.0
    at.x_rate[bodies] = 0.0
    at.y_rate[bodies] = 0.0
    at.phi_rate[bodies] = 0.0
    first = Sizes(block).y_alpha
    for k in range(Sizes(block).alphas):
        at.alpha[k] = y[first + k]
    return at


@jit
def place_pair(block: Array, y: Array, i: int, j: int) -> Pose:
    """As `place_bodies`, of two bodies alone; all others, and the contact coordinates, stay as they were placed last.

    For whom looks at one pair again and again, so that the cost of a look does not grow with the mechanism.
    """
    keep_small()
    bodies = Sizes(block).bodies
    at = Pose(block)
    if i < bodies:
        _place(at, y, i, bodies)
    if j < bodies:
        _place(at, y, j, bodies)
    return at
