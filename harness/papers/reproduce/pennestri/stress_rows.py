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

from ..bench import Bench, FloatArray, off_by
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


RITZ, RECOVERY = "mechanism_fmu/stress/ritz.py", "mechanism_fmu/stress/recovery.py"

TOOTH, MODES = "mechanism_fmu/stress/tooth.py", "mechanism_fmu/stress/modes.py"

RESPONSE = "mechanism_fmu/stress/recovery.py"

#: Places and times at which fields are compared, in parts of the length and of the first period.
XI = np.linspace(0.05, 0.9, 18)

_FINE = 1e-7


def times_of(modes: tuple[BeamMode, ...]) -> FloatArray:
    """Times over two periods of the first mode [s]."""
    return np.linspace(0.0, 2.0, 41) * 2 * math.pi / modes[0].natural_frequency


def _eq8(bench: Bench) -> Found:
    """One mode: the moment at all times is one curve along the tooth, times a function of time."""
    tooth, speed = bench.base.tooth, bench.base.impact_velocity
    mode = ritz_modes(tooth, STEEL)[:1]
    field = bending_moment(tooth, STEEL, speed, XI * tooth.length, times_of(mode), mode)
    values = np.linalg.svd(field, compute_uv=False)
    return within(
        float(values[1] / values[0]),
        1e-12,
        "one mode: bending along the tooth and in time is a product, u''(x) η(t), rank 1",
        f"base case, v_I = {speed:.6e} m/s",
    )


def _eq9(bench: Bench) -> Found:
    tooth = bench.base.tooth
    worst, worked = 0.0, []
    for mode in ritz_modes(tooth, STEEL):
        m, k = by_quadrature(tooth, mode)
        worst = max(worst, abs(m / mode.mass - 1), abs(k / mode.stiffness - 1))
        worked.append(f"m = {m:.6e} kg, k = {k:.6e} N/m, √(k/m) = {math.sqrt(k / m):.2f} rad/s")
    return within(worst, 1e-10, f"base case, first mode: {worked[0]}; integrals by adaptive quadrature", *worked)


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


def _eq10(bench: Bench) -> Found:
    """The closed form put into the equation, by differences."""
    tooth, speed = bench.base.tooth, bench.base.impact_velocity
    worst = 0.0
    for mode in ritz_modes(tooth, STEEL):
        c = 2 * STEEL.damping_ratio * math.sqrt(mode.stiffness * mode.mass)
        h = 0.01 / mode.natural_frequency
        t = np.linspace(3, 300, 100) * h
        eta = [
            damped_response(np.array([mode.natural_frequency]), STEEL.damping_ratio, speed, t + k * h)[0]
            for k in (-2, -1, 0, 1, 2)
        ]
        rate = (eta[0] - 8 * eta[1] + 8 * eta[3] - eta[4]) / (12 * h)
        bend = (-eta[0] + 16 * eta[1] - 30 * eta[2] + 16 * eta[3] - eta[4]) / (12 * h * h)
        left = mode.mass * bend + c * rate + mode.stiffness * eta[2]
        worst = max(worst, float(np.abs(left).max() / np.abs(mode.stiffness * eta[2]).max()))
    first = ritz_modes(tooth, STEEL)[0].natural_frequency
    damped = first * math.sqrt(1 - STEEL.damping_ratio**2)
    return within(
        worst,
        1e-6,
        "η = v_I/Λ_d e^(−ζΛt) sin Λ_d t, Λ_d = Λ√(1 − ζ²), put into (10) leaves nothing; η(0) = 0, η'(0) = v_I",
        f"base case: Λ_d = {damped:.2f} rad/s; a period takes {2 * math.pi / damped * 1e6:.4f} µs, and the swing "
        f"falls to {math.exp(-2 * math.pi * STEEL.damping_ratio / math.sqrt(1 - 0.03**2)):.4f} in it",
    )


