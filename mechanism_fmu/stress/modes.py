"""Bending modes of a cantilever tooth by the Rayleigh–Ritz method: as many as asked for, or as its stress needs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from math import comb

import numpy as np
from numpy.polynomial import polynomial

from .beam import Beam, FloatArray, require_within
from .material import Material
from .ritz import ModeScaling, NaturalMode, natural_modes
from .tooth import WedgeTooth

# Powers of xi and Legendre polynomials of s = 2 xi - 1, each written in the other.


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


#: Powers of xi add little with more of them: each further one costs a digit.
_MOST_TERMS = 10


@dataclass(frozen=True)
class BeamMode:
    """One bending mode u(xi) = sum of a_i xi^(i+1), i = 1, 2, ..., with xi = x / length, of a cantilever beam.

    Attributes:
        coefficients: a_1, a_2, ... [-]; their scale fixes what eta of eq (8) means.
        mass: modal mass m of eq (9) [kg], for these coefficients.
        stiffness: modal stiffness k of eq (9) [N/m], for these coefficients.

    Source: `ritz_modes`: Pennestrì, Valentini, Vita, eqs (8), (9).
    """

    coefficients: tuple[float, ...]
    mass: float
    stiffness: float

    @property
    def natural_frequency(self) -> float:
        """Undamped natural frequency Lambda = sqrt(k / m) [rad/s]."""
        return math.sqrt(self.stiffness / self.mass)

    def shape(self, xi: FloatArray, derivative: int = 0) -> FloatArray:
        """Mode shape u, or its `derivative`-th derivative with respect to xi, at `xi` (0 root, 1 tip) [-].

        Args:
            xi: places x / length [-], 0 root, 1 tip; any shape.
            derivative: number of the derivative with respect to xi, 0 for u itself.
        """
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


# As many modes of a cantilever as its largest stress needs.

#: How many take part, and of how many terms: the first half of the modes of a Ritz series are good.
_MODES, _TERMS = 20, 40

#: As long as it is thick at its root.
WEDGE = WedgeTooth(length=1.0, apex_angle=math.pi / 4)


def converged_modes(tooth: Beam, material: Material) -> tuple[NaturalMode, ...]:
    """The first 20 natural modes of a cantilever that starts from a rigid rotation, the slowest first.

    Together they stress it as all modes would: with more of them, the largest stress of a wedge, a trapezoid or a
    uniform beam changes by less than 1e-6 at the damping ratio 0.03, by 1e-4 at 0.01 and by 2e-3 at 0.001, where fast
    modes live longer. The paper's two Ritz modes give a wedge 22 % less. Cross sections with steps need more terms: see
    `natural_modes`.

    All wedges are one shape, so their modes are those of one wedge with other masses and stiffnesses; those of other
    beams are remembered.

    Args:
        tooth: the beam.
        material: what it is made of; its damping plays no part.

    Raises:
        ValueError: when the cross section is not positive.

    Source: Pennestrì, Valentini, Vita, eqs (9), (11), (12), with the scaling of docs/decisions/003-mode-scaling.md.
    """
    return _modes(tooth, material.youngs_modulus, material.density)


@lru_cache(maxsize=1024)
def _modes(tooth: Beam, youngs_modulus: float, density: float) -> tuple[NaturalMode, ...]:
    if isinstance(tooth, WedgeTooth) and tooth != WEDGE:
        # With h = l tan(alpha): m ~ rho b h l and k ~ E b (h / l)^3; the shapes over xi are the same.
        slope = math.tan(tooth.apex_angle)
        width = tooth.thickness / WEDGE.thickness
        mass, stiffness = density * width * slope * tooth.length**2, youngs_modulus * width * slope**3
        return tuple(
            NaturalMode(mode.series, mass * mode.mass, stiffness * mode.stiffness, mode.name)
            for mode in _modes(WEDGE, 1.0, 1.0)
        )
    material = Material(youngs_modulus, density, damping_ratio=0.0)
    return natural_modes(tooth, material, _TERMS, scaling=ModeScaling.PROJECTION)[:_MODES]


# The exact bending frequencies of a wedge: the reference that Rayleigh–Ritz modes approach from above.

#: More than anybody can use; the asymptotic distance of the roots was checked as far.
_MOST = 1000


def exact_wedge_frequencies(tooth: WedgeTooth, material: Material, count: int) -> FloatArray:
    """The first `count` natural frequencies Lambda [rad/s] of a clamped wedge, to rounding.

    With s = 1 - xi, eqs (9) and (14) lead to (s^3 u'')'' = p^2 s u, where p = Lambda sqrt(12 rho / E) l / tan(alpha).
    The operator splits into (B - p)(B + p) u = 0 with B u = (s^2 u')' / s, so that u = J1(z) / sqrt(s) and
    u = I1(z) / sqrt(s), z = 2 sqrt(p s), are its solutions without moment and shear force at the tip s = 0. The root of
    the beam, s = 1, neither moves nor turns: with (J1(z) / z)' = -J2(z) / z and (I1(z) / z)' = I2(z) / z,

        J1(z) I2(z) + I1(z) J2(z) = 0,  Lambda = z^2 / (4 sqrt(12)) sqrt(E / rho) tan(alpha) / l.

    For large z this becomes cos(z) = 0 up to a constant factor: one root in each interval (k pi, (k + 1) pi),
    k = 1, 2, ...

    Args:
        tooth: the wedge.
        material: what it is made of; its damping plays no part.
        count: of frequencies, 1 to 1000.

    Raises:
        ValueError: when `count` is outside its limits.

    Source: G. Kirchhoff, Über die Transversalschwingungen eines Stabes von veränderlichem Querschnitt (1879).
    """
    from scipy.optimize import brentq  # takes long to load, and few commands get here

    require_within("number of frequencies", count, 1, _MOST, "", "ask for as many as you can use")

    roots = [brentq(_clamped, k * math.pi, (k + 1) * math.pi, xtol=1e-14, rtol=1e-15) for k in range(1, count + 1)]
    unit = math.sqrt(material.youngs_modulus / material.density) * math.tan(tooth.apex_angle) / tooth.length
    return np.array(roots) ** 2 / (4 * math.sqrt(12)) * unit


def _clamped(z: float) -> float:
    """J1 I2 + I1 J2, the modified functions without their growth exp(z)."""
    from scipy.special import ive, jv

    return float(jv(1, z) * ive(2, z) + ive(1, z) * jv(2, z))
