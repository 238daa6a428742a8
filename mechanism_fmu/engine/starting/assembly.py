"""Assembly: the position nearest to the start guess at which no row is off, by Newton's method."""

from __future__ import annotations

import math

from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Loads, Rows, Stages
from ...tables.parts import Bodies
from ...tables.sizes import Sizes
from .. import status
from ..compiler.subset import jit, keep_small
from ..constraints.kinematics import place_bodies
from ..constraints.rows import active_rows
from ..dynamics.minimum_norm import minimum_norm
from ..profiles.nearest import find_contact_points, settle_contact_points
from ..vectors import copy

#: Position rows are closed when none is off by more than this [m, rad, m^2].
CLOSED_WITHIN = 1e-12
_NEWTON_STEPS = 50
_HALVINGS = 30


@jit
def assemble(block: Array) -> int:
    """Close the position rows from the bodies' start guess by Newton's method with minimum-norm steps.

    Held coordinates do not move. The result, or the closest position found, stands in y_end; `rows.residual` holds
    what is left of Phi, for the joints and the contacts that are closed at the start.
    """
    n = Sizes(block).coordinates
    now = Course(block)
    s = Stages(block)
    for i in range(Bodies(block).start.shape[0]):
        for k in range(3):
            now.y_end[3 * i + k] = Bodies(block).start[i, k]
    at = place_bodies(block, now.y_end)
    find_contact_points(block, at, now.y_end)
    count = active_rows(block, at)
    worst = worst_of(Rows(block).residual, count)
    for _ in range(_NEWTON_STEPS):
        if worst == 0.0:
            return status.OK
        newton_direction(block, count, Rows(block).residual)
        step = 1.0
        improved = False
        for _ in range(_HALVINGS):
            copy(now.y_end, s.y_new)
            for k in range(n):
                s.y_new[k] += step * Loads(block).weight[k] * LinearSystem(block).solution[k]
            at = place_bodies(block, s.y_new)
            settle_contact_points(block, at, s.y_new)
            active_rows(block, at)
            after = worst_of(Rows(block).residual, count)
            if after < worst:
                improved = True
                break
            step *= 0.5
        if not improved:
            break
        copy(s.y_new, now.y_end)
        worst = after
    at = place_bodies(block, now.y_end)
    active_rows(block, at)
    if worst <= CLOSED_WITHIN:
        return status.OK
    return status.NOT_ASSEMBLED


@jit
def newton_direction(block: Array, count: int, left: Array) -> None:
    """Minimum-norm solution of Phi_q dq = -left over the coordinates that are not held; left is Phi, or Phi'."""
    keep_small()
    n = Sizes(block).coordinates
    row = Rows(block)
    weight = Loads(block).weight
    system = LinearSystem(block)
    for r in range(count):
        system.right_side[r] = -left[r]
        for k in range(n):
            system.scaled[r, k] = row.jacobian[r, k] * weight[k]
    minimum_norm(block, count, n)


@jit
def worst_of(values: Array, count: int) -> float:
    """Largest magnitude of the first `count` values; infinite when one is not a number."""
    most = 0.0
    for k in range(count):
        if not abs(values[k]) <= most:
            most = abs(values[k])
        if not most < math.inf:
            return math.inf
    return most
