"""Stress recovery: response of the modes, bending moment, stress and shear along the tooth after an impact."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from itertools import zip_longest

import numpy as np
import numpy.typing as npt
from numpy.polynomial import legendre

from .beam import Beam, FloatArray, gauss_rule, require_all_within, require_impact_velocity
from .material import Material
from .modes import ritz_modes
from .ritz import Mode

# Free response of a mode to an impact.


def damped_response(
    natural_frequency: FloatArray, damping_ratio: float, impact_velocity: float, t: FloatArray
) -> FloatArray:
    """Modal coordinates eta_i(t) [m] after an impact at t = 0, of shape (number of modes, len(t)).

    Each solves m eta'' + c eta' + k eta = 0 with c = 2 zeta sqrt(k m), eta(0) = 0 and eta'(0) = v_I:
    eta = v_I / Lambda_d exp(-zeta Lambda t) sin(Lambda_d t), where Lambda_d = Lambda sqrt(1 - zeta^2).

    Args:
        natural_frequency: Lambda_i = sqrt(k_i / m_i) [rad/s], of shape (number of modes,).
        damping_ratio: zeta [-], 0 <= zeta < 1.
        impact_velocity: v_I [m/s].
        t: times since the impact [s], of shape (n,).

    Source: Pennestrì, Valentini, Vita, eq (10) and the initial conditions below it.
    """
    damped = natural_frequency * math.sqrt(1 - damping_ratio**2)
    decay = np.exp(-damping_ratio * np.multiply.outer(natural_frequency, t))
    swing = np.sin(np.multiply.outer(damped, t))
    return np.asarray((impact_velocity / damped)[:, None] * decay * swing)


# Bending of a tooth over its length and over time, for an impact velocity of 1 m/s.


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


# Stress recovery: bending moment and stress along the tooth after an impact.

#: Latest time [s] since the impact; it only keeps the phase of the fastest tooth finite.
_LATEST_TIME = 1e9


def bending_moment(
    tooth: Beam,
    material: Material,
    impact_velocity: float,
    x: npt.ArrayLike,
    t: npt.ArrayLike,
    modes: Sequence[Mode] | None = None,
) -> FloatArray:
    """Bending moment M_b = -E I_n w'' [N m], of shape (len(x), len(t)).

    Arguments and errors as of `bending_stress`.

    Source: Pennestrì, Valentini, Vita, eqs (13), (16).
    """
    places, times = checked(tooth, impact_velocity, x, t)
    return impact_velocity * _field(tooth, material, modes).moment(places, times)


def bending_stress(
    tooth: Beam,
    material: Material,
    impact_velocity: float,
    x: npt.ArrayLike,
    t: npt.ArrayLike,
    modes: Sequence[Mode] | None = None,
) -> FloatArray:
    """Bending stress sigma_b = M_b / W_b of the outer fibre [Pa], of shape (len(x), len(t)).

    At the tip, where M_b and W_b vanish, it is their limit: zero.

    Args:
        tooth: the beam.
        material: what it is made of.
        impact_velocity: |v_I| [m/s], >= 0: the tooth's length times the jump of the wheel's rate in the impact,
            l |omega_after - omega_before|.
        x: distances from the root [m], from 0 to the length of the tooth; a number or shape (n,).
        t: times since the impact [s], 0 to 1e9; a number or shape (m,).
        modes: the modes that take part; without them the two of `ritz_modes`, as in the paper.

    Raises:
        ValueError: when velocity, a place or a time is outside its limits or not a number, or `modes` is empty or has a
            rigid one.

    Source: Pennestrì, Valentini, Vita, eqs (13), (16).
    """
    places, times = checked(tooth, impact_velocity, x, t)
    return impact_velocity * _field(tooth, material, modes).stress(places, times)


def _field(tooth: Beam, material: Material, modes: Sequence[Mode] | None) -> BendingField:
    return BendingField(tooth, material, ritz_modes(tooth, material) if modes is None else modes)


def checked(tooth: Beam, impact_velocity: float, x: npt.ArrayLike, t: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Places and times as one-dimensional arrays, after refusing what cannot be right."""
    places = np.atleast_1d(np.asarray(x, dtype=np.float64))
    times = np.atleast_1d(np.asarray(t, dtype=np.float64))
    require_impact_velocity(impact_velocity)
    require_all_within("place", places, 0.0, tooth.length, "m", "x runs from the root to the tip of the tooth")
    require_all_within("time", times, 0.0, _LATEST_TIME, "s", "t counts from the impact")
    return places, times


