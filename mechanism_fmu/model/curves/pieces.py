"""Functions of one variable in pieces, that parts of a mechanism follow; and splines through given points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...codes import AMPLITUDE
from ..errors import MechanismError
from ..findings import plain
from ..functions import Number, is_plain

# Functions of one variable: the profiles of cams and slots, and the motions of drivers.
#
# A curve consists of pieces, each of which begins at a value of the variable; a piece is a sum of terms, and a term is
# a polynomial of at most the fifth degree plus one harmonic. So the engine knows three derivatives of all of them. How
# to make them: `profiles` and `motions` beside this file.


@dataclass(frozen=True)
class Term:
    """Sum over k of polynomial[k] xi^k, plus amplitude sin(frequency xi + phase); xi counts from the piece's start.

    Attributes:
        polynomial: at most six coefficients, constant first; the k-th in units of the curve / unit of the variable^k.
        amplitude: of the harmonic, in the unit of the curve.
        frequency: angular, [1/unit of the variable], e.g. [rad/s].
        phase: [rad].

    Raises:
        MechanismError: one of them is of the wrong kind, or there are more than six coefficients.

    Source: definition: the sum above.
    """

    polynomial: tuple[Number, ...] = ()
    amplitude: Number = 0.0
    frequency: Number = 0.0
    phase: Number = 0.0

    def __post_init__(self) -> None:
        """Refuse arguments of the wrong kind here, where the traceback still points at the line that gives them."""
        _require_tuple(self, "polynomial", "coefficients, constant first: Term((1.0, 2.0))")
        for k, coefficient in enumerate(self.polynomial):
            _require_number(f"Term: coefficient {k} of the polynomial", coefficient)
        if len(self.polynomial) > AMPLITUDE:
            raise MechanismError(
                f"Term: a polynomial of {len(self.polynomial)} coefficients; {AMPLITUDE} is the most: give several "
                "pieces."
            )
        for what in ("amplitude", "frequency", "phase"):
            _require_number(f"Term: {what}", getattr(self, what))

    def data(self) -> tuple[Number, ...]:
        """The term's row of the table `term_data`."""
        coefficients = (*self.polynomial, *[0.0] * (6 - len(self.polynomial)))
        return (*coefficients, self.amplitude, self.frequency, self.phase)


@dataclass(frozen=True)
class Piece:
    """A piece of a curve, from `start` to the start of the next one: the sum of its terms.

    Attributes:
        start: where it begins, in the unit of the curve's variable.
        terms: what is added up.

    Raises:
        MechanismError: `start` is no number, or `terms` is no tuple of `Term`s.
    """

    start: Number
    terms: tuple[Term, ...]

    def __post_init__(self) -> None:
        """Refuse arguments of the wrong kind, as `Term` does."""
        _require_number("Piece: start", self.start)
        _require_tuple(self, "terms", "terms: Piece(0.0, (constant(1.0),))")
        for number, term in enumerate(self.terms, start=1):
            _require_kind(f"Piece: entry {number} of terms", term, Term, "constant(1.0) or Term((1.0, 2.0))")


@dataclass(frozen=True)
class Smoothing:
    """Assumptions and results of a smoothing spline.

    Attributes:
        noise: standard deviation of the points about the true curve, as given [unit of the curve].
        scatter: the same, estimated from the points alone [unit of the curve].
        points: how many there are.
        pieces: of the spline.
        degree: of its pieces.
        rms: root mean square of the residuals, points minus spline [unit of the curve].
        largest: largest residual [unit of the curve].
        second_derivative_change: largest difference of the second derivative, at a point, from that of the spline
            through all points [unit of the curve / unit of its variable^2].
    """

    noise: float
    scatter: float
    points: int
    pieces: int
    degree: int
    rms: float
    largest: float
    second_derivative_change: float

    def __str__(self) -> str:
        return (
            f"{self.points} points with noise of {self.noise:.3g} (they scatter by about {self.scatter:.2g}): "
            f"{self.pieces} pieces of degree {self.degree}; residuals {self.rms:.3g} (rms), {self.largest:.3g} "
            "(largest); the second derivative changes by up to "
            f"{self.second_derivative_change:.3g} from that of the spline through the points."
        )


