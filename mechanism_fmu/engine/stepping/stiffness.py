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
from .rosenbrock import fastest
from .runge_kutta import ABSOLUTE_FRACTION

_LAST = METHOD.last
#: Whether the stage before the last one is at the end of the step, too.
_TELLS = float(METHOD.c[METHOD.last - 1]) == 1.0
#: Steps that look stiff in turn before the method is changed, and steps that do not before it is changed back.
_IN_TURN = 15
#: h times an eigenvalue is at the border of stability from here on.
_AT_BORDER = 3.25
#: And well within it below.
_WITHIN = 1.6


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
            scale = ABSOLUTE_FRACTION + abs(s.y_new[i])
            slope = (s.derivatives[_LAST, i] - s.derivatives[_LAST - 1, i]) / scale
            place = (s.y_new[i] - s.y_stage[i]) / scale
            slopes += slope * slope
            places += place * place
    s.looks_stiff[0] = s.tried[1] * math.sqrt(slopes / places) if places > 0.0 else 0.0


@jit
def choose_method(block: Array) -> None:
    """After an accepted step: count what is stiff or is not, and change the method where that has gone on."""
    keep_small()
    now = Course(block)
    if now.counters[codes.IMPLICIT] == 1:
        now.counters[codes.COUNT_IMPLICIT] += 1
    if not _may_change(block):
        return
    if now.counters[codes.IMPLICIT] == 1:
        changes = Stages(block).tried[1] * fastest(block) < _WITHIN
    else:
        changes = Stages(block).looks_stiff[0] > _AT_BORDER
    if not changes:
        now.counters[codes.STIFF] = 0
        return
    now.counters[codes.STIFF] += 1
    if now.counters[codes.STIFF] >= _IN_TURN:
        now.counters[codes.STIFF] = 0
        now.counters[codes.IMPLICIT] = 1 - now.counters[codes.IMPLICIT]


@jit
def _may_change(block: Array) -> bool:
    return Options(block).settings[codes.METHOD] == codes.AUTOMATIC and Sizes(block).implicit > 0
