"""Search for the largest stress over length and time: a grid brackets the maxima, bounded descent locates them."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.optimize import minimize

from .audible import audible_stretches
from .checks import FloatArray
from .field import BendingField

#: Cells of the grid along the tooth, at least so many for each mode, and in a period of the fastest mode still heard.
_CELLS_OF_LENGTH = 32
_CELLS_OF_MODE = 4
_CELLS_OF_PERIOD = 64

#: A local maximum lies less than this fraction above the highest grid point beside it (1e-3 for the paper's modes).
_GRID_ERROR = 0.01

#: A mode is heard above this part of what the loudest starts with. Quieter ones belong to every value, but they
#: no longer set the pace of the grid.
_HEARD = 1e-5

#: Times that are looked at together, so that little damping takes no more memory.
_BLOCK = 4096

#: A located maximum may lie this many cells away from its grid point.
_REACH = 2

#: Points, in cells, of the central differences that give the slope of the stress at the middle one.
_DIFFERENCE = 1e-3
_STENCIL = np.array([-1.0, 0.0, 1.0])


class StressPoint(NamedTuple):
    """|sigma_b| [Pa per m/s], the distance from the root [m] and the time since the impact [s] at which it acts."""

    stress: float
    x: float
    t: float


def largest_stress(field: BendingField) -> StressPoint:
    """The largest |sigma_b| over the length of the tooth and over all times after the impact.

    Every local maximum that the grid cannot tell from the largest is located, and the largest of them is taken.
    """
    cells = max(_CELLS_OF_LENGTH, _CELLS_OF_MODE * len(field.frequencies))
    x = np.linspace(0.0, field.length, cells + 1)
    t = _times(field, x, _horizon(field, x))
    steps = np.diff(t, append=2 * t[-1] - t[-2])
    bounds, decay = field.stress_bounds(x), field.damping_ratio * field.frequencies
    largest = 0.0
    peaks: list[tuple[float, int, int]] = []
    for begin in range(0, len(t), _BLOCK):
        if (1 + _GRID_ERROR) * (bounds @ np.exp(-decay * t[begin])).max() < largest:
            break
        margin = min(begin, 1)  # so that peaks at either end of a block have their neighbours
        stress = np.abs(field.stress(x, t[begin - margin : begin + _BLOCK + 1]))
        highest_around = sliding_window_view(np.pad(stress, 1), (3, 3)).max(axis=(2, 3))
        largest = max(largest, float(stress.max()))
        found = np.argwhere((stress == highest_around) & (stress > (1 - _GRID_ERROR) * largest))
        peaks += [(stress[i, j], i, begin - margin + j) for i, j in found]
    candidates = {(i, j) for height, i, j in peaks if height > (1 - _GRID_ERROR) * largest}
    return max(_locate(field, (x[i], t[j]), (field.length / cells, steps[j])) for i, j in candidates)


def _horizon(field: BendingField, x: FloatArray) -> float:
    """Time [s] after which the stress stays below the largest of the first swing, that of the slowest mode.

    The bound of the stress decays at least as fast as the slowest mode.
    """
    slowest = float(field.frequencies.min())
    first_swing = np.abs(field.stress(x, _times(field, x, math.pi / slowest))).max()
    bound = (1 + _GRID_ERROR) * field.stress_bounds(x).sum(axis=1).max()
    return math.log(bound / first_swing) / (field.damping_ratio * slowest)


def _times(field: BendingField, x: FloatArray, until: float) -> FloatArray:
    """Times from 0 to `until` [s], as close as the fastest mode needs that is still heard, of shape (n,), n >= 2."""
    loudness = field.stress_bounds(x).max(axis=0)
    threshold = _HEARD * float(loudness.max())
    pieces = [np.zeros(1)]
    for stretch in audible_stretches(loudness, field.frequencies, field.damping_ratio, threshold, until):
        cells = math.ceil((stretch.end - stretch.begin) * stretch.frequency / (2 * math.pi) * _CELLS_OF_PERIOD)
        pieces.append(np.linspace(stretch.begin, stretch.end, cells + 1)[1:])
    return np.concatenate(pieces)


def _locate(field: BendingField, centre: tuple[float, float], cell: tuple[float, float]) -> StressPoint:
    """The maximum of |sigma_b| near a grid point (x, t), found in units of cells from there."""

    def stress_around(point: FloatArray) -> FloatArray:
        x, t = (c + size * (at + _DIFFERENCE * _STENCIL) for c, size, at in zip(centre, cell, point, strict=True))
        return field.stress(x, t)

    def descent(point: FloatArray) -> tuple[float, FloatArray]:
        values = -stress_around(point) / scale
        slope = np.array([values[2, 1] - values[0, 1], values[1, 2] - values[1, 0]]) / (2 * _DIFFERENCE)
        return float(values[1, 1]), slope

    start = np.zeros(2)
    scale = stress_around(start)[1, 1]
    bounds = [
        (max(-_REACH, -centre[0] / cell[0]), min(_REACH, (field.length - centre[0]) / cell[0])),
        (max(-_REACH, -centre[1] / cell[1]), _REACH),
    ]
    # TNC, and no scaling by it: cells are the right unit, and its small problem starts no threads of a BLAS.
    options = {"ftol": 1e-15, "gtol": 1e-9, "xtol": 1e-7, "scale": np.ones(2), "offset": np.zeros(2)}
    found = minimize(descent, start, jac=True, method="TNC", bounds=bounds, options=options)
    x, t = (float(c + size * at) for c, size, at in zip(centre, cell, found.x, strict=True))
    return StressPoint(abs(float(found.fun * scale)), x, t)
