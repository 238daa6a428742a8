"""Singular configurations: where the rank of the active rows drops, the motion can go on along more than one branch.

At such an instant the rows depend on each other although they do not just before and after, as in a parallelogram that
lies flat. A step may well pass over it, and come out on any branch. So after each step the independence of the rows at
its stages is looked at: where it has a dip, the least value is sought, and that decides.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.method import METHOD
from ...tables.motion import Course, LinearSystem, Loads, Rubs, Stages
from ...tables.parts import Bodies
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..constraints.friction_rows import rubs
from ..constraints.kinematics import place_bodies
from ..constraints.rows import active_rows
from ..dynamics.forces import set_time
from ..dynamics.linear_solve import factorise, write_matrix
from ..interpolation import interpolate
from ..scales import length_scale

_LAST = METHOD.last
_INTERIOR = METHOD.interior
#: The stage next to the end of the step.
_BEFORE_LAST = _INTERIOR[-1]
#: Rows with less independence than this (a squared sine) are singular: the configuration is passed, not just neared.
SINGULAR_BELOW = 1e-10
#: Dips above this are no sign of a singular configuration.
_LOOK_BELOW = 0.1
_SEARCH_STEPS = 60
#: A sine that could fall so many times as steeply as has been seen, and would yet stay above this, falls to no zero.
_STEEPER = 3.0
_SINE_ABOVE = 1e-3
#: A dip that seems to lie between two steps is sought from so much of a step before the second one on.
_BACK = 0.5
_GOLDEN = 0.3819660112501051


@jit
def independence(block: Array) -> float:
    """How independent the active rows are, by the last acceleration; 0 when their rank has dropped."""
    keep_small()
    system = LinearSystem(block)
    if system.rank[0] < Course(block).counters[codes.RANK]:
        return 0.0
    value: float = system.independence[0]
    return value


@jit
def note_rank(block: Array) -> None:
    """After an event or a change of inputs, and the acceleration there: the rank that the rows have from now on.

    And the sense in which the forces of what slips agree: to change it, they must become infinite on the way.
    """
    now = Course(block)
    now.counters[codes.SENSE] = 1
    if rubs(block):
        now.counters[codes.SENSE] = Rubs(block).sense[0]
    now.counters[codes.RANK] = LinearSystem(block).rank[0]
    now.independence_end[0] = LinearSystem(block).independence[0]


@jit
def is_singular(block: Array) -> bool:
    """Whether the step last tried, from y_start on, leads over a singular configuration, or begins in one."""
    keep_small()
    now = Course(block)
    at = Stages(block).independence
    at[0] = now.independence_end[0]
    inside = at[_BEFORE_LAST]
    for k in _INTERIOR:
        inside = min(inside, at[k])
    if LinearSystem(block).rank[0] > now.counters[codes.RANK]:
        return True
    before = now.counters[codes.FALLING] == 1 and at[1] > at[0]
    dips = before or (inside < at[0] and inside < at[_LAST])
    if not dips or min(inside, at[0]) > _LOOK_BELOW:
        return False
    return least_independence(block, -_BACK if before else 0.0)[0] < SINGULAR_BELOW


@jit
def keep_independence(block: Array) -> None:
    """Of the step last tried, which is accepted: how independent the rows are at its end, and whether that falls."""
    now = Course(block)
    at = Stages(block).independence
    now.independence_end[0] = at[_LAST]
    now.counters[codes.FALLING] = 0
    if at[_LAST] < at[_BEFORE_LAST]:
        now.counters[codes.FALLING] = 1


@jit
def least_independence(block: Array, low: float) -> tuple[float, float]:
    """The least independence from `low` on in the step last tried, by golden section on the dense output; and where.

    Or one that is not the least, where the least is none of a singular configuration: there, the sine, the root of the
    independence, falls to zero and rises again, each nearly straight.
    """
    keep_small()
    high = 1.0
    left = low + _GOLDEN * (high - low)
    right = high - _GOLDEN * (high - low)
    at_left = math.sqrt(_independence_at(block, left))
    at_right = math.sqrt(_independence_at(block, right))
    steepest = abs(at_left - at_right) / (right - left)
    for _ in range(_SEARCH_STEPS):
        if at_left < at_right:
            high = right
            right = left
            at_right = at_left
            left = low + _GOLDEN * (high - low)
            at_left = math.sqrt(_independence_at(block, left))
        else:
            low = left
            left = right
            at_left = at_right
            right = high - _GOLDEN * (high - low)
            at_right = math.sqrt(_independence_at(block, right))
        if right > left:
            steepest = max(steepest, abs(at_left - at_right) / (right - left))
        if min(at_left, at_right) > _STEEPER * steepest * (high - low) + _SINE_ABOVE:
            break
    return min(at_left, at_right) ** 2, 0.5 * (low + high)


@jit
def _independence_at(block: Array, fraction: float) -> float:
    """As `independence`, of the bare rows: very different masses make rows look alike that are not."""
    keep_small()
    s = Stages(block)
    interpolate(s.new_dense, fraction, s.y_at)
    set_time(block, s.tried[0] + fraction * s.tried[1])
    at = place_bodies(block, s.y_at)
    count = active_rows(block, at)
    weight = Loads(block).weight
    root = Bodies(block).inverse_root_mass
    length = length_scale(block)
    for k in range(Sizes(block).coordinates):
        # In scratch of the start, which is over. A loop of ones becomes a call of what only macOS has.
        weight[k] = root[k] / root[k] if k % 3 == 2 else length
    write_matrix(block, count, weight)
    factorise(block, count, Sizes(block).coordinates)
    return independence(block)