@dataclass(frozen=True)
class Curve:
    """A function of one variable.

    Attributes:
        pieces: in the order of their starts, each beginning where the one before it ends. The first one holds before
            its start, too; of two with the same start, the first one holds there only.
        start: where the range of a profile begins, in the unit of its variable; of a periodic curve, of the period.
        span: the length of that range, in the same unit.
        periodic: whether it repeats itself.
        smoothing: of measured points, what it assumes of their noise; None where it goes through its points.

    Raises:
        MechanismError: `pieces` is no tuple of `Piece`s, or start or span is no number.
    """

    pieces: tuple[Piece, ...]
    start: Number = 0.0
    span: Number = 0.0
    periodic: bool = False
    smoothing: Smoothing | None = None

    def __post_init__(self) -> None:
        """Refuse arguments of the wrong kind, as `Term` does."""
        _require_tuple(self, "pieces", "pieces: Curve((Piece(0.0, (constant(1.0),)),))")
        for number, piece in enumerate(self.pieces, start=1):
            _require_kind(f"Curve: entry {number} of pieces", piece, Piece, "Piece(0.0, (constant(1.0),))")
        for what in ("start", "span"):
            _require_number(f"Curve: {what}", getattr(self, what))


def _require_tuple(record: Term | Piece | Curve, name: str, entries: str) -> None:
    value = getattr(record, name)
    if isinstance(value, list):
        object.__setattr__(record, name, tuple(value))
    elif not isinstance(value, tuple):
        what = f"{type(record).__name__}: {name} is {value!r}"
        raise MechanismError(f"{what}, but it must be a tuple of {entries}; one entry needs its comma.")


def _require_kind(what: str, value: Any, kind: type, example: str) -> None:
    if not isinstance(value, kind):
        raise MechanismError(f"{what} is {value!r}, but it must be a {kind.__name__}, e.g. {example}.")


def _require_number(what: str, value: Any) -> None:
    # Symbolic numbers are of any class; what is certainly none is refused.
    if value is None or isinstance(value, str | tuple | list | dict | set | Term | Piece | Curve) or callable(value):
        raise MechanismError(f"{what} is {value!r}, but it must be a number.")


def constant(value: Number) -> Term:
    """A term that does not vary: `value`, in the unit of the curve.

    Args:
        value: in the unit of the curve.

    Source: definition: `Term` with one coefficient.
    """
    return Term((value,))


def cosine(amplitude: Number, frequency: Number) -> Term:
    """The term amplitude cos(frequency xi): in the unit of the curve, and 1/unit of its variable.

    Args:
        amplitude: in the unit of the curve.
        frequency: angular [1/unit of the variable], e.g. [rad/s].

    Source: definition: cos x = sin(x + pi/2), of `Term`.
    """
    return Term((), amplitude, frequency, math.pi / 2)


def sine(amplitude: Number, frequency: Number, phase: Number = 0.0) -> Term:
    """The term amplitude sin(frequency xi + phase): as of `cosine`, phase in rad.

    Args:
        amplitude: in the unit of the curve.
        frequency: angular [1/unit of the variable], e.g. [rad/s].
        phase: where the piece begins [rad].

    Source: definition: the harmonic of `Term`.
    """
    return Term((), amplitude, frequency, phase)


# Splines through points, of third or fifth degree: C2 or C4, periodic or clamped.

Matrix = np.ndarray[Any, np.dtype[np.float64]]


def spline_pieces(knots: Sequence[float], values: Sequence[Number], degree: int, periodic: bool) -> tuple[Piece, ...]:
    """The pieces of the spline through (knots, values).

    The coefficients are linear in the values, which may be symbolic; the knots are plain numbers.

    Args:
        knots: increasing; of a periodic spline the last one is where the first value comes again.
        values: at the knots, without the repeated one of a periodic spline.
        degree: 3 (two continuous derivatives) or 5 (four).
        periodic: else clamped: the derivatives (of degree 5, and the second ones) are zero at both ends.

    Raises:
        MechanismError: another degree, too few points, a place without a value, or knots that do not increase.
    """
    widths = spline_widths(knots, len(values), degree, periodic)
    coefficients = _coefficients(widths, degree, periodic)
    pieces = []
    for k, start in enumerate(knots[:-1]):
        terms = [_combine(row, values) for row in coefficients[k]]
        pieces.append(Piece(float(start), (Term(tuple(terms)),)))
    return tuple(pieces)


