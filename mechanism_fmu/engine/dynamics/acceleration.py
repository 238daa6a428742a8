"""Acceleration by Gauss / Udwadia-Kalaba (Pennestrì et al., eqs (2) and (3)), and the way back to the constraints."""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Loads, Pose, Rows
from ...tables.parts import Bodies
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.entries import along_row
from ..constraints.friction_rows import rubs
from ..constraints.kinematics import place_bodies
from ..constraints.rows import active_rows, drift_power, driver_power, follow_open_contacts, stabilise
from ..constraints.wear import wear_by_sliding
from ..outlines.advance import come_nearer
from ..profiles.nearest import settle_contact_points
from ..vectors import largest
from .forces import apply_forces
from .linear_solve import KEEP, STANDS, factorise, solve, solve_again, write_matrix
from .sliding import slide


@jit
def derivative(block: Array, y: Array, dy: Array) -> Pose:
    """Derivative of y = (q, qd, work, loss, alpha, own, wear): dy = (qd, qdd, powers, alpha', ...); shape (unknowns,).

    qdd = qdd_f + M^-1/2 D^+ (gamma - Phi_q qdd_f), eq (3). `linear_system.multiplier` afterwards holds the force along
    each active row (M qdd = F + Phi_q^T multiplier; for a contact, positive when it pushes).
    """
    n = Sizes(block).coordinates
    at = place_bodies(block, y)
    count = active_rows(block, at)
    stabilise(block, y, count)
    given, lost = apply_forces(block, at, y, dy)
    accelerate(block, count)
    if rubs(block):
        lost += slide(block, at, count, Sizes(block).rubs)
    free = Loads(block).free_acceleration
    root = Bodies(block).inverse_root_mass
    correction = LinearSystem(block).solution
    for k in range(n):
        dy[k] = y[n + k]
        dy[n + k] = free[k] + root[k] * correction[k]
    dy[Sizes(block).y_work] = given + driver_power(block)
    if Course(block).counters[codes.IMPLICIT] == 1:  # its stages are off the constraints by more than others
        dy[Sizes(block).y_work] += drift_power(block, count)
    dy[Sizes(block).y_loss] = lost
    if Sizes(block).wears > 0:
        wear_by_sliding(block, at, dy)
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
    row = Rows(block)
    system = LinearSystem(block)
    ground = Sizes(block).bodies
    for r in range(count):
        system.right_side[r] = -along_row(row, r, load.free_acceleration, ground, -row.gamma[r])
    if system.kept[0] != STANDS:
        scale_rows(block, count)
        factorise(block, count, n)
        if system.kept[0] == KEEP:
            system.kept[0] = STANDS
    solve_again(block, count, n)


@jit
def scale_rows(block: Array, count: int) -> None:
    """D = Phi_q M^-1/2, eq (2)."""
    write_matrix(block, count, Bodies(block).inverse_root_mass)


# Back to the constraints, when integration has drifted off them.

#: Active rows may be off by this: in position [m, rad, m2], and in their rates [m/s, rad/s].
MOST_DRIFT = 1e-11
MOST_RATE_DRIFT = 1e-10
#: Where rows bend, as that of a pin in a hole with little play, one correction leaves some of a large drift. Rows that
#: contradict each other come no nearer by more.
_CORRECTIONS = 3
#: At events, where positions and rates are put right anyway.
LEAST_DRIFT = 1e-14
#: Rows with less independence than this are not closed: their bodies would move by 1000 times the drift, and more.
LEAST_INDEPENDENCE = 1e-6


@jit
def close_again(block: Array, y: Array, count: int) -> None:
    """Close the `count` active rows at `y`, shape (unknowns,), with the factors of the last evaluation.

    That evaluation was at `y`. What is off by d is off by d^2 afterwards; multipliers are lost.
    """
    keep_small()
    n = Sizes(block).coordinates
    root = Bodies(block).inverse_root_mass
    system = LinearSystem(block)
    for first in (0, n):
        for r in range(count):
            system.right_side[r] = -(Rows(block).residual[r] if first == 0 else Rows(block).residual_rate[r])
        solve_again(block, count, n)
        for k in range(n):
            y[first + k] += root[k] * system.solution[k]


@jit
def mend(block: Array, most: float, most_rate: float) -> bool:
    """Close the active rows at y_end when one is off by more than `most`, or its rate; whether anything was moved."""
    return close_rows(block, Course(block).y_end, most, most_rate, LEAST_INDEPENDENCE)


@jit
def close_rows(block: Array, y: Array, most: float, most_rate: float, independent: float) -> bool:
    """Close the active rows at `y`, shape (unknowns,), as `mend` does, positions where they are `independent`.

    Both corrections are the least in the metric of the masses, as that of an impact.
    """
    keep_small()
    n = Sizes(block).coordinates
    count, moved = close_positions(block, y, most, independent)
    if moved or largest(Rows(block).residual_rate, count) > most_rate:
        correct(block, count, Rows(block).residual_rate, y[n:])
        moved = True
    return moved


@jit
def close_positions(block: Array, y: Array, most: float, independent: float) -> tuple[int, bool]:
    """Close the active rows at `y`, shape (unknowns,), where one is off by more than `most`, and leave their rates.

    The rows are then those at the new positions. Return their number, and whether anything was moved.
    """
    keep_small()
    at = place_bodies(block, y)
    settle_contact_points(block, at, y)
    count = active_rows(block, at)
    if not largest(Rows(block).residual, count) > most:
        return count, False
    LinearSystem(block).least_independence[0] = independent
    for _ in range(_CORRECTIONS):
        come_nearer(block, correct(block, count, Rows(block).residual, y))
        at = place_bodies(block, y)
        settle_contact_points(block, at, y)
        count = active_rows(block, at)
        if not largest(Rows(block).residual, count) > MOST_DRIFT:
            break
    LinearSystem(block).least_independence[0] = 0.0
    return count, True


@jit
def correct(block: Array, count: int, left: Array, values: Array) -> float:
    """Values += -M^-1/2 D^+ left; return the most by which one is changed."""
    keep_small()
    scale_rows(block, count)
    for r in range(count):
        LinearSystem(block).right_side[r] = -left[r]
    return _change(block, count, values)


@jit
def take_off(block: Array, count: int, part: float, values: Array) -> None:
    """Take from coordinates or rates, shape (coordinates,), a part of what leads off the active rows."""
    keep_small()
    row = Rows(block)
    scale_rows(block, count)
    for r in range(count):
        LinearSystem(block).right_side[r] = -part * along_row(row, r, values, Sizes(block).bodies, 0.0)
    _change(block, count, values)


@jit
def _change(block: Array, count: int, values: Array) -> float:
    """Values += M^-1/2 z with the least z of D z = `right_side`; return the most by which one is changed."""
    keep_apart()
    n = Sizes(block).coordinates
    root = Bodies(block).inverse_root_mass
    system = LinearSystem(block)
    solve(block, count, n)
    most = 0.0
    for k in range(n):
        change = root[k] * system.solution[k]
        values[k] += change
        most = max(most, abs(change))
    return most
