"""Which unknown limits the size of the steps: the one whose error is largest, measured by its tolerance."""

from __future__ import annotations

from ..block.layout import Array
from ..block.motion import stages
from ..block.parts import sizes
from ..compiler.subset import jit, keep_small
from .dormand_prince import scaled_error


@jit
def note_stiffest(block: Array) -> None:
    """Write the number of that unknown of the step last tried into `stages.stiffest`, for a message."""
    keep_small()
    s = stages(block)
    work = 2 * sizes(block).coordinates
    worst = -1.0
    for i in range(sizes(block).unknowns):
        if i == work or i == work + 1:
            continue  # work and loss follow from the motion
        error = abs(scaled_error(block, i, s.tried[1]))
        if not error <= worst:
            worst = error
            s.stiffest[0] = i