def spline_widths(knots: Sequence[float], count: int, degree: int, periodic: bool) -> Matrix:
    """Distances of the knots of a spline through `count` values, as of `spline_pieces`, which refuses the same."""
    if degree not in (3, 5):
        raise MechanismError(f"A spline of degree {degree} is not made here; take 3 (C2) or 5 (C4).")
    points = len(knots) - periodic
    if count != points:
        raise MechanismError(f"A spline has {points} places for {count} values; give as many of each.")
    widths = np.diff(np.asarray(knots, dtype=float))
    if points < 3 or not np.all(np.isfinite(widths)) or not np.all(widths > 0.0):
        where = ", ".join(f"{float(knot):g}" for knot in knots)
        again = "; the last one is where it repeats itself" if periodic else ""
        raise MechanismError(f"A spline needs at least 3 points at increasing places, but they are at {where}{again}.")
    return widths


def plain_places(places: Sequence[Number], what: str) -> list[float]:
    """The places of a spline's points, which `what` names (an angle, a time), as plain numbers.

    Raises:
        MechanismError: one of them depends on a parameter.
    """
    for number, place in enumerate(places, start=1):
        if not is_plain(place):
            raise MechanismError(
                f"The {what} of point {number} of a spline depends on a parameter, but its points must stand at plain "
                "numbers: what each of them contributes is solved for once, for all values of the parameters. Let only "
                "the values there depend on parameters, or make a Curve of Pieces, which may begin anywhere."
            )
    return [float(place) for place in places]


def _combine(weights: Matrix, values: Sequence[Number]) -> Number:
    """The weighted sum, of plain numbers by the same operations as of symbols."""
    total: Number = 0.0
    for weight, value in zip(weights, values, strict=True):
        if weight != 0.0:
            total = total + float(weight) * plain(value)
    return total


def _coefficients(widths: Matrix, degree: int, periodic: bool) -> Matrix:
    """The polynomial coefficients of all pieces as linear functions of the values, shape (pieces, degree + 1, values).

    Unknown are the lower derivatives at the knots; the higher ones must be continuous.
    """
    pieces = len(widths)
    orders = (degree + 1) // 2  # given at each end of a piece: the value and the derivatives below this order
    knots = pieces if periodic else pieces + 1
    # every quantity is a row over (values, then the unknown derivatives of each order) at all knots
    unit = np.eye(orders * knots)
    ends = [unit[order * knots : (order + 1) * knots] for order in range(orders)]
    rows = np.empty((pieces, degree + 1, orders * knots))
    for k, h in enumerate(widths):
        after = (k + 1) % knots
        given = [ends[order][at] * h**order for at in (k, after) for order in range(orders)]
        scales = np.array([h**-power for power in range(degree + 1)])
        rows[k] = scales[:, None] * (_hermite(degree) @ np.array(given))
    joins = range(pieces) if periodic else range(1, pieces)
    conditions = [
        _derivative(rows[k - 1], order, widths[k - 1]) - _derivative(rows[k], order, 0.0)
        for k in joins
        for order in range(orders, degree)
    ]
    if not periodic:
        conditions += [ends[order][at] for order in range(1, orders) for at in (0, knots - 1)]
    system = np.array(conditions)
    unknown = -np.linalg.solve(system[:, knots:], system[:, :knots])
    solution = np.vstack([np.eye(knots), unknown])
    result: Matrix = rows @ solution
    return result


def _hermite(degree: int) -> Matrix:
    """From the value and derivatives at 0, then at 1, to the coefficients of the polynomial on 0..1."""
    orders = (degree + 1) // 2
    powers = np.eye(degree + 1)
    return np.linalg.inv(np.array([_derivative(powers, order, at) for at in (0.0, 1.0) for order in range(orders)]))


def _derivative(rows: Matrix, order: int, at: float) -> Matrix:
    """A derivative at a place of the polynomial whose coefficients are `rows`, constant first."""
    total = np.zeros(rows.shape[1])
    for power in range(order, len(rows)):
        total += math.perm(power, order) * at ** (power - order) * rows[power]
    return total
