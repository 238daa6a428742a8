"""Oscillations: period, amplitude and power of a body that swings, from its motion; the motion itself does without.

What is known of one (columns in `codes`) is brought up to the time reached from the dense output of each of the
engine's own steps. So it does not depend on communication steps, and costs no events.
"""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.kinds import FORCES
from ...tables.motion import Course, Pose
from ...tables.parts import Forces, Oscillations
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..interpolation import dense_value
from ..vectors import copy
from .element import Element

_MIDDLE, _NOMINAL_PERIOD = FORCES.places("oscillation")
#: A step is looked at in so many parts, in each of which the body turns round, or passes the middle, once at most.
_PARTS = 4
_BISECTIONS = 60
_DAY = 86400.0
#: What is read, in the order of the class.
_PERIOD, _AMPLITUDE, _RATE, _POWER, _PASSAGES = range(5)


@jit
def begin_oscillations(block: Array) -> None:
    """Nothing is known yet but where the bodies stand and which way they turn."""
    keep_small()
    now = Course(block)
    n = Sizes(block).coordinates
    for number in range(Sizes(block).oscillations):
        k = _element(block, number)
        coordinate = 3 * Forces(block).body[k] + 2
        swing = Oscillations(block).swing[number]
        for column in range(codes.SWING_COLUMNS):
            swing[column] = 0.0
        swing[codes.SWING_SEEN] = now.clock[codes.TIME]
        swing[codes.SWING_SIDE] = _sign(now.y_end[coordinate] - Forces(block).data[k, _MIDDLE])
        swing[codes.SWING_SENSE] = _sign(now.y_end[n + coordinate])
        swing[codes.SWING_TIME] = -1.0


@jit
def observe(block: Array) -> None:
    """Bring what is known of all oscillations up to TIME, within the engine's own step or at its end."""
    for number in range(Sizes(block).oscillations):
        _bring_up(block, number, Oscillations(block).swing[number])


@jit
def _element(block: Array, number: int) -> int:
    """The force element that an oscillation is: they are the last ones."""
    first: int = Sizes(block).forces - Sizes(block).oscillations
    return first + number


@jit
def _sign(value: float) -> float:
    return -1.0 if value < 0.0 else 1.0


@jit
def _bring_up(block: Array, number: int, swing: Array) -> None:
    """Write to `swing` what the present step shows of an oscillation up to TIME.

    It is looked for in the whole step, whatever TIME is: the same instants are found at each of its times.
    """
    keep_small()
    clock = Course(block).clock
    if swing[codes.SWING_SEEN] < clock[codes.STEP_END] and clock[codes.STEP_SIZE] > 0.0:
        whole = (clock[codes.STEP_END] - clock[codes.STEP_START]) / clock[codes.STEP_SIZE]
        for part in range(_PARTS):
            _look_through(block, number, swing, whole * part / _PARTS, whole * (part + 1) / _PARTS)
    swing[codes.SWING_SEEN] = clock[codes.TIME]


@jit
def _look_through(block: Array, number: int, swing: Array, before: float, after: float) -> None:
    """Take up where, between two fractions of the step, the body turns round or passes the middle, if before TIME."""
    keep_small()
    k = _element(block, number)
    coordinate = 3 * Forces(block).body[k] + 2
    rate = Sizes(block).coordinates + coordinate
    middle = Forces(block).data[k, _MIDDLE]
    turning, passing = 2.0, 2.0
    if _sign(_at(block, after, rate)) != swing[codes.SWING_SENSE]:
        turning = _change(block, rate, 0.0, swing[codes.SWING_SENSE], before, after)
    if _sign(_at(block, after, coordinate) - middle) != swing[codes.SWING_SIDE]:
        passing = _change(block, coordinate, middle, swing[codes.SWING_SIDE], before, after)
    if turning < passing and _is_past(block, turning):
        _turn_round(swing, _at(block, turning, coordinate) - middle)
    if _is_past(block, passing):
        work = _at(block, passing, Sizes(block).y_work)
        _pass_middle(swing, _instant(block, passing), work)
    if passing <= turning and _is_past(block, turning):
        _turn_round(swing, _at(block, turning, coordinate) - middle)


@jit
def _at(block: Array, fraction: float, unknown: int) -> float:
    """An unknown at a fraction of the step."""
    value: float = dense_value(Course(block).dense, fraction, unknown)
    return value


@jit
def _change(block: Array, unknown: int, level: float, sign: float, before: float, after: float) -> float:
    """The fraction, from `before` to `after`, from which on an unknown minus a level has no longer this sign."""
    keep_small()
    for _ in range(_BISECTIONS):
        fraction = 0.5 * (before + after)
        if _sign(_at(block, fraction, unknown) - level) == sign:
            before = fraction
        else:
            after = fraction
    return after


@jit
def _instant(block: Array, fraction: float) -> float:
    clock = Course(block).clock
    instant: float = clock[codes.STEP_START] + fraction * clock[codes.STEP_SIZE]
    return instant


@jit
def _is_past(block: Array, fraction: float) -> bool:
    past: bool = fraction <= 1.0 and _instant(block, fraction) <= Course(block).clock[codes.TIME]
    return past


@jit
def _turn_round(swing: Array, beyond: float) -> None:
    """The body turns round at this angle from the middle [rad]."""
    keep_small()
    swing[codes.SWING_SENSE] = -swing[codes.SWING_SENSE]
    swing[codes.SWING_REACH] = max(swing[codes.SWING_REACH], abs(beyond))


@jit
def _pass_middle(swing: Array, time: float, work: float) -> None:
    """The body passes the middle at this time [s], at which this much work has been done on the mechanism [J]."""
    keep_small()
    if swing[codes.SWING_SIDE] > 0.0:
        swing[codes.SWING_ABOVE] = swing[codes.SWING_REACH]
    else:
        swing[codes.SWING_BELOW] = swing[codes.SWING_REACH]
        if swing[codes.SWING_PASSAGES] > 0.0:
            swing[codes.SWING_PERIOD] = time - swing[codes.SWING_TIME]
            swing[codes.SWING_POWER] = (work - swing[codes.SWING_WORK]) / swing[codes.SWING_PERIOD]
        swing[codes.SWING_PASSAGES] += 1.0
        swing[codes.SWING_TIME] = time
        swing[codes.SWING_WORK] = work
    swing[codes.SWING_SIDE] = -swing[codes.SWING_SIDE]
    swing[codes.SWING_REACH] = 0.0


@jit
def _read(block: Array, _at_: Pose, k: int, _y: Array, which: int) -> float:
    keep_small()
    number = k - _element(block, 0)
    swing = Oscillations(block).shown[number]
    copy(Oscillations(block).swing[number], swing)
    _bring_up(block, number, swing)
    period = swing[codes.SWING_PERIOD]
    value: float = swing[codes.SWING_TIME]
    if which == _PERIOD:
        value = period
    elif which == _AMPLITUDE:
        value = 0.0
        if swing[codes.SWING_ABOVE] > 0.0 and swing[codes.SWING_BELOW] > 0.0:
            value = 0.5 * (swing[codes.SWING_ABOVE] + swing[codes.SWING_BELOW])
    elif which == _RATE:
        value = 0.0
        if period > 0.0:
            value = _DAY * (Forces(block).data[k, _NOMINAL_PERIOD] / period - 1.0)
    elif which == _POWER:
        value = swing[codes.SWING_POWER]
    elif which == _PASSAGES:
        value = swing[codes.SWING_PASSAGES]
    return value


ELEMENTS = {"oscillation": Element(read=_read)}
