"""Linearly implicit steps by Rodas5P (`tables.implicit_method`), for what is stiff.

The unknowns are y = (q, q', work, loss, alpha, own, wear). Of the linear systems W u = r, those of q need no solution,
because q' is the rate of q: u_q = h gamma (r_q + u_q'). Work, loss and wear act on nothing. What is left is a dense
system of the rates, contact coordinates and own states, as large as half the unknowns.

The Jacobian comes from differences of the derivative: so it holds whatever acts, laws of the user's own and friction
included. What such a difference lacks in digits costs order, not stability.
"""

from __future__ import annotations

import math

import numpy as np

from ...tables.declare import Array
from ...tables.implicit_method import RODAS5P
from ...tables.method import METHOD
from ...tables.motion import Implicit, Loads, Rows, Stages
from ...tables.parts import Bodies
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.kinematics import place_bodies
from ..constraints.rows import active_rows
from ..dynamics.acceleration import correct, derivative, take_off
from ..dynamics.forces import set_time
from ..elementary import exp, log
from ..scales import rate_scale, write_scales
from ..vectors import clear, copy
from .stage import evaluate_stage

_STAGES = RODAS5P.stages
_LAST = RODAS5P.last
_GAMMA = RODAS5P.gamma
_C = RODAS5P.c
_A = RODAS5P.a
_COUPLING = RODAS5P.coupling
_TIME = RODAS5P.time
_DENSE = RODAS5P.dense
_ROWS = METHOD.dense_rows
#: Under which number a stage's independence of rows is kept: those of the explicit method are in the order of time.
_KEPT_AS = np.full(RODAS5P.stages, METHOD.last - 1)
_KEPT_AS[list(RODAS5P.inside)] = [METHOD.interior[min(k, len(METHOD.interior) - 1)] for k in range(len(RODAS5P.inside))]
#: By such a part of its scale, and of an absolute one, an unknown is moved for a difference: the root of rounding.
_MOVES = 2.0**-26
_MOVES_AT_LEAST = 1e-3
#: What changes by such a part of what acts, a few last digits, changes by rounding; looked at in places that are so
#: many times their scale away from zero, where the way of a step may be as long.
_ROUNDING = 2.0**-48
_FAR = 16.0
#: And the time, by such a part of the step.
_MOVES_TIME = 1e-3
#: So much counts what of a step's error leads off the constraints: mending takes it away, but not from within the step.
_DRIFT_COUNTS = 0.02
#: Products with the Jacobian, and how many of them, an even number, tell how much it can grow in one.
_PRODUCTS = 6
_MEASURED = 4


@jit
def implicit_stages(block: Array, start: float, h: float) -> None:
    """All stages of a step of size `h` [s] from y_start at `start` [s]; writes y_new and its dense output."""
    keep_small()
    s = Stages(block)
    table = Implicit(block)
    if table.fresh[0] == 0:
        _differentiate(block, start, h)
        table.fresh[0] = 1
    _factorise(block, h)
    u = table.increment
    y = s.y_start
    n = Sizes(block).unknowns
    f = s.derivatives[0]
    for r in range(_STAGES):
        for i in range(n):
            total = y[i]
            for j in range(r):
                if _A[r, j] != 0.0:
                    total += _A[r, j] * u[j, i]
            s.y_stage[i] = total
        if r > 0:
            s.stage[0] = _KEPT_AS[r] - 1
            evaluate_stage(block, start + h * _C[r], s.y_stage, s.derivatives[1])
            f = s.derivatives[1]
        for i in range(n):
            total = f[i] + h * _TIME[r] * table.by_time[i]
            for j in range(r):
                total += _COUPLING[r, j] * u[j, i] / h
            table.right[i] = total
        _solve(block, h, u[r])
    for i in range(n):
        s.y_new[i] = s.y_stage[i] + u[_LAST, i]
    table.turnover[0] = _turnover(block)
    _mend_rates(block, h)
    _write_dense(block)
    _weigh_drift(block)


@jit
def _turnover(block: Array) -> float:
    """The powers of all forces together, without their signs, at the last stage [W]."""
    total = 0.0
    n = Sizes(block).coordinates
    for k in range(n):
        total += abs(Loads(block).force[k] * Stages(block).y_stage[n + k])
    return total


@jit
def _weigh_drift(block: Array) -> None:
    """Of the error that leads off the constraints, which mending takes away, let a part only count."""
    keep_apart()
    s = Stages(block)
    error = Implicit(block).increment[_LAST]
    n = Sizes(block).coordinates
    count = active_rows(block, place_bodies(block, s.y_new))
    take_off(block, count, 1.0 - _DRIFT_COUNTS, error[:n])
    take_off(block, count, 1.0 - _DRIFT_COUNTS, error[n : 2 * n])


