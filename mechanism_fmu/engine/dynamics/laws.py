"""Laws of force of the user's own: their operations carried out (see `mechanism_fmu.model.laws`), or their table."""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.kinds import OPERATIONS
from ...tables.parts import Curves, Forces, Operations, Thresholds
from ..compiler.by_kind import by_kind
from ..compiler.subset import jit, keep_small
from ..elementary import atan2, cos, exp, log, power, sin, tan, tanh
from ..profiles.curves import evaluate_piece, piece_at

_CONSTANT = OPERATIONS.number("constant")
_LENGTH = OPERATIONS.number("length")
_RATE = OPERATIONS.number("rate")
MINIMUM = OPERATIONS.number("minimum")
WHERE = OPERATIONS.number("where_positive")


@jit
def _add(a: float, b: float, _c: float) -> float:
    return a + b


@jit
def _subtract(a: float, b: float, _c: float) -> float:
    return a - b


@jit
def _multiply(a: float, b: float, _c: float) -> float:
    return a * b


@jit
def _divide(a: float, b: float, _c: float) -> float:
    return a / b


@jit
def _negate(a: float, _b: float, _c: float) -> float:
    return -a


@jit
def _minimum(a: float, b: float, _c: float) -> float:
    return a if a < b else b


@jit
def _maximum(a: float, b: float, _c: float) -> float:
    return a if a > b else b


@jit
def _where_positive(a: float, b: float, c: float) -> float:
    return b if a > 0.0 else c


# Functions have no value outside their domain, where plain Python would raise: what is not chosen may lie there.


@jit
def _sqrt(a: float, _b: float, _c: float) -> float:
    return math.sqrt(a) if a >= 0.0 else math.nan


@jit
def _sin(a: float, _b: float, _c: float) -> float:
    return sin(a)


@jit
def _cos(a: float, _b: float, _c: float) -> float:
    return cos(a)


@jit
def _tan(a: float, _b: float, _c: float) -> float:
    return tan(a)


@jit
def _atan2(a: float, b: float, _c: float) -> float:
    return atan2(a, b)


@jit
def _exp(a: float, _b: float, _c: float) -> float:
    return exp(a)


@jit
def _log(a: float, _b: float, _c: float) -> float:
    return log(a)


@jit
def _tanh(a: float, _b: float, _c: float) -> float:
    return tanh(a)


@jit
def _power(a: float, b: float, _c: float) -> float:
    return power(a, b)


_result = by_kind(
    OPERATIONS.numbered(
        {
            "add": _add,
            "subtract": _subtract,
            "multiply": _multiply,
            "divide": _divide,
            "negate": _negate,
            "minimum": _minimum,
            "maximum": _maximum,
            "where_positive": _where_positive,
            "sqrt": _sqrt,
            "sin": _sin,
            "cos": _cos,
            "tan": _tan,
            "atan2": _atan2,
            "exp": _exp,
            "log": _log,
            "tanh": _tanh,
            "power": _power,
        }
    ),
    "a, b, c",
    "math.nan",
)


@jit
def _chosen(kind: int, above: bool, a: float, b: float, c: float) -> float:
    """The result of a choice whose condition (a, or a - b of the lesser and the greater) is above zero or is not."""
    if kind == WHERE:
        return b if above else c
    return b if above == (kind == MINIMUM) else a


@jit
def carry_out(block: Array, first: int, end: int, length: float, rate: float) -> float:
    """The result of the last of the operations from `first` up to `end`."""
    table = Operations(block)
    result = table.result
    for n in range(first, end):
        kind = table.kind[n]
        if kind == _CONSTANT:
            result[n] = table.value[n]
        elif kind == _LENGTH:
            result[n] = length
        elif kind == _RATE:
            result[n] = rate
        else:
            of = table.operands[n]
            a, b, c = result[of[0]], result[of[1]], result[of[2]]
            held = table.threshold[n]
            chosen = math.nan
            if held != codes.NONE and Thresholds(block).side[held] != codes.UNDECIDED:
                chosen = _chosen(kind, Thresholds(block).side[held] > 0, a, b, c)
            if math.isnan(chosen):  # beyond the threshold, what is chosen may have no value
                chosen = _result(kind, a, b, c)
            result[n] = chosen
    value: float = result[end - 1]
    return value


@jit
def by_law(block: Array, k: int, length: float, rate: float) -> tuple[float, float, float]:
    """Force or torque of the law of element `k`, and the powers that come in and are lost [W]: nothing is lost."""
    keep_small()
    table = Forces(block)
    if table.law[k] == table.law_end[k]:
        return law_energy(block, k, length)[1], 0.0, 0.0
    pull = carry_out(block, table.law[k], table.law_end[k], length, rate)
    return pull, -pull * rate, 0.0


@jit
def law_energy(block: Array, k: int, length: float) -> tuple[float, float]:
    """Energy of a law that is a table [J], and its derivative, which is the force or torque; of others zero."""
    number = Forces(block).curve[k]
    if number < 0:
        return 0.0, 0.0
    piece = piece_at(block, number, length)
    first = Curves(block).piece[number]
    last = first + Curves(block).pieces[number] - 1
    behind = Forces(block).threshold[k] - first - 1  # of a piece, the threshold where it begins
    side = Thresholds(block).side
    while piece > first and side[behind + piece] < 0:
        piece -= 1
    while piece < last and side[behind + piece + 1] > 0:
        piece += 1
    energy, slope, _, _ = evaluate_piece(block, piece, length)
    return energy, slope
