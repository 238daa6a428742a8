"""Back to the constraints, when integration has drifted off them."""

from __future__ import annotations

from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Rows
from ...tables.parts import Bodies
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..constraints.kinematics import place_bodies
from ..constraints.rows import active_rows
from ..profiles.nearest import settle_contact_points
from ..vectors import largest
from .acceleration import scale_rows
from .minimum_norm import minimum_norm

#: Active rows may be off by this: in position [m, rad, m2], and in their rates [m/s, rad/s].
MOST_DRIFT = 1e-11
MOST_RATE_DRIFT = 1e-10
#: At events, where positions and rates are put right anyway.
LEAST_DRIFT = 1e-14


@jit
def mend(block: Array, most: float, most_rate: float) -> bool:
    """Close the active rows at y_end when one is off by more than `most`, or its rate; whether anything was moved.

    Both corrections are the least in the metric of the masses, as that of an impact.
    """
    keep_small()
    n = Sizes(block).coordinates
    y = Course(block).y_end
    moved = False
    at = place_bodies(block, y)
    settle_contact_points(block, at, y)
    count = active_rows(block, at)
    if largest(Rows(block).residual, count) > most:
        _correct(block, count, Rows(block).residual, y)
        at = place_bodies(block, y)
        settle_contact_points(block, at, y)
        active_rows(block, at)
        moved = True
    if moved or largest(Rows(block).residual_rate, count) > most_rate:
        _correct(block, count, Rows(block).residual_rate, y[n:])
        moved = True
    return moved


@jit
def _correct(block: Array, count: int, left: Array, values: Array) -> None:
    """Values += -M^-1/2 D^+ left."""
    keep_small()
    n = Sizes(block).coordinates
    root = Bodies(block).inverse_root_mass
    system = LinearSystem(block)
    scale_rows(block, count)
    for r in range(count):
        system.right_side[r] = -left[r]
    minimum_norm(block, count, n)
    for k in range(n):
        values[k] += root[k] * system.solution[k]
