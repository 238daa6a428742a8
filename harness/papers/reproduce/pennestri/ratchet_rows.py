"""Section 5 of Pennestrì, Valentini, Vita: the ratchet's data, its tooth, and the beam that stands for it."""

from __future__ import annotations

import math

import numpy as np

from mechanism_fmu.stress import wedge_of_sawtooth

from ...study.wheels import SLOPE_ANGLES_DEG, TOOTH_COUNTS
from ..bench import CASES, CRANK, HINGES, PARTS, PAWL, RADIUS, SLOPE_RATIO, Bench, each_off_by, tooth
from ..figures.all_figures import redrawn
from ..row import RUN, Found, Row, Verdict, judged, within
from ..wheel_by_hand import alpha_star, gamma_on_slope

PARAMETERS, SAWTOOTH = "models/ratchet/ports.py", "mechanism_fmu/model/sawtooth.py"
BEAM = (SAWTOOTH, "mechanism_fmu/stress/tooth.py")


def _table1(bench: Bench) -> Found:
    names = ("hinge_distance", "crank_length", "pawl_length", "wheel_inner_radius")
    values = [bench.parameter(name) for name in names]
    return judged(
        values == [HINGES, CRANK, PAWL, RADIUS],
        "d, a, b, r = " + ", ".join(f"{value:.3f}" for value in values) + " m: defaults of the FMU",
        *(f"{name} = {value:g} m" for name, value in zip(names, values, strict=True)),
        verdict=Verdict.TAKEN_OVER,
    )


def _table2(bench: Bench) -> Found:
    values = [(bench.parameter(f"{part}_mass"), bench.parameter(f"{part}_inertia")) for part in PARTS]
    return judged(
        values == [(0.1, 0.09e-3), (0.0976, 0.0853e-3), (5.6264, 32.7948e-3)],
        "masses as printed; inertias in 10⁻³ kg m² instead of kg mm²: misprint X-inertia",
        *(f"{part}: {m:g} kg, {j:g} kg m²" for part, (m, j) in zip(PARTS, values, strict=True)),
        verdict=Verdict.HOLDS_IN_PART,
    )


def _start(bench: Bench) -> Found:
    deg = {angle: math.degrees(gamma_on_slope(angle)) for angle in SLOPE_ANGLES_DEG}
    base = bench.study.base_case.results.iloc[0]
    rates = [abs(float(base[f"{part}_speed"])) for part in PARTS]
    return within(
        max(abs(math.degrees(float(base["pawl_angle"])) - deg[90]), *rates),
        1e-6,
        f"φ = 77°, ψ = 75°, at rest; γ(0) follows from the slope: {deg[90]:.4f}° at β₀ = 90° (misprint X-gamma)",
        "; ".join(f"β₀ = {angle}°: γ(0) = {value:.4f}°" for angle, value in deg.items()),
        verdict=Verdict.HOLDS_IN_PART,
    )


def _loads(bench: Bench) -> Found:
    drive, spring, free, restitution, friction = map(
        bench.parameter, ("drive_torque", "spring_stiffness", "spring_free_angle", "restitution", "friction")
    )
    return judged(
        (drive, spring) == (1e-3, 15e-3) and restitution == friction == 0.0,
        f"1 N mm on the crank, {1e3 * spring:g} N mm/rad on the wheel, e = 0, no friction",
        f"the spring is relaxed at ψ = {math.degrees(free):.0f}°, which is not printed (choice C-spring); no gravity",
        verdict=Verdict.TAKEN_OVER,
    )


