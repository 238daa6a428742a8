"""Section 5.1 of Pennestrì, Valentini, Vita: the case studies, Figs 8 to 11, and the claims about them."""

from __future__ import annotations

import math

import numpy as np
from scipy.interpolate import RectBivariateSpline

from mechanism_fmu.stress import STEEL, WedgeTooth, maximum_stress

from ...study.wheels import SLOPE_ANGLES_DEG, TOOTH_COUNTS
from ..bench import STEPS_OF_ANGLE, STEPS_OF_COUNT, Bench, FloatArray
from ..figures.all_figures import redrawn
from ..row import STUDY, Found, Row, Verdict, judged, within
from .stress_rows import largest

FIGURES, PAPER, CASES = (f"harness/papers/study/{name}.py" for name in ("study_report", "wheels", "study"))
#: A wheel between those of the paper, to predict.
_BETWEEN = (18, 93.0)


def _cases(bench: Bench) -> Found:
    wheels = bench.study.wheels
    times = sorted({round(wheel.impact_time, 7) for wheel in wheels})
    alike = [
        [[getattr(bench.wheel(n, a), what) for n in TOOTH_COUNTS] for a in SLOPE_ANGLES_DEG]
        for what in ("impact_time", "wheel_speed")
    ]
    return judged(
        len(wheels) == 20 and len(times) == 5 and float((np.ptp(alike, axis=2) / np.min(alike, axis=2)).max()) < 1e-6,
        f"{len(wheels)} wheels; t_I from {times[0]:.7f} to {times[-1]:.7f} s; t_I and ω(t_I+) depend on β₀ only, to a "
        "millionth",
        *(
            f"nt = {wheel.tooth_count}, β₀ = {wheel.slope_angle_deg}°: t_I = {wheel.impact_time:.7f} s, ω(t_I+) = "
            f"{wheel.wheel_speed:.8f} rad/s, v_I = {wheel.impact_velocity:.6e} m/s, σ_max = {wheel.stress_max:.2f} Pa"
            for wheel in wheels
        ),
        verdict=Verdict.TAKEN_OVER,
    )


def _thickness(bench: Bench) -> Found:
    wheel = bench.base
    thin = maximum_stress(WedgeTooth(wheel.tooth_length, wheel.tooth_apex_angle, 0.002), STEEL, wheel.impact_velocity)
    return within(
        abs(thin.stress / wheel.stress_max - 1) + abs(wheel.tooth.thickness - 0.02),
        1e-9,
        f"b = {wheel.tooth.thickness} m; a tooth of 0.002 m has the same σ_max = {thin.stress:.2f} Pa: A, I and W are "
        "all proportional to b",
        verdict=Verdict.TAKEN_OVER,
    )


def _constant(bench: Bench) -> Found:
    differing = {name for name, values in bench.study.parameters.items() if len(set(values)) > 1}
    # the mass of a wheel of steel is for comparison only, and gamma(0) cannot be kept
    exempt = {"solid_wheel_mass", "solid_wheel_inertia", "pawl_angle_start"}
    known = sorted(bench.study.parameters.keys() - exempt)
    inputs = [name for name in known if name.endswith(("_mass", "_inertia", "torque", "stiffness"))]
    starts = [name for name in known if name.endswith("_angle_start")]
    return judged(
        len(inputs) > 5 and len(starts) > 1 and not differing.intersection(inputs, starts),
        "torques, spring, masses and φ(0), ψ(0) are those of the base case in all 20; γ(0) cannot be kept (choice "
        "C-gamma), Table 2 is kept for wheels that it does not fit (choice C-table2)",
        f"the same in all: {', '.join(sorted(inputs + starts))}",
        f"what differs between the wheels: {', '.join(sorted(differing))}",
        verdict=Verdict.HOLDS_IN_PART,
    )


def _radii(bench: Bench) -> dict[tuple[int, int], FloatArray]:
    """Distances of the outlines' points from the hinge [m], by nt and beta_0 [deg]."""
    return {
        (wheel.tooth_count, wheel.slope_angle_deg): np.hypot(*rim.wheel())
        for wheel, rim in zip(bench.study.wheels, bench.study.rims, strict=True)
    }


