"""Solutions of the linear system D z = b: sparse where rows are many and all independent, else dense, by pivots."""

from __future__ import annotations

from ...tables.declare import Array
from ...tables.motion import LinearSystem, Rows
from ..compiler.subset import jit
from .minimum_norm import expand, orthogonalise, orthogonalise_islands, solve_orthogonalised
from .sparse import factorise_sparse, solve_sparse

#: From so many rows on; fewer gain little, and keep what is exact to the last digit, such as zeros along a guide.
_SPARSE_FROM = 20

#: Of `linear_system.kept`.
KEEP, STANDS = 1, 2


@jit
def write_matrix(block: Array, count: int, factor: Array) -> None:
    """D = Phi_q diag(factor): the first `count` rows, with `factor` of shape (columns,), 0 for the ground."""
    row = Rows(block)
    system = LinearSystem(block)
    for r in range(count):
        entry = system.scaled[r]
        for end in range(2):
            first = 3 * row.body[r, end]
            k = 3 * end
            system.scaled_body[r, end] = row.body[r, end]
            entry[k] = row.jacobian[r, first] * factor[first]
            entry[k + 1] = row.jacobian[r, first + 1] * factor[first + 1]
            entry[k + 2] = row.jacobian[r, first + 2] * factor[first + 2]


@jit
def solve(block: Array, count: int, width: int) -> None:
    """The minimum-norm solution z = D^+ b and its multipliers: to `solution`[:width] and `multiplier`[:count]."""
    factorise(block, count, width)
    solve_again(block, count, width)


@jit
def factorise(block: Array, count: int, width: int) -> None:
    """Factorise D, for `solve_again`; write its rank and how independent its rows are."""
    LinearSystem(block).by_pivots[0] = 0
    if count < _SPARSE_FROM:
        LinearSystem(block).by_pivots[0] = 1
        expand(block, count, width)
        orthogonalise(block, count, width)
    elif not factorise_sparse(block, count):
        LinearSystem(block).by_pivots[0] = 1
        orthogonalise_islands(block, count, width)


@jit
def solve_again(block: Array, count: int, width: int) -> None:
    """As `solve`, with the D that was factorised last."""
    system = LinearSystem(block)
    if system.by_pivots[0] == 0:
        if solve_sparse(block, count, width):
            return
        system.by_pivots[0] = 1
        orthogonalise_islands(block, count, width)
    solve_orthogonalised(block, count, width)
