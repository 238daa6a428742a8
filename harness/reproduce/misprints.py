"""Misprints: what is printed and cannot be right, each with a proof by calculation."""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import brentq

from ..paper import SLOPE_ANGLES_DEG
from .bench import CRANK, PAWL, Bench
from .erdman import angles_at, at_angle, bprime
from .geometry import CASES, gamma_on_slope, slope_gap, solid_wheel
from .row import Found, Row, Verdict, judged

#: Of the wheel of Table 2 [m]; steel [kg/m3]; thickness [m].
_BORE, _STEEL, _THICKNESS = 6.5e-3, 7850.0, 0.02
_MISPRINT = Verdict.MISPRINT


def _inertia(bench: Bench) -> Found:
    """Only one wheel of the study has Table 2's mass and inertia with one bore; rods explain crank and follower."""
    fits = {}
    for case in CASES:
        if solid_wheel(*case, 0.0)[0] <= 5.6264:
            continue
        bore = math.sqrt((solid_wheel(*case, 0.0)[0] - 5.6264) / (_STEEL * _THICKNESS * math.pi))
        fits[case] = bore, solid_wheel(*case, bore)[1] / 32.7948e-3 - 1
    best, second = sorted(fits, key=lambda case: abs(fits[case][1]))[:2]
    bore, off = fits[best]
    mass, inertia = solid_wheel(10, 90, _BORE)
    rods = 0.1 * CRANK**2 / 12, 0.0976 * PAWL**2 / 12
    radius = math.sqrt(32.7948e-6 / 5.6264)
    return judged(
        best == (10, 90) and abs(off) < 2e-4 and abs(mass - 5.6264) < 5e-5,
        f"taken: 10⁻³ kg m². A steel wheel, nt = 10, β₀ = 90°, bore {1e3 * bore:.2f} mm, has 5.6264 kg and "
        f"{1e3 * inertia:.4f}·10⁻³ kg m²",
        f"kg mm² would put all mass of the wheel {1e3 * radius:.2f} mm from its hinge; it reaches to 100 mm and more",
        f"with 7850 kg/m³, 0.02 m and the bore that gives the mass, the inertia is off by {off:.1e}; next best wheel "
        f"(nt = {second[0]}, β₀ = {second[1]}°): {fits[second][1]:.1e}; so the base case is found, too",
        f"crank as a rod: m a²/12 = {1e3 * rods[0]:.4f}·10⁻³ (printed 0.0900), follower: m b²/12 = "
        f"{1e3 * rods[1]:.4f}·10⁻³ kg m² (printed 0.0853): both of that size; in kg mm² they would be a thousandth of "
        "it",
        verdict=_MISPRINT,
    )


def _gamma(_bench: Bench) -> Found:
    angle = float(brentq(lambda beta: math.degrees(gamma_on_slope(beta)) - 190.0, 85.0, 105.0))
    normal_gap = {beta: 1e3 * slope_gap(beta, 190.0) for beta in SLOPE_ANGLES_DEG}
    return judged(
        abs(angle - 92.4) < 0.1,
        "taken: γ(0) solved for each β₀. With φ = 77° and ψ = 75° the tip is on the slope at γ = 190° for β₀ = "
        f"{angle:.4f}° only, which is none of the five",
        "distance of the tip from the slope at γ = 190° (negative: inside the tooth): "
        + ", ".join(f"{beta}°: {gap:.3f} mm" for beta, gap in normal_gap.items()),
        "γ(0) on the slope: " + ", ".join(f"{beta}°: {math.degrees(gamma_on_slope(beta)):.4f}°" for beta in normal_gap),
        verdict=_MISPRINT,
    )


def _a12(bench: Bench) -> Found:
    rows, columns = bench.impact.jacobian.shape
    return judged(
        (rows, columns) == (8, 9),
        f"taken: A_12 = [Ψ_qᵀ, (∂s/∂q)ᵀ]. One above the other they do not fit: {columns} × {rows - 1} and {columns} × "
        "1",
        f"eq (4) needs {columns} × {rows}; printed with one block above the other in the text at hand",
        verdict=_MISPRINT,
    )


def _three(_bench: Bench) -> Found:
    count = round((105 - 85) / 5) + 1
    return judged(
        count == 5,
        f"85° to 105° by 5° are {count} angles; beside 95° there are {count - 1}",
        ", ".join(f"{85 + 5 * k}°" for k in range(count)),
        verdict=_MISPRINT,
    )


def _column6(bench: Bench) -> Found:
    """Equilibrium of pin B and of the crank pin under a unit moment on the coupler, with the printed column."""
    number, _ = at_angle(bench, 60)
    phi, coupler, psi = angles_at(bench, number)
    elements = bench.path_generator.linkage.elements
    length = next(e.length for e in elements if e.member.name == "coupler_bar")
    left = np.array([-math.sin(coupler), math.cos(coupler)])
    along = np.array([math.cos(coupler), math.sin(coupler)])
    follower = np.array([math.cos(psi), math.sin(psi)])

    def left_over(column: np.ndarray[tuple[int], np.dtype[np.float64]]) -> float:
        return float(np.linalg.norm(column[5] / length * left - column[6] * along - column[7] * follower)) * length

    printed, right = np.eye(8)[5], bprime(bench, 60)[:, 5]
    inch = right.copy()
    inch[[3, 4, 6, 7]] *= 0.0254
    return judged(
        left_over(printed) > 0.99 and left_over(right) < 1e-10,
        "taken: rows 4 to 8 = " + ", ".join(f"{value:.6f}" for value in inch[3:]) + " at φ = 60°, forces per inch",
        f"printed (0, 0, 0, 0, 0, 1, 0, 0): a force of {left_over(printed):.3f}/l₂ is left at pin B for a unit "
        "moment; with the right column nothing is",
        "a moment on the coupler is carried by a couple of pin forces 1/l₂, which crank and follower must take: φ, λ, "
        f"ψ = {math.degrees(phi):.3f}°, {math.degrees(coupler):.3f}°, {math.degrees(psi):.3f}°",
        verdict=_MISPRINT,
    )


MISPRINTS = (
    Row(
        "X-inertia",
        "Pennestrì, Table 2",
        "Unit of the inertia column.",
        "kg mm²",
        ("models/ratchet/parameters.py",),
        _inertia,
    ),
    Row("X-gamma", "Pennestrì, section 5", "γ at the start.", "190°", ("models/ratchet/start.py",), _gamma),
    Row(
        "X-A12",
        "Pennestrì, below (5)",
        "A_12.",
        "Ψ_qᵀ above (∂s/∂q)ᵀ",
        ("mechanism_fmu/engine/contacts/impact.py",),
        _a12,
    ),
    Row(
        "X-three",
        "Pennestrì, section 5.1",
        "“The other three configurations concerning β₀”.",
        "three",
        ("harness/paper.py",),
        _three,
    ),
    Row(
        "X-column6",
        "Erdman, eq (13)",
        "Column 6 of B'.",
        "0, 0, 0, 0, 0, 1, 0, 0",
        ("mechanism_fmu/elastodynamics/transfer.py",),
        _column6,
    ),
)
