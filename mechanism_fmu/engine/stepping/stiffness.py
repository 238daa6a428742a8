"""Whether the motion is stiff, and by which method the next step is taken.

The explicit method tells by itself, as in DOPRI5 (Hairer, Wanner: Solving ODEs II, IV.2): its last two stages are both
at the end of the step, and h |k_7 - k_6| / |y_7 - y_6| is h times the size of the eigenvalue that matters, which is
at the border of the stability domain, 3.3, where stability limits the steps. The implicit one knows its Jacobian.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.method import METHOD
from ...tables.motion import Course, Stages
from ...tables.parts import Options
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from .rosenbrock import evaluations, fastest
from .runge_kutta import ABSOLUTE_FRACTION

_LAST = METHOD.last
#: Whether the stage before the last one is at the end of the step, too.
_TELLS = float(METHOD.c[METHOD.last - 1]) == 1.0
#: h times an eigenvalue is about 3.3 where stability limits the steps: it goes up and down by a tenth.
_AT_BORDER = 2.75
#: So many steps in turn must look stiff before the method is changed; twice as many each time that it was changed back.
#: DOPRI5 takes 15; an implicit step costs as much as five, so that it pays only for what stays stiff.
_IN_TURN = 60
_DOUBLES_AT_MOST = 4
#: Where even the shortest step is so many times as long as stability allows, nothing but stiffness makes it fail.
_FAR_BEYOND = 10.0
#: The first steps after an event are short, whatever the motion is: so many must not be worth it to change back.
_BACK_IN_TURN = 25
#: The explicit method is taken for steps that it can do in so many times the evaluations, or less.
_WORTH = 0.5
_BORDER = 3.3


@jit
def look_stiff(block: Array) -> None:
    """Of the step just tried: note how near to the border of stability it is, where it was explicit."""
    keep_small()
    if Course(block).counters[codes.IMPLICIT] == 1 or not _may_change(block) or not _TELLS:
        return
    s = Stages(block)
    slopes = places = 0.0
    work, alpha = Sizes(block).y_work, Sizes(block).y_alpha
    for i in range(Sizes(block).y_wear):
        if i < work or i >= alpha:
            scale = ABSOLUTE_FRACTION * s.scale[i] + abs(s.y_new[i])
            slope = (s.derivatives[_LAST, i] - s.derivatives[_LAST - 1, i]) / scale
            place = (s.y_new[i] - s.y_stage[i]) / scale
            slopes += slope * slope
            places += place * place
    s.looks_stiff[0] = s.tried[1] * math.sqrt(slopes / places) if places > 0.0 else 0.0


@jit
def is_beyond_explicit(block: Array) -> bool:
    """Whether the explicit step just tried, the shortest there is, fails by stiffness alone; then goes implicit."""
    keep_small()
    look_stiff(block)
    counters = Course(block).counters
    if counters[codes.IMPLICIT] == 1 or not _may_change(block) or not Stages(block).looks_stiff[0] > _FAR_BEYOND:
        return False
    counters[codes.STIFF] = 0
    counters[codes.IMPLICIT] = 1
    return True


@jit
def choose_method(block: Array) -> None:
    """After an accepted step: count what is stiff or is not, and change the method where that has gone on."""
    keep_small()
    counters = Course(block).counters
    implicit = counters[codes.IMPLICIT] == 1
    if implicit:
        counters[codes.COUNT_IMPLICIT] += 1
    if not _may_change(block):
        return
    in_turn = _BACK_IN_TURN
    if implicit:
        explicit_steps = Stages(block).tried[1] * fastest(block) / _BORDER
        changes = explicit_steps * _LAST < _WORTH * evaluations(block)
    else:
        changes = Stages(block).looks_stiff[0] > _AT_BORDER
        in_turn = _IN_TURN << min(counters[codes.COUNT_BACK], _DOUBLES_AT_MOST)
    if not changes:
        counters[codes.STIFF] = 0
        return
    counters[codes.STIFF] += 1
    if counters[codes.STIFF] >= in_turn:
        counters[codes.STIFF] = 0
        counters[codes.IMPLICIT] = 0 if implicit else 1
        if implicit:
            counters[codes.COUNT_BACK] += 1


@jit
def _may_change(block: Array) -> bool:
    return Options(block).settings[codes.METHOD] == codes.AUTOMATIC and Sizes(block).implicit > 0
