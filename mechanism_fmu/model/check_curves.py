"""What cannot be right of the numbers of curves, as findings."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from .conditions import finite, not_negative, plain, positive, size
from .curves import Curve, Piece
from .findings import Finding, literal, refuse_unless
from .functions import Number, cos, sin, where_positive

#: Rounding is allowed this much, of 1 and the value at a join, or of the period.
_ROUNDING = 1e-9
#: And this much, of 1 and the slope at a join.
_SLOPE_ROUNDING = 1e-7


def curve_findings(owner: str, curve: Curve) -> Iterator[Finding]:
    """Every problem that the numbers of a curve of the part `owner` can have."""
    label = f"The curve of {literal(repr(owner))}"
    terms = [number for piece in curve.pieces for term in piece.terms for number in term.data()]
    numbers = [curve.start, curve.span, *(piece.start for piece in curve.pieces), *terms]
    yield refuse_unless(finite(*numbers), f"{label} holds a number that is not finite; give finite ones.")
    for piece, after in pairwise(curve.pieces):
        text = f"{label} has a piece from {{:g}} on behind one from {{:g}} on; give them in increasing order."
        yield refuse_unless(not_negative(plain(after.start) - plain(piece.start)), text, after.start, piece.start)
        yield from _joins(label, piece, after, after.start, after.start)
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
    yield from _joins(label, last, curve.pieces[0], end, curve.start)


def _joins(label: str, piece: Piece, after: Piece, end: Number, begin: Number) -> Iterator[Finding]:
    """Whether a piece ends, at `end`, where and as steep as the one after it begins, at `begin`."""
    left, left_slope = _value_and_slope(piece, end)
    right, right_slope = _value_and_slope(after, begin)
    text = f"{label} jumps at {{:.9g}} from {{:.9g}} to {{:.9g}}; let each piece begin where the one before it ends."
    yield refuse_unless(_agree(left, right, _ROUNDING), text, end, left, right)
    text = (
        f"{label} has an edge at {{:.9g}}: its slope jumps from {{:.9g}} to {{:.9g}}, which no finite force can "
        "follow; let each piece begin as steep as the one before it ends."
    )
    yield refuse_unless(_agree(left_slope, right_slope, _SLOPE_ROUNDING), text, end, left_slope, right_slope)


def _agree(left: Number, right: Number, rounding: float) -> Number:
    return not_negative(rounding * (1.0 + size(left)) - size(right - left))


def _value_and_slope(piece: Piece, at: Number) -> tuple[Number, Number]:
    xi = plain(at) - plain(piece.start)
    value: Number = 0.0
    slope: Number = 0.0
    for term in piece.terms:
        polynomial: Number = 0.0
        derivative: Number = 0.0
        for coefficient in reversed(term.polynomial):
            derivative = derivative * xi + polynomial
            polynomial = polynomial * xi + plain(coefficient)
        frequency = plain(term.frequency)
        angle = frequency * xi + plain(term.phase)
        angle = where_positive(finite(angle), angle, 0.0)  # which has no sine
        value = value + polynomial + plain(term.amplitude) * sin(angle)
        slope = slope + derivative + plain(term.amplitude) * frequency * cos(angle)
    return value, slope
