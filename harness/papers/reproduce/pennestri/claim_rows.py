"""What Pennestrì, Valentini and Vita claim of their method and its accuracy, and the contributions that they list."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from ...study.accuracy import accuracy_findings
from ..bench import AFTER_IMPACT, Bench
from ..row import STUDY, Found, Row, Verdict, judged
from . import beam_rows, case_rows, impact_rows, stress_rows

ACCURACY = ("harness/papers/study/accuracy.py", "harness/papers/study/plane_teeth.csv")


def _claim(bench: Bench, number: int) -> Found:
    """A finding of the study as one of the page."""
    finding = accuracy_findings(bench.study.wheels)[number]
    return Found(finding.evidence, finding.verdict, calculated=finding.verdict is not Verdict.TAKEN_OVER)


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
        ("mechanism_fmu/stress/recovery.py",),
        Found(
            "taken over; of W. Goldsmith's book only what the paper quotes is at hand. What starts the modes here is "
            "no striker at the free end: assumption X-struck",
            Verdict.TAKEN_OVER,
        ),
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
        lambda bench: _claim(bench, 0),
        STUDY,
    ),
    Row(
        "P-cantilever",
        "section 5",
        "“The tooth has been modelled as a cantilever beam”, which “may not seem appropriate”: what it costs.",
        "in words",
        ACCURACY,
        lambda bench: _claim(bench, 1),
        STUDY,
    ),
)


# The contributions that Pennestrì, Valentini and Vita list, weighed by the rows that they rest on.

_ROWS = {row.id: row for module in (impact_rows, stress_rows, beam_rows, case_rows) for row in module.ROWS}
_STANDS = (Verdict.REPRODUCED, Verdict.HOLDS, Verdict.TAKEN_OVER)


def _rests_on(text: str, ids: Sequence[str], verdict: Verdict = Verdict.HOLDS) -> Callable[[Bench], Found]:
    """A finding that works other rows anew, and stands only while all of them do."""

    def find(bench: Bench) -> Found:
        found = {name: _ROWS[name].found(bench).verdict for name in ids}
        lines = (f"{name}: {result}" for name, result in found.items())
        return judged(all(result in _STANDS for result in found.values()), text, *lines, verdict=verdict)

    return find


CONTRIBUTIONS = (
    Row(
        "P-contribution1",
        "section 1",
        "The formulation of Udwadia and Kalaba is extended to impacts.",
        "eq (7)",
        ("mechanism_fmu/engine/contacts/impact.py",),
        _rests_on(
            "eq (7) gives the engine's jump, also with redundant rows; rows P-eq4, P-eq7, P-features stand",
            ("P-eq4", "P-eq7", "P-features"),
        ),
    ),
    Row(
        "P-contribution2",
        "section 1",
        "An engineering model of impacts in ratchet mechanisms.",
        "section 4",
        ("mechanism_fmu/stress/recovery.py", "models/ratchet/model.py"),
        _rests_on(
            "from the impact to bending stress; rows P-eq8 to P-eq16 stand",
            [f"P-eq{number}" for number in range(8, 17)],
        ),
    ),
    Row(
        "P-contribution3",
        "section 1",
        "A procedure of optimal design of ratchet mechanisms.",
        "a study of 20 wheels",
        ("harness/papers/study/study.py", "harness/designs/search.py"),
        _rests_on(
            "a table of 20 wheels, calculated again (rows P-cases, P-falls, P-rises, P-predict stand); it states no "
            "objective or constraint and names no optimum. A search with both is this project's",
            ("P-cases", "P-falls", "P-rises", "P-predict"),
            Verdict.HOLDS_IN_PART,
        ),
        STUDY,
    ),
)