def _fig8(bench: Bench) -> Found:
    radii = {count: radius for (count, angle), radius in _radii(bench).items() if angle == 95}
    worked = [f"{count} teeth: outer radius {1e3 * float(radius.max()):.3f} mm" for count, radius in radii.items()]
    return redrawn(
        bench,
        "fig08_wheels",
        ("10 teeth", "15 teeth", "20 teeth", "25 teeth"),
        f"redrawn: fig08_wheels.svg; four wheels of inner radius 100 mm, {worked[0]}, {worked[-1]}",
        *worked,
        true=max(abs(float(radius.min()) - 0.1) for radius in radii.values()) < 1e-9 and len(worked) == 4,
    )


def _fig9(bench: Bench) -> Found:
    high = {w: 1e3 * w.tooth_length * math.tan(w.tooth_apex_angle) for w in (bench.base, bench.wheel(25, 105))}
    return redrawn(
        bench,
        "fig09_teeth",
        ("10 teeth", "25 teeth", "β₀ = 85°", "β₀ = 105°"),
        "redrawn: fig09_teeth.svg, 20 teeth; root of the beam "
        + ", ".join(f"{value:.3f} mm ({wheel})" for wheel, value in high.items()),
        true=len(bench.study.wheels) == 20,
    )


def _fig11(bench: Bench) -> Found:
    stresses = bench.stresses.values()
    return redrawn(
        bench,
        "fig11_maximum",
        ("maximum stress", "25 teeth", "β₀ = 105°"),
        f"redrawn: fig11_maximum.svg; from {min(stresses):.2f} to {max(stresses):.2f} Pa; the paper's scale is lost",
    )


def _place(bench: Bench) -> Found:
    places = [wheel.stress_position for wheel in bench.study.wheels]
    return judged(
        max(abs(place - 0.4) for place in places) < 0.02,
        f"x/l = {places[0]:.4f} in all 20 cases",
        "with two modes and a_1 = 1; one mode has 0.285, converged modes 0.71 (docs/decisions/003-mode-scaling.md)",
    )


def _falls(bench: Bench) -> Found:
    ratios = [bench.stresses[after] / bench.stresses[before] for before, after in STEPS_OF_COUNT]
    return judged(
        max(ratios) < 1,
        f"falls in all {len(ratios)} steps, by {100 * (1 - max(ratios)):.1f} to {100 * (1 - min(ratios)):.1f} %",
        f"β₀ = 90°: {', '.join(f'{bench.stresses[count, 90]:.2f}' for count in TOOTH_COUNTS)} Pa",
    )


def _rises(bench: Bench) -> Found:
    ratios = [bench.stresses[after] / bench.stresses[before] for before, after in STEPS_OF_ANGLE]
    return judged(
        min(ratios) > 1,
        f"rises in all {len(ratios)} steps, by {100 * (min(ratios) - 1):.1f} to {100 * (max(ratios) - 1):.1f} %",
        f"nt = 10: {', '.join(f'{bench.stresses[10, angle]:.2f}' for angle in SLOPE_ANGLES_DEG)} Pa",
    )


def _maxima(bench: Bench) -> Found:
    named, (factor, _) = ((10, 90), (20, 95), (25, 85), (10, 105)), largest()
    by_hand = {
        case: factor
        * bench.wheel(*case).tooth_length
        * float(first["wheel_speed"] - first["wheel_speed_before"])
        * math.sqrt(STEEL.density * STEEL.youngs_modulus)
        for case, first in bench.first_impacts.items()
    }
    return within(
        max(abs(bench.stresses[case] / stress - 1) for case, stress in by_hand.items()),
        1e-6,
        "; ".join(f"({count}, {angle}°) {bench.stresses[count, angle]:.2f} Pa" for count, angle in named),
        f"σ_max = C l (ω(t_I+) − ω(t_I−)) √(ρE) with C = {factor:.6f} by hand (P-eq16) and ω of the FMU, for every "
        "wheel",
        verdict=Verdict.NOT_DETERMINED,
    )


