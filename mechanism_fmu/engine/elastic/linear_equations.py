"""Square linear equations by elimination with row pivoting: one factorisation, solved either way round."""

from __future__ import annotations

from ...tables.declare import Array
from ..compiler.subset import jit, keep_small

#: A pivot below this part of the largest entry is taken as this part: what hangs on it becomes huge, but stays finite.
_LEAST_PIVOT = 1e-15


@jit
def factorise(matrix: Array, order: Array) -> None:
    """P A = L U in place of A, shape (n, n), with ones on the diagonal of L; row `order`[k] of A has become row k."""
    keep_small()
    count = order.shape[0]
    largest = 0.0
    for i in range(count):
        order[i] = i
        for k in range(count):
            largest = max(largest, abs(matrix[i, k]))
    for k in range(count):
        _pivot(matrix, order, k)
        if abs(matrix[k, k]) < _LEAST_PIVOT * largest:
            matrix[k, k] = _LEAST_PIVOT * largest
        for i in range(k + 1, count):
            if matrix[i, k] != 0.0:
                factor = matrix[i, k] / matrix[k, k]
                matrix[i, k] = factor
                for j in range(k + 1, count):
                    matrix[i, j] -= factor * matrix[k, j]


@jit
def _pivot(matrix: Array, order: Array, k: int) -> None:
    """Exchange row k and the row from there on that has the largest entry in column k."""
    keep_small()
    count = order.shape[0]
    best = k
    for i in range(k + 1, count):
        if abs(matrix[i, k]) > abs(matrix[best, k]):
            best = i
    if best != k:
        row = order[k]
        order[k] = order[best]
        order[best] = row
        for j in range(count):
            entry = matrix[k, j]
            matrix[k, j] = matrix[best, j]
            matrix[best, j] = entry


@jit
def solve(matrix: Array, order: Array, right: Array, solution: Array) -> None:
    """A solution = right, with the factors of A; shapes (n,)."""
    keep_small()
    count = order.shape[0]
    for i in range(count):
        value = right[order[i]]
        for j in range(i):
            value -= matrix[i, j] * solution[j]
        solution[i] = value
    for back in range(count):
        i = count - 1 - back
        value = solution[i]
        for j in range(i + 1, count):
            value -= matrix[i, j] * solution[j]
        solution[i] = value / matrix[i, i]


@jit
def solve_transposed(matrix: Array, order: Array, right: Array, solution: Array) -> None:
    """A^T solution = right, with the factors of A; shapes (n,). `right` is used up."""
    keep_small()
    count = order.shape[0]
    for i in range(count):
        value = right[i]
        for j in range(i):
            value -= matrix[j, i] * right[j]
        right[i] = value / matrix[i, i]
    for back in range(count):
        i = count - 1 - back
        value = right[i]
        for j in range(i + 1, count):
            value -= matrix[j, i] * right[j]
        right[i] = value
    for i in range(count):
        solution[order[i]] = right[i]
