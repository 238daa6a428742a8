"""The minimum-norm least-squares solution z = D^+ b, and the multipliers of the same solve.

D = L Q by row-pivoted modified Gram-Schmidt with re-orthogonalisation: Q has orthonormal rows, L one column a basis
row. When all rows are independent, L is triangular up to the order of rows; when some depend on others, a second
Gram-Schmidt on the columns of L gives the least-squares answer, which is what the pseudoinverse of the papers means.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import LinearSystem
from ..compiler.subset import jit, keep_small

#: A row depends on the rows before it when less than this fraction of its length is left after projection.
RANK_TOLERANCE = 1e-10
#: A row that lost more than this fraction of its squared length to the projection is orthogonalised once more.
_REORTHOGONALISE_BELOW = 0.25
#: Below this fraction, the squared length left of a row is computed afresh, because subtraction has cancelled it.
_RECOMPUTE_BELOW = 1e-4
#: Columns of two bodies.
_TWO_BODIES = 6


@jit
def orthogonalise(block: Array, count: int, width: int) -> int:
    """D = L Q, with D = `scaled`[:count, :width] of the linear system; return its rank, which is left in `rank`, too.

    Row order[r] of `basis` is the r-th basis row, `triangle`[i, r] its share in row i.
    """
    system = LinearSystem(block)
    basis = system.basis
    system.rank[0] = count
    system.independence[0] = 1.0
    system.singletons[0] = 0
    for i in range(count):
        system.order[i] = i
        system.singleton[i] = _copy_row(system, i, width)
        square = _dot(basis[i], basis[i], width)
        system.row_norm[i, 0] = square
        system.row_norm[i, 1] = square
        system.row_norm[i, 2] = 1.0 if square > 0.0 else 0.0
    for r in range(count):
        fraction = _choose_pivot(system, r, count)
        if not fraction > RANK_TOLERANCE * RANK_TOLERANCE:
            system.rank[0] = r
            return r
        p = system.order[r]
        if system.singleton[p] != codes.NONE and fraction == 1.0:
            _eliminate_singleton(system, r, count, width)
            continue
        square = _dot(basis[p], basis[p], width)
        if square < _REORTHOGONALISE_BELOW * system.row_norm[p, 0]:
            for j in range(r):
                share = _dot(basis[system.order[j]], basis[p], width)
                system.triangle[p, j] += share
                _add_multiple(basis[p], -share, basis[system.order[j]], width)
            square = _dot(basis[p], basis[p], width)
        if not square > RANK_TOLERANCE * RANK_TOLERANCE * system.row_norm[p, 0]:  # what rounding hid from the pivoting
            system.rank[0] = r
            return r
        system.independence[0] = fraction
        length = math.sqrt(square)
        system.triangle[p, r] = length
        for k in range(width):
            basis[p, k] /= length
        for s in range(r + 1, count):
            i = system.order[s]
            share = _dot(basis[p], basis[i], width)
            system.triangle[i, r] = share
            if share == 0.0:  # most rows have no body in common
                continue
            _add_multiple(basis[i], -share, basis[p], width)
            system.singleton[i] = codes.NONE
            _note_what_is_left(system, i, share, width)
    return count


@jit
def _copy_row(system: LinearSystem, row: int, width: int) -> int:
    """Copy a row of D into the basis; return in which column its only entry is, `codes.NONE` where there are more."""
    entry = system.scaled[row]
    basis = system.basis[row]
    for k in range(width):
        basis[k] = entry[k]
    found = codes.NONE
    for k in range(width):
        if entry[k] != 0.0:
            if found != codes.NONE:
                return codes.NONE
            found = k
    return found


@jit
def _eliminate_singleton(system: LinearSystem, r: int, count: int, width: int) -> None:
    """The r-th basis row has one entry only: of the rows that follow, it takes that, and no more.

    What the general way does, without the sums of zeros that make the most of it: rows of a pin at the middle of a
    body, and of bodies that are guided along the axes, are such.
    """
    p = system.order[r]
    column = system.singleton[p]
    system.independence[0] = 1.0
    length = abs(system.basis[p, column])
    system.triangle[p, r] = length
    system.basis[p, column] /= length
    unit = system.basis[p, column]
    if system.singletons[0] == r:
        system.singletons[0] = r + 1
    for s in range(r + 1, count):
        i = system.order[s]
        share = unit * system.basis[i, column]
        system.triangle[i, r] = share
        if share != 0.0:
            system.basis[i, column] -= share * unit
            _note_what_is_left(system, i, share, width)


@jit
def _note_what_is_left(system: LinearSystem, row: int, share: float, width: int) -> None:
    """A row has lost its share in a basis row: note its squared length now."""
    left = system.row_norm[row, 1] - share * share
    if left < _RECOMPUTE_BELOW * system.row_norm[row, 0]:
        left = _dot(system.basis[row], system.basis[row], width)
    system.row_norm[row, 1] = left
    system.row_norm[row, 2] = left / system.row_norm[row, 0]


@jit
def solve_orthogonalised(block: Array, count: int, width: int) -> None:
    """Solve D z = b in the minimum-norm least-squares sense, with the D that was orthogonalised last.

    Reads b = `right_side`[:count] of the linear system; writes z = D^+ b to `solution`[:width] and the minimum-norm
    solution of D^T multiplier = z to `multiplier`[:count].
    """
    system = LinearSystem(block)
    rank = system.rank[0]
    if rank == count:
        _solve_full_rank(block, count)
    else:
        _solve_deficient(block, count, rank)
    for k in range(width):
        system.solution[k] = 0.0
    singletons = system.singletons[0]
    for r in range(singletons):
        p = system.order[r]
        column = system.singleton[p]
        system.solution[column] += system.coefficient[r] * system.basis[p, column]
    for r in range(singletons, rank):
        _add_multiple(system.solution, system.coefficient[r], system.basis[system.order[r]], width)


@jit
def _choose_pivot(system: LinearSystem, r: int, count: int) -> float:
    """Move the row with the largest remaining fraction of its squared length to place r; return that fraction."""
    best = r
    best_fraction = -1.0
    for s in range(r, count):
        fraction = system.row_norm[system.order[s], 2]
        if fraction > best_fraction:
            best_fraction = fraction
            best = s
            if fraction == 1.0:  # there is no more
                break
    chosen = system.order[best]
    system.order[best] = system.order[r]
    system.order[r] = chosen
    return best_fraction


@jit
def _solve_full_rank(block: Array, count: int) -> None:
    """L coefficient = b forwards, then L^T multiplier = coefficient backwards."""
    system = LinearSystem(block)
    singletons = system.singletons[0]  # which have no share in each other
    for r in range(singletons):
        p = system.order[r]
        system.coefficient[r] = system.right_side[p] / system.triangle[p, r]
    for r in range(singletons, count):
        p = system.order[r]
        value = system.right_side[p]
        for j in range(r):
            value -= system.triangle[p, j] * system.coefficient[j]
        system.coefficient[r] = value / system.triangle[p, r]
    for back in range(count):
        r = count - 1 - back
        p = system.order[r]
        value = system.coefficient[r]
        for s in range(max(r + 1, singletons), count):
            q = system.order[s]
            value -= system.triangle[q, r] * system.multiplier[q]
        system.multiplier[p] = value / system.triangle[p, r]


@jit
def _solve_deficient(block: Array, count: int, rank: int) -> None:
    """L = U R by columns; coefficient = R^-1 U^T b, multiplier = U R^-T coefficient."""
    keep_small()
    system = LinearSystem(block)
    u = system.column_basis
    triangle = system.column_triangle
    for r in range(rank):
        for i in range(count):
            u[r, i] = system.triangle[i, r]
        for i in range(r):
            u[r, system.order[i]] = 0.0
            triangle[i, r] = 0.0
        for _ in range(2):
            for j in range(r):
                share = _dot(u[j], u[r], count)
                triangle[j, r] += share
                _add_multiple(u[r], -share, u[j], count)
        length = math.sqrt(_dot(u[r], u[r], count))
        triangle[r, r] = length
        for i in range(count):
            u[r, i] /= length
    for r in range(rank):
        system.coefficient[r] = _dot(u[r], system.right_side, count)
    for back in range(rank):
        r = rank - 1 - back
        for s in range(r + 1, rank):
            system.coefficient[r] -= triangle[r, s] * system.coefficient[s]
        system.coefficient[r] /= triangle[r, r]
    for i in range(count):
        system.multiplier[i] = 0.0
    for r in range(rank):
        value = system.coefficient[r]
        for j in range(r):
            value -= triangle[j, r] * system.dual[j]
        system.dual[r] = value / triangle[r, r]
        _add_multiple(system.multiplier, system.dual[r], u[r], count)


@jit
def _dot(a: Array, b: Array, length: int) -> float:
    """Scalar product of the first `length` entries, in four sums: one would wait for each addition."""
    if length == _TWO_BODIES:  # the same without a loop, whose overhead would be most of the work
        total: float = (a[0] * b[0] + a[4] * b[4] + a[5] * b[5] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3])
        return total
    first = second = third = fourth = 0.0
    whole = length - length % 4
    for k in range(0, whole, 4):
        first += a[k] * b[k]
        second += a[k + 1] * b[k + 1]
        third += a[k + 2] * b[k + 2]
        fourth += a[k + 3] * b[k + 3]
    for k in range(whole, length):
        first += a[k] * b[k]
    return (first + second) + (third + fourth)


@jit
def _add_multiple(target: Array, factor: float, source: Array, length: int) -> None:
    """Target += factor * source, in the first `length` entries."""
    if length == _TWO_BODIES:
        target[0] += factor * source[0]
        target[1] += factor * source[1]
        target[2] += factor * source[2]
        target[3] += factor * source[3]
        target[4] += factor * source[4]
        target[5] += factor * source[5]
        return
    for k in range(length):
        target[k] += factor * source[k]
