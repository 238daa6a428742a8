"""Looks at a guard within the step last tried, on its dense output."""

from __future__ import annotations

import math
from typing import Any

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Pose, Stages
from ...tables.parts import Contacts
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..constraints.kinematics import place_bodies, place_pair
from ..contacts.guards import guard_value
from ..interpolation import dense_value, interpolate

#: Bisections of a bracket: 2^-60 of a step is below rounding.
BISECTIONS = 60


@jit
def place_at(block: Array, fraction: float) -> Pose:
    """Put the bodies where they are at `fraction` of the step."""
    keep_small()
    s = Stages(block)
    interpolate(s.new_dense, fraction, s.y_at)
    return place_bodies(block, s.y_at)


@jit
def value_at(block: Array, number: int, fraction: float) -> tuple[float, float]:
    """Value and rate of a guard at `fraction` of the step.

    Of a contact that depends on its two bodies alone, only these are placed: many may come down between two looks.
    """
    keep_small()
    contacts = Sizes(block).contacts
    if number < 2 * contacts:
        contact = number % contacts
        if Contacts(block).alpha[contact] == codes.NONE:
            at = _place_pair_at(block, Contacts(block).body_i[contact], Contacts(block).body_j[contact], fraction)
            return guard_value(block, at, number)
    at = place_at(block, fraction)
    return guard_value(block, at, number)


@jit
def _place_pair_at(block: Array, i: int, j: int, fraction: float) -> Pose:
    """As `place_at`, of two bodies alone: what a contact without contact coordinates depends on."""
    keep_small()
    s = Stages(block)
    n = Sizes(block).coordinates
    for end in range(2):
        first = 3 * (i if end == 0 else j)
        if first < n:
            for k in range(first, first + 3):
                s.y_at[k] = dense_value(s.new_dense, fraction, k)
                s.y_at[n + k] = dense_value(s.new_dense, fraction, n + k)
    return place_pair(block, s.y_at, i, j)


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


def falling(value: Any, false_positions: int, then_bisect: int) -> Any:
    """Make the function that finds where a value comes down to its limit between two looks.

    It takes (block, guard, number, before, above, after, below, limit, close): the value is more than its limit by
    `above` and `below` at two fractions of the step; it returns the end of an interval no longer than `close`. By false
    position, where the value at an end that stays counts half (Illinois); by bisection where it is no number at one
    end, or that leads nowhere, as where the value jumps behind two corners that meet.

    Args:
        value: compiled, of (block, guard, number, fraction of the step).
        false_positions: after so many looks, only bisections.
        then_bisect: of so many looks, the last one is a bisection.
    """

    @jit
    def falls(
        block: Array,
        guard: int,
        number: int,
        before: float,
        above: float,
        after: float,
        below: float,
        limit: float,
        close: float,
    ) -> float:
        keep_small()
        stayed = 0
        for look in range(2 * BISECTIONS):
            middle = 0.5 * (before + after)
            if look < false_positions and look % then_bisect < then_bisect - 1 and 0.0 < above < math.inf:
                place = (before * below - after * above) / (below - above)
                middle = max(min(place, after - 0.5 * close), before + 0.5 * close)
            if after - before <= close or not before < middle < after:
                break
            spare = value(block, guard, number, middle) - limit
            if spare < 0.0:
                after = middle
                below = spare
                if stayed < 0:
                    above *= 0.5
                stayed = -1
            else:
                before = middle
                above = spare
                if stayed > 0:
                    below *= 0.5
                stayed = 1
        return after

    return falls


@jit
def _guard_at(block: Array, _guard: int, number: int, fraction: float) -> float:
    return value_at(block, number, fraction)[0]


# a gap jumps where corners meet
_falls = falling(_guard_at, false_positions=16, then_bisect=4)


@jit
def falls_between(
    block: Array, number: int, before: float, above: float, after: float, below: float, floor: float, close: float
) -> float:
    """As `bisect`, where a guard is more than `floor` by `above` and `below` at the two fractions of the step.

    The end of an interval no longer than `close` (see `falling`).
    """
    found: float = _falls(block, codes.GUARD_NONE, number, before, above, after, below, floor, close)
    return found
