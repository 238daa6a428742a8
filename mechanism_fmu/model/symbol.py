"""Symbolic numbers that record how they came about: what a parameters-to-tables function is traced with."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NoReturn

from . import functions
from .errors import MechanismError
from .findings import Finding
from .functions import Number, is_plain
from .operators import Recorded

#: Operations on plain numbers.
APPLY: dict[str, Callable[..., float]] = {
    "add": operator.add,
    "subtract": operator.sub,
    "multiply": operator.mul,
    "divide": operator.truediv,
    "negate": operator.neg,
    "sin": functions.sin,
    "cos": functions.cos,
    "tan": functions.tan,
    "sqrt": functions.sqrt,
    "atan2": functions.atan2,
    "where_positive": functions.where_positive,
}


@dataclass(frozen=True)
class Operation:
    """One step of a calculation.

    Attributes:
        name: "parameter", "constant", "add", "subtract", "multiply", "divide", "negate", "sin", "cos", "tan", "sqrt",
            "atan2" (y, x) or "where_positive" (condition, positive, otherwise).
        operands: numbers of the operations whose results it takes; all are earlier ones.
        value: of a constant, or the place of a parameter among all parameters.
    """

    name: str
    operands: tuple[int, ...] = ()
    value: float = 0.0


@dataclass(frozen=True)
class Limits:
    """What is known of a parameter's values: they are finite, from `low` to `high`, and perhaps whole numbers."""

    low: float
    high: float
    whole: bool = False


@dataclass
class Recorder:
    """The operations of a calculation in their order, each once.

    Nothing is simplified or reordered: the same operations on floats give the same numbers to the last bit.

    Attributes:
        operations: them.
        refusals: what helpers refuse in it (`findings.refuse`), in their order; floats are refused at the first that
            applies.
    """

    operations: list[Operation] = field(default_factory=list)
    refusals: list[Finding] = field(default_factory=list)
    _starts: dict[int, float] = field(default_factory=dict)
    _nominal: list[float] = field(default_factory=list)
    _limits: dict[int, Limits] = field(default_factory=dict)
    _known: dict[tuple[str, tuple[int, ...], str], int] = field(default_factory=dict)

    def parameter(self, place: int, limits: Limits | None = None, start: float = math.nan) -> Symbol:
        """The symbol of the parameter at a place; its limits and the value at which it starts may be known."""
        symbol = Symbol(self, self._number("parameter", (), float(place)))
        self._starts[symbol.number] = start
        if limits is not None:
            self._limits[symbol.number] = limits
        return symbol

    def limits(self, symbol: Symbol) -> Limits | None:
        """The limits of a parameter; of the result of any other operation, none are known."""
        return self._limits.get(symbol.number)

    def nominal(self, symbol: Symbol) -> float:
        """The value of a symbol for the values at which all parameters start; NaN where it has none."""
        for number, operation in enumerate(self.operations[len(self._nominal) :], len(self._nominal)):
            operands = [self._nominal[i] for i in operation.operands]
            value = self._starts.get(number, operation.value)
            if operands:
                try:
                    value = APPLY[operation.name](*operands)
                except (ArithmeticError, MechanismError, ValueError):
                    value = math.nan
            self._nominal.append(value)
        return self._nominal[symbol.number]

    def apply(self, name: str, *operands: Number) -> Symbol:
        """The symbol of an operation's result; operands are symbols of this recorder and plain numbers."""
        return Symbol(self, self._number(name, tuple(self._operand(x) for x in operands)))

    def _operand(self, x: Number) -> int:
        if not isinstance(x, Symbol):
            return self._number("constant", (), float(x))
        if x.recorder is not self:
            raise MechanismError("A number of one trace was used in another; keep no parameter values between calls.")
        return x.number

    def _number(self, name: str, operands: tuple[int, ...], value: float = 0.0) -> int:
        key = (name, operands, value.hex())  # as text, 0 and -0 are two
        if key not in self._known:
            self._known[key] = len(self.operations)
            self.operations.append(Operation(name, operands, value))
        return self._known[key]


def _refuse(*_: object) -> NoReturn:
    raise MechanismError(
        "A parameters-to-tables function must not branch on a parameter, compare it, or turn it into a plain number or "
        "text (if, <, ==, abs, max, float, int, math.sin ...): choose between values with where_positive, and take "
        "sin, cos, tan, sqrt and atan2, too, from mechanism_fmu.model.functions."
    )


def _refuse_power(*_: object) -> NoReturn:
    raise MechanismError(
        "A parameters-to-tables function must not use **, // or % on a parameter: not every target carries them out to "
        "the same bits. Write x * x, or sqrt(x)."
    )


class Symbol(Recorded):
    """A number of a calculation that is being recorded: it can be calculated with, but has no value to look at.

    Attributes:
        recorder: of the calculation.
        number: of the operation that it is the result of.

    Raises:
        MechanismError: it is compared, or a plain number is made of it; the message says what to use instead.
    """

    __slots__ = ("number", "recorder")

    def __init__(self, recorder: Recorder, number: int) -> None:
        self.recorder, self.number = recorder, number

    def __repr__(self) -> str:
        return f"Symbol({self.number})"

    def __neg__(self) -> Symbol:
        return self.recorder.apply("negate", self)

    def __pos__(self) -> Symbol:
        return self

    @property
    def limits(self) -> Limits | None:
        """What is known of its values, where it is a parameter and nothing more."""
        return self.recorder.limits(self)

    @property
    def nominal(self) -> float:
        """Its value where all parameters have the values at which they start (`functions.nominal`)."""
        return self.recorder.nominal(self)

    def sin(self) -> Symbol:
        """Sine."""
        return self.recorder.apply("sin", self)

    def cos(self) -> Symbol:
        """Cosine."""
        return self.recorder.apply("cos", self)

    def tan(self) -> Symbol:
        """Tangent."""
        return self.recorder.apply("tan", self)

    def sqrt(self) -> Symbol:
        """Square root."""
        return self.recorder.apply("sqrt", self)

    def arctan2(self, x: Number) -> Symbol:
        """Angle of the point (x, this number)."""
        return self.recorder.apply("atan2", self, x)

    def where_positive(self, positive: Number, otherwise: Number) -> Symbol:
        """`positive` where this number is positive, else `otherwise`."""
        return self.recorder.apply("where_positive", self, positive, otherwise)

    def refuse(self, finding: Finding) -> None:
        """Keep what is refused where this number is positive: `findings.refuse`."""
        self.recorder.refusals.append(finding)

    def _binary(self, name: str, left: Number, right: Number) -> Number:
        if not all(isinstance(x, Symbol) or is_plain(x) for x in (left, right)):
            return NotImplemented
        return self.recorder.apply(name, left, right)

    __bool__ = __lt__ = __le__ = __gt__ = __ge__ = _refuse
    __eq__ = __ne__ = _refuse
    __float__ = __int__ = __index__ = __complex__ = _refuse
    __abs__ = __round__ = __trunc__ = __floor__ = __ceil__ = __format__ = _refuse
    __pow__ = __rpow__ = __mod__ = __rmod__ = __floordiv__ = __rfloordiv__ = _refuse_power
    __hash__ = object.__hash__
