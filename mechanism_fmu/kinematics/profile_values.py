"""Values and derivatives of profiles over many places at once."""

from __future__ import annotations

import numpy as np

from ..model.curves import Curve, Piece
from .rank import FloatArray


def piece_values(piece: Piece, places: FloatArray) -> FloatArray:
    """Rho [m] and its first two derivatives on a piece at `places` [rad]: from shape (places,) to (3, places)."""
    xi = places - float(piece.start)
    values = np.zeros((3, len(xi)))
    for term in piece.terms:
        polynomial = np.polynomial.Polynomial([float(c) for c in term.polynomial] or [0.0])
        amplitude, frequency, phase = map(float, (term.amplitude, term.frequency, term.phase))
        for order in range(3):
            values[order] += (polynomial.deriv(order) if order else polynomial)(xi)
            values[order] += amplitude * frequency**order * np.sin(frequency * xi + phase + order * np.pi / 2)
    return values


def curve_values(curve: Curve, places: FloatArray) -> FloatArray:
    """Value and first two derivatives of a curve at `places`: from shape (places,) to (3, places)."""
    if curve.periodic:
        places = float(curve.start) + (places - float(curve.start)) % float(curve.span)
    starts = np.array([float(piece.start) for piece in curve.pieces])
    which = np.clip(np.searchsorted(starts, places, side="right") - 1, 0, None)
    values = np.empty((3, len(places)))
    for k, piece in enumerate(curve.pieces):
        values[:, which == k] = piece_values(piece, places[which == k])
    return values


def curvature(values: FloatArray) -> FloatArray:
    """Curvature of a profile [1/m]: positive where it bends as a circle about its centre does.

    Args:
        values: rho, rho' and rho'' [m], shape (3, places).
    """
    rho, rate, bend = values
    result: FloatArray = (rho * rho + 2 * rate * rate - rho * bend) / (rho * rho + rate * rate) ** 1.5
    return result


def radius_of(curve: Curve) -> float | None:
    """The radius of a profile that is a circle about its centre [m], None of any other."""
    values = curve_values(curve, np.linspace(0.0, 2 * np.pi, 8))
    round_ = len(curve.pieces) == 1 and not values[1:].any()
    return float(values[0, 0]) if round_ else None