@jit
def _mend_rates(block: Array, h: float) -> None:
    """Bring the rates of y_new back to the constraints with the step's own matrix in place of the masses.

    By the masses alone, what is damped hard would be moved as well, and come back within the next step by large forces,
    which lead off the constraints again: from step to step more, where steps are long.
    """
    keep_apart()
    s = Stages(block)
    table = Implicit(block)
    n = Sizes(block).coordinates
    count = active_rows(block, place_bodies(block, s.y_new))
    clear(table.right)
    correct(block, count, Rows(block).residual_rate, table.right[n : 2 * n])
    for k in range(n, 2 * n):
        table.right[k] /= h * _GAMMA
    _solve(block, h, s.y_at)
    for k in range(n, 2 * n):
        s.y_new[k] += s.y_at[k]


@jit
def error_of_implicit(block: Array, i: int) -> float:
    """Local error of unknown `i` in the implicit step last tried."""
    error: float = Implicit(block).increment[_LAST, i]
    return error


@jit
def passed_on(block: Array, i: int, h: float) -> float:
    """For work and loss, the energy that all forces together have passed on in the step of size `h` [s]; 0 for others.

    Where a large force holds another, their powers cancel, and no work is more exact than the rounding of either.
    """
    if Sizes(block).y_work <= i < Sizes(block).y_alpha:
        energy: float = h * Implicit(block).turnover[0]
        return energy
    return 0.0


@jit
def evaluations(block: Array) -> int:
    """How many times a step evaluates the derivative."""
    return _STAGES + Sizes(block).coordinates + _order(block) + 2


@jit
def _unknown(block: Array, k: int) -> int:
    """Which unknown is number `k` of the linear system: rates, contact coordinates, own states."""
    n = Sizes(block).coordinates
    if k < n:
        return n + k
    first: int = Sizes(block).y_alpha
    return first + k - n


@jit
def _order(block: Array) -> int:
    """How many unknowns the linear system has."""
    order: int = Sizes(block).coordinates + Sizes(block).y_wear - Sizes(block).y_alpha
    return order


@jit
def _differentiate(block: Array, start: float, h: float) -> None:
    """The Jacobian at y_start by differences of the derivative, and its change with time."""
    keep_apart()
    s = Stages(block)
    table = Implicit(block)
    n = Sizes(block).coordinates
    copy(s.y_start, s.y_stage)
    set_time(block, start)
    write_scales(block, rate_scale(block), 0.0)
    for k in range(n + _order(block)):
        j = k if k < n else _unknown(block, k - n)
        there = s.y_start[j]
        s.y_stage[j] = there + _MOVES * (_MOVES_AT_LEAST * s.scale[j] + abs(there))
        move = s.y_stage[j] - there
        derivative(block, s.y_stage, s.dy_at)
        s.y_stage[j] = there
        far = k < n and abs(there) > _FAR * s.scale[j]
        for i in range(Sizes(block).unknowns):
            change = s.dy_at[i] - s.derivatives[0, i]
            if far and n <= i < 2 * n:  # the rounding of an acceleration would be taken times a long way
                acts = Loads(block).size[i - n] * Bodies(block).inverse_mass[i - n]
                if abs(change) <= _ROUNDING * (acts + abs(s.dy_at[i])):
                    change = 0.0
            table.jacobian[i, j] = change / move
    # of second order and from this instant on: before it, another piece of a driver's motion may have held
    for i in range(Sizes(block).unknowns):
        table.by_time[i] = -1.5 * s.derivatives[0, i]
    for k in range(1, 3):
        set_time(block, start + k * _MOVES_TIME * h)
        derivative(block, s.y_stage, s.dy_at)
        for i in range(Sizes(block).unknowns):
            table.by_time[i] += 2.0 * s.dy_at[i] if k == 1 else -0.5 * s.dy_at[i]
    for i in range(Sizes(block).unknowns):
        table.by_time[i] /= _MOVES_TIME * h


