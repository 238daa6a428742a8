"""Integrals over the length of a beam."""

from __future__ import annotations

import itertools
from functools import lru_cache

import numpy as np
from numpy.polynomial.legendre import leggauss

from .beam import Beam
from .checks import FloatArray

#: Points beyond those that a constant cross section needs: enough for any that a drawing shows.
_MORE_POINTS = 40


def gauss_points(beam: Beam, degree: int) -> tuple[FloatArray, FloatArray]:
    """Places x [m] and weights [m] of a Gauss–Legendre rule, piece by piece between the breaks of the beam.

    It is exact for the square of a polynomial up to `degree`, times a polynomial up to degree 80.
    """
    nodes, weights = gauss_rule(degree + 1 + _MORE_POINTS)
    pieces = list(itertools.pairwise((0.0, *beam.breaks, beam.length)))
    x = [a + (b - a) * (nodes + 1) / 2 for a, b in pieces]
    dx = [(b - a) * weights / 2 for a, b in pieces]
    return np.concatenate(x), np.concatenate(dx)


@lru_cache
def gauss_rule(points: int) -> tuple[FloatArray, FloatArray]:
    """Nodes and weights of the Gauss–Legendre rule on (-1, 1); not to be written to."""
    nodes, weights = leggauss(points)
    return nodes, weights
