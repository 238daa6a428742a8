"""Search for the largest stress over length and time: a grid brackets the maxima, bounded descent locates them."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.optimize import minimize

from .checks import FloatArray
from .field import BendingField

#: Cells of the grid along the tooth, at least so many for each mode, and in a period of the fastest mode.
_CELLS_OF_LENGTH = 32
_CELLS_OF_MODE = 4
_CELLS_OF_PERIOD = 64

#: A local maximum lies less than this fraction above the highest grid point beside it (1e-3 for the paper's modes).
_GRID_ERROR = 0.01

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
    cell = (field.length / cells, 2 * math.pi / _CELLS_OF_PERIOD / float(field.frequencies.max()))
    x = np.linspace(0.0, field.length, cells + 1)
    last = math.ceil(_horizon(field, x, cell[1]) / cell[1])
    t = np.linspace(0.0, last * cell[1], last + 1)
    stress = np.abs(field.stress(x, t))
    highest_around = sliding_window_view(np.pad(stress, 1), (3, 3)).max(axis=(2, 3))
    candidates = (stress == highest_around) & (stress > (1 - _GRID_ERROR) * stress.max())
    return max(_locate(field, cell, int(i), int(j)) for i, j in np.argwhere(candidates))


def _horizon(field: BendingField, x: FloatArray, step: float) -> float:
    """Time [s] after which the stress stays below the largest of the first swing, that of the slowest mode.

    The bound of the stress decays at least as fast as the slowest mode.
    """
    slowest = float(field.frequencies.min())
    first_swing = np.abs(field.stress(x, np.arange(0.0, math.pi / slowest, step))).max()
    bound = (1 + _GRID_ERROR) * field.stress_bound(x).max()
    return math.log(bound / first_swing) / (field.damping_ratio * slowest)


def _locate(field: BendingField, cell: tuple[float, float], i: int, j: int) -> StressPoint:
    """The maximum of |sigma_b| near the grid point (i, j), found in units of cells."""

    def stress_around(point: FloatArray) -> FloatArray:
        x, t = (size * (at + _DIFFERENCE * _STENCIL) for size, at in zip(cell, point, strict=True))
        return field.stress(x, t)

    def descent(point: FloatArray) -> tuple[float, FloatArray]:
        values = -stress_around(point) / scale
        slope = np.array([values[2, 1] - values[0, 1], values[1, 2] - values[1, 0]]) / (2 * _DIFFERENCE)
        return float(values[1, 1]), slope

    start = np.array([i, j], dtype=np.float64)
    scale = stress_around(start)[1, 1]
    bounds = [(max(i - _REACH, 0), min(i + _REACH, round(field.length / cell[0]))), (max(j - _REACH, 0), j + _REACH)]
    # TNC, and no scaling by it: cells are the right unit, and its small problem starts no threads of a BLAS.
    options = {"ftol": 1e-15, "gtol": 1e-9, "xtol": 1e-7, "scale": np.ones(2), "offset": np.zeros(2)}
    found = minimize(descent, start, jac=True, method="TNC", bounds=bounds, options=options)
    x, t = (size * float(at) for size, at in zip(cell, found.x, strict=True))
    return StressPoint(abs(float(found.fun * scale)), x, t)
