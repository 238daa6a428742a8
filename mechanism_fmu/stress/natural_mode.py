"""What a mode of a beam is, and one from orthogonal polynomials."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.polynomial import legendre

from .checks import FloatArray


class Mode(Protocol):
    """One bending mode of a beam: its shape, and what it weighs and resists.

    Attributes:
        mass: modal mass m of eq (9) [kg].
        stiffness: modal stiffness k of eq (9) [N/m].
        natural_frequency: Lambda = sqrt(k / m) [rad/s].
    """

    @property
    def mass(self) -> float:
        """Modal mass m [kg]."""

    @property
    def stiffness(self) -> float:
        """Modal stiffness k [N/m]."""

    @property
    def natural_frequency(self) -> float:
        """Undamped natural frequency Lambda [rad/s]."""

    def legendre_series(self) -> FloatArray:
        """Coefficients of the shape over the Legendre polynomials of s = 2 xi - 1 [-]."""

    def shape(self, xi: FloatArray, derivative: int = 0) -> FloatArray:
        """Mode shape u, or its `derivative`-th derivative with respect to xi, at `xi` (0 root, 1 tip) [-]."""


@dataclass(frozen=True)
class NaturalMode:
    """One mode of `natural_modes`: u as a Legendre series in s = 2 xi - 1, with xi = x / length.

    Attributes:
        series: coefficients of the Legendre polynomials P_0, P_1, ... [-]; their scale fixes what eta of eq (8) means.
        mass: modal mass m of eq (9) [kg], for these coefficients.
        stiffness: modal stiffness k of eq (9) [N/m], for these coefficients; 0 of a rigid mode.
        name: "bending 1", "bending 2", ..., "rigid translation" or "rigid rotation".
    """

    series: tuple[float, ...]
    mass: float
    stiffness: float
    name: str

    @property
    def natural_frequency(self) -> float:
        """Undamped natural frequency Lambda = sqrt(k / m) [rad/s]."""
        return math.sqrt(self.stiffness / self.mass)

    def legendre_series(self) -> FloatArray:
        """Coefficients of the shape over the Legendre polynomials of s = 2 xi - 1 [-]."""
        return np.array(self.series)

    def shape(self, xi: FloatArray, derivative: int = 0) -> FloatArray:
        """Mode shape u, or its `derivative`-th derivative with respect to xi, at `xi` (0 root, 1 tip) [-]."""
        series = legendre.legder(self.legendre_series(), derivative, scl=2)
        return np.asarray(legendre.legval(2 * np.asarray(xi, dtype=np.float64) - 1, series))

    def scaled(self, factor: float) -> NaturalMode:
        """The same mode with `factor` times the deflection."""
        series = tuple(factor * c for c in self.series)
        return NaturalMode(series, factor**2 * self.mass, factor**2 * self.stiffness, self.name)
