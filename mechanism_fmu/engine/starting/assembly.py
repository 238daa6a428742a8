"""Assembly: the position nearest to the start guess at which no row is off, by Newton's method."""

from __future__ import annotations

import math

from .. import status
from ..block.layout import Array
from ..block.motion import course, linear_system, loads, rows, stages
from ..block.parts import bodies, sizes
from ..block.vectors import copy
from ..compiler.subset import jit, keep_small
from ..constraints.kinematics import place_bodies
from ..constraints.rows import active_rows
from ..dynamics.minimum_norm import minimum_norm
from ..profiles.nearest import find_contact_points, settle_contact_points

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
    n = sizes(block).coordinates
    now = course(block)
    s = stages(block)
    for i in range(bodies(block).start.shape[0]):
        for k in range(3):
            now.y_end[3 * i + k] = bodies(block).start[i, k]
    place_bodies(block, now.y_end)
    find_contact_points(block, now.y_end)
    count = active_rows(block)
    worst = largest(rows(block).residual, count)
    for _ in range(_NEWTON_STEPS):
        if worst == 0.0:
            return status.OK
        newton_direction(block, count, rows(block).residual)
        step = 1.0
        improved = False
        for _ in range(_HALVINGS):
            copy(now.y_end, s.y_new)
            for k in range(n):
                s.y_new[k] += step * loads(block).weight[k] * linear_system(block).solution[k]
            place_bodies(block, s.y_new)
            settle_contact_points(block, s.y_new)
            active_rows(block)
            after = largest(rows(block).residual, count)
            if after < worst:
                improved = True
                break
            step *= 0.5
        if not improved:
            break
        copy(s.y_new, now.y_end)
        worst = after
    place_bodies(block, now.y_end)
    active_rows(block)
    if worst <= CLOSED_WITHIN:
        return status.OK
    return status.NOT_ASSEMBLED


@jit
def newton_direction(block: Array, count: int, left: Array) -> None:
    """Minimum-norm solution of Phi_q dq = -left over the coordinates that are not held; left is Phi, or Phi'."""
    keep_small()
    n = sizes(block).coordinates
    row = rows(block)
    weight = loads(block).weight
    system = linear_system(block)
    for r in range(count):
        system.right_side[r] = -left[r]
        for k in range(n):
            system.scaled[r, k] = row.jacobian[r, k] * weight[k]
    minimum_norm(block, count, n)


@jit
def largest(values: Array, count: int) -> float:
    """Largest magnitude of the first `count` values; infinite when one is not a number."""
    most = 0.0
    for k in range(count):
        if not abs(values[k]) <= most:
            most = abs(values[k])
        if not most < math.inf:
            return math.inf
    return most
