"""Looks at a guard within the step last tried, on its dense output."""

from __future__ import annotations

from ...tables.declare import Array
from ...tables.motion import Pose, Stages
from ..compiler.subset import jit, keep_small
from ..constraints.kinematics import place_bodies
from ..contacts.guards import guard_value
from ..interpolation import interpolate

#: Bisections of a bracket: 2^-60 of a step is below rounding.
BISECTIONS = 60
#: After so many false positions, bisections.
_FALSE_POSITIONS = 16


@jit
def place_at(block: Array, fraction: float) -> Pose:
    """Put the bodies where they are at `fraction` of the step."""
    keep_small()
    s = Stages(block)
    interpolate(s.new_dense, fraction, s.y_at)
    return place_bodies(block, s.y_at)


@jit
def value_at(block: Array, number: int, fraction: float) -> tuple[float, float]:
    """Value and rate of a guard at `fraction` of the step."""
    keep_small()
    at = place_at(block, fraction)
    return guard_value(block, at, number)


@jit
def bisect(block: Array, number: int, before: float, after: float, floor: float) -> float:
    """The fraction at which a guard, above `floor` at `before` and not at `after`, comes down to it."""
    keep_small()
    for _ in range(BISECTIONS):
        middle = 0.5 * (before + after)
        if middle <= before or middle >= after:
            return after
        if value_at(block, number, middle)[0] > floor:
            before = middle
        else:
            after = middle
    return after


@jit
def falls_between(
    block: Array, number: int, before: float, above: float, after: float, below: float, floor: float, close: float
) -> float:
    """As `bisect`, where a guard is more than `floor` by `above` and `below` at the two fractions of the step.

    The end of an interval no longer than `close`. By false position, where the value at an end that stays counts half
    (Illinois); where the value jumps, as behind two corners that meet, false positions lead nowhere: by bisection.
    """
    keep_small()
    stayed = 0
    for look in range(2 * BISECTIONS):
        middle = 0.5 * (before + after)
        if above > 0.0 and look < _FALSE_POSITIONS and look % 4 < 3:
            middle = (before * below - after * above) / (below - above)
            middle = max(min(middle, after - 0.5 * close), before + 0.5 * close)
        if after - before <= close or not before < middle < after:
            break
        value = value_at(block, number, middle)[0] - floor
        if value > 0.0:
            before = middle
            above = value
            if stayed > 0:
                below *= 0.5
            stayed = 1
        else:
            after = middle
            below = value
            if stayed < 0:
                above *= 0.5
            stayed = -1
    return after