def _eq11(bench: Bench) -> Found:
    tooth = bench.base.tooth
    unit = math.sqrt(STEEL.youngs_modulus / STEEL.density) * math.tan(tooth.apex_angle) / tooth.length
    worst, worked = 0.0, []
    for terms in (2, 3, 4):
        found = np.array([mode.natural_frequency for mode in ritz_modes(tooth, STEEL, terms)]) / unit
        by_hand = frequencies(terms)
        worst = max(worst, off_by(found / by_hand, np.ones(terms)))
        worked.append(f"{terms} terms: " + ", ".join(f"{value:.5f}" for value in by_hand))
    return within(
        worst,
        1e-9,
        "powers ξ², ξ³, … (a_0 = a_1 = 0, the root is clamped): Λ with 2, 3, 4 terms = scipy's eigenvalues of "
        "matrices of beta functions",
        *worked,
    )


def _eq12(bench: Bench) -> Found:
    """The gradient of V - Lambda^2 T at the mode shapes, by differences of the energies."""
    tooth = bench.base.tooth
    worst, worked = 0.0, []
    for mode in ritz_modes(tooth, STEEL):
        square = mode.natural_frequency**2

        def balance(a: FloatArray, mode: BeamMode = mode, square: float = square) -> float:
            m, k = by_quadrature(tooth, replace(mode, coefficients=tuple(a)))
            return (k - square * m) / mode.stiffness

        gradient = approx_fprime(np.array(mode.coefficients), balance, 1e-6)
        worst = max(worst, float(np.abs(gradient).max()))
        worked.append(f"a_2/a_1 = {mode.coefficients[1]:.7f}")
    return within(
        worst,
        1e-4,
        f"∂V/∂a_i − Λ² ∂T/∂a_i vanishes at both modes; {worked[0]}, {worked[1].removeprefix('a_2/a_1 = ')}",
        "energies by quadrature, gradient by differences (1e-6)",
    )


def _eq13(bench: Bench) -> Found:
    tooth, speed = bench.base.tooth, bench.base.impact_velocity
    modes = ritz_modes(tooth, STEEL)
    x, t = XI * tooth.length, times_of(modes)
    h = 1e-3
    bend = np.zeros((len(x), len(t)))
    for mode in modes:
        eta = damped_response(np.array([mode.natural_frequency]), STEEL.damping_ratio, speed, t)[0]
        u = [mode.shape(XI + k * h) for k in (-1, 0, 1)]
        bend = bend + np.outer((u[0] - 2 * u[1] + u[2]) / (h * tooth.length) ** 2, eta)
    height = (tooth.length - x) * math.tan(tooth.apex_angle)
    moment = -STEEL.youngs_modulus * (tooth.thickness / 12 * height**3)[:, None] * bend
    stress = moment / (tooth.thickness / 6 * height**2)[:, None]
    deviation = max(
        off_by(bending_moment(tooth, STEEL, speed, x, t), moment),
        off_by(bending_stress(tooth, STEEL, speed, x, t), stress),
    )
    return within(
        deviation,
        _FINE,
        f"M_b and σ_b from differences of w agree; largest |σ_b| of the base case {bench.base.stress_max:.2f} Pa",
        f"{len(x)} places, {len(t)} times",
    )


def _fig3(bench: Bench) -> Found:
    return redrawn(
        bench,
        "fig03_stress",
        tuple(f"({k})" for k in (7, 9, 10, 11, 12, 13, 14, 15, 16)),
        "redrawn: fig03_stress.svg, what this program does, with the equations of section 4; the paper's chart may "
        "differ",
    )


ROWS = (
    Row("P-eq8", "eq (8)", "Deflection is a mode shape times a function of time.", "w = u(x) η(t)", (RECOVERY,), _eq8),
    Row("P-eq9", "eq (9)", "Equivalent mass and stiffness of a mode.", "½ m η'², ½ k η²", (RITZ,), _eq9),
    Row("P-eq10", "eq (10)", "The mode swings.", "m η'' + c η' + k η = 0, c = 2ζ√(km)", (RESPONSE,), _eq10),
    Row("P-eq11", "eq (11)", "The shape is a polynomial.", "u = Σ a_i x^i", (MODES,), _eq11),
    Row("P-eq12", "eq (12)", "Rayleigh–Ritz.", "∂V/∂a_i − Λ² ∂T/∂a_i = 0", (RITZ,), _eq12),
    Row("P-eq13", "eq (13)", "Moment and stress.", "M_b = −E I_n w'', σ_b = M_b/W_b", (RECOVERY,), _eq13),
    Row("P-fig3", "Fig. 3", "Flow chart of the stress recovery.", "drawing lost", (RECOVERY,), _fig3),
)
