"""How a beam is held at its ends, and the polynomials that respect it."""

from __future__ import annotations

from enum import Enum
from functools import lru_cache

import numpy as np
from numpy.polynomial import legendre

from .checks import FloatArray


class End(Enum):
    """What is held at one end of a beam.

    What is not held follows by itself from the stationary energy: no moment where the slope is free, no shear force
    where the deflection is.
    """

    FREE = "free"
    PINNED = "pinned"
    GUIDED = "guided"
    CLAMPED = "clamped"

    @property
    def vanishing(self) -> tuple[int, ...]:
        """Orders of the derivatives of the deflection that are 0 there."""
        return _VANISHING[self]


# Not the values themselves: Python 3.11.2, which is Debian 12's, makes something else of an empty tuple.
_VANISHING = {End.FREE: (), End.PINNED: (0,), End.GUIDED: (1,), End.CLAMPED: (0, 1)}


def held(degree: int, root: End, tip: End) -> FloatArray:
    """Vanishing derivatives as rows over the Legendre polynomials up to `degree`, of shape (held, degree + 1).

    The polynomials are those of s = 2 xi - 1, normalised so that the integral of their square over xi is 1. Rows are
    scaled to length 1, because derivatives grow fast with the degree.
    """
    unit = np.diag(norms(degree))
    rows = [
        legendre.legval(at, legendre.legder(unit, order))
        for end, at in ((root, -1.0), (tip, 1.0))
        for order in end.vanishing
    ]
    return np.asarray(np.reshape([row / np.linalg.norm(row) for row in rows], (len(rows), degree + 1)))


def norms(degree: int) -> FloatArray:
    """Factors that give the Legendre polynomials in s = 2 xi - 1 a unit integral of their square over xi."""
    return np.asarray(np.sqrt(2.0 * np.arange(degree + 1) + 1))


@lru_cache
def admissible(terms: int, root: End, tip: End) -> FloatArray:
    """`terms` orthonormal polynomials that fulfil the geometric end conditions, of shape (degree + 1, terms).

    Columns are coefficients of the normalised Legendre polynomials of `held`; the n-th is of the lowest degree that has
    room for n of them. Because the columns are orthonormal, so are the polynomials over xi: this basis is as well
    conditioned as can be, where powers of xi end with twelve. Not to be written to: it is remembered.

    Source: J. Shen, Efficient spectral-Galerkin method I, SIAM J. Sci. Comput. 15 (1994): neighbouring Legendre
    polynomials recombined to fulfil the end conditions; here made orthonormal, too.
    """
    count = len(root.vanishing) + len(tip.vanishing)
    degree = terms - 1 + count
    rows = held(degree, root, tip)
    columns = np.zeros((degree + 1, terms))
    for n in range(terms):
        neighbours = slice(n, n + count + 1)
        columns[neighbours, n] = np.linalg.svd(rows[:, neighbours])[2][-1] if count else 1.0
    # Each column of Q is a combination of those up to it, so the degrees still ascend.
    return np.asarray(np.linalg.qr(columns)[0])


def rigid_motions(root: End, tip: End) -> dict[str, tuple[float, float]]:
    """Motions without bending, c_0 + c_1 xi, that the ends allow: (c_0, c_1) by name."""
    held_by_both = root.vanishing + tip.vanishing
    motions = {}
    if 0 not in held_by_both:
        motions["rigid translation"] = (1.0, 0.0)
    if 1 not in held_by_both and held_by_both.count(0) < 2:
        motions["rigid rotation"] = (-1.0, 1.0) if 0 in tip.vanishing else (0.0, 1.0)
    return motions
