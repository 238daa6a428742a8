"""Rank of constraint rows: which of them depend on others, and how near the others are to it."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

FloatArray = np.ndarray[Any, np.dtype[np.float64]]

#: A row depends on those before it when less than this part of its length is independent of them.
DEPENDENT_BELOW = 1e-8


class Independence(NamedTuple):
    """Rows in their order, each against those before it.

    `independent` are the numbers of the rows that add to the rank; `weights` says of each other row how it is combined
    of these, shape (rows that depend, independent rows); `least` is the smallest singular value of the independent
    rows, each scaled to length 1: near 0, they are about to depend on each other.
    """

    independent: list[int]
    dependent: list[int]
    weights: FloatArray
    least: float


def independence(jacobian: FloatArray) -> Independence:
    """Sort the rows of `jacobian`, shape (rows, coordinates), into independent and dependent ones."""
    lengths = np.linalg.norm(jacobian, axis=1)
    scaled = jacobian / np.where(lengths > 0.0, lengths, 1.0)[:, None]
    independent: list[int] = []
    dependent: list[int] = []
    basis = np.zeros((0, jacobian.shape[1]))
    for k, row in enumerate(scaled):
        left = row - basis.T @ (basis @ row)
        left -= basis.T @ (basis @ left)
        size = float(np.linalg.norm(left))
        if size > DEPENDENT_BELOW:
            basis = np.vstack([basis, left / size])
            independent.append(k)
        else:
            dependent.append(k)
    kept = jacobian[independent]
    weights = np.asarray(np.linalg.lstsq(kept.T, jacobian[dependent].T, rcond=None)[0].T, dtype=np.float64)
    values = np.linalg.svd(scaled[independent], compute_uv=False)
    return Independence(independent, dependent, weights, float(values[-1]) if len(values) else 1.0)
