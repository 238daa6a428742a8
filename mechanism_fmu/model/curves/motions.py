"""Motions over time for drivers, and laws of motion for cams."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ..errors import MechanismError
from ..functions import Number, is_plain, where_positive
from .pieces import Curve, Piece, Term, constant, plain_places, sine, spline_pieces

# Standard motion laws of cams: how a rise is spread over an angle (Norton, Cam Design and Manufacturing Handbook).

#: Moves may fill the turn to the last bit but this share of it.
_ROUNDING = 1e-9

#: From where it begins [rad], the value there, the rise [both m or rad] and the width [rad] to the pieces of a move.
Law = Callable[[Number, Number, Number, Number], tuple[Piece, ...]]


def dwell(start: Number, value: Number, _rise: Number, _width: Number) -> tuple[Piece, ...]:
    """No motion, whatever the rise. The arguments are those of every `Law`.

    Args:
        start: angle at which it begins [rad].
        value: lift there [m or rad].

    Source: definition: a constant.
    """
    return (Piece(start, (Term((value,)),)),)


def cycloidal(start: Number, value: Number, rise: Number, width: Number) -> tuple[Piece, ...]:
    """Lift = rise (u - sin(2 pi u)/(2 pi)), u = xi/width: largest acceleration 6.283 rise/width^2; see `Law`.

    Args:
        start: angle at which it begins [rad].
        value: lift there [m or rad].
        rise: change of the lift [m or rad].
        width: angle over which it changes [rad], >= 0.

    Source: textbook: R. L. Norton, Cam Design and Manufacturing Handbook, cycloidal displacement; inclined sine line of
        VDI 2143, Blatt 1.
    """
    divisor = _divisor(width)
    return (Piece(start, (Term((value, rise / divisor), -rise / (2 * math.pi), 2 * math.pi / divisor),)),)


def polynomial_345(start: Number, value: Number, rise: Number, width: Number) -> tuple[Piece, ...]:
    """Lift = rise (10 u^3 - 15 u^4 + 6 u^5), u = xi/width: largest acceleration 5.7735 rise/width^2; see `Law`.

    Args:
        start: angle at which it begins [rad].
        value: lift there [m or rad].
        rise: change of the lift [m or rad].
        width: angle over which it changes [rad], >= 0.

    Source: textbook: R. L. Norton, Cam Design and Manufacturing Handbook, 3-4-5 polynomial; polynomial of fifth degree
        of VDI 2143, Blatt 1.
    """
    divisor = _divisor(width)
    third = rise / (divisor * divisor * divisor)
    fourth = third / divisor
    return (Piece(start, (Term((value, 0.0, 0.0, 10 * third, -15 * fourth, 6 * fourth / divisor)),)),)


def modified_sine(start: Number, value: Number, rise: Number, width: Number) -> tuple[Piece, ...]:
    """Modified sine, arcs of a quarter at both ends and a slow one between: largest acceleration 5.528 rise/width^2.

    With k = rise/(4 + pi): k (pi u - sin(4 pi u)/4) up to u = 1/8, k (2 + pi u - 9/4 sin(4 pi u/3 + pi/3)) up to 7/8,
    and k (4 + pi u - sin(4 pi u)/4) to the end. The arguments are those of every `Law`.

    Args:
        start: angle at which it begins [rad].
        value: lift there [m or rad].
        rise: change of the lift [m or rad].
        width: angle over which it changes [rad], >= 0.

    Source: textbook: R. L. Norton, Cam Design and Manufacturing Handbook, modified sine acceleration; modified sine
        line of VDI 2143, Blatt 1. The three pieces are its acceleration, sines of a fast and a slow frequency,
        integrated twice.
    """
    k = rise / (4 + math.pi)
    divisor = _divisor(width)
    slope, fast, slow = k * math.pi / divisor, 4 * math.pi / divisor, 4 * math.pi / (3 * divisor)
    first, second = math.pi / 8, math.pi * 7 / 8  # pi u where the middle and the last piece begin
    return (
        Piece(start, (Term((value, slope), -k / 4, fast),)),
        Piece(start + width / 8, (Term((value + k * (2 + first), slope), -9 * k / 4, slow, math.pi / 2),)),
        Piece(start + 7 * width / 8, (Term((value + k * (4 + second), slope), -k / 4, fast, 7 * math.pi / 2),)),
    )


def _divisor(width: Number) -> Number:
    """A width to divide by; of a move without width, 1: if it rises, it is a jump that the check of curves sees."""
    return where_positive(width, width, 1.0)


@dataclass(frozen=True)
class Move:
    """One move of a cam's program.

    Attributes:
        lift: where it leads to, above the base [m or rad].
        width: over which angle [rad], >= 0; 0 only where the lift stays.
        law: how.
    """

    lift: Number
    width: Number
    law: Law = cycloidal


def moves_to_pieces(base: Number, moves: Sequence[Move], turn: float, back: Law) -> tuple[Piece, ...]:
    """The pieces of base + lift over one turn [rad]; what the moves leave of it leads back to the base by `back`.

    Raises:
        MechanismError: a width is negative, or the moves need more than the turn. Of symbolic widths, the curve's
            findings say so.
    """
    start: Number = 0.0
    lift: Number = 0.0
    pieces: list[Piece] = []
    for number, move in enumerate(moves, start=1):
        if is_plain(move.width) and not move.width >= 0.0:
            raise MechanismError(f"Move {number} of the cam has width = {move.width:g} rad; it must not be negative.")
        pieces += move.law(start, base + lift, move.lift - lift, move.width)
        start, lift = start + move.width, move.lift
    left = turn - start
    if is_plain(left) and left < -_ROUNDING * turn:
        raise MechanismError(f"The cam's moves take {start:g} rad of a turn of {turn:g} rad; make them narrower.")
    return (*pieces, *back(start, base + lift, -lift, where_positive(left, left, 0.0)))


# Motions C(t) of drivers, in the unit of the driven coordinate over time [s].


def polynomial_motion(*coefficients: Number) -> Curve:
    """C = coefficients[0] + coefficients[1] t + ... [m or rad], at most up to t^5; two of them are a constant speed.

    Args:
        coefficients: constant first [m or rad, per s^k], at most six.

    Source: definition: a polynomial of time.
    """
    return Curve((Piece(0.0, (Term(tuple(coefficients)),)),))


def harmonic_motion(mean: Number, amplitude: Number, frequency: Number, phase: Number = 0.0) -> Curve:
    """C = mean + amplitude sin(frequency t + phase) [m or rad], frequency in rad/s and phase in rad.

    Args:
        mean: in the unit of the driven coordinate [m or rad].
        amplitude: in the unit of the driven coordinate [m or rad].
        frequency: angular [rad/s].
        phase: at t = 0 [rad].

    Source: definition: harmonic motion about a mean.
    """
    return Curve((Piece(0.0, (constant(mean), sine(amplitude, frequency, phase))),))


def table_motion(points: Sequence[tuple[float, Number]]) -> Curve:
    """A cubic spline through points (t [s], value); before the first and after the last one the value rests.

    The speed is zero there, too.

    Args:
        points: pairs of time [s] and value [m or rad], 3 or more.

    Raises:
        MechanismError: fewer than 3 points, or times that do not increase or that depend on a parameter.

    Source: C. de Boor, A Practical Guide to Splines: the cubic spline with clamped ends, here of slope zero.
    """
    times, values = plain_places([time for time, _ in points], "time"), [value for _, value in points]
    pieces = spline_pieces(times, values, 3, periodic=False)
    before = Piece(times[0], (constant(values[0]),))  # the first piece of a curve holds before its start
    rest = Piece(times[-1], (constant(values[-1]),))
    return Curve((before, *pieces, rest))
