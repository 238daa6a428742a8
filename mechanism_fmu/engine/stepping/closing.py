"""Rows are closed behind a step, by the factors of its last evaluation."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Rows, Stages
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_apart
from ..constraints.kinematics import place_bodies
from ..constraints.rows import row_count
from ..dynamics.acceleration import LEAST_INDEPENDENCE, MOST_DRIFT, MOST_RATE_DRIFT, close_again, derivative
from ..interpolation import QUINTIC, has_gains, write_motion
from ..profiles.nearest import settle_contact_points
from ..scales import rate_scale
from ..vectors import copy, largest
from .singular import independence

#: Rows that have drifted by less than so many times `MOST_DRIFT` are closed by one correction, and no further look.
_NEAR = 1e3


@jit
def closes_step(block: Array) -> bool:
    """Close the rows at y_end by the factors of the step's last evaluation, which was there; whether that could be.

    Not where Baumgarte's gains bring them back, where they have drifted far, or depend on each other.
    """
    keep_apart()
    now = Course(block)
    drift = Stages(block).drift
    near = drift[0] < _NEAR * MOST_DRIFT and drift[1] < _NEAR * MOST_RATE_DRIFT * rate_scale(block)
    if not near or has_gains(block) or now.counters[codes.IMPLICIT] == 1:
        return False
    count = row_count(block)
    stands = largest(Rows(block).residual, count) == drift[2]
    if not (stands and largest(Rows(block).residual_rate, count) == drift[3]):
        derivative(block, now.y_end, now.dy_end)  # something else has been evaluated since
    if not independence(block) > LEAST_INDEPENDENCE:
        return False
    closes = drift[0] > 0.0 or drift[1] > 0.0
    if closes:
        n = Sizes(block).coordinates
        close_again(block, now.y_end, count)
        copy(now.y_end[n : 2 * n], now.dy_end[:n])
    if Sizes(block).alphas > 0:
        settle_contact_points(block, place_bodies(block, now.y_end), now.y_end)
    if QUINTIC and closes:
        write_motion(block, now.clock[codes.STEP_SIZE], now.y_end, now.dense)
    return True
