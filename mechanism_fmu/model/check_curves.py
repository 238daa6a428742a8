"""What cannot be right of the numbers of curves, as findings."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from .conditions import finite, not_negative, plain, positive, size
from .curves import Curve, Piece
from .findings import Finding, literal, refuse_unless
from .functions import Number, sin, where_positive

#: Rounding is allowed this much, of 1 and the value at a join, or of the period.
_ROUNDING = 1e-9


def curve_findings(owner: str, curve: Curve) -> Iterator[Finding]:
    """Every problem that the numbers of a curve of the part `owner` can have."""
    label = f"The curve of {literal(repr(owner))}"
    terms = [number for piece in curve.pieces for term in piece.terms for number in term.data()]
    numbers = [curve.start, curve.span, *(piece.start for piece in curve.pieces), *terms]
    yield refuse_unless(finite(*numbers), f"{label} holds a number that is not finite; give finite ones.")
    for piece, after in pairwise(curve.pieces):
        text = f"{label} has a piece from {{:g}} on behind one from {{:g}} on; give them in increasing order."
        yield refuse_unless(not_negative(plain(after.start) - plain(piece.start)), text, after.start, piece.start)
        yield _join(label, piece, after, after.start, after.start)
    if curve.periodic:
        text = f"{label} repeats itself after span = {{:g}}, which must be positive."
        yield refuse_unless(positive(curve.span), text, curve.span)
        if curve.pieces:
            yield from _closing(label, curve)


def _closing(label: str, curve: Curve) -> Iterator[Finding]:
    last = curve.pieces[-1]
    end = plain(curve.start) + plain(curve.span)
    text = f"{label} has a piece from {{:g}} on, but repeats itself at {{:g}} already; shorten the ones before."
    yield refuse_unless(not_negative(end - plain(last.start) + _ROUNDING * plain(curve.span)), text, last.start, end)
    yield _join(label, last, curve.pieces[0], end, curve.start)


def _join(label: str, piece: Piece, after: Piece, end: Number, begin: Number) -> Finding:
    """Whether a piece ends, at `end`, where the one after it begins, at `begin`."""
    left, right = _value(piece, end), _value(after, begin)
    text = f"{label} jumps at {{:.9g}} from {{:.9g}} to {{:.9g}}; let each piece begin where the one before it ends."
    room = _ROUNDING * (1.0 + size(left)) - size(right - left)
    return refuse_unless(not_negative(room), text, end, left, right)


def _value(piece: Piece, at: Number) -> Number:
    xi = plain(at) - plain(piece.start)
    total: Number = 0.0
    for term in piece.terms:
        polynomial: Number = 0.0
        for coefficient in reversed(term.polynomial):
            polynomial = polynomial * xi + plain(coefficient)
        angle = plain(term.frequency) * xi + plain(term.phase)
        angle = where_positive(finite(angle), angle, 0.0)  # which has no sine
        total = total + polynomial + plain(term.amplitude) * sin(angle)
    return total
