"""A smooth curve through points that overshoots nowhere."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from .beam import FloatArray


def monotone_cubic(places: Sequence[float], values: Sequence[float]) -> Callable[[FloatArray], FloatArray]:
    """Piecewise cubic through points, monotone wherever they are; beyond the ends, its first and last pieces go on.

    Slopes at inner points are weighted harmonic means of those of the two chords, 0 where these differ in sign; at the
    ends they are those of a parabola, limited likewise.

    Args:
        places: ascending, at least two.
        values: at the places.

    Source: F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984), with the weights and ends of C. Moler,
        Numerical Computing with MATLAB, 3.6, as `scipy.interpolate.PchipInterpolator`.
    """
    x, y = np.array(places, dtype=float), np.array(values, dtype=float)
    h, chord = np.diff(x), np.diff(y) / np.diff(x)
    slopes = np.full(len(x), chord[0])
    if len(x) > 2:
        left, right = 2 * h[1:] + h[:-1], h[1:] + 2 * h[:-1]
        alike = chord[:-1] * chord[1:] > 0.0
        first, second = np.where(alike, chord[:-1], 1.0), np.where(alike, chord[1:], 1.0)
        slopes[1:-1] = np.where(alike, (left + right) / (left / first + right / second), 0.0)
        slopes[0] = _end(h[0], h[1], chord[0], chord[1])
        slopes[-1] = _end(h[-1], h[-2], chord[-1], chord[-2])

    def curve(at: FloatArray) -> FloatArray:
        at = np.asarray(at, dtype=float)
        k = np.clip(np.searchsorted(x, at, side="right") - 1, 0, len(h) - 1)
        z, size = at - x[k], h[k]
        square = (3 * chord[k] - 2 * slopes[k] - slopes[k + 1]) / size
        cube = (slopes[k] - 2 * chord[k] + slopes[k + 1]) / size**2
        found: FloatArray = y[k] + z * (slopes[k] + z * (square + z * cube))
        return found

    return curve


def _end(h: float, beside: float, chord: float, next_chord: float) -> float:
    """Slope at an end, from its own piece and the next one."""
    slope = ((2 * h + beside) * chord - h * next_chord) / (h + beside)
    if slope * chord <= 0.0:
        return 0.0
    if chord * next_chord <= 0.0 and abs(slope) > 3 * abs(chord):
        return 3 * chord
    return float(slope)
