"""Choices: what the documents leave open and what this project takes, each with what it does to the numbers."""

from __future__ import annotations

import math

from mechanism_fmu.stress import STEEL, ModeScaling, WedgeTooth, maximum_stress, ritz_modes

from ..study.accuracy import SMALL, accuracy_findings
from ..study.wheels import SLOPE_ANGLES_DEG, TOOTH_COUNTS
from .bench import CASES, PAWL, STEPS_OF_ANGLE, STEPS_OF_COUNT, Bench, tooth
from .row import Found, Row, Verdict, judged
from .wheel_by_hand import alpha_star, solid_wheel

_CHOICE = Verdict.CHOICE
_BORE = 6.5e-3


def _gamma(bench: Bench) -> Found:
    free = float(bench.first_impact(0.01, guided=False, pawl_angle_start=math.radians(190))["time"])
    return judged(
        free < bench.base.impact_time,
        "γ(0) is solved anew for each β₀, so that the tip starts on the slope; of the "
        "“initial configurations” φ and ψ are “kept constant”",
        f"a free pawl from 190° at (10, 90°) would fly first and strike the slope at t = {free:.4f} s",
        verdict=_CHOICE,
    )


def _table2(bench: Bench) -> Found:
    """The stress of a wheel with its own mass, against that with Table 2's."""
    worked, changes = [], []
    for count, angle in ((25, 85), (10, 105)):
        mass, inertia = solid_wheel(count, angle, _BORE)
        case = {"tooth_count": count, "tooth_slope_angle": math.radians(angle)}
        stress = float(bench.first_impact(**case, wheel_mass=mass, wheel_inertia=inertia)["stress_max"])
        kept = bench.stresses[count, angle]
        changes.append(100 * (stress / kept - 1))
        worked.append(f"({count}, {angle}°): own mass {mass:.4f} kg, {stress:.1f} Pa instead of {kept:.1f} Pa")
    return judged(
        changes[1] < -0.1 < 0.1 < changes[0],
        f"Table 2 is kept for all 20 wheels; with its own mass a wheel would have {changes[0]:+.1f} % (25, 85°) to "
        f"{changes[1]:+.1f} % (10, 105°) of stress",
        *worked,
        verdict=_CHOICE,
    )


def _scale(tooth: WedgeTooth, speed: float) -> Found:
    projected = maximum_stress(tooth, STEEL, speed, ritz_modes(tooth, STEEL, 2, ModeScaling.PROJECTION))
    taken = maximum_stress(tooth, STEEL, speed)
    return judged(
        taken.position < projected.position,
        f"a_1 = 1 in both modes: C = {taken.coefficient:.6f} at x/l = {taken.position:.3f}, the paper's 40 %; scaled "
        f"by projection C = {projected.coefficient:.6f} at {projected.position:.3f}",
        "seven scales are compared in docs/decisions/003-mode-scaling.md; comparisons between wheels do not depend on "
        "it",
        verdict=_CHOICE,
    )


def _foot(case: tuple[int, int]) -> float:
    """The other reading of l: L cos(alpha) for every wheel [m]."""
    shape = tooth(*case)
    return float(shape.slope_length) * math.cos(float(shape.apex_angle))


def _length(bench: Bench) -> Found:
    other = {case: bench.stresses[case] * _foot(case) / bench.wheel(*case).tooth_length for case in CASES}
    return judged(
        not all(other[after] > other[before] for before, after in STEPS_OF_ANGLE),
        "l = F while α* < 90°, else L cos α: the leg of the right-angled triangle that lies within the tooth. With l "
        f"= L cos α for all, σ_max(10, 90°) would be {other[10, 90]:.1f} Pa, and the claim that it rises with β₀ "
        "would fail",
        f"α* of (10, 90°) = {alpha_star(10, 90):.2f}°",
        verdict=_CHOICE,
    )


def _velocity(bench: Bench) -> Found:
    """What the claims of Fig. 11 would be with the pawl's closing speed for v_I, over all wheels."""
    closing = {case: float(first["closing_speed"]) for case, first in bench.first_impacts.items()}
    falls = [closing[after] < closing[before] for before, after in STEPS_OF_COUNT]
    rises = [closing[after] > closing[before] for before, after in STEPS_OF_ANGLE]
    return judged(
        not (all(falls) and all(rises)),
        f"v_I = l (ω(t_I+) − ω(t_I−)), {bench.base.impact_velocity:.6e} m/s in the base case. With the pawl's closing "
        f"speed, {min(closing.values()):.6f} to {max(closing.values()):.6f} m/s over the 20 wheels, σ_max would fall "
        f"with nt in {sum(falls)} of {len(falls)} steps and rise with β₀ in {sum(rises)} of {len(rises)}, where Fig. "
        "11 has it fall and rise; l ω(t_I+) is right for a wheel at rest only",
        "it is the velocity of the free end against the root of every tooth of a wheel whose rate jumps; the push at "
        "the root of the struck tooth is outside this law",
        *(
            f"closing speed, nt = {n}: " + ", ".join(f"{closing[n, angle]:.6f}" for angle in SLOPE_ANGLES_DEG) + " m/s"
            for n in TOOTH_COUNTS
        ),
        verdict=_CHOICE,
    )


def _gravity(_bench: Bench) -> Found:
    weight = 1e3 * 0.0976 * 9.81 * PAWL / 2
    return judged(
        weight > 10,
        f"no gravity: the pawl's weight alone would turn it with up to {weight:.0f} N mm, against a drive of 1 N mm",
        "0.0976 kg at 50 mm from the pin",
        verdict=_CHOICE,
    )


