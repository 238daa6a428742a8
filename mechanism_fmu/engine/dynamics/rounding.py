"""Rounding of forces and impulses along rows, by what acts there: the same for a grain and for a crane.

The least z of D z = b is rounded in the metric of the masses: by a share of the largest multiplier times the length of
its row of D = Phi_q M^-1/2. What is summed up in a row before that is rounded by a share of its terms: of the rates
before an impact, and of forces and gamma by a share of the acceleration that the present rate stands for, to which each
force has contributed its magnitude (`scaling.note_rate`). That is a constant between events: forces fall through zero
as they are.
"""

from __future__ import annotations

import math

from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Rows
from ...tables.sizes import Sizes
from ...tolerances import ACCELERATIONS_WITHIN, PUSHES_SHARE, PUSHES_WITHIN, SPEEDS_SHARE
from ..compiler.subset import jit, keep_small
from ..constraints.rows import row_response
from ..scales import pair_rate, row_unit


@jit
def note_level(block: Array, count: int) -> None:
    """Write to `linear_system.level` the rounding of the last solve, of `count` rows [N/kg^1/2, N s/kg^1/2]."""
    keep_small()
    system = LinearSystem(block)
    most = 0.0
    for r in range(count):
        if system.multiplier[r] != 0.0:
            most = max(most, system.multiplier[r] * system.multiplier[r] * row_response(block, r))
    system.level[0] = PUSHES_SHARE * math.sqrt(most)


@jit
def acceleration_rounding(block: Array, row: int) -> float:
    """What the acceleration along a row may miss, behind `note_level`."""
    return _part(block, row, ACCELERATIONS_WITHIN)


@jit
def force_rounding(block: Array, row: int) -> float:
    """Rounding of the force along a row [N, N m], behind `note_level`."""
    response = row_response(block, row)
    return _part(block, row, PUSHES_WITHIN) / response if response > 0.0 else 0.0


@jit
def _part(block: Array, row: int, part: float) -> float:
    """A part of the acceleration along a row by what acts, and the rounding of the last solve."""
    rate = pair_rate(block, Rows(block).body[row, 0], Rows(block).body[row, 1])
    own = row_unit(block, row) * rate * rate
    rounding: float = part * own + LinearSystem(block).level[0] * math.sqrt(row_response(block, row))
    return rounding


@jit
def speed_rounding(block: Array, row: int, size: float) -> float:
    """Rounding of the rate along a row behind an impact, of terms of this `size`, and of the rates before it."""
    keep_small()
    entry = Rows(block).jacobian[row]
    n = Sizes(block).coordinates
    size += row_unit(block, row) * pair_rate(block, Rows(block).body[row, 0], Rows(block).body[row, 1])
    for end in range(2):
        first = 3 * Rows(block).body[row, end]
        for k in range(first, min(first + 3, n)):
            size += abs(entry[k] * Course(block).y_end[n + k])
    rounding: float = SPEEDS_SHARE * size + LinearSystem(block).level[0] * math.sqrt(row_response(block, row))
    return rounding


@jit
def impulse_rounding(block: Array, row: int) -> float:
    """Rounding of the impulse along a row [N s, N m s], behind `note_level`."""
    response = row_response(block, row)
    return LinearSystem(block).level[0] / math.sqrt(response) if response > 0.0 else 0.0


@jit
def over_rounding(block: Array, force: float, row: int) -> float:
    """A force along a row over its rounding; 0 where nothing acts."""
    rounding = force_rounding(block, row)
    return force / rounding if rounding > 0.0 else 0.0
