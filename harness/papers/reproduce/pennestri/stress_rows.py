"""Section 4 of Pennestrì, Valentini, Vita: eqs (8) to (13), Fig. 3; and the beam by hand."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.linalg import eigh
from scipy.optimize import approx_fprime, minimize
from scipy.special import beta

from mechanism_fmu.stress import (
    STEEL,
    BeamMode,
    WedgeTooth,
    bending_moment,
    bending_stress,
    damped_response,
    ritz_modes,
)

from ..bench import Bench, FloatArray, each_off_by, first_derivative, off_by, second_derivative
from ..figures.all_figures import redrawn
from ..row import Found, Row, within

# The paper's beam without this project's modes: closed forms of eqs (11) to (16) with two terms, and a quadrature.
#
# With xi = x/l, K_ij and M_ij of u = a_1 xi^2 + a_2 xi^3 are integrals of (1 - xi)^3 u'' u'' and (1 - xi) u u, beta
# functions all of them. Times in l / (sqrt(E/rho) tan alpha), stresses in v_I sqrt(rho E).

#: Lambda^2 with two terms is (273 -+ 7 sqrt(1041)) / 20.
LAMBDAS = tuple(math.sqrt((273 + sign * 7 * math.sqrt(1041)) / 20) for sign in (-1, 1))
#: a_2 / a_1, from the first row of (12): K = [[1, 3/5], [3/5, 3/5]] and M = [[1/30, 1/42], [1/42, 1/56]].
RATIOS = tuple(-(1 - 12 * x * x / 30) / (3 / 5 - 12 * x * x / 42) for x in LAMBDAS)

_DAMPING = 0.03


def frequencies(terms: int) -> FloatArray:
    """Lambda with powers xi^2 to xi^(terms + 1), in units of sqrt(E/rho) tan(alpha) / l, shape (terms,)."""
    i, j = np.meshgrid(*[np.arange(2, terms + 2)] * 2)
    stiffness = i * (i - 1) * j * (j - 1) * beta(i + j - 3, 4) / 12
    return np.asarray(np.sqrt(eigh(stiffness, beta(i + j + 1, 2), eigvals_only=True)))


def swings(times: FloatArray) -> list[FloatArray]:
    """Eta of both modes by integrating eq (10) from 0 and 1, each of shape (times,)."""

    def slope(_t: float, y: FloatArray, rate: float) -> list[float]:
        return [y[1], -2 * _DAMPING * rate * y[1] - rate**2 * y[0]]

    span, options = (0.0, float(times[-1])), {"rtol": 1e-11, "atol": 1e-13}
    return [solve_ivp(slope, span, [0.0, 1.0], "DOP853", times, args=(rate,), **options).y[0] for rate in LAMBDAS]


def stress(xi: FloatArray, eta: list[FloatArray]) -> FloatArray:
    """Sigma of eqs (13) and (16) for a_1 = 1, without its sign, shape (places, times)."""
    return np.asarray(np.transpose([(1 - xi) / 2 * (2 + 6 * ratio * xi) for ratio in RATIOS]) @ np.array(eta))


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


RITZ, RECOVERY, TOOTH, MODES = (f"mechanism_fmu/stress/{name}.py" for name in ("ritz", "recovery", "tooth", "modes"))

#: Places and times at which fields are compared, in parts of the length and of the first period.
XI = np.linspace(0.05, 0.9, 18)


def times_of(modes: tuple[BeamMode, ...]) -> FloatArray:
    """Times over two periods of the first mode [s]."""
    return np.linspace(0.0, 2.0, 41) * 2 * math.pi / modes[0].natural_frequency


def swing(mode: BeamMode, speed: float, t: FloatArray) -> FloatArray:
    """Eta of one mode, of shape (times,)."""
    return np.asarray(damped_response(np.array([mode.natural_frequency]), STEEL.damping_ratio, speed, t)[0])


def _eq8(tooth: WedgeTooth, speed: float) -> Found:
    """One mode: the moment at all times is one curve along the tooth, times a function of time."""
    mode = ritz_modes(tooth, STEEL)[:1]
    field = bending_moment(tooth, STEEL, speed, XI * tooth.length, times_of(mode), mode)
    values = np.linalg.svd(field, compute_uv=False)
    return within(
        float(values[1] / values[0]),
        1e-12,
        "one mode: bending along the tooth and in time is a product, u''(x) η(t), rank 1",
        f"base case, v_I = {speed:.6e} m/s",
    )


def _eq9(tooth: WedgeTooth) -> Found:
    modes = ritz_modes(tooth, STEEL)
    found = [by_quadrature(tooth, mode) for mode in modes]
    worked = [f"m = {m:.6e} kg, k = {k:.6e} N/m, √(k/m) = {math.sqrt(k / m):.2f} rad/s" for m, k in found]
    return within(
        each_off_by(found, [(mode.mass, mode.stiffness) for mode in modes]),
        1e-10,
        f"base case, first mode: {worked[0]}; integrals by adaptive quadrature",
        *worked,
    )


def by_quadrature(tooth: WedgeTooth, mode: BeamMode) -> tuple[float, float]:
    """The modal mass [kg] and stiffness [N/m] of eq (9), integral by integral, with A and I of eq (14)."""
    slope, length, b = math.tan(tooth.apex_angle), tooth.length, tooth.thickness

    def mass(xi: float) -> float:
        return float(b * length * (1 - xi) * slope * mode.shape(np.array(xi)) ** 2)

    def stiffness(xi: float) -> float:
        second = float(mode.shape(np.array(xi), derivative=2)) / length**2
        return b / 12 * (length * (1 - xi) * slope) ** 3 * second**2

    return (
        STEEL.density * length * quad(mass, 0, 1, epsabs=0, epsrel=1e-13)[0],
        STEEL.youngs_modulus * length * quad(stiffness, 0, 1, epsabs=0, epsrel=1e-13)[0],
    )


def _left_over(mode: BeamMode, speed: float) -> float:
    """By the closed form in eq (10), by differences, in parts of the largest force of the spring."""
    c, h = 2 * STEEL.damping_ratio * math.sqrt(mode.stiffness * mode.mass), 0.01 / mode.natural_frequency
    t = np.linspace(4, 300, 100) * h

    def eta(when: FloatArray) -> FloatArray:
        return swing(mode, speed, when)

    spring = mode.stiffness * eta(t)
    left = mode.mass * second_derivative(eta, t, h) + c * first_derivative(eta, t, h) + spring
    return float(np.abs(left).max() / np.abs(spring).max())


def _eq10(tooth: WedgeTooth, speed: float) -> Found:
    """The closed form put into the equation, by differences."""
    modes, root = ritz_modes(tooth, STEEL), math.sqrt(1 - STEEL.damping_ratio**2)
    damped = modes[0].natural_frequency * root
    return within(
        max(_left_over(mode, speed) for mode in modes),
        1e-6,
        "η = v_I/Λ_d e^(−ζΛt) sin Λ_d t, Λ_d = Λ√(1 − ζ²), put into (10) leaves nothing; η(0) = 0, η'(0) = v_I",
        f"base case: Λ_d = {damped:.2f} rad/s; a period takes {2 * math.pi / damped * 1e6:.4f} µs, and the swing "
        f"falls to {math.exp(-2 * math.pi * STEEL.damping_ratio / root):.4f} in it",
    )


def _eq11(tooth: WedgeTooth) -> Found:
    unit = math.sqrt(STEEL.youngs_modulus / STEEL.density) * math.tan(tooth.apex_angle) / tooth.length
    found = {n: np.array([mode.natural_frequency for mode in ritz_modes(tooth, STEEL, n)]) / unit for n in (2, 3, 4)}
    return within(
        max(each_off_by(values, frequencies(terms)) for terms, values in found.items()),
        1e-9,
        "powers ξ², ξ³, … (a_0 = a_1 = 0, the root is clamped): Λ with 2, 3, 4 terms = scipy's eigenvalues of "
        "matrices of beta functions",
        *(f"{terms} terms: " + ", ".join(f"{value:.5f}" for value in frequencies(terms)) for terms in found),
    )


def _eq12(tooth: WedgeTooth) -> Found:
    """The gradient of V - Lambda^2 T at the mode shapes, by differences of the energies."""
    modes = ritz_modes(tooth, STEEL)

    def balance(a: FloatArray, mode: BeamMode) -> float:
        m, k = by_quadrature(tooth, replace(mode, coefficients=tuple(a)))
        return (k - mode.natural_frequency**2 * m) / mode.stiffness

    gradients = [approx_fprime(np.array(mode.coefficients), balance, 1e-6, mode) for mode in modes]
    return within(
        float(np.abs(gradients).max()),
        1e-4,
        "∂V/∂a_i − Λ² ∂T/∂a_i vanishes at both modes; a_2/a_1 = "
        + ", ".join(f"{mode.coefficients[1]:.7f}" for mode in modes),
        "energies by quadrature, gradient by differences (1e-6)",
    )


def _eq13(bench: Bench) -> Found:
    tooth, speed = bench.struck
    modes = ritz_modes(tooth, STEEL)
    x, t = XI * tooth.length, times_of(modes)
    curvatures = [second_derivative(mode.shape, XI, 1e-3) / tooth.length**2 for mode in modes]
    bend = sum(np.outer(u, swing(mode, speed, t)) for u, mode in zip(curvatures, modes, strict=True))
    height = ((tooth.length - x) * math.tan(tooth.apex_angle))[:, None]
    moment = -STEEL.youngs_modulus * tooth.thickness / 12 * height**3 * bend
    return within(
        max(
            off_by(bending_moment(tooth, STEEL, speed, x, t), moment),
            off_by(bending_stress(tooth, STEEL, speed, x, t), moment / (tooth.thickness / 6 * height**2)),
        ),
        1e-7,
        f"M_b and σ_b from differences of w agree; largest |σ_b| of the base case {bench.base.stress_max:.2f} Pa",
        f"{len(x)} places, {len(t)} times",
    )


ROWS = (
    Row(
        "P-eq8",
        "eq (8)",
        "Deflection is a mode shape times a function of time.",
        "w = u(x) η(t)",
        (RECOVERY,),
        lambda bench: _eq8(*bench.struck),
    ),
    Row(
        "P-eq9",
        "eq (9)",
        "Equivalent mass and stiffness of a mode.",
        "½ m η'², ½ k η²",
        (RITZ,),
        lambda bench: _eq9(bench.base.tooth),
    ),
    Row(
        "P-eq10",
        "eq (10)",
        "The mode swings.",
        "m η'' + c η' + k η = 0, c = 2ζ√(km)",
        (RECOVERY,),
        lambda bench: _eq10(*bench.struck),
    ),
    Row(
        "P-eq11",
        "eq (11)",
        "The shape is a polynomial.",
        "u = Σ a_i x^i",
        (MODES,),
        lambda bench: _eq11(bench.base.tooth),
    ),
    Row(
        "P-eq12",
        "eq (12)",
        "Rayleigh–Ritz.",
        "∂V/∂a_i − Λ² ∂T/∂a_i = 0",
        (RITZ,),
        lambda bench: _eq12(bench.base.tooth),
    ),
    Row("P-eq13", "eq (13)", "Moment and stress.", "M_b = −E I_n w'', σ_b = M_b/W_b", (RECOVERY,), _eq13),
    Row(
        "P-fig3",
        "Fig. 3",
        "Flow chart of the stress recovery.",
        "drawing lost",
        (RECOVERY,),
        lambda bench: redrawn(
            bench,
            "fig03_stress",
            tuple(f"({k})" for k in (7, *range(9, 17))),
            "redrawn: fig03_stress.svg, what this program does, with the equations of section 4; the paper's chart "
            "may differ",
        ),
    ),
)