# Transverse shear along the tooth after an impact.

#: Points of the rule between two breaks of the beam.
_POINTS = 64

#: Largest over mean shear stress of a rectangular section.
_RECTANGLE = 1.5


def shear_force(
    tooth: Beam,
    material: Material,
    impact_velocity: float,
    x: npt.ArrayLike,
    t: npt.ArrayLike,
    modes: Sequence[Mode] | None = None,
) -> FloatArray:
    """Elastic shear force V = dM_b / dx [N], of shape (len(x), len(t)), of a beam whose tip is free.

    It is what speeds up the part between x and the tip: V = sum of Lambda_i^2 eta_i(t) times the integral of rho A u_i
    from x to the tip. For exact modes that is the derivative of `bending_moment`; for modes of few Ritz terms it is
    much closer to it than their own derivative, and it vanishes at the free tip, as it must.

    Arguments as of `bending_stress`, where none of the modes is rigid.

    Raises:
        ValueError: when velocity, a place or a time is outside its limits or not a number.

    Source: equilibrium of the part beyond x, with the modes of Pennestrì, Valentini, Vita, eqs (8) to (10);
        docs/explanation/stress.md, section Shear, axial stress, contact pressure.
    """
    places, times = checked(tooth, impact_velocity, x, t)
    modes = ritz_modes(tooth, material) if modes is None else modes
    frequencies = np.array([mode.natural_frequency for mode in modes])
    loads = np.array([_beyond(tooth, material, mode, places) for mode in modes])
    response = damped_response(frequencies, material.damping_ratio, impact_velocity, times)
    return np.asarray((loads * frequencies[:, None] ** 2).T @ response)


def shear_stress(
    tooth: Beam,
    material: Material,
    impact_velocity: float,
    x: npt.ArrayLike,
    t: npt.ArrayLike,
    modes: Sequence[Mode] | None = None,
) -> FloatArray:
    """Largest shear stress over the cross section, 3/2 V / A [Pa], of shape (len(x), len(t)); zero at a sharp tip.

    It acts at the neutral axis, where the bending stress is zero; at the outer fibre it vanishes. It holds for
    rectangular sections of a height that changes slowly along x: in a wedge as stubby as a ratchet's tooth it is an
    estimate, since the parabola over the height is that of the uniform beam. That shear also softens the beam
    (Timoshenko) is not in it: the modes are those of Euler and Bernoulli.

    Arguments as of `bending_stress`, where none of the modes is rigid; errors as of `shear_force`.

    Source: S. P. Timoshenko, J. M. Gere, Mechanics of Materials, section on shear stresses in rectangular beams.
    """
    places, _ = checked(tooth, impact_velocity, x, t)
    force = shear_force(tooth, material, impact_velocity, x, t, modes)
    area = np.asarray(tooth.area(places))[:, None]
    # At a sharp tip force and area vanish, the force faster.
    return np.divide(_RECTANGLE * force, area, out=np.zeros_like(force), where=area > 0)


def _beyond(tooth: Beam, material: Material, mode: Mode, x: FloatArray) -> FloatArray:
    """Integral of rho A u from each place to the tip [kg], in the shape of `x`."""
    nodes, weights = gauss_rule(_POINTS)
    edges = (0.0, *tooth.breaks, tooth.length)
    whole = np.zeros_like(x)
    for low, high in itertools.pairwise(edges):
        a, b = np.maximum(low, x), np.maximum(high, x)  # nothing of a piece that lies before x
        points = a[:, None] + (b - a)[:, None] * (nodes + 1) / 2
        whole += (tooth.area(points) * mode.shape(points / tooth.length)) @ weights * (b - a) / 2
    return material.density * whole
