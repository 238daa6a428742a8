"""Acceleration by Gauss / Udwadia-Kalaba (Pennestrì et al., eqs (2) and (3)), and the multipliers of the same solve."""

from __future__ import annotations

import math

from ...tables.declare import Array
from ...tables.motion import LinearSystem, Loads, Pose, Rows
from ...tables.parts import Bodies
from ...tables.sizes import Sizes
from ...tolerances import PUSHES_WITHIN
from ..compiler.subset import jit, keep_small
from ..constraints.kinematics import place_bodies
from ..constraints.rows import active_rows, driver_power, follow_open_contacts, stabilise
from .forces import apply_forces
from .friction import has_friction, resist
from .minimum_norm import minimum_norm

#: Friction and normal forces agree when no multiplier changes by more than this part of the largest one, or, where all
#: vanish as a contact opens, by what is no push and is left by rounding: it does not shrink from round to round.
_AGREE = 1e-13
_ROUNDS = 200


@jit
def derivative(block: Array, y: Array, dy: Array) -> Pose:
    """Derivative of y = (q, qd, work, loss, alpha, own): dy = (qd, qdd, powers, alpha', own'); shape (unknowns,).

    qdd = qdd_f + M^-1/2 D^+ (gamma - Phi_q qdd_f), eq (3). `linear_system.multiplier` afterwards holds the force along
    each active row (M qdd = F + Phi_q^T multiplier; for a contact, positive when it pushes).
    """
    n = Sizes(block).coordinates
    at = place_bodies(block, y)
    count = active_rows(block, at)
    stabilise(block, count)
    given, lost = apply_forces(block, at, y, dy)
    accelerate(block, count)
    if has_friction(block):
        lost += _with_friction(block, at, count)
    free = Loads(block).free_acceleration
    root = Bodies(block).inverse_root_mass
    correction = LinearSystem(block).solution
    for k in range(n):
        dy[k] = y[n + k]
        dy[n + k] = free[k] + root[k] * correction[k]
    dy[Sizes(block).y_work] = given + driver_power(block)
    dy[Sizes(block).y_loss] = lost
    alphas = Sizes(block).alphas
    if alphas > 0:
        follow_open_contacts(block, at)
    first = Sizes(block).y_alpha
    for k in range(alphas):
        dy[first + k] = at.alpha_rate[k]
    return at


@jit
def accelerate(block: Array, count: int) -> None:
    """Solve D z = gamma - Phi_q qdd_f with D = Phi_q M^-1/2 and qdd_f = M^-1 F, eq (2)."""
    n = Sizes(block).coordinates
    mass = Bodies(block)
    load = Loads(block)
    for k in range(n):
        load.free_acceleration[k] = mass.inverse_mass[k] * load.force[k]
    scale_rows(block, count)
    row = Rows(block)
    system = LinearSystem(block)
    for r in range(count):
        right = row.gamma[r]
        for k in range(n):
            right -= row.jacobian[r, k] * load.free_acceleration[k]
        system.right_side[r] = right
    minimum_norm(block, count, n)


@jit
def scale_rows(block: Array, count: int) -> None:
    """D = Phi_q M^-1/2, eq (2)."""
    n = Sizes(block).coordinates
    root = Bodies(block).inverse_root_mass
    row = Rows(block)
    system = LinearSystem(block)
    for r in range(count):
        for k in range(n):
            system.scaled[r, k] = row.jacobian[r, k] * root[k]


@jit
def _with_friction(block: Array, at: Pose, count: int) -> float:
    """Normal forces and friction that agree, by iteration; the power lost, or not a number when they never do."""
    keep_small()
    load = Loads(block)
    multiplier = LinearSystem(block).multiplier
    for k in range(load.force.shape[0]):
        load.applied[k] = load.force[k]
    before = math.inf
    for _ in range(_ROUNDS):
        for r in range(count):
            load.last_multiplier[r] = multiplier[r]
        lost = resist(block, at)
        accelerate(block, count)
        change = 0.0
        largest = 0.0
        for r in range(count):
            change = max(change, abs(multiplier[r] - load.last_multiplier[r]))
            largest = max(largest, abs(multiplier[r]))
        if change <= _AGREE * largest or before <= change <= PUSHES_WITHIN:
            return lost
        before = change
    return math.nan
