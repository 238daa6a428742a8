"""Bending modes of a cantilever tooth by the Rayleigh–Ritz method."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import polynomial
from numpy.polynomial.legendre import leggauss
from scipy.linalg import eigh

from .checks import FloatArray, require_within
from .material import Material
from .tooth import WedgeTooth

#: Powers of xi beyond this many make the two matrices of eq (12) too ill-conditioned for double precision.
_MOST_TERMS = 10


@dataclass(frozen=True)
class BeamMode:
    """One bending mode u(xi) = sum of a_i xi^(i+1), i = 1, 2, ..., with xi = x / length, of a cantilever beam.

    Attributes:
        coefficients: a_1, a_2, ... [-]; their scale fixes what eta of eq (8) means.
        mass: modal mass m of eq (9) [kg], for these coefficients.
        stiffness: modal stiffness k of eq (9) [N/m], for these coefficients.
    """

    coefficients: tuple[float, ...]
    mass: float
    stiffness: float

    @property
    def natural_frequency(self) -> float:
        """Undamped natural frequency Lambda = sqrt(k / m) [rad/s]."""
        return math.sqrt(self.stiffness / self.mass)

    def shape(self, xi: FloatArray, derivative: int = 0) -> FloatArray:
        """Mode shape u, or its `derivative`-th derivative with respect to xi, at `xi` (0 root, 1 tip) [-]."""
        ascending = (0.0, 0.0, *self.coefficients)
        return np.asarray(polynomial.polyval(xi, polynomial.polyder(ascending, derivative)))


def ritz_modes(tooth: WedgeTooth, material: Material, terms: int = 2) -> tuple[BeamMode, ...]:
    """Modes of `tooth` from the deflection a_1 xi^2 + a_2 xi^3 + ..., the slowest first, scaled to a_1 = 1.

    Solves eq (12), the stationary values of V - Lambda^2 T, as a generalised symmetric eigenproblem. The integrals
    over the length are exact: the integrands are polynomials and the Gauss–Legendre rule has enough points. Why
    a_1 = 1: docs/decisions/003-mode-scaling.md.

    Args:
        tooth: the beam.
        material: what it is made of; its damping plays no part.
        terms: number of terms and of modes, 1 to 10. The paper has 2; with more, each frequency falls towards the
            exact one (the first is 7e-4 too high with 2 terms), but the last modes of any number are poor.

    Raises:
        ValueError: when `terms` is outside its limits.

    Source: Pennestrì, Valentini, Vita, eqs (9), (11), (12), (15).
    """
    require_within("number of Ritz terms", terms, 1, _MOST_TERMS, "", "the paper has 2")
    # The longest integrand, A u^2, has degree 2 terms + 3; a rule of n points is exact to degree 2 n - 1.
    nodes, weights = leggauss(terms + 2)
    xi = (nodes + 1) / 2
    x = xi * tooth.length
    dx = weights * tooth.length / 2
    powers = np.arange(2, terms + 2)
    shapes = xi[:, None] ** powers
    curvatures = powers * (powers - 1) * xi[:, None] ** (powers - 2) / tooth.length**2
    mass = material.density * shapes.T @ (shapes * (dx * tooth.area(x))[:, None])
    stiffness = material.youngs_modulus * curvatures.T @ (curvatures * (dx * tooth.second_moment(x))[:, None])
    _, vectors = eigh(stiffness, mass)
    scaled = (vectors / vectors[0]).T
    return tuple(BeamMode(tuple(a.tolist()), float(a @ mass @ a), float(a @ stiffness @ a)) for a in scaled)
