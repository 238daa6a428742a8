"""Rows that depend on each other, after D = L Q (`minimum_norm`): the least multipliers, and which of them are free."""

from __future__ import annotations

import math

from ...tables.declare import Array
from ...tables.motion import LinearSystem
from ..compiler.subset import jit, keep_small
from ..vectors import add_multiple, dot

#: A column of which less than this fraction of its squared length is left is orthogonalised once more.
_AGAIN_BELOW = 0.25


@jit
def solve_dependent(block: Array, first: int, end: int, after: int) -> None:
    """L = U R by columns; coefficient = R^-1 U^T b, multiplier = U R^-T coefficient.

    The basis rows are in the places from `first` to `after`. A row of `column_basis` has the entries of the island's
    rows, in the order of `island_row`.
    """
    keep_small()
    system = LinearSystem(block)
    u = system.column_basis
    triangle = system.column_triangle
    count = end - first
    b = system.gathered
    for i in range(count):
        b[i] = system.right_side[system.island_row[first + i]]
    for r in range(first, after):
        for i in range(count):
            u[r, i] = system.triangle[system.island_row[first + i], r]
        for i in range(first, r):
            u[r, system.island_spot[system.order[i]] - first] = 0.0
            triangle[i, r] = 0.0
        left = dot(u[r], u[r], count)
        before = math.inf
        while left < _AGAIN_BELOW * before:
            before = left
            for j in range(first, r):
                share = dot(u[j], u[r], count)
                triangle[j, r] += share
                add_multiple(u[r], -share, u[j], count)
            left = dot(u[r], u[r], count)
        length = math.sqrt(left)
        triangle[r, r] = length
        for i in range(count):
            u[r, i] /= length
    for r in range(first, after):
        system.coefficient[r] = dot(u[r], b, count)
    for back in range(after - first):
        r = after - 1 - back
        for s in range(r + 1, after):
            system.coefficient[r] -= triangle[r, s] * system.coefficient[s]
        system.coefficient[r] /= triangle[r, r]
    for i in range(count):
        b[i] = 0.0
    for r in range(first, after):
        value = system.coefficient[r]
        for j in range(first, r):
            value -= triangle[j, r] * system.dual[j]
        system.dual[r] = value / triangle[r, r]
        add_multiple(b, system.dual[r], u[r], count)
    for i in range(count):
        system.multiplier[system.island_row[first + i]] = b[i]


@jit
def take_out_range(block: Array, row: int, count: int, left: Array) -> None:
    """The part of a row's unit vector that is outside the range of all rows, into `left`, shape (count,).

    That is by which multipliers may change without any change of the rates. Only behind a solution by pivots of rows
    that depend on each other.
    """
    keep_small()
    system = LinearSystem(block)
    for r in range(count):
        left[r] = 0.0
    left[row] = 1.0
    island = 0
    while system.island_range[island, 1] <= system.island_spot[row]:
        island += 1
    first = system.island_range[island, 0]
    rank = system.island_rank[island]
    end = system.island_range[island, 1]
    if rank == end - first:
        left[row] = 0.0
        return
    spot = system.island_spot[row] - first
    for j in range(first, first + rank):
        share = system.column_basis[j, spot]
        for q in range(first, end):
            left[system.island_row[q]] -= share * system.column_basis[j, q - first]
