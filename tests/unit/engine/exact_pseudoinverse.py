"""The minimum-norm least-squares solution in rational arithmetic: no rounding until the last line."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np

Rows = list[list[Fraction]]


class Solution(NamedTuple):
    """z = D^+ b, the minimum-norm solution of D^T multiplier = z, and the rank of D."""

    z: np.ndarray[Any, Any]
    multiplier: np.ndarray[Any, Any]
    rank: int


def exact_minimum_norm(D: Any, b: Any) -> Solution:
    """Solve D z = b by the full-rank factorisation D = F C, so that D^+ = C^T (C C^T)^-1 (F^T F)^-1 F^T."""
    rows = [[Fraction(x) for x in row] for row in D.tolist()]
    C, pivots = _reduced_rows(rows)
    F = [[row[p] for p in pivots] for row in rows]
    columns = _transposed(F)
    squares = [[_dot(u, v) for v in columns] for u in columns]
    y = _solve(squares, [_dot(column, [Fraction(x) for x in b.tolist()]) for column in columns])
    w = _solve([[_dot(u, v) for v in C] for u in C], y)
    v = _solve(squares, w)
    z = [sum((row[k] * weight for row, weight in zip(C, w, strict=True)), Fraction()) for k in range(len(rows[0]))]
    return Solution(_floats(z), _floats([_dot(row, v) for row in F]), len(C))


def _reduced_rows(rows: Rows) -> tuple[Rows, list[int]]:
    """The non-zero rows of the reduced row echelon form, and their pivots."""
    left, found, pivots = [row[:] for row in rows], [], []
    for k in range(len(rows[0]) if rows else 0):
        pivot = next((row for row in left if row[k]), None)
        if pivot is None:
            continue
        left.remove(pivot)
        pivot = [x / pivot[k] for x in pivot]
        left, found = ([_minus(row, row[k], pivot) for row in part] for part in (left, found))
        found.append(pivot)
        pivots.append(k)
    return found, pivots


def _solve(A: Rows, y: list[Fraction]) -> list[Fraction]:
    """Solve A x = y with a regular A."""
    reduced, _ = _reduced_rows([[*row, value] for row, value in zip(A, y, strict=True)])
    return [row[-1] for row in reduced]


def _minus(row: list[Fraction], factor: Fraction, other: list[Fraction]) -> list[Fraction]:
    return [x - factor * y for x, y in zip(row, other, strict=True)] if factor else row


def _dot(u: list[Fraction], v: list[Fraction]) -> Fraction:
    return sum((x * y for x, y in zip(u, v, strict=True)), Fraction())


def _transposed(rows: Rows) -> Rows:
    return [list(column) for column in zip(*rows, strict=True)]


def _floats(values: list[Fraction]) -> np.ndarray[Any, Any]:
    return np.array([float(value) for value in values])
