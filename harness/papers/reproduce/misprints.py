"""Misprints, and assumptions that do not hold, each with a proof by calculation."""

from __future__ import annotations

import cmath
import math

import numpy as np
from scipy.optimize import brentq

import build_fmu
from mechanism_fmu.kinematics import profile_report
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.slides import CAM

from ...run.checks import Verdict
from ..study.wheels import SLOPE_ANGLES_DEG
from .bench import CASES, CRANK, PAWL, RADIUS, AtAngle, Bench
from .erdman.flexibility_rows import bprime, length_of, pin_b
from .row import Found, Row, judged
from .wheel_by_hand import gamma_on_slope, slope_gap, solid_wheel

# Misprints: what is printed and cannot be right, each with a proof by calculation.

#: Of the wheel of Table 2 [m]; steel [kg/m3]; thickness [m].
_BORE, _STEEL, _THICKNESS = 6.5e-3, 7850.0, 0.02
_MISPRINT = Verdict.MISPRINT


def _inertia(_bench: Bench) -> Found:
    """Only one wheel of the study has Table 2's mass and inertia with one bore; rods explain crank and follower."""
    surplus = {case: (solid_wheel(*case, 0.0)[0] - 5.6264) / (_STEEL * _THICKNESS * math.pi) for case in CASES}
    bores = {case: math.sqrt(area) for case, area in surplus.items() if area > 0}
    off = {case: solid_wheel(*case, bore)[1] / 32.7948e-3 - 1 for case, bore in bores.items()}
    best, second = sorted(off, key=lambda case: abs(off[case]))[:2]
    mass, inertia = solid_wheel(10, 90, _BORE)
    return judged(
        best == (10, 90) and abs(off[best]) < 2e-4 and abs(mass - 5.6264) < 5e-5,
        f"taken: 10⁻³ kg m². A steel wheel, nt = 10, β₀ = 90°, bore {1e3 * bores[best]:.2f} mm, has 5.6264 kg and "
        f"{1e3 * inertia:.4f}·10⁻³ kg m²",
        f"kg mm² would put all mass of the wheel {1e3 * math.sqrt(32.7948e-6 / 5.6264):.2f} mm from its hinge; it "
        "reaches to 100 mm and more",
        f"with 7850 kg/m³, 0.02 m and the bore that gives the mass, the inertia is off by {off[best]:.1e}; next best "
        f"wheel (nt = {second[0]}, β₀ = {second[1]}°): {off[second]:.1e}; so the base case is found, too",
        f"crank as a rod: m a²/12 = {1e3 * 0.1 * CRANK**2 / 12:.4f}·10⁻³ (printed 0.0900), follower: m b²/12 = "
        f"{1e3 * 0.0976 * PAWL**2 / 12:.4f}·10⁻³ kg m² (printed 0.0853): both of that size; in kg mm² they would be a "
        "thousandth of it",
        verdict=_MISPRINT,
    )


