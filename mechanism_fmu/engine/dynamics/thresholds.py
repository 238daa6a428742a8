"""Thresholds of force elements: numbers that come to zero where a force begins, ends or goes over to another formula.

Within a step each keeps its side, so that forces are smooth there, also beyond the threshold; the step ends where one
comes to zero (`stepping.crossing`), and only then it changes its side. At events, all sides follow from the values.
"""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.kinds import FORCES, OPERATIONS
from ...tables.motion import Course, Pose
from ...tables.parts import Curves, Forces, Operations, Thresholds
from ...tolerances import PILED
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.kinematics import place_bodies
from ..scales import rate_scale
from .element import relative_angle, relative_speed
from .laws import WHERE, carry_out
from .point_forces import DAMPING, FREE_LENGTH, PRELOAD, SIDE, STIFFNESS, line_between
from .torsional import CONSTANT, RELAXED, SIDE as ANGLE_SIDE, SPRING_DAMPING, STIFFNESS as ANGLE_STIFFNESS

_SPRING_DAMPER = FORCES.number("spring_damper")
_NONLINEAR = FORCES.number("nonlinear_spring")
_ADD = OPERATIONS.number("add")
_SUBTRACT = OPERATIONS.number("subtract")
#: A sum is zero within this part of its terms: each of them carries a rounding, and so does the sum (4 half ulps).
_ROUNDING = 4.0 * 2.0**-53
#: Crossings of one threshold within this part of the mechanism's time are without progress: `PILED` of them, as by a
#: law that jumps back at its own condition, and each evaluation decides for itself.
NO_PROGRESS = 1e-9


@jit
def threshold_value(block: Array, at: Pose, n: int) -> float:
    """Value of a threshold at the bodies' poses; `thresholds.rounding` becomes the part of it that is rounding."""
    keep_apart()
    table = Thresholds(block)
    element = Forces(block)
    k = table.force[n]
    kind = element.kind[k]
    if kind in (_SPRING_DAMPER, _NONLINEAR):
        line = line_between(block, at, k)
        length, rate = line.length, line.speed
    else:
        length, rate = relative_angle(block, at, k), relative_speed(block, at, k)
    if table.kind[n] == codes.THRESHOLD_CONDITION:
        return _condition(block, n, length, rate)
    data = element.data[k]
    plus, minus, third = length, 0.0, 0.0
    side = 1.0
    if table.kind[n] == codes.THRESHOLD_PIECE:
        minus = Curves(block).piece_start[table.subject[n]]
    else:
        between_points = kind == _SPRING_DAMPER
        side = data[SIDE] if between_points else data[ANGLE_SIDE]
        minus = data[FREE_LENGTH] if between_points else data[RELAXED]
        if table.kind[n] == codes.THRESHOLD_PULL:
            damping = data[DAMPING] if between_points else data[SPRING_DAMPING]
            third = data[PRELOAD] if between_points else data[CONSTANT]
            if damping == 0.0 and third == 0.0:
                return 1.0  # zero where its stretch is
            stiffness = data[STIFFNESS] if between_points else data[ANGLE_STIFFNESS]
            plus, minus = stiffness * (length - minus), -damping * rate
    table.rounding[n] = _ROUNDING * (abs(plus) + abs(minus) + abs(third))
    value: float = side * (plus - minus + third)
    return value


@jit
def _condition(block: Array, n: int, length: float, rate: float) -> float:
    """The condition of an operation of a law."""
    keep_small()
    table = Thresholds(block)
    operation = Operations(block)
    k = table.force[n]
    carry_out(block, Forces(block).law[k], Forces(block).law_end[k], length, rate)
    result = operation.result
    of = operation.operands[table.subject[n]]
    a, b = result[of[0]], result[of[1]]
    if operation.kind[table.subject[n]] == WHERE:
        value = a
        a = b = 0.0
        kind = operation.kind[of[0]]
        if kind in (_ADD, _SUBTRACT):
            a, b = result[operation.operands[of[0], 0]], result[operation.operands[of[0], 1]]
    else:
        value = a - b
    table.rounding[n] = _ROUNDING * (abs(a) + abs(b))
    return float(value)


@jit
def beyond(block: Array, at: Pose, n: int) -> float:
    """Return the distance of a threshold from zero on the present side; negative where it has crossed."""
    value = threshold_value(block, at, n)
    return value if Thresholds(block).side[n] > 0 else -value


@jit
def is_watched(block: Array, n: int) -> bool:
    """Return whether a threshold has a side and counts, which the force of a slack one-sided spring does not."""
    table = Thresholds(block)
    if table.side[n] == codes.UNDECIDED:
        return False
    acts: bool = table.kind[n] != codes.THRESHOLD_PULL or table.side[n - 1] > 0
    return acts


@jit
def decide_sides(block: Array) -> None:
    """Give each threshold the side that its value at y_end has, but for those that cross without progress."""
    keep_apart()
    table = Thresholds(block)
    at = place_bodies(block, Course(block).y_end)
    for n in range(table.side.shape[0]):
        if table.crossings[n] <= PILED:
            table.side[n] = codes.ABOVE if threshold_value(block, at, n) > 0.0 else codes.BELOW


@jit
def clear_sides(block: Array, time: float) -> None:
    """Begin at `time` [s] without sides."""
    keep_small()
    table = Thresholds(block)
    for n in range(table.side.shape[0]):
        table.side[n] = codes.UNDECIDED
        table.crossings[n] = 0
        table.since[n] = time


@jit
def change_sides(block: Array) -> bool:
    """At STEP_END: change the sides of thresholds that have come to zero there; whether there are any."""
    keep_apart()
    table = Thresholds(block)
    time = Course(block).clock[codes.STEP_END]
    changed = False
    for n in range(table.side.shape[0]):
        if (time - table.since[n]) * rate_scale(block) > NO_PROGRESS and table.crossings[n] > 0:
            table.since[n] = time
            table.crossings[n] = 0
            if table.side[n] == codes.UNDECIDED:
                at = place_bodies(block, Course(block).y_end)
                table.side[n] = codes.ABOVE if threshold_value(block, at, n) > 0.0 else codes.BELOW
        if abs(table.side[n]) == codes.CROSSES:
            cross(block, n)
            changed = True
    return changed


@jit
def cross(block: Array, n: int) -> None:
    """Let a threshold go over to its other side at y_end."""
    keep_small()
    table = Thresholds(block)
    table.side[n] = codes.BELOW if table.side[n] > 0 else codes.ABOVE
    table.crossings[n] += 1
    if table.crossings[n] > PILED:
        table.side[n] = codes.UNDECIDED
    if table.kind[n] == codes.THRESHOLD_SIDE:
        pull = threshold_value(block, place_bodies(block, Course(block).y_end), n + 1)
        table.side[n + 1] = codes.ABOVE if pull > 0.0 else codes.BELOW
