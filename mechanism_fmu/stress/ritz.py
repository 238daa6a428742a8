"""Natural bending modes of any beam by the Rayleigh–Ritz method, in orthogonal polynomials."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum
from functools import lru_cache
from typing import Protocol

import numpy as np
from numpy.polynomial import legendre

from .beam import Beam, FloatArray, gauss_points, require_within
from .material import Material

# How a beam is held at its ends, and the polynomials that respect it.


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
    n of them. Because the columns are orthonormal, so are the polynomials over xi: this basis is as well
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


# What a mode of a beam is, and one from orthogonal polynomials.


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
        """Mode shape u, or its `derivative`-th derivative with respect to xi, at `xi` (0 root, 1 tip) [-].

        Args:
            xi: places x / length [-], 0 root, 1 tip; any shape.
            derivative: number of the derivative with respect to xi, 0 for u itself.
        """


@dataclass(frozen=True)
class NaturalMode:
    """One mode of `natural_modes`: u as a Legendre series in s = 2 xi - 1, with xi = x / length.

    Attributes:
        series: coefficients of the Legendre polynomials P_0, P_1, ... [-]; their scale fixes what eta of eq (8) means.
        mass: modal mass m of eq (9) [kg], for these coefficients.
        stiffness: modal stiffness k of eq (9) [N/m], for these coefficients; 0 of a rigid mode.
        name: "bending 1", "bending 2", ..., "rigid translation" or "rigid rotation".

    Source: `natural_modes`: Pennestrì, Valentini, Vita, eqs (8), (9).
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
        """Mode shape u, or its `derivative`-th derivative with respect to xi, at `xi` (0 root, 1 tip) [-].

        Args:
            xi: places x / length [-], 0 root, 1 tip; any shape.
            derivative: number of the derivative with respect to xi, 0 for u itself.
        """
        series = legendre.legder(self.legendre_series(), derivative, scl=2)
        return np.asarray(legendre.legval(2 * np.asarray(xi, dtype=np.float64) - 1, series))

    def scaled(self, factor: float) -> NaturalMode:
        """The same mode with `factor` times the deflection.

        Args:
            factor: of the deflection [-]; mass and stiffness grow with its square.
        """
        series = tuple(factor * c for c in self.series)
        return NaturalMode(series, factor**2 * self.mass, factor**2 * self.stiffness, self.name)


# Mode normalisation: a mode shape has no scale of its own, but the stress depends on it.

#: A mode of which this part or less takes part in a motion takes no part in it.
_NO_SHARE = 1e-9


class ModeScaling(Enum):
    """The scale of mode shapes that all start with eta'(0) = v_I; see docs/decisions/003-mode-scaling.md.

    Attributes:
        FIRST_COEFFICIENT: the lowest power of xi that the root allows has the coefficient 1; for a clamped root a_1 = 1
            of u = a_1 xi^2 + a_2 xi^3 + ..., which gives the paper's "40 % of the length".
        PROJECTION: the shapes add up to xi, the rigid rotation about the root, so that the tooth starts with the
            velocity v_I xi all along. The stress then depends on no scale.
    """

    FIRST_COEFFICIENT = "a1 = 1"
    PROJECTION = "projection of the rigid rotation"


def scaled(mode: NaturalMode, beam: Beam, material: Material, root: End, scaling: ModeScaling) -> NaturalMode:
    """The bending mode `mode`, scaled.

    Raises:
        ValueError: the mode has no such scale.
    """
    if scaling is ModeScaling.PROJECTION:
        return mode.scaled(_share_in_rotation(mode, beam, material))
    return mode.scaled(1 / _first_coefficient(mode, root))


def _first_coefficient(mode: NaturalMode, root: End) -> float:
    """Coefficient of the lowest power of xi that the root allows [-]: 2 for a clamped root, 1 for a pinned, else 0."""
    power = next(power for power in range(3) if power not in root.vanishing)
    derivatives = mode.shape(np.array([0.0]), derivative=power)
    return float(derivatives[0]) / math.factorial(power)


def _share_in_rotation(mode: NaturalMode, beam: Beam, material: Material) -> float:
    """Coefficient of the mode when the rotation xi is written as a sum of modes: integral of rho A u xi over m [-].

    Raises:
        ValueError: the mode takes no part in it.
    """
    x, dx = gauss_points(beam, len(mode.series))
    xi = x / beam.length
    weight = material.density * dx * beam.area(x)
    share = float(weight @ (xi * mode.shape(xi))) / mode.mass
    largest = math.sqrt(float(weight @ xi**2) / mode.mass)
    if abs(share) <= _NO_SHARE * largest:
        raise ValueError(
            f"{mode.name} takes no part in a rotation about the root, so the projection gives it no scale: choose "
            "ModeScaling.FIRST_COEFFICIENT, or hold the root."
        )
    return share


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
    vectors = _slow_first(mass, stiffness + shift * mass)
    bending = [vector / math.sqrt(vector @ mass @ vector) for vector in vectors[first:]]
    modes = (
        NaturalMode(tuple((polynomials @ u).tolist()), 1.0, float(u @ stiffness @ u), f"bending {number}")
        for number, u in enumerate(bending, 1)
    )
    kept = _rigid_modes(beam, material, motions) if rigid else ()
    return (*kept, *(scaled(mode, beam, material, root, scaling) for mode in modes))


def _slow_first(mass: FloatArray, stiffness: FloatArray) -> FloatArray:
    """Eigenvectors u of M u = (1/Lambda^2) K u as rows, those of the slowest modes first.

    By Cholesky's factor of K, scaled so that its diagonal is 1: stiffnesses differ by many powers of ten.
    """
    scale = 1.0 / np.sqrt(np.diag(stiffness))
    factor = np.linalg.cholesky(stiffness * np.outer(scale, scale))
    half = np.linalg.solve(factor, mass * np.outer(scale, scale))
    _, vectors = np.linalg.eigh(np.linalg.solve(factor, half.T))
    found: FloatArray = (scale[:, None] * np.linalg.solve(factor.T, vectors)).T[::-1]
    return found


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
