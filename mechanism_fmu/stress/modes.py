"""Bending modes of a cantilever tooth by the Rayleigh–Ritz method."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import polynomial

from .beam import Beam
from .checks import FloatArray, require_within
from .material import Material
from .natural_mode import NaturalMode
from .powers import legendre_of_powers, powers_of_legendre
from .ritz import natural_modes
from .scaling import ModeScaling

#: Powers of xi tell little with more of them: each further one costs a digit.
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

    def legendre_series(self) -> FloatArray:
        """Coefficients of the shape over the Legendre polynomials of s = 2 xi - 1 [-]."""
        return legendre_of_powers(len(self.coefficients) + 1) @ [0.0, 0.0, *self.coefficients]


def ritz_modes(
    tooth: Beam,
    material: Material,
    terms: int = 2,
    scaling: ModeScaling = ModeScaling.FIRST_COEFFICIENT,
) -> tuple[BeamMode, ...]:
    """Modes of a cantilever from the deflection a_1 xi^2 + a_2 xi^3 + ..., the slowest first: the paper's.

    They are those of `natural_modes` for the same number of terms, written in powers of xi; why a_1 = 1, and what the
    other scaling means: docs/decisions/003-mode-scaling.md.

    Args:
        tooth: the beam.
        material: what it is made of; its damping plays no part.
        terms: number of terms and of modes, 1 to 10. The paper has 2; with more, each frequency falls towards the
            exact one (the first is 7e-4 too high with 2 terms), but the last modes of any number are poor.
        scaling: of the shapes; a_1 = 1 unless given.

    Raises:
        ValueError: when `terms` is outside its limits, or the cross section is not positive.

    Source: Pennestrì, Valentini, Vita, eqs (9), (11), (12), (15).
    """
    require_within("number of Ritz terms", terms, 1, _MOST_TERMS, "", "the paper has 2")
    modes = natural_modes(tooth, material, terms, scaling=scaling)
    return tuple(BeamMode(_powers(mode, scaling), mode.mass, mode.stiffness) for mode in modes)


def _powers(mode: NaturalMode, scaling: ModeScaling) -> tuple[float, ...]:
    """Coefficients a_1, a_2, ... of a mode of a beam that is clamped at its root."""
    a = (powers_of_legendre(len(mode.series) - 1) @ mode.series)[2:]
    rounding = a[0] if scaling is ModeScaling.FIRST_COEFFICIENT else 1.0  # a[0] is 1, nearly
    return tuple((a / rounding).tolist())