def _baumgarte(bench: Bench) -> Found:
    alpha, beta = bench.parameter("baumgarte_alpha"), bench.parameter("baumgarte_beta")
    roots = np.roots([1.0, 2 * alpha, beta**2])
    without = float(bench.first_impact(baumgarte_alpha=0.0, baumgarte_beta=0.0)["time"])
    return judged(
        bool(np.isreal(roots).all()) and abs(without - bench.base.impact_time) < 1e-7 and (alpha, beta) == (10.0, 1.0),
        f"γ − 2αΨ' − β²Ψ: errors die away as e^({roots.max():.4f} t) and e^({roots.min():.4f} t), without any "
        f"frequency; t_I without it: {without:.7f} s, the same",
        "over-damped: α² > β²; the slow root takes 20 s, so that position errors hardly change within a run",
    )


def _geometry(bench: Bench) -> Found:
    wheel, shape = bench.base, tooth(10, 90)
    h, face, length = float(shape.chord), float(shape.face_length), bench.parameter("tooth_length")
    found = wedge_of_sawtooth(h, float(shape.slope_length), float(shape.chord_angle))
    wanted = [wheel.tooth_length, wheel.tooth_apex_angle, float(shape.beam_length), 2 * RADIUS * math.sin(math.pi / 10)]
    return redrawn(
        bench,
        "fig05_tooth",
        ("θ", "h", "L = 1.115 h", "β₀"),
        f"redrawn: fig05_tooth.svg; nt = 10: θ = 36°, h = 2r sin(θ/2) = {1e3 * h:.4f} mm",
        f"β₀ = 90°: α₂ = {math.degrees(float(shape.chord_angle)):.4f}°, α = "
        f"{math.degrees(float(shape.apex_angle)):.4f}°, face F = {1e3 * face:.4f} mm",
        true=each_off_by([found.length, found.apex_angle, length, h], wanted) < 1e-12,
    )


def _slope(bench: Bench) -> Found:
    ratios = [
        bench.parameter("tooth_slope_length", w) / float(tooth(w.tooth_count, 90).chord) for w in bench.study.wheels
    ]
    return within(
        max(abs(ratio / SLOPE_RATIO - 1) for ratio in ratios),
        1e-12,
        f"L/h = {ratios[0]:.3f} for all 20 wheels; nt = 10: L = {1e3 * bench.parameter('tooth_slope_length'):.4f} mm",
        verdict=Verdict.TAKEN_OVER,
    )


def _length_by_hand(count: int, angle: int) -> float:
    """Of the beam as Fig. 7 is read: l = F on its left, l = L cos(alpha) on its right [m]."""
    shape = tooth(count, angle)
    foot = float(shape.slope_length) * math.cos(float(shape.apex_angle))
    return foot if alpha_star(count, angle) >= 90 else float(shape.face_length)


def _fig7(bench: Bench) -> Found:
    right = [case for case in CASES if alpha_star(*case) >= 90]
    lengths = [bench.wheel(*case).tooth_length for case in CASES]
    return redrawn(
        bench,
        "fig07_shapes",
        ("l = F", "l = L cos α", "α₂"),
        f"redrawn: fig07_shapes.svg; left, l = F: {len(CASES) - len(right)} wheels; right, l = L cos α: "
        + ", ".join(f"({count}, {angle}°)" for count, angle in right),
        *(
            f"nt = {count}: α* = " + ", ".join(f"{alpha_star(count, angle):.2f}°" for angle in SLOPE_ANGLES_DEG)
            for count in TOOTH_COUNTS
        ),
        true=each_off_by(lengths, [_length_by_hand(*case) for case in CASES]) < 1e-12 and len(right) == 3,
    )


def _length(bench: Bench) -> Found:
    lengths = {case: 1e3 * bench.wheel(*case).tooth_length for case in CASES}
    return judged(
        len({round(length, 6) for length in lengths.values()}) == len(CASES),
        "different for each of the 20: l(nt, β₀) = "
        + ", ".join(f"{lengths[case]:.4f} mm at {case[0]}, {case[1]}°" for case in ((10, 90), (10, 105), (25, 85))),
        "how Fig. 7 is read: choice C-length",
    )


