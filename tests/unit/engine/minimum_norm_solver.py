"""The engine's minimum-norm solver as a function of a matrix and a right side."""

from __future__ import annotations

from typing import Any

import numpy as np

from mechanism_fmu import codes
from mechanism_fmu.engine.compiler.subset import entry
from mechanism_fmu.engine.dynamics.minimum_norm import orthogonalise, solve_orthogonalised
from mechanism_fmu.tables.layout import allocate, field_of
from mechanism_fmu.tables.motion import LinearSystem
from mechanism_fmu.tables.sizes import GIVEN_SIZES

Array = np.ndarray[Any, Any]

BLOCK = allocate(dict.fromkeys(GIVEN_SIZES, 0) | {"bodies": 4, "joint_rows": 12})


@entry
def _solve_in(block: Array, count: int, width: int) -> int:
    orthogonalise(block, count, width)
    solve_orthogonalised(block, count, width)
    return LinearSystem(block).rank[0]


def solve(D: Array, b: Array) -> tuple[Array, Array, int]:
    """z, multipliers and rank by the engine, with rubbish left over in everything it need not read."""
    count, width = D.shape
    for name in ("basis", "triangle", "column_basis", "column_triangle", "multiplier", "solution", "dual"):
        field_of(BLOCK, name)[...] = np.nan
    field_of(BLOCK, "basis")[:count, :width] = D
    only = np.count_nonzero(D, axis=1) == 1
    field_of(BLOCK, "singleton")[:count] = np.where(only, np.argmax(D != 0.0, axis=1), codes.NONE)
    field_of(BLOCK, "right_side")[:count] = b
    rank = _solve_in(BLOCK, count, width)
    return field_of(BLOCK, "solution")[:width].copy(), field_of(BLOCK, "multiplier")[:count].copy(), rank
