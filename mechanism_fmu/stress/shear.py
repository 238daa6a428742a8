"""Transverse shear along the tooth after an impact."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from .beam import Beam
from .checks import FloatArray
from .material import Material
from .modes import ritz_modes
from .natural_mode import Mode
from .quadrature import gauss_rule
from .recovery import checked
from .response import damped_response

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

    Arguments and errors are those of `bending_stress`.
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

    Arguments and errors are those of `bending_stress`.

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
