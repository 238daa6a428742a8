"""Validation of the numbers of curves, as findings."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from ...codes import AMPLITUDE
from ..findings import Finding, finite, first, literal, not_negative, plain, positive, refuse_unless, size
from ..functions import Number, cos, is_plain, sin, where_positive
from .pieces import Curve, Piece

#: Rounding is allowed this much, of 1 and the value at a join, or of the period.
_ROUNDING = 1e-9
#: And this much, of 1 and the slope at a join.
_SLOPE_ROUNDING = 1e-7
#: Between its ends, a piece is looked at in so many places.
_PLACES = 16


def curve_findings(owner: str, curve: Curve) -> Iterator[Finding]:
    """Every problem that the numbers of a curve of the part `owner` can have."""
    label = f"The curve of {literal(repr(owner))}"
    yield from first(*_not_finite(label, curve))
    for piece, after in pairwise(curve.pieces):
        text = f"{label} has a piece from {{:g}} on behind one from {{:g}} on; give them in increasing order."
        yield refuse_unless(not_negative(plain(after.start) - plain(piece.start)), text, after.start, piece.start)
        yield from _joins(label, piece, after, after.start, after.start)
    if curve.periodic:
        text = f"{label} repeats itself after span = {{:g}}, which must be positive."
        yield refuse_unless(positive(curve.span), text, curve.span)
        if curve.pieces:
            yield from _closing(label, curve)


def _not_finite(label: str, curve: Curve) -> Iterator[Finding]:
    """That numbers of a curve are not finite, a few at a time."""
    text = f"{label}: start = {{:g}} or span = {{:g}} is not finite; give finite numbers."
    yield refuse_unless(finite(curve.start, curve.span), text, curve.start, curve.span)
    for number, piece in enumerate(curve.pieces, start=1):
        where = f"{label}, piece {number}"
        text = f"{where}: start = {{:g}} is not finite; give a finite number."
        yield refuse_unless(finite(piece.start), text, piece.start)
        for term in piece.terms:
            coefficients = term.polynomial[:AMPLITUDE]  # more are refused elsewhere
            text = (
                f"{where}: polynomial ({', '.join(['{:g}'] * len(coefficients))}) is not finite; give finite numbers."
            )
            yield refuse_unless(finite(*coefficients), text, *coefficients)
            harmonic = (term.amplitude, term.frequency, term.phase)
            text = f"{where}: amplitude {{:g}}, frequency {{:g}} or phase {{:g}} is not finite; give finite numbers."
            yield refuse_unless(finite(*harmonic), text, *harmonic)


def least_value(curve: Curve) -> Number:
    """The least value that a motion is known to take: on pieces with an end, at sampled places.

    Of a last piece without an end, at its start, and everywhere when it is a constant and one harmonic.
    """
    bounds = [plain(piece.start) for piece in curve.pieces]
    if curve.periodic:
        bounds.append(plain(curve.start) + plain(curve.span))
    values = [
        value_and_slope(piece, start + (end - start) * (k / _PLACES))[0]
        for piece, (start, end) in zip(curve.pieces, pairwise(bounds), strict=False)
        for k in range(_PLACES)
    ]
    last = curve.pieces[-1]
    begin = value_and_slope(last, last.start)[0]
    values.append(begin)
    swinging = [term for term in last.terms if not (is_plain(term.amplitude) and term.amplitude == 0.0)]
    if not curve.periodic and len(swinging) == 1 and all(len(term.polynomial) <= 1 for term in last.terms):
        mean = sum((plain(term.polynomial[0]) for term in last.terms if term.polynomial), 0.0)
        values.append(where_positive(size(swinging[0].frequency), mean - size(swinging[0].amplitude), begin))
    least = values[0]
    for value in values[1:]:
        least = where_positive(least - value, value, least)
    return least


def _closing(label: str, curve: Curve) -> Iterator[Finding]:
    last = curve.pieces[-1]
    end = plain(curve.start) + plain(curve.span)
    text = f"{label} has a piece from {{:g}} on, but repeats itself at {{:g}} already; shorten the ones before."
    yield refuse_unless(not_negative(end - plain(last.start) + _ROUNDING * plain(curve.span)), text, last.start, end)
    yield from _joins(label, last, curve.pieces[0], end, curve.start)


def _joins(label: str, piece: Piece, after: Piece, end: Number, begin: Number) -> Iterator[Finding]:
    """Whether a piece ends, at `end`, where and as steep as the one after it begins, at `begin`."""
    left, left_slope = value_and_slope(piece, end)
    right, right_slope = value_and_slope(after, begin)
    text = f"{label} jumps at {{:.9g}} from {{:.9g}} to {{:.9g}}; let each piece begin where the one before it ends."
    yield refuse_unless(_agree(left, right, _ROUNDING), text, end, left, right)
    text = (
        f"{label} has an edge at {{:.9g}}: its slope jumps from {{:.9g}} to {{:.9g}}, which no finite force can "
        "follow; let each piece begin as steep as the one before it ends."
    )
    yield refuse_unless(_agree(left_slope, right_slope, _SLOPE_ROUNDING), text, end, left_slope, right_slope)


def _agree(left: Number, right: Number, rounding: float) -> Number:
    return not_negative(rounding * (1.0 + size(left)) - size(right - left))


def value_and_slope(piece: Piece, at: Number) -> tuple[Number, Number]:
    """Value and first derivative of a piece of a curve at a place, whose numbers may be symbolic."""
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
