"""Laws of force of the user's own: a function `def law(x, v): ...` as a list of operations, and tables of points.

The function is called once, with numbers that remember what was done with them. What comes of it, a few operations in
the tables, is what the engine carries out, in Python and in every FMU: nothing is compiled for one model.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from inspect import signature
from itertools import pairwise
from typing import NamedTuple, NoReturn

import numpy as np

from ..tables.kinds import OPERATIONS
from .curves import Curve, Piece, Term, plain_places
from .errors import MechanismError, place_of
from .functions import Number, is_plain, where_positive
from .operators import Recorded

#: Most operations of one law.
MOST_OPERATIONS = 500
#: Up to this exponent, a whole power is the number times itself, times itself, ...
_ONE_BY_ONE = 12


class LawOperation(NamedTuple):
    """One operation of a law.

    Attributes:
        code: its number in `tables.kinds.OPERATIONS`.
        operands: the places of the operations whose results it takes, three; 0 where there are fewer.
        value: of a constant, which may follow from parameters.
    """

    code: int
    operands: tuple[int, int, int] = (0, 0, 0)
    value: Number = 0.0


@dataclass
class _Recording:
    """The operations of a law in their order. Each constant has its own, so that structure follows from no value."""

    operations: list[LawOperation] = field(default_factory=list)
    known: dict[tuple[str, tuple[int, ...]], int] = field(default_factory=dict)

    def apply(self, name: str, *operands: Number) -> LawNumber:
        """The number that an operation gives; an operand that is none of this law is a constant."""
        numbers = tuple(self._number(x) for x in operands)
        if (name, numbers) not in self.known:
            first, second, third = (*numbers, 0, 0, 0)[:3]
            self.known[name, numbers] = self._append(name, (first, second, third))
        return LawNumber(self, self.known[name, numbers])

    def _number(self, x: Number) -> int:
        if isinstance(x, LawNumber):
            if x.law is not self:
                raise MechanismError("A number of one law was used in another; a law must only use its own arguments.")
            return x.number
        if isinstance(x, Condition):
            x._refuse()
        if not _is_number(x):
            raise MechanismError(f"it calculates with {x!r}, but a law takes real numbers alone, one by one.")
        return self._append("constant", (0, 0, 0), float(x) if is_plain(x) else x)

    def ends_with(self, result: LawNumber) -> bool:
        """Whether a number is the result of the last operation so far."""
        return result.number == len(self.operations) - 1

    def _append(self, name: str, operands: tuple[int, int, int], value: Number = 0.0) -> int:
        if len(self.operations) == MOST_OPERATIONS:
            raise MechanismError(f"A law has more than {MOST_OPERATIONS} operations; make it shorter, or take a table.")
        self.operations.append(LawOperation(OPERATIONS.number(name), operands, value))
        return len(self.operations) - 1


class Condition:
    """A comparison of numbers of a law: to choose between values with `where`, never to branch."""

    __slots__ = ("margin", "swapped")
    __array_ufunc__ = None  # numbers of numpy leave it to this class to calculate

    def __init__(self, margin: LawNumber, swapped: bool = False) -> None:
        """The comparison margin > 0; swapped, not margin > 0."""
        self.margin, self.swapped = margin, swapped

    def choose(self, positive: Number, otherwise: Number) -> LawNumber:
        """`positive` where the comparison holds, else `otherwise`."""
        chosen = (otherwise, positive) if self.swapped else (positive, otherwise)
        return self.margin.law.apply("where_positive", self.margin, *chosen)

    def _refuse(self, *_: object) -> NoReturn:
        raise MechanismError(
            "A law must not branch on its arguments (if, and, or, not, max, min, or a comparison as a number): it is "
            "called only once. Choose values with where(x > 0, this, that), minimum, maximum or smoothstep of "
            "mechanism_fmu.model.functions; nest them for several conditions."
        )

    __bool__ = __float__ = __int__ = __and__ = __or__ = __invert__ = _refuse
    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = __rtruediv__ = __neg__ = _refuse


def _refuse_number(*_: object) -> NoReturn:
    raise MechanismError(
        "A law must not make plain numbers or text of its arguments (float, int, round, math.sin, an index): take sin, "
        " cos, tan, sqrt, atan2, exp, log, tanh, power, minimum, maximum, where and smoothstep of "
        "mechanism_fmu.model.functions."
    )


class LawNumber(Recorded):
    """An argument of a law, or what came of one.

    Attributes:
        law: the recording.
        number: of the operation whose result it is.

    Raises:
        MechanismError: it is branched on, or a plain number is made of it; the message says what to use instead.
    """

    __slots__ = ("law", "number")
    __array_ufunc__ = None  # numbers of numpy leave it to this class to calculate

    def __init__(self, law: _Recording, number: int) -> None:
        self.law, self.number = law, number

    def __repr__(self) -> str:
        return f"LawNumber({self.number})"

    def _binary(self, name: str, left: Number, right: Number) -> LawNumber:
        return self.law.apply(name, left, right)

    def __pow__(self, exponent: Number) -> Number:
        if not (isinstance(exponent, int | float | np.integer | np.floating) and float(exponent).is_integer()):
            return self.law.apply("power", self, exponent)
        whole = int(exponent)  # also of negative bases, of which the operation "power" gives NaN
        if whole == 0:
            return 1.0
        return self._times_itself(whole) if whole > 0 else 1.0 / self._times_itself(-whole)

    def _times_itself(self, times: int) -> LawNumber:
        """The product of so many of it, one by one up to the 12th power, by squares beyond."""
        result = self
        if times > _ONE_BY_ONE:
            half = self._times_itself(times // 2)
            result = half * half
        for _ in range(times % 2 if times > _ONE_BY_ONE else times - 1):
            result = result * self
        return result

    def __rpow__(self, base: Number) -> LawNumber:
        return self.law.apply("power", base, self)

    def __neg__(self) -> LawNumber:
        return self.law.apply("negate", self)

    def __pos__(self) -> LawNumber:
        return self

    def __abs__(self) -> LawNumber:
        return self.law.apply("maximum", self, -self)

    def __gt__(self, other: Number) -> Condition:
        return Condition(self - other)

    def __lt__(self, other: Number) -> Condition:
        return Condition(other - self)

    def __ge__(self, other: Number) -> Condition:
        return Condition(other - self, swapped=True)

    def __le__(self, other: Number) -> Condition:
        return Condition(self - other, swapped=True)

    def __bool__(self) -> bool:
        Condition(self)._refuse()

    __eq__ = __ne__ = Condition._refuse
    __float__ = __int__ = __index__ = __complex__ = __round__ = __trunc__ = __floor__ = __ceil__ = _refuse_number
    __format__ = __mod__ = __rmod__ = __floordiv__ = __rfloordiv__ = _refuse_number
    __hash__ = object.__hash__


#: A law: force [N] or torque [N m] from length [m] or angle [rad] and its rate.
Law = Callable[[Number, Number], Number]


def law_operations(law: Law, owner: str) -> tuple[LawOperation, ...]:
    """What a law does, as operations; the result is that of the last one.

    Args:
        law: is called with the length or angle, and its rate.
        owner: whose law it is, for messages.

    Raises:
        MechanismError: it is no function of two arguments, or cannot be recorded, with the line.
    """
    _require_two_arguments(law, owner)
    recording = _Recording()
    arguments = recording.apply("length"), recording.apply("rate")
    try:
        result = law(*arguments)
        if not _is_number(result):
            raise MechanismError(f"it returns {result!r}, but must return a number.")
        if not isinstance(result, LawNumber) or result.law is not recording or not recording.ends_with(result):
            recording.apply("add", result, 0.0)  # an argument, a constant or an earlier operation
    except (ArithmeticError, AttributeError, IndexError, KeyError, MechanismError, TypeError, ValueError) as error:
        raise MechanismError(f"The law of {owner} cannot be used, {place_of(error)}: {error}") from error
    return tuple(recording.operations)


def _require_two_arguments(law: Law, owner: str) -> None:
    """Refuse what is no function of two arguments before it is called: only mistakes within a law have a line."""
    if not callable(law):
        raise MechanismError(
            f"The law of {owner} cannot be used, as {law!r} is neither a function law(x, v) nor a curve."
        )
    try:
        taken = signature(law)
    except ValueError:
        return  # a function that does not say what it takes
    try:
        taken.bind(0.0, 0.0)
    except TypeError as error:
        raise MechanismError(
            f"The law of {owner} cannot be used, as it is called with two arguments, the length or angle and its rate, "
            f"also where it does not need the second: write law(x, v), not {getattr(law, '__name__', 'law')}{taken}."
        ) from error


def _is_number(x: object) -> bool:
    """Whether it is a number of a law, a real plain one, or a symbol."""
    if is_plain(x):
        return not isinstance(x, np.complexfloating)
    return isinstance(x, LawNumber) or hasattr(x, "sin")


# Laws as tables: a monotone cubic through points, and the energy that belongs to it.


def characteristic(points: Sequence[tuple[float, Number]]) -> Curve:
    """A force over a length, or a torque over an angle, through points: monotone cubic, straight beyond the ends.

    It rises and falls only where the points do, and its slope is continuous. The values may follow from parameters.

    Args:
        points: (x [m or rad], force [N] or torque [N m]) with increasing plain x, two or more.

    Raises:
        MechanismError: fewer than 2 points, or points that are no pairs, or places that do not increase or that depend
            on a parameter.

    Source: F. N. Fritsch and J. Butland, A method for constructing local monotone piecewise cubic interpolants,
        SIAM J. Sci. Stat. Comput. 5 (1984), with the ends as in PCHIP.
    """
    for number, point in enumerate(points, start=1):
        if not isinstance(point, Sequence | np.ndarray) or isinstance(point, str) or len(point) != 2:
            raise MechanismError(
                f"Point {number} of a characteristic is {point!r}, but each must be a pair (x, force or torque)."
            )
    places = plain_places([x for x, _ in points], "place")
    values = [value for _, value in points]
    widths = [after - before for before, after in pairwise(places)]
    if len(places) < 2 or not all(0.0 < width < float("inf") for width in widths):
        shown = ", ".join(f"{x:g}" for x in places)
        raise MechanismError(f"A characteristic needs 2 or more points at increasing places, but they are at {shown}.")
    secants = [(after - before) / width for (before, after), width in zip(pairwise(values), widths, strict=True)]
    slopes = _slopes(widths, secants)
    pieces = [Piece(places[0], (Term((values[0], slopes[0])),))]  # the first one holds before its start
    for k, (h, secant) in enumerate(zip(widths, secants, strict=True)):
        begin, end = slopes[k], slopes[k + 1]
        second, third = (3.0 * secant - 2.0 * begin - end) / h, (begin + end - 2.0 * secant) / (h * h)
        pieces.append(Piece(places[k], (Term((values[k], begin, second, third)),)))
    pieces.append(Piece(places[-1], (Term((values[-1], slopes[-1])),)))
    return Curve(tuple(pieces))


def _slopes(widths: list[float], secants: list[Number]) -> list[Number]:
    if len(secants) == 1:
        return [secants[0], secants[0]]
    inner = []
    for (h, after), (s, t) in zip(pairwise(widths), pairwise(secants), strict=True):
        v, w = 2.0 * after + h, after + 2.0 * h
        same = s * t
        inner.append(where_positive(same, (v + w) * same / where_positive(same, v * t + w * s, 1.0), 0.0))
    first = _end_slope(widths[0], widths[1], secants[0], secants[1])
    last = _end_slope(widths[-1], widths[-2], secants[-1], secants[-2])
    return [first, *inner, last]


def _end_slope(h: float, after: float, s: Number, t: Number) -> Number:
    """The slope at an end, by three points, but never against the first secant, nor beyond three times that."""
    slope = ((2.0 * h + after) * s - h * t) / (h + after)
    bounded = where_positive(s * t, slope, where_positive(slope * slope - 9.0 * s * s, 3.0 * s, slope))
    return where_positive(slope * s, bounded, 0.0)


def potential(curve: Curve, owner: str) -> Curve:
    """The energy of a force over a length: its integral, 0 where the first piece begins.

    Raises:
        MechanismError: a piece is no polynomial of at most the fourth degree, or the curve is periodic.
    """
    if curve.periodic:
        raise MechanismError(f"The characteristic of {owner} is periodic, so it has no energy; give it pieces instead.")
    pieces: list[Piece] = []
    at_start: Number = 0.0
    for number, piece in enumerate(curve.pieces):
        if any(not is_plain(t.amplitude) or t.amplitude != 0.0 or len(t.polynomial) > 5 for t in piece.terms):
            raise MechanismError(
                f"Piece {number + 1} of the characteristic of {owner} has a harmonic or a degree above 4; take "
                "polynomials up to the fourth degree, or write a function law(x, v)."
            )
        if number > 0:
            at_start = _value(pieces[-1], piece.start)
        terms = [Term((0.0, *(c / (k + 1.0) for k, c in enumerate(term.polynomial)))) for term in piece.terms]
        pieces.append(Piece(piece.start, (Term((at_start,)), *terms)))
    return Curve(tuple(pieces), curve.start, curve.span)


def _value(piece: Piece, at: Number) -> Number:
    total: Number = 0.0
    for term in piece.terms:
        value: Number = 0.0
        for coefficient in reversed(term.polynomial):
            value = value * (at - piece.start) + coefficient
        total = total + value
    return total
