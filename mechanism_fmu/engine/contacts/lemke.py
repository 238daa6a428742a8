"""Lemke's algorithm: w = M z + q with w >= 0, z >= 0, w z = 0.

Source: Cottle, Pang, Stone, The Linear Complementarity Problem, chapter 4.

The tableau has a row for each unknown and the columns (w, z, z0, q), which begin as (1, -M, -1, q). Ties of the ratio
test are broken lexicographically, so that it ends.
"""

from __future__ import annotations

from ...tables.declare import Array
from ..compiler.subset import jit, keep_apart, keep_small

#: A pivot below this, or a difference of two ratios beside their size, is rounding.
_LEAST_PIVOT = 1e-11
_TIE = 1e-12
#: Of its first value, z0 is nothing when less than this is left.
_NOTHING = 1e-13
#: Pivots for each unknown after which it is given up.
_MOST_PIVOTS = 12


@jit
def lemke(tableau: Array, basis: Array, count: int) -> bool:
    """Solve a problem with `count` unknowns in place; whether that ended, and not in a ray.

    Afterwards the variable `basis[i]` (w_k is k, z_k is `count` + k) has the value `tableau[i, 2 count + 1]`, all
    others are zero. It also ends where rounding is all that is left of z0.
    """
    keep_apart()
    covering = 2 * count
    leaving = 0
    for i in range(count):
        basis[i] = i
        if tableau[i, covering + 1] < tableau[leaving, covering + 1]:
            leaving = i
    least = tableau[leaving, covering + 1]
    if least >= 0.0:
        return True
    entering = covering
    for _ in range(_MOST_PIVOTS * count):
        left = basis[leaving]
        _pivot(tableau, count, leaving, entering)
        basis[leaving] = entering
        if left == covering:
            return True
        for i in range(count):
            if basis[i] == covering and tableau[i, covering + 1] <= -_NOTHING * least:
                return True
        entering = left - count if left >= count else left + count
        leaving = _leaving_row(tableau, basis, count, entering)
        if leaving < 0:
            return False
    return False


@jit
def _pivot(tableau: Array, count: int, row: int, column: int) -> None:
    keep_apart()
    width = 2 * count + 2
    divisor = tableau[row, column]
    for k in range(width):
        tableau[row, k] /= divisor
    for i in range(count):
        share = tableau[i, column]
        if i != row and share != 0.0:
            for k in range(width):
                tableau[i, k] -= share * tableau[row, k]


@jit
def _leaving_row(tableau: Array, basis: Array, count: int, entering: int) -> int:
    """The row whose variable is first to become zero as another enters; -1: none does."""
    keep_small()
    best = -1
    for i in range(count):
        if tableau[i, entering] > _LEAST_PIVOT and (best < 0 or _is_before(tableau, basis, count, entering, i, best)):
            best = i
    return best


@jit
def _is_before(tableau: Array, basis: Array, count: int, entering: int, i: int, j: int) -> bool:
    """Whether row i comes before row j: by the ratios of the right side; z0 in a tie, else by those of the inverse."""
    keep_small()
    for place in range(-1, count):
        column = 2 * count + 1 if place < 0 else place
        mine = tableau[i, column] / tableau[i, entering]
        other = tableau[j, column] / tableau[j, entering]
        if abs(mine - other) > _TIE * (abs(mine) + abs(other)):
            return bool(mine < other)
        if place < 0 and (basis[i] == 2 * count or basis[j] == 2 * count):
            return bool(basis[i] == 2 * count)
    return False