def _gamma(_bench: Bench) -> Found:
    angle = float(brentq(lambda beta: math.degrees(gamma_on_slope(beta)) - 190.0, 85.0, 105.0))
    return judged(
        abs(angle - 92.4) < 0.1,
        "taken: γ(0) solved for each β₀. With φ = 77° and ψ = 75° the tip is on the slope at γ = 190° for β₀ = "
        f"{angle:.4f}° only, which is none of the five",
        "distance of the tip from the slope at γ = 190° (negative: inside the tooth): "
        + ", ".join(f"{beta}°: {1e3 * slope_gap(beta, 190.0):.3f} mm" for beta in SLOPE_ANGLES_DEG),
        "γ(0) on the slope: "
        + ", ".join(f"{beta}°: {math.degrees(gamma_on_slope(beta)):.4f}°" for beta in SLOPE_ANGLES_DEG),
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


def _column6(at: AtAngle) -> Found:
    """Equilibrium of pin B under a unit moment on the coupler, with the printed column."""
    right, length = bprime(at)[:, 5], length_of(at, "coupler_bar")
    printed, left = (pin_b(at, column) * length for column in (np.eye(8)[5], right))
    return judged(
        printed > 0.99 and left < 1e-10,
        "taken: rows 4 to 8 = "
        + ", ".join(f"{value:.6f}" for value in right[3:] * [0.0254, 0.0254, 1, 0.0254, 0.0254])
        + " at φ = 60°, forces per inch",
        f"printed (0, 0, 0, 0, 0, 1, 0, 0): a force of {printed:.3f}/l₂ is left at pin B for a unit moment; with the "
        "right column nothing is",
        "a moment on the coupler is carried by a couple of pin forces 1/l₂, which crank and follower must take: φ, λ, "
        f"ψ = {math.degrees(at.phi):.3f}°, {math.degrees(at.coupler):.3f}°, {math.degrees(at.psi):.3f}°",
        verdict=_MISPRINT,
    )


MISPRINTS = (
    Row(
        "X-inertia",
        "Pennestrì, Table 2",
        "Unit of the inertia column.",
        "kg mm²",
        ("models/ratchet/ports.py",),
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
        ("harness/papers/study/wheels.py",),
        _three,
    ),
    Row(
        "X-column6",
        "Erdman, eq (13)",
        "Column 6 of B'.",
        "0, 0, 0, 0, 0, 1, 0, 0",
        ("mechanism_fmu/elastodynamics/structure/configuration.py",),
        lambda bench: _column6(bench.crank_at(60)),
    ),
)


# Assumptions and readings of the documents that do not hold, each with numbers; nothing in them is misprinted.

_FAILS = Verdict.ASSUMPTION


def _pulls(bench: Bench) -> Found:
    """The first pull of the guided slope, located by the engine, beside the impact of the same wheel."""

    def first_pull(angle: int) -> float:
        simulation = Simulation(build_fmu.mechanism("ratchet", tooth_slope_angle=math.radians(angle)))
        simulation.advance(6.0)
        return simulation.pulling_contacts().get("slope", math.inf)

    early, late = first_pull(105), first_pull(95)
    impact = {angle: bench.wheel(10, angle).impact_time for angle in (95, 105)}
    return judged(
        early < impact[105] and impact[95] < late and not first_pull(90) < 6.0,
        f"taken: the paper's guided slope, with a warning. At 105° it pulls from t = {early:.4f} s on, before the "
        f"impact at {impact[105]:.4f} s; at 95° from t = {late:.3f} s",
        "a slope of steel can only push; `--set guided=false` gives a pawl that may leave it",
        "nt = 10; at 90° it pushes throughout the first 6 s",
        verdict=_FAILS,
    )


def _at_rest(bench: Bench) -> Found:
    """The wheel's rate before the impact, as the FMU records it."""
    records = {angle: bench.first_impacts[10, angle] for angle in SLOPE_ANGLES_DEG}
    before = {angle: float(first["wheel_speed_before"]) for angle, first in records.items()}
    share = -before[90] / float(records[90]["wheel_speed"])
    return judged(
        all(value < -1e-4 for value in before.values()),
        "taken: v_I = l (ω(t_I+) − ω(t_I−)). “All the links are initially at rest”, but the slope turns the wheel "
        f"back, to ω(t_I−) = {before[90]:.9f} rad/s (β₀ = 90°)",
        "ω(t_I−) in rad/s, as the FMU records it: " + ", ".join(f"{a}°: {value:.9f}" for a, value in before.items()),
        f"l ω(t_I+), right for a wheel at rest, would be {100 * share / (1 + share):.2f} % too low at 90°",
        "the paper does not say that the wheel is at rest at t_I; it says what it monitors, and that is not enough",
        verdict=_FAILS,
    )


def _struck(bench: Bench) -> Found:
    """Where along the face the tip is at the impact."""
    q = bench.impact.q
    tip = complex(q[3], q[4]) + cmath.rect(PAWL / 2, q[5])
    return judged(
        abs(tip - cmath.rect(RADIUS, q[8])) < 1e-7,
        "taken: the jump of the wheel's rate starts every tooth of it alike. The striker does not meet the free end "
        "of the beam: at t_I the tip of the pawl stands in the root P₀, at the clamped end, to less than 0.1 µm",
        f"base case: the tip is {1e3 * abs(tip):.6f} mm from the wheel's hinge, r = 100 mm; the beam is "
        f"{1e3 * bench.base.tooth_length:.4f} mm long",
        "what the push at the root does to the struck tooth itself is outside this law",
        verdict=_FAILS,
    )


def _cam(_bench: Bench) -> Found:
    report = profile_report(CAM)
    jumps = sorted((round(math.degrees(j.alpha)), j.order, abs(j.after - j.before)) for j in report.jumps)
    return judged(
        not report.convex and all(order == 2 for _, order, _ in jumps),
        "taken as it is: the cam of the example is concave beside its joins (curvature "
        f"{-1 / report.hollow_radius:.2f})",
        "hollow: " + ", ".join(f"{math.degrees(a):.2f}° to {math.degrees(b):.2f}°" for a, b in report.hollows),
        "; ".join(f"ρ'' jumps by {size:.2f} at {angle}°" for angle, _, size in jumps),
        verdict=_FAILS,
    )


ASSUMPTIONS = (
    Row(
        "X-pull",
        "Pennestrì, section 5",
        "The slope is the path of the tip in all cases.",
        "β₀ up to 105°",
        ("models/ratchet/model.py",),
        _pulls,
        "mechanism-fmu run build/Ratchet.fmu --set tooth_slope_angle=105deg --stop-time 1.2",
    ),
    Row(
        "X-rest",
        "Pennestrì, section 5.1",
        "ω(t_I+) is monitored, the rate before the impact is not.",
        "“the angular velocity of ratchet wheel after impact”",
        ("mechanism_fmu/engine/contacts/impact.py",),
        _at_rest,
    ),
    Row(
        "X-struck",
        "Pennestrì, sections 4, 5",
        "A rigid striker meets the beam that stands for the tooth.",
        "“transverse collision of a rigid striker with a beam”",
        ("models/ratchet/model.py",),
        _struck,
    ),
    Row(
        "X-cam",
        "ME451, cam example",
        "Convex bodies.",
        "“the bodies we are dealing with are convex”",
        ("mechanism_fmu/slides.py",),
        _cam,
    ),
)