@jit
def _factorise(block: Array, h: float) -> None:
    """1/(h gamma) I - J of the linear system's unknowns, with q eliminated, as L U with the largest pivots."""
    keep_apart()
    table = Implicit(block)
    matrix = table.matrix
    n = Sizes(block).coordinates
    order = _order(block)
    inverse = 1.0 / (h * _GAMMA)
    for r in range(order):
        i = _unknown(block, r)
        for c in range(order):
            matrix[r, c] = -table.jacobian[i, _unknown(block, c)]
            if c < n:
                matrix[r, c] -= h * _GAMMA * table.jacobian[i, c]
        matrix[r, r] += inverse
    for k in range(order):
        best = k
        for r in range(k + 1, order):
            if abs(matrix[r, k]) > abs(matrix[best, k]):
                best = r
        table.pivot[k] = best
        if best != k:
            for c in range(order):
                matrix[k, c], matrix[best, c] = matrix[best, c], matrix[k, c]
        for r in range(k + 1, order):
            if matrix[r, k] != 0.0:
                matrix[r, k] /= matrix[k, k]
                for c in range(k + 1, order):
                    matrix[r, c] -= matrix[r, k] * matrix[k, c]


@jit
def _solve(block: Array, h: float, u: Array) -> None:
    """W u = `right`, both of shape (unknowns,)."""
    keep_apart()
    table = Implicit(block)
    matrix = table.matrix
    right = table.right
    x = table.rest
    n = Sizes(block).coordinates
    order = _order(block)
    step = h * _GAMMA
    for r in range(order):
        i = _unknown(block, r)
        total = right[i]
        for j in range(n):
            total += step * table.jacobian[i, j] * right[j]
        x[r] = total
    for k in range(order):
        best = table.pivot[k]
        x[k], x[best] = x[best], x[k]
    for k in range(order):
        for r in range(k + 1, order):
            x[r] -= matrix[r, k] * x[k]
    for back in range(order):
        k = order - 1 - back
        for c in range(k + 1, order):
            x[k] -= matrix[k, c] * x[c]
        x[k] /= matrix[k, k]
    for r in range(order):
        u[_unknown(block, r)] = x[r]
    for j in range(n):
        u[j] = step * (right[j] + x[j])
    work, alpha, wear = Sizes(block).y_work, Sizes(block).y_alpha, Sizes(block).y_wear
    for i in range(work, alpha):
        u[i] = 0.0  # they act on nothing, but what is left of a step that failed is not a number
    for i in range(work, alpha):
        u[i] = _added(block, i, step, u)
    for i in range(wear, Sizes(block).unknowns):
        u[i] = _added(block, i, step, u)


@jit
def _added(block: Array, i: int, step: float, u: Array) -> float:
    """The increment of an unknown that acts on nothing."""
    table = Implicit(block)
    total: float = table.right[i]
    for j in range(Sizes(block).y_wear):
        total += table.jacobian[i, j] * u[j]
    return step * total


@jit
def _write_dense(block: Array) -> None:
    """Coefficients of the step last tried, in the form of `interpolation`."""
    keep_apart()
    s = Stages(block)
    u = Implicit(block).increment
    for i in range(Sizes(block).unknowns):
        first = second = third = 0.0
        for j in range(_STAGES):
            first += _DENSE[0, j] * u[j, i]
            second += _DENSE[1, j] * u[j, i]
            third += _DENSE[2, j] * u[j, i]
        for row in range(_ROWS):
            s.new_dense[row, i] = 0.0
        s.new_dense[0, i] = s.y_start[i]
        s.new_dense[1, i] = s.y_new[i] - s.y_start[i]
        s.new_dense[2, i] = first
        s.new_dense[3, i] = second + third  # x = 1 - (1 - x)
        if _ROWS > 4:
            s.new_dense[4, i] = -third


@jit
def fastest(block: Array) -> float:
    """A guess of the spectral radius of the Jacobian last made [1/s], by products with it: good where it is stiff."""
    keep_apart()
    table = Implicit(block)
    s = Stages(block)
    z = s.y_stage
    n, work, alpha = Sizes(block).coordinates, Sizes(block).y_work, Sizes(block).y_alpha
    count = Sizes(block).y_wear
    for i in range(count):
        z[i] = 1.0 if i % 2 == 0 else -1.0
    grows = 0.0
    for product in range(_PRODUCTS):
        square = 0.0
        for i in range(count):
            total = 0.0
            if i < n:
                total = z[n + i]
            elif i < work or i >= alpha:
                for j in range(count):
                    total += table.jacobian[i, j] * z[j]
            s.y_at[i] = total
            square += total * total
        length = math.sqrt(square)
        if not 0.0 < length < math.inf:
            return length
        for i in range(count):
            z[i] = s.y_at[i] / length
        if product >= _PRODUCTS - _MEASURED:
            grows += log(length)
    return exp(grows / _MEASURED)
