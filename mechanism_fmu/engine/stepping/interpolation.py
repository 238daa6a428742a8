"""The continuous extension of a step (see `dormand_prince`)."""

from __future__ import annotations

from ...tables.declare import Array
from ..compiler.subset import jit


@jit
def interpolate(dense: Array, fraction: float, y: Array) -> None:
    """Y at `fraction` (0..1) of the step whose coefficients are `dense`, shape (5, unknowns)."""
    rest = 1.0 - fraction
    for i in range(y.shape[0]):
        y[i] = dense[0, i] + fraction * (
            dense[1, i] + rest * (dense[2, i] + fraction * (dense[3, i] + rest * dense[4, i]))
        )
