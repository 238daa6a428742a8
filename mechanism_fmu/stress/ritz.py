"""Natural bending modes of any beam by the Rayleigh–Ritz method, in orthogonal polynomials."""

from __future__ import annotations

import math

import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import eigh

from .beam import Beam
from .checks import FloatArray, require_within
from .ends import End, admissible, norms, rigid_motions
from .material import Material
from .natural_mode import NaturalMode
from .quadrature import gauss_points
from .scaling import ModeScaling, scaled

#: Beyond this many terms the frequencies gain nothing and the highest modes are noise.
_MOST_TERMS = 60


def natural_modes(
    beam: Beam,
    material: Material,
    terms: int = 12,
    *,
    root: End = End.CLAMPED,
    tip: End = End.FREE,
    scaling: ModeScaling = ModeScaling.FIRST_COEFFICIENT,
    rigid: bool = False,
) -> tuple[NaturalMode, ...]:
    """Modes of `beam` from deflections that are polynomials, the slowest first.

    Solves eq (12), the stationary values of V - Lambda^2 T, over the `terms` polynomials of lowest degree that fulfil
    the geometric end conditions. Integrals over the length are by the Gauss–Legendre rule, piece by piece between the
    beam's breaks: exact where the cross section is a polynomial of x.

    With n terms about the first n / 2 modes are good, and the first of them to near rounding; the last are poor.

    Args:
        beam: what swings.
        material: what it is made of; its damping plays no part.
        terms: number of terms, rigid motions included, 1 to 60; there is a mode for each.
        root: how x = 0 is held.
        tip: how x = length is held.
        scaling: of the shapes of the bending modes; rigid ones move the beam by 1 or turn it by 1 / length.
        rigid: whether modes without bending, of frequency 0, are among the modes; they come first, then.

    Raises:
        ValueError: when `terms` is outside its limits or leaves no bending mode, the cross section is not positive, or
            a mode has no such scale.

    Source: Pennestrì, Valentini, Vita, eqs (9), (11), (12).
    """
    motions = rigid_motions(root, tip)
    advice = "12 give the first three modes of most beams to ten digits; each rigid motion takes one"
    require_within("number of Ritz terms", terms, 1 + len(motions), _MOST_TERMS, "", advice)
    basis = admissible(terms, root, tip)
    polynomials = norms(len(basis) - 1)[:, None] * basis
    mass, stiffness = _energies(beam, material, polynomials)
    # Inverse problem: slow modes are its large eigenvalues and lose nothing to the huge stiffness of the fast ones. The
    # shift makes the stiffness of rigid motions, the first polynomials, positive; it is about that of the first mode.
    first = len(motions)
    shift = float(stiffness[first, first] / mass[first, first]) if motions else 0.0
    _, vectors = eigh(mass, stiffness + shift * mass)
    bending = [vector / math.sqrt(vector @ mass @ vector) for vector in vectors.T[::-1][first:]]
    modes = (
        NaturalMode(tuple((polynomials @ u).tolist()), 1.0, float(u @ stiffness @ u), f"bending {number}")
        for number, u in enumerate(bending, 1)
    )
    kept = _rigid_modes(beam, material, motions) if rigid else ()
    return (*kept, *(scaled(mode, beam, material, root, scaling) for mode in modes))


def _energies(beam: Beam, material: Material, polynomials: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mass and stiffness matrices of eq (9) over `polynomials`, columns of Legendre coefficients.

    Raises:
        ValueError: the cross section is not positive somewhere.
    """
    x, dx = gauss_points(beam, len(polynomials))
    area, second_moment = beam.area(x), beam.second_moment(x)
    for name, values in (("area", area), ("second moment", second_moment)):
        if not np.all((values > 0) & np.isfinite(values)):
            wrong = int(np.argmin((values > 0) & np.isfinite(values)))
            raise ValueError(
                f"the {name} of the beam is {values[wrong]:g} at x = {x[wrong]:g} m: it must be positive there."
            )
    s = 2 * x / beam.length - 1
    deflections = legendre.legval(s, polynomials)
    curvatures = legendre.legval(s, legendre.legder(polynomials, 2, scl=2)) / beam.length**2
    mass = deflections * (material.density * dx * area) @ deflections.T
    stiffness = curvatures * (material.youngs_modulus * dx * second_moment) @ curvatures.T
    return mass, stiffness


def _rigid_modes(beam: Beam, material: Material, motions: dict[str, tuple[float, float]]) -> tuple[NaturalMode, ...]:
    """Motions without bending, those that come later without any part of those before."""
    x, dx = gauss_points(beam, 2)
    weight = material.density * dx * beam.area(x)
    xi = x / beam.length
    modes: list[NaturalMode] = []
    for name, (c_0, c_1) in motions.items():
        series = np.array([c_0 + c_1 / 2, c_1 / 2])
        for other in modes:
            part = float(weight @ (other.shape(xi) * legendre.legval(2 * xi - 1, series))) / other.mass
            series = series - part * other.legendre_series()
        mass = float(weight @ legendre.legval(2 * xi - 1, series) ** 2)
        modes.append(NaturalMode(tuple(series.tolist()), mass, 0.0, name))
    return tuple(modes)
