"""Steps of 1 s whose motion is a polynomial that a test writes."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.polynomial import Polynomial

from mechanism_fmu import codes
from mechanism_fmu.engine.compiler.subset import entry
from mechanism_fmu.engine.stepping.events import first_event
from mechanism_fmu.tables.layout import field_of

T = Polynomial([0.0, 1.0])
#: What the search answers when there is no event.
NOTHING = (codes.GUARD_NONE, codes.NONE, 2.0)

Block = np.ndarray[Any, Any]


@entry
def search(block: Block) -> tuple[int, int, float]:
    """The engine's `first_event`: guard, contact and fraction of the step."""
    return first_event(block)


def write(block: Block, motions: dict[int, Polynomial]) -> None:
    """Make the dense output: coordinate k moves as `motions[k]`, of degree 4 at most; the others stay at 0."""
    dense = field_of(block, "new_dense")
    coordinates = (dense.shape[1] - 2) // 2  # then as many rates and two energies
    dense[:] = 0.0
    field_of(block, "tried")[:] = 0.0, 1.0
    for k, motion in motions.items():
        dense[:5, k] = coefficients(motion)
        dense[:5, coordinates + k] = coefficients(motion.deriv())


def coefficients(x: Polynomial) -> list[float]:
    """Of the dense output: x = d0 + t (d1 + (1 - t) (d2 + t (d3 + (1 - t) d4)))."""
    kept = []
    for divisor in (T, 1 - T, T, 1 - T):
        root = 0.0 if divisor is T else 1.0
        kept.append(x(root))
        x = (x - x(root)) // divisor
    return [*kept, x(0.0)]
