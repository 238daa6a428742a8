"""Powers of xi and Legendre polynomials of s = 2 xi - 1, each written in the other."""

from __future__ import annotations

from functools import lru_cache
from math import comb

import numpy as np

from .checks import FloatArray


@lru_cache
def powers_of_legendre(degree: int) -> FloatArray:
    """Matrix that takes Legendre coefficients to coefficients of 1, xi, ..., xi^`degree`; not to be written to.

    P_n(2 xi - 1) = sum over i of (-1)^(n + i) (n over i) (n + i over i) xi^i.
    """
    matrix = np.zeros((degree + 1, degree + 1))
    for n in range(degree + 1):
        for i in range(n + 1):
            matrix[i, n] = (-1) ** (n + i) * comb(n, i) * comb(n + i, i)
    return matrix


@lru_cache
def legendre_of_powers(degree: int) -> FloatArray:
    """Matrix that takes coefficients of 1, xi, ..., xi^`degree` to Legendre coefficients; not to be written to.

    xi^i = sum over n of (2 n + 1) (i over n) / ((i + n + 1) (i + n over n)) P_n(2 xi - 1).
    """
    matrix = np.zeros((degree + 1, degree + 1))
    for i in range(degree + 1):
        for n in range(i + 1):
            matrix[n, i] = (2 * n + 1) * comb(i, n) / ((i + n + 1) * comb(i + n, n))
    return matrix
