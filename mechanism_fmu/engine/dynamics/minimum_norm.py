"""The minimum-norm least-squares solution z = D^+ b, and the multipliers of the same solve.

D = L Q by row-pivoted modified Gram-Schmidt with re-orthogonalisation: Q has orthonormal rows, L one column a basis
row. When all rows are independent, L is triangular up to the order of rows; when some depend on others, a second
Gram-Schmidt on the columns of L gives the least-squares answer, which is what the pseudoinverse of the papers means.

Rows that share bodies, or are joined by others that do, make an island (`islands`): each is solved by itself, with
columns of its own bodies alone, so that a hundred boxes on a floor cost a hundred times what one does.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import LinearSystem
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..vectors import add_multiple, dot
from .dependent_rows import solve_dependent
from .islands import find_islands

#: A row depends on the rows before it when less than this fraction of its length is left after projection.
RANK_TOLERANCE = 1e-10
#: A row that lost more than this fraction of its squared length to the projection is orthogonalised once more.
_REORTHOGONALISE_BELOW = 0.25
#: Below this fraction, the squared length left of a row is computed afresh, because subtraction has cancelled it.
_RECOMPUTE_BELOW = 1e-4


@jit
def orthogonalise(block: Array, count: int, width: int) -> int:
    """D = L Q, with D in `basis`[:count, :width], and `singleton` (see `expand`); return its rank, kept in `rank`, too.

    All rows make one island. D is lost.
    """
    system = LinearSystem(block)
    system.islands[0] = 1
    system.island_range[0, 0] = 0
    system.island_range[0, 1] = count
    for i in range(count):
        system.island_row[i] = i
        system.island_spot[i] = i
    system.independence[0] = _orthogonalise_island(system, 0, width)
    rank: int = system.island_rank[0]
    system.rank[0] = rank
    return rank


@jit
def orthogonalise_islands(block: Array, count: int, width: int) -> None:
    """As `expand` and `orthogonalise`, island by island."""
    keep_small()
    if find_islands(block, count) == 1:
        expand(block, count, width)
        orthogonalise(block, count, width)
        return
    system = LinearSystem(block)
    system.rank[0] = 0
    least = 1.0
    for island in range(system.islands[0]):
        for q in range(system.island_range[island, 0], system.island_range[island, 1]):
            _expand_row(system, system.island_row[q], system.island_width[island], width)
        least = min(least, _orthogonalise_island(system, island, system.island_width[island]))
        system.rank[0] += system.island_rank[island]
    system.independence[0] = least


@jit
def _orthogonalise_island(system: LinearSystem, island: int, width: int) -> float:
    """The rows of an island, which `basis` holds; write its rank, and return how independent its last basis row is.

    Row order[r] of `basis` is the r-th basis row, `triangle`[i, r] its share in row i; the places r of an island begin
    at `island_range`.
    """
    basis = system.basis
    first = system.island_range[island, 0]
    end = system.island_range[island, 1]
    independence = 1.0
    least = max(RANK_TOLERANCE * RANK_TOLERANCE, system.least_independence[0])
    system.island_singletons[island] = first
    for q in range(first, end):
        i = system.island_row[q]
        system.order[q] = i
        square = dot(basis[i], basis[i], width)
        system.row_norm[i, 0] = square
        system.row_norm[i, 1] = square
        system.row_norm[i, 2] = 1.0 if square > 0.0 else 0.0
    for r in range(first, end):
        system.island_rank[island] = r - first
        fraction = _choose_pivot(system, r, end)
        if not fraction > least:
            return independence
        p = system.order[r]
        if system.singleton[p] != codes.NONE and fraction == 1.0:
            independence = 1.0
            if system.island_singletons[island] == r:
                system.island_singletons[island] = r + 1
            _eliminate_singleton(system, r, end, width)
            continue
        square = dot(basis[p], basis[p], width)
        if square < _REORTHOGONALISE_BELOW * system.row_norm[p, 0]:
            for j in range(first, r):
                share = dot(basis[system.order[j]], basis[p], width)
                system.triangle[p, j] += share
                add_multiple(basis[p], -share, basis[system.order[j]], width)
            square = dot(basis[p], basis[p], width)
        if not square > RANK_TOLERANCE * RANK_TOLERANCE * system.row_norm[p, 0]:  # what rounding hid from the pivoting
            return independence
        independence = fraction
        length = math.sqrt(square)
        system.triangle[p, r] = length
        for k in range(width):
            basis[p, k] /= length
        for s in range(r + 1, end):
            i = system.order[s]
            share = dot(basis[p], basis[i], width)
            system.triangle[i, r] = share
            if share == 0.0:  # most rows have no body in common
                continue
            add_multiple(basis[i], -share, basis[p], width)
            system.singleton[i] = codes.NONE
            _note_what_is_left(system, i, share, width)
    system.island_rank[island] = end - first
    return independence


@jit
def expand(block: Array, count: int, width: int) -> None:
    """Write D, of which `scaled` has the entries of two bodies a row, to the first `width` columns of `basis`.

    And to `singleton` in which column the only entry of a row is; `codes.NONE` where there are more, or none.
    """
    system = LinearSystem(block)
    for body in range(Sizes(block).bodies):
        system.island_column[body] = 3 * body
    for i in range(count):
        _expand_row(system, i, width, width)


@jit
def _expand_row(system: LinearSystem, row: int, width: int, ground: int) -> None:
    """As `expand`, of one row, with the columns of its island; those of the ground, from `ground` on, are left out."""
    basis = system.basis[row]
    for k in range(width):
        basis[k] = 0.0
    only = codes.NONE
    entries = 0
    for end in range(2):
        body = system.scaled_body[row, end]
        if 3 * body < ground:
            column = system.island_column[body]
            for k in range(3):
                entry = system.scaled[row, 3 * end + k]
                basis[column + k] = entry
                if entry != 0.0:
                    only = column + k
                    entries += 1
    system.singleton[row] = only if entries == 1 else codes.NONE


@jit
def _eliminate_singleton(system: LinearSystem, r: int, end: int, width: int) -> None:
    """The r-th basis row has one entry only: of the rows that follow, it takes that, and no more.

    What the general way does, without the sums of zeros that make the most of it: rows of a pin at the middle of a
    body, and of bodies that are guided along the axes, are such.
    """
    p = system.order[r]
    column = system.singleton[p]
    length = abs(system.basis[p, column])
    system.triangle[p, r] = length
    system.basis[p, column] /= length
    unit = system.basis[p, column]
    for s in range(r + 1, end):
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
        left = dot(system.basis[row], system.basis[row], width)
    system.row_norm[row, 1] = left
    system.row_norm[row, 2] = left / system.row_norm[row, 0]


@jit
def solve_orthogonalised(block: Array, count: int, width: int) -> None:
    """Solve D z = b in the minimum-norm least-squares sense, with the D that was orthogonalised last.

    Reads b = `right_side`[:count] of the linear system; writes z = D^+ b to `solution`[:width] and the minimum-norm
    solution of D^T multiplier = z to `multiplier`[:count].
    """
    system = LinearSystem(block)
    for k in range(width):
        system.solution[k] = 0.0
    if system.islands[0] == 1:
        _solve_island(block, 0)
        _combine(system, 0, system.solution, width)
        return
    for island in range(system.islands[0]):
        _solve_island(block, island)
        own = system.island_solution
        for k in range(system.island_width[island]):
            own[k] = 0.0
        _combine(system, island, own, system.island_width[island])
        _scatter(system, island, width)


@jit
def _solve_island(block: Array, island: int) -> None:
    """Coefficients of the basis rows of an island, and its multipliers."""
    system = LinearSystem(block)
    first = system.island_range[island, 0]
    end = system.island_range[island, 1]
    if system.island_rank[island] == end - first:
        _solve_full_rank(block, first, end, system.island_singletons[island])
    else:
        solve_dependent(block, first, end, first + system.island_rank[island])


@jit
def _combine(system: LinearSystem, island: int, solution: Array, width: int) -> None:
    """Add the basis rows of an island times their coefficients."""
    first = system.island_range[island, 0]
    singletons = system.island_singletons[island]
    for r in range(first, singletons):
        p = system.order[r]
        column = system.singleton[p]
        solution[column] += system.coefficient[r] * system.basis[p, column]
    for r in range(singletons, first + system.island_rank[island]):
        add_multiple(solution, system.coefficient[r], system.basis[system.order[r]], width)


@jit
def _scatter(system: LinearSystem, island: int, ground: int) -> None:
    """What an island's columns hold, to those of the bodies."""
    keep_small()
    for q in range(system.island_range[island, 0], system.island_range[island, 1]):
        row = system.island_row[q]
        for end in range(2):
            first = 3 * system.scaled_body[row, end]
            if first < ground:
                column = system.island_column[system.scaled_body[row, end]]
                for k in range(3):
                    system.solution[first + k] = system.island_solution[column + k]


@jit
def _choose_pivot(system: LinearSystem, r: int, end: int) -> float:
    """Move the row with the largest remaining fraction of its squared length to place r; return that fraction."""
    best = r
    best_fraction = -1.0
    for s in range(r, end):
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
def _solve_full_rank(block: Array, first: int, end: int, singletons: int) -> None:
    """L coefficient = b forwards, then L^T multiplier = coefficient backwards; singletons share nothing."""
    system = LinearSystem(block)
    for r in range(first, singletons):
        p = system.order[r]
        system.coefficient[r] = system.right_side[p] / system.triangle[p, r]
    for r in range(singletons, end):
        p = system.order[r]
        value = system.right_side[p]
        for j in range(first, r):
            value -= system.triangle[p, j] * system.coefficient[j]
        system.coefficient[r] = value / system.triangle[p, r]
    for back in range(end - first):
        r = end - 1 - back
        p = system.order[r]
        value = system.coefficient[r]
        for s in range(max(r + 1, singletons), end):
            q = system.order[s]
            value -= system.triangle[q, r] * system.multiplier[q]
        system.multiplier[p] = value / system.triangle[p, r]
