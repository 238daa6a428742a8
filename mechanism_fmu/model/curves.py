"""Functions of one variable: the profiles of cams and slots, and the motions of drivers.

A curve consists of pieces, each of which begins at a value of the variable; a piece is a sum of terms, and a term is a
polynomial of at most the fifth degree plus one harmonic. So the engine knows three derivatives of all of them. How to
make them: `profiles` and `motions` beside this file.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from .functions import Number


@dataclass(frozen=True)
class Term:
    """Sum over k of polynomial[k] xi^k, plus amplitude sin(frequency xi + phase); xi counts from the piece's start.

    Attributes:
        polynomial: at most six coefficients, constant first.
        amplitude: of the harmonic, in the unit of the curve.
        frequency: angular, [1/unit of the variable], e.g. [rad/s].
        phase: [rad].
    """

    polynomial: tuple[Number, ...] = ()
    amplitude: Number = 0.0
    frequency: Number = 0.0
    phase: Number = 0.0

    def data(self) -> tuple[Number, ...]:
        """The term's row of the table `term_data`."""
        coefficients = (*self.polynomial, *[0.0] * (6 - len(self.polynomial)))
        return (*coefficients, self.amplitude, self.frequency, self.phase)


@dataclass(frozen=True)
class Piece:
    """A piece of a curve, from `start` to the start of the next one: the sum of its terms."""

    start: Number
    terms: tuple[Term, ...]


@dataclass(frozen=True)
class Curve:
    """A function of one variable.

    Attributes:
        pieces: in the order of their starts, each beginning where the one before it ends. The first one holds before
            its start, too; of two with the same start, the first one holds there only.
        start: where the range of a profile begins; of a periodic curve, of the period.
        span: the length of that range.
        periodic: whether it repeats itself.
    """

    pieces: tuple[Piece, ...]
    start: Number = 0.0
    span: Number = 0.0
    periodic: bool = False


def constant(value: Number) -> Term:
    """A term that does not vary: `value`, in the unit of the curve."""
    return Term((value,))


def cosine(amplitude: Number, frequency: Number) -> Term:
    """The term amplitude cos(frequency xi): in the unit of the curve, and 1/unit of its variable."""
    return Term((), amplitude, frequency, math.pi / 2)


def sine(amplitude: Number, frequency: Number, phase: Number = 0.0) -> Term:
    """The term amplitude sin(frequency xi + phase): as of `cosine`, phase in rad."""
    return Term((), amplitude, frequency, phase)
