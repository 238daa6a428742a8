"""Rank of constraint rows: which of them depend on others, and what they leave free."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

FloatArray = np.ndarray[Any, np.dtype[np.float64]]

#: A row depends on those before it when less than this part of its length is independent of them. Positions are closed
#: to 1e-12 only, and next to a singular one they may be off by the root of that.
DEPENDENT_BELOW = 1e-6


class Independence(NamedTuple):
    """Rows in their order, each against those before it.

    `independent` are the numbers of the rows that add to the rank; `weights` says of each other row how it is combined
    of these, shape (rows that depend, independent rows).
    """

    independent: list[int]
    dependent: list[int]
    weights: FloatArray


def independence(rows: FloatArray) -> Independence:
    """Sort rows of length 1, shape (rows, coordinates), into independent and dependent ones."""
    independent: list[int] = []
    dependent: list[int] = []
    basis = np.zeros((0, rows.shape[1]))
    for k, row in enumerate(rows):
        left = row - basis.T @ (basis @ row)
        left -= basis.T @ (basis @ left)  # once more: the first time leaves rounding of the basis
        size = float(np.linalg.norm(left))
        if size > DEPENDENT_BELOW:
            basis = np.vstack([basis, left / size])
            independent.append(k)
        else:
            dependent.append(k)
    weights = np.linalg.lstsq(rows[independent].T, rows[dependent].T, rcond=None)[0].T
    return Independence(independent, dependent, np.asarray(weights, dtype=np.float64))


def free_directions(rows: FloatArray) -> FloatArray:
    """Orthonormal directions in which no row changes, shape (coordinates, directions)."""
    _, values, directions = np.linalg.svd(rows)
    free: FloatArray = directions[int(np.sum(values > DEPENDENT_BELOW)) :].T
    return free
