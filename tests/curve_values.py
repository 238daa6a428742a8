"""Values and derivatives of curves by numpy's polynomials, independently of the engine."""

import math
from itertools import pairwise
from typing import NamedTuple

from numpy.polynomial import Polynomial

from mechanism_fmu.model import Curve, Piece


class Join(NamedTuple):
    """Where a piece ends and the one after it begins, each by its own variable."""

    piece: Piece
    end: float
    after: Piece
    begin: float


def value(curve: Curve, x: float, order: int = 0) -> float:
    """A derivative of a curve; of order 0, its value."""
    if curve.periodic:
        x = curve.start + (x - curve.start) % curve.span
    piece = [curve.pieces[0], *(piece for piece in curve.pieces if piece.start <= x)][-1]
    return piece_value(piece, x - piece.start, order)


def piece_value(piece: Piece, xi: float, order: int = 0) -> float:
    """A derivative of a piece at xi from its start."""
    total = 0.0
    for term in piece.terms:
        polynomial = Polynomial(term.polynomial or (0.0,))
        total += (polynomial.deriv(order) if order else polynomial)(xi)
        angle = term.frequency * xi + term.phase + order * math.pi / 2
        total += term.amplitude * term.frequency**order * math.sin(angle)
    return float(total)


def joins(curve: Curve) -> list[Join]:
    """All joins of a curve, of a periodic one also from the last piece to the first."""
    found = [Join(piece, after.start - piece.start, after, 0.0) for piece, after in pairwise(curve.pieces)]
    if curve.periodic:
        last, first = curve.pieces[-1], curve.pieces[0]
        found.append(Join(last, curve.start + curve.span - last.start, first, curve.start - first.start))
    return found


def jumps(curve: Curve, order: int) -> list[float]:
    """By how much a derivative changes at each join."""
    return [piece_value(j.after, j.begin, order) - piece_value(j.piece, j.end, order) for j in joins(curve)]
