"""Assumptions and readings of the documents that do not hold, each with numbers; nothing in them is misprinted."""

from __future__ import annotations

import math

import build_fmu
from mechanism_fmu.kinematics import profile_report
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.slides import CAM

from ..paper import SLOPE_ANGLES_DEG
from .bench import PAWL, RADIUS, Bench
from .row import Found, Row, Verdict, judged

_FAILS = Verdict.ASSUMPTION


def _pulls(bench: Bench) -> Found:
    """The first pull of the guided slope, located by the engine, beside the impact of the same wheel."""
    first = {}
    for angle in (90, 95, 105):
        simulation = Simulation(build_fmu.mechanism("ratchet", tooth_slope_angle=math.radians(angle)))
        simulation.advance(6.0)
        first[angle] = simulation.pulling_contacts().get("slope", math.inf), bench.wheel(10, angle).impact_time
    early, late = first[105], first[95]
    return judged(
        early[0] < early[1] and late[1] < late[0] and not first[90][0] < 6.0,
        f"taken: the paper's guided slope, with a warning. At 105° it pulls from t = {early[0]:.4f} s on, before the "
        f"impact at {early[1]:.4f} s; at 95° from t = {late[0]:.3f} s",
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
    tip = q[3] + PAWL / 2 * math.cos(q[5]), q[4] + PAWL / 2 * math.sin(q[5])
    root = RADIUS * math.cos(q[8]), RADIUS * math.sin(q[8])
    away = math.hypot(tip[0] - root[0], tip[1] - root[1])
    return judged(
        away < 1e-7,
        "taken: the jump of the wheel's rate starts every tooth of it alike. The striker does not meet the free end "
        "of the beam: at t_I the tip of the pawl stands in the root P₀, at the clamped end, to less than 0.1 µm",
        f"base case: the tip is {1e3 * math.hypot(*tip):.6f} mm from the wheel's hinge, r = 100 mm; the beam is "
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
        ("mechanism_fmu/engine/contacts/records.py",),
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
        ("mechanism_fmu/slides/cam.py",),
        _cam,
    ),
)
