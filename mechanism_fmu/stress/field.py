"""Bending of a tooth over its length and over time, for an impact velocity of 1 m/s."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import zip_longest

import numpy as np
from numpy.polynomial import legendre

from .beam import Beam
from .checks import FloatArray
from .material import Material
from .natural_mode import Mode
from .response import damped_response


class BendingField:
    """Moment and stress per unit of impact velocity: everything else is proportional to it.

    Args:
        tooth: the beam.
        material: what it is made of.
        modes: the modes that take part, at least one and none of them rigid.

    Raises:
        ValueError: when there is no mode, or a rigid one.

    Attributes:
        length: of the tooth [m].
        damping_ratio: zeta of every mode [-].
        frequencies: natural frequencies of the modes [rad/s], of shape (len(modes),).

    Source: Pennestrì, Valentini, Vita, eqs (13), (16).
    """

    def __init__(self, tooth: Beam, material: Material, modes: Sequence[Mode]) -> None:
        if not modes:
            raise ValueError("no mode takes part, so there is no stress to recover: give at least one of ritz_modes.")
        if not all(mode.stiffness > 0 for mode in modes):
            raise ValueError("a rigid mode bends nothing and has no stress: leave it out.")
        self.length = tooth.length
        self.damping_ratio = material.damping_ratio
        self._tooth = tooth
        self._youngs_modulus = material.youngs_modulus
        self.frequencies: FloatArray = np.array([mode.natural_frequency for mode in modes])
        shapes = np.array(list(zip_longest(*(mode.legendre_series() for mode in modes), fillvalue=0.0)))
        self._curvature = legendre.legder(shapes, 2, scl=2) / tooth.length**2

    def moment(self, x: FloatArray, t: FloatArray) -> FloatArray:
        """Bending moment M_b = -E I_n w'' [N m per m/s], of shape (len(x), len(t))."""
        return -self._youngs_modulus * self._tooth.second_moment(x)[:, None] * self._bending(x, t)

    def stress(self, x: FloatArray, t: FloatArray) -> FloatArray:
        """Bending stress M_b / W_b of the outer fibre [Pa per m/s], of shape (len(x), len(t)); zero at the tip."""
        return -self._youngs_modulus * self._tooth.outer_fibre(x)[:, None] * self._bending(x, t)

    def modal_stress(self, x: FloatArray) -> FloatArray:
        """Stress of the outer fibre where one mode has eta = 1 [Pa/m], of shape (len(x), number of modes)."""
        return np.asarray((-self._youngs_modulus * self._tooth.outer_fibre(x) * self._curvatures(x)).T)

    def stress_bounds(self, x: FloatArray) -> FloatArray:
        """Largest stress of each mode if it did not decay [Pa per m/s], of shape (len(x), number of modes)."""
        amplitudes = 1 / (self.frequencies * math.sqrt(1 - self.damping_ratio**2))
        return np.asarray(np.abs(self.modal_stress(x)) * amplitudes)

    def _bending(self, x: FloatArray, t: FloatArray) -> FloatArray:
        """Curvature w'' of the deflection of eq (16) [1/m per m/s], of shape (len(x), len(t))."""
        response = damped_response(self.frequencies, self.damping_ratio, 1.0, t)
        return np.asarray(self._curvatures(x).T @ response)

    def _curvatures(self, x: FloatArray) -> FloatArray:
        """Curvature of every mode shape [1/m2], of shape (number of modes, len(x))."""
        return np.asarray(legendre.legval(2 * x / self._tooth.length - 1, self._curvature))
