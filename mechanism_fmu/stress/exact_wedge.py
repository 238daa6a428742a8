"""The exact bending frequencies of a wedge: the reference that Rayleigh–Ritz modes approach from above."""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import brentq
from scipy.special import ive, jv

from .checks import FloatArray, require_within
from .material import Material
from .tooth import WedgeTooth

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
    require_within("number of frequencies", count, 1, _MOST, "", "ask for as many as you can use")
    roots = [brentq(_clamped, k * math.pi, (k + 1) * math.pi, xtol=1e-14, rtol=1e-15) for k in range(1, count + 1)]
    unit = math.sqrt(material.youngs_modulus / material.density) * math.tan(tooth.apex_angle) / tooth.length
    return np.array(roots) ** 2 / (4 * math.sqrt(12)) * unit


def _clamped(z: float) -> float:
    """J1 I2 + I1 J2, the modified functions without their growth exp(z)."""
    return float(jv(1, z) * ive(2, z) + ive(1, z) * jv(2, z))
