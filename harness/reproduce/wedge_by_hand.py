"""The paper's beam without this project's modes: closed forms of eqs (11) to (16) with two terms, and a quadrature.

With xi = x/l, K_ij and M_ij of u = a_1 xi^2 + a_2 xi^3 are integrals of (1 - xi)^3 u'' u'' and (1 - xi) u u, beta
functions all of them. Times in l / (sqrt(E/rho) tan alpha), stresses in v_I sqrt(rho E).
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from scipy.integrate import solve_ivp
from scipy.linalg import eigh
from scipy.optimize import minimize
from scipy.special import beta

FloatArray = npt.NDArray[np.float64]

#: Lambda^2 with two terms is (273 -+ 7 sqrt(1041)) / 20.
LAMBDAS = tuple(math.sqrt((273 + sign * 7 * math.sqrt(1041)) / 20) for sign in (-1, 1))
#: a_2 / a_1, from the first row of (12): K = [[1, 3/5], [3/5, 3/5]] and M = [[1/30, 1/42], [1/42, 1/56]].
RATIOS = tuple(-(1 - 12 * x * x / 30) / (3 / 5 - 12 * x * x / 42) for x in LAMBDAS)

_DAMPING = 0.03


def frequencies(terms: int) -> FloatArray:
    """Lambda with powers xi^2 to xi^(terms + 1), in units of sqrt(E/rho) tan(alpha) / l, shape (terms,)."""
    powers = np.arange(2, terms + 2)
    i, j = np.meshgrid(powers, powers)
    stiffness = i * (i - 1) * j * (j - 1) * beta(i + j - 3, 4) / 12
    mass = beta(i + j + 1, 2)
    return np.asarray(np.sqrt(eigh(stiffness, mass, eigvals_only=True)))


def swings(times: FloatArray) -> list[FloatArray]:
    """Eta of both modes by integrating eq (10) from 0 and 1, each of shape (times,)."""
    found = []
    for rate in LAMBDAS:

        def slope(_t: float, y: FloatArray, rate: float = rate) -> list[float]:
            return [y[1], -2 * _DAMPING * rate * y[1] - rate**2 * y[0]]

        span = (0.0, float(times[-1]))
        found.append(solve_ivp(slope, span, [0.0, 1.0], "DOP853", times, rtol=1e-11, atol=1e-13).y[0])
    return found


def stress(xi: FloatArray, eta: list[FloatArray]) -> FloatArray:
    """Sigma of eqs (13) and (16) for a_1 = 1, without its sign, shape (places, times)."""
    field = sum(np.outer((1 - xi) / 2 * (2 + 6 * ratio * xi), swing) for ratio, swing in zip(RATIOS, eta, strict=True))
    return np.asarray(field)


def largest() -> tuple[float, float]:
    """C = sigma_max / (v_I sqrt(rho E)) and x/l of it, by a grid and then by Nelder and Mead's method."""
    root = math.sqrt(1 - _DAMPING**2)

    def at(place: FloatArray) -> float:
        eta = [
            np.array([math.exp(-_DAMPING * r * place[1]) * math.sin(root * r * place[1]) / (root * r)]) for r in LAMBDAS
        ]
        return -abs(float(stress(np.array([place[0]]), eta)[0, 0]))

    places = [np.array([x, t]) for x in np.linspace(0, 1, 41) for t in np.linspace(0, 8, 161)]
    best = minimize(at, min(places, key=at), method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-13})
    return -float(best.fun), float(best.x[0])
