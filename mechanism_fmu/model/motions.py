"""Motions C(t) of drivers, in the unit of the driven coordinate over time [s]."""

from __future__ import annotations

from collections.abc import Sequence

from .curves import Curve, Piece, Term, constant, sine
from .functions import Number
from .splines import plain_places, spline_pieces


def polynomial_motion(*coefficients: Number) -> Curve:
    """C = coefficients[0] + coefficients[1] t + ... [m or rad], at most up to t^5; two of them are a constant speed."""
    return Curve((Piece(0.0, (Term(tuple(coefficients)),)),))


def harmonic_motion(mean: Number, amplitude: Number, frequency: Number, phase: Number = 0.0) -> Curve:
    """C = mean + amplitude sin(frequency t + phase) [m or rad], frequency in rad/s and phase in rad."""
    return Curve((Piece(0.0, (constant(mean), sine(amplitude, frequency, phase))),))


def table_motion(points: Sequence[tuple[float, Number]]) -> Curve:
    """A cubic spline through points (t [s], value); before the first and after the last one the value rests.

    The speed is zero there, too.

    Raises:
        MechanismError: fewer than 3 points, or times that do not increase or that depend on a parameter.
    """
    times, values = plain_places([time for time, _ in points], "time"), [value for _, value in points]
    pieces = spline_pieces(times, values, 3, periodic=False)
    before = Piece(times[0], (constant(values[0]),))  # the first piece of a curve holds before its start
    rest = Piece(times[-1], (constant(values[-1]),))
    return Curve((before, *pieces, rest))