def _velocity(bench: Bench) -> Found:
    """v_I of every wheel against l times the jump of its rate, from the FMU's own records."""
    length, speed, hit = bench.base.tooth_length, bench.base.impact_velocity, bench.impact
    recorded = float(bench.study.base_case.impacts.iloc[0]["velocity"])
    return within(
        each_off_by([recorded, speed], [length * hit.jump[8]] * 2),
        1e-6,
        f"base case: v_I = l (ω(t_I+) − ω(t_I−)) = {speed:.6e} m/s (choice C-velocity)",
        f"l = {1e3 * length:.4f} mm, ω jumps from {hit.before[8]:.9f} to {hit.after[8]:.9f} rad/s",
        f"l ω(t_I+) alone, right for a wheel at rest only, would be {length * hit.after[8]:.6e} m/s",
        verdict=Verdict.TAKEN_OVER,
    )


def _friction(bench: Bench) -> Found:
    rubbed = float(bench.first_impact(friction=0.1)["time"])
    return judged(
        bench.parameter("friction") == 0.0 and rubbed > bench.base.impact_time,
        f"neglected, as in the paper; with 0.1 between pawl and tooth t_I = {rubbed:.5f} s instead of "
        f"{bench.base.impact_time:.5f} s",
        verdict=Verdict.TAKEN_OVER,
    )


ROWS = (
    Row("P-table1", "Table 1", "Lengths.", "0.130, 0.110, 0.100, 0.100 m", (PARAMETERS,), _table1, RUN),
    Row(
        "P-table2",
        "Table 2",
        "Masses and inertias.",
        "0.1000, 0.0976, 5.6264 kg; 0.0900, 0.0853, 32.7948 kg mm²",
        (PARAMETERS,),
        _table2,
        RUN,
    ),
    Row(
        "P-start",
        "section 5",
        "The start.",
        "φ = 77°, γ = 190°, ψ = 75°, at rest",
        ("models/ratchet/start.py",),
        _start,
    ),
    Row("P-loads", "section 5", "Torques, e, no friction.", "1 N mm, 15 N mm/rad, e = 0", (PARAMETERS,), _loads, RUN),
    Row(
        "P-friction",
        "section 5",
        "Friction is neglected.",
        "none",
        ("mechanism_fmu/engine/dynamics/sliding.py",),
        _friction,
        f"{RUN} --set friction=0.1 --stop-time 1.2",
    ),
    Row(
        "P-baumgarte",
        "claim, section 5",
        "Baumgarte's gains bring in hardly any extraneous frequencies.",
        "α = 10, β = 1",
        ("mechanism_fmu/engine/constraints/rows.py",),
        _baumgarte,
    ),
    Row(
        "P-fig4",
        "Fig. 4",
        "The mechanism with its symbols.",
        "drawing lost",
        ("models/ratchet/model.py",),
        lambda bench: redrawn(
            bench,
            "fig04_nomenclature",
            ("φ", "γ", "ψ", "d = 0.130", "a = 0.110", "b = 0.100", "r = 0.100"),
            "redrawn from Table 1 and the start: fig04_nomenclature.svg; angles are absolute, the paper's arrows are "
            "lost",
        ),
    ),
    Row("P-fig5", "Fig. 5", "The tooth: θ, h, L, β₀.", "drawing lost", (SAWTOOTH,), _geometry),
    Row("P-slope", "section 5", "Length of the slope.", "L = 1.115 h", (SAWTOOTH,), _slope),
    Row("P-fig7", "Fig. 7", "Two shapes of beam, by α* = α + α₂ below or above 90°.", "drawing lost", BEAM, _fig7),
    Row("P-length", "section 5", "Length l of the beam.", "a function of nt and β₀", (SAWTOOTH,), _length),
    Row(
        "P-velocity",
        "section 5",
        "v_I is the velocity of the free end less that of the fixed end.",
        "in words",
        ("mechanism_fmu/engine/contacts/impact.py",),
        _velocity,
        f"{RUN} --stop-time 1.2",
    ),
)