def _predict(bench: Bench) -> Found:
    """The chart, interpolated, against the run of a wheel between its points."""
    (count, angle), stresses = _BETWEEN, bench.stresses
    logarithms = [[math.log(stresses[n, a]) for a in SLOPE_ANGLES_DEG] for n in TOOTH_COUNTS]
    chart = RectBivariateSpline(TOOTH_COUNTS, SLOPE_ANGLES_DEG, logarithms, kx=3, ky=3)
    read = math.exp(float(chart(count, angle)[0, 0]))
    calculated = float(bench.first_impact(tooth_count=count, tooth_slope_angle=math.radians(angle))["stress_max"])
    off = abs(read / calculated - 1)
    return judged(
        off < 0.02,
        f"nt = {count}, β₀ = {angle:g}°: {read:.0f} Pa read from the chart, {calculated:.0f} Pa calculated "
        f"({100 * off:.1f} % off)",
        "cubic interpolation of the logarithm",
    )


def _others(bench: Bench) -> Found:
    heights = {case: float(radius.max()) for case, radius in _radii(bench).items()}
    return judged(
        all(heights[before] > heights[after] for before, after in STEPS_OF_COUNT),
        f"outer radius falls with nt for all {len(SLOPE_ANGLES_DEG)} angles; the others are four, not three (misprint "
        "X-three)",
        *(
            f"β₀ = {angle}°: " + ", ".join(f"{1e3 * heights[count, angle]:.2f} mm" for count in TOOTH_COUNTS)
            for angle in SLOPE_ANGLES_DEG
        ),
    )


ROWS = (
    Row("P-cases", "section 5.1", "Wheels of 10 to 25 teeth, 85° to 105°.", "by 5 each", (CASES,), _cases),
    Row("P-thickness", "section 5.1", "Thickness of the tooth.", "b = 0.02 m", (PAPER,), _thickness),
    Row("P-constant", "section 5.1", "All else is kept constant.", "in words", (CASES,), _constant, STUDY),
    Row("P-fig8", "Fig. 8", "Wheel shapes at β₀ = 95°.", "drawing lost", (FIGURES, CASES), _fig8, STUDY),
    Row("P-others", "claim, section 5.1", "The other angles look alike.", "in words", (FIGURES,), _others),
    Row("P-fig9", "Fig. 9", "Tooth shapes.", "drawing lost", (FIGURES,), _fig9, STUDY),
    Row(
        "P-fig10",
        "Fig. 10",
        "Stress along the tooth.",
        "drawing lost",
        (FIGURES,),
        lambda bench: redrawn(
            bench,
            "fig10_stress",
            ("10 teeth", "25 teeth", "β₀ = 85°", "β₀ = 105°"),
            "redrawn: fig10_stress.svg; the paper's curves are lost, so that its claims are all there is to compare",
        ),
        STUDY,
    ),
    Row(
        "P-place", "claim, section 5.1", "The maximum is at about 40 % of the length.", "40 %", (PAPER,), _place, STUDY
    ),
    Row("P-fig11", "Fig. 11", "Maximum stress.", "drawing lost", (FIGURES,), _fig11, STUDY),
    Row(
        "P-maxima",
        "Fig. 11",
        "Values of σ_max.",
        "no number in the text at hand",
        ("mechanism_fmu/stress/maximum.py",),
        _maxima,
        STUDY,
    ),
    Row("P-falls", "claim, section 5.1", "σ_max falls with nt.", "generally", (PAPER,), _falls, STUDY),
    Row("P-rises", "claim, section 5.1", "σ_max rises with β₀.", "generally", (PAPER,), _rises, STUDY),
    Row(
        "P-predict",
        "claim, section 5.1",
        "Once nt and β₀ are known, the stress can be predicted.",
        "in words",
        (CASES,),
        _predict,
    ),
)
