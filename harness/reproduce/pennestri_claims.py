"""What Pennestrì, Valentini and Vita claim of their method and its accuracy, beside single equations."""

from __future__ import annotations

import math

from ..accuracy import accuracy_findings
from ..findings import Finding
from .bench import AFTER_IMPACT, Bench
from .row import STUDY, Found, Row, Verdict, judged

ACCURACY = ("harness/accuracy.py", "harness/plane_teeth.csv")


def _weighed(finding: Finding) -> Found:
    """A finding of the study as one of the page."""
    return Found(finding.evidence, finding.verdict, calculated=finding.verdict is not Verdict.TAKEN_OVER)


def _triangle(bench: Bench) -> Found:
    return _weighed(accuracy_findings(bench.study.wheels)[0])


def _cantilever(bench: Bench) -> Found:
    return _weighed(accuracy_findings(bench.study.wheels)[1])


def _ode(bench: Bench) -> Found:
    rows, coordinates = bench.impact.jacobian.shape
    return judged(
        (rows - 1, coordinates) == (7, 9),
        f"{coordinates} coordinates and {rows - 1} rows are integrated as 18 first-order equations, by an explicit "
        "method; no multiplier is an unknown",
    )


def _logic(bench: Bench) -> Found:
    run = bench.run(AFTER_IMPACT, 0.01)
    changes = run.results[["slope_active", "face_active"]].drop_duplicates().to_numpy().tolist()
    shown = " → ".join("/".join("closed" if value else "open" for value in line) for line in changes)
    return judged(
        len(changes) == 2,
        f"slope/face of the base case: {shown}; `touches`, `approaches`, `leaves`, `pushes`, `next`, `click` are the "
        "logical functions",
    )


def _proportions(bench: Bench) -> Found:
    wheels = bench.study.wheels
    ratios = [bench.parameter("tooth_slope_length", w) / bench.parameter("tooth_face_length", w) for w in wheels]
    slender = [1 / math.tan(w.tooth_apex_angle) for w in wheels]
    return judged(
        min(ratios) > 1.0 and min(slender) < 1.0,
        f"slope over face from {min(ratios):.2f} to {max(ratios):.2f}; the beam's length over its root height from "
        f"{min(slender):.2f} to {max(slender):.2f}: sawteeth, whose slopes are longer than their faces, but not beams",
        verdict=Verdict.HOLDS_IN_PART,
    )


def _resembles(_bench: Bench) -> Found:
    return Found(
        "taken over; of W. Goldsmith's book only what the paper quotes is at hand. What starts the modes here is no "
        "striker at the free end: assumption X-struck",
        Verdict.TAKEN_OVER,
    )


ROWS = (
    Row(
        "P-ode",
        "claim, section 2",
        "The DAE is reduced to ordinary differential equations.",
        "in words",
        ("mechanism_fmu/engine/stepping/runge_kutta.py",),
        _ode,
    ),
    Row(
        "P-logic",
        "claim, section 3",
        "Logical functions monitor the varying structure.",
        "in words",
        ("mechanism_fmu/model/logic.py", "mechanism_fmu/engine/contacts/guards.py"),
        _logic,
        "mechanism-fmu modes build/Ratchet.fmu",
    ),
    Row(
        "P-goldsmith",
        "section 4",
        "Impact on a beam as mass, spring and damper (Goldsmith).",
        "in words",
        ("mechanism_fmu/stress/response.py",),
        _resembles,
    ),
    Row(
        "P-proportions",
        "claim, section 5",
        "L = 1.115 h ensures realistic proportions.",
        "in words",
        ("mechanism_fmu/model/sawtooth.py",),
        _proportions,
    ),
    Row(
        "P-triangle",
        "claim, section 5",
        "A right-angled triangle “without accuracy loss”; the grey part can be regarded as rigid.",
        "in words",
        ACCURACY,
        _triangle,
        STUDY,
    ),
    Row(
        "P-cantilever",
        "section 5",
        "“The tooth has been modelled as a cantilever beam”, which “may not seem appropriate”: what it costs.",
        "in words",
        ACCURACY,
        _cantilever,
        STUDY,
    ),
)