def _small(bench: Bench) -> Found:
    """The verdicts of P-triangle and P-second-mode at other limits."""
    found = {limit: accuracy_findings(bench.study.wheels, limit) for limit in (0.10, SMALL, 0.20, 0.30)}
    return judged(
        SMALL == 0.15,
        f"up to {SMALL:.0%} of a frequency or a stress counts as small, a limit of this project's own without a "
        "source; the verdicts by other limits: "
        + "; ".join(
            f"{limit:.0%}: triangle {wedge.verdict}, second mode {second.verdict}"
            for limit, (wedge, _, second) in found.items()
        ),
        "a place along the tooth: 0.02 of its length, as “about 40 %” says",
        verdict=_CHOICE,
    )


def _spring(bench: Bench) -> Found:
    moved = float(bench.first_impact(spring_preload=1e-4)["time"])
    return _simple(
        "the wheel's spring is relaxed at ψ(0) = 75°", f"0.1 N mm of preload would move t_I to {moved:.5f} s"
    )


def _simple(text: str, *worked: str) -> Found:
    return Found(text, _CHOICE, worked)


_RATCHET = ("models/ratchet/start.py",)

CHOICES = (
    Row("C-gamma", "Pennestrì, section 5.1", "γ(0) of the other wheels.", "190°", _RATCHET, _gamma),
    Row(
        "C-table2",
        "Pennestrì, Table 2",
        "Mass of the other wheels.",
        "one wheel",
        ("harness/papers/study/study.py",),
        _table2,
    ),
    Row(
        "C-base",
        "Pennestrì, Table 2",
        "Whose wheel it is.",
        "not printed",
        ("harness/papers/study/wheels.py",),
        _simple(
            "base case nt = 10, β₀ = 90°: the paper does not say whose wheel Table 2 is; mass and inertia say it "
            "(X-inertia)"
        ),
    ),
    Row(
        "C-a1",
        "Pennestrì, (12), (16)",
        "Scale of the mode shapes.",
        "not printed",
        ("mechanism_fmu/stress/ritz.py",),
        lambda bench: _scale(*bench.struck),
    ),
    Row(
        "C-length", "Pennestrì, Fig. 7", "Reading of l.", "drawing lost", ("mechanism_fmu/model/sawtooth.py",), _length
    ),
    Row(
        "C-velocity",
        "Pennestrì, sections 4, 5",
        "Reading of v_I.",
        "“sudden variation of its velocity … follows from (7)”",
        ("mechanism_fmu/engine/contacts/impact.py",),
        _velocity,
    ),
    Row(
        "C-steel",
        "Pennestrì, (15)",
        "E and ρ.",
        "not printed",
        ("mechanism_fmu/stress/material.py",),
        _simple("E = 2.06e11 Pa, ρ = 7850 kg/m³; σ_max is proportional to √(ρE)"),
    ),
    Row(
        "C-small",
        "Pennestrì, section 5",
        "What a small error is.",
        "“without accuracy loss”, “a little effect”",
        ("harness/papers/study/accuracy.py",),
        _small,
    ),
    Row("C-gravity", "Pennestrì, section 5", "Gravity.", "not printed", ("models/ratchet/model.py",), _gravity),
    Row(
        "C-spring",
        "Pennestrì, section 5",
        "Where the spring is relaxed.",
        "not printed",
        ("models/ratchet/ports.py",),
        _spring,
    ),
    Row(
        "C-centres",
        "Pennestrì, Table 2",
        "Centres of mass.",
        "not printed",
        ("models/ratchet/model.py",),
        _simple("crank and follower at mid-length, wheel at its hinge; inertias about them"),
    ),
    Row(
        "C-guided",
        "Pennestrì, section 5",
        "Slope and face as rows.",
        "“the path of the pawl tip”",
        ("models/ratchet/model.py",),
        _simple(
            "both hold on both sides, as in the paper (guided); before the impact the slope, with e = 0 afterwards "
            "both",
            "free pawl with one-sided contacts: `--set guided=false`, docs/decisions/005-one-sided-contacts.md",
        ),
    ),
    Row(
        "C-lumps",
        "Erdman, Case 2",
        "Which masses are lumped.",
        "“a concentrated or a disk mass at each joint”",
        ("mechanism_fmu/elastodynamics/structure/masses.py",),
        _simple("half of each link's mass at either end, and disks where the model has them"),
    ),
    Row(
        "C-example",
        "Erdman, abstract",
        "Numbers of the example.",
        "beyond the pages at hand",
        ("models/four_bar_path_generator/model.py",),
        _simple("an example with links of 10, 4, 10, 8, 6 in, steel ¼ × ½ in, 500 rpm; it is this project's own"),
        "mechanism-fmu ked four_bar_path_generator",
    ),
    Row(
        "C-axes",
        "Erdman, (13)",
        "Directions of element coordinates.",
        "drawing lost",
        ("mechanism_fmu/elastodynamics/elements.py",),
        _simple("tension positive, transverse to the left; column 7 says that the document's crank has them reversed"),
    ),
    Row(
        "C-disc",
        "ME451, example 3.4.1",
        "How gear 2 falls.",
        "mass and time not given",
        ("mechanism_fmu/slides.py",),
        _simple("a homogeneous disc of 1 kg under 9.81 m/s², from rest; φ₂ does not depend on it"),
        "mechanism-fmu reproduce S-3.4.1",
    ),
)
