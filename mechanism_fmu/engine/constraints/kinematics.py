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
def place_bodies(block: Array, y: Array) -> Pose:
    """Poses and rates of y = (q, qd, work, loss, alpha, ...).

    q and qd are (x, y, phi) of each body in turn, shape (3 bodies,); alpha are the contact coordinates.
    """
    keep_small()
    bodies = Sizes(block).bodies
    at = Pose(block)
    for i in range(bodies):
        k = 3 * i
        at.x[i] = y[k]
        at.y[i] = y[k + 1]
        at.phi[i] = y[k + 2]
        at.sine[i], at.cosine[i] = sine_cosine(y[k + 2])
        k += 3 * bodies
        at.x_rate[i] = y[k]
        at.y_rate[i] = y[k + 1]
        at.phi_rate[i] = y[k + 2]
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
