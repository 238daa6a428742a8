"""The contributions that Pennestrì, Valentini and Vita list, weighed by the rows that they rest on."""

from __future__ import annotations

from . import pennestri_beam, pennestri_cases, pennestri_impact, pennestri_stress
from .bench import Bench
from .row import STUDY, Found, Row, Verdict, judged

_ROWS = {
    row.id: row
    for module in (pennestri_impact, pennestri_stress, pennestri_beam, pennestri_cases)
    for row in module.ROWS
}
_STANDS = (Verdict.REPRODUCED, Verdict.HOLDS, Verdict.TAKEN_OVER)


def _rests_on(bench: Bench, text: str, ids: tuple[str, ...], verdict: Verdict = Verdict.HOLDS) -> Found:
    """Works the rows anew, and stands only while all of them do."""
    found = {name: _ROWS[name].find(bench).verdict for name in ids}
    lines = (f"{name}: {result}" for name, result in found.items())
    return judged(all(result in _STANDS for result in found.values()), text, *lines, verdict=verdict)


def _extension(bench: Bench) -> Found:
    return _rests_on(
        bench,
        "eq (7) gives the engine's jump, also with redundant rows; rows P-eq4, P-eq7, P-features stand",
        ("P-eq4", "P-eq7", "P-features"),
    )


def _model(bench: Bench) -> Found:
    ids = ("P-eq8", "P-eq9", "P-eq10", "P-eq11", "P-eq12", "P-eq13", "P-eq14", "P-eq15", "P-eq16")
    return _rests_on(bench, "from the impact to bending stress; rows P-eq8 to P-eq16 stand", ids)


def _procedure(bench: Bench) -> Found:
    return _rests_on(
        bench,
        "a table of 20 wheels, calculated again (rows P-cases, P-falls, P-rises, P-predict stand); it states no "
        "objective or constraint and names no optimum. A search with both is this project's",
        ("P-cases", "P-falls", "P-rises", "P-predict"),
        Verdict.HOLDS_IN_PART,
    )


ROWS = (
    Row(
        "P-contribution1",
        "section 1",
        "The formulation of Udwadia and Kalaba is extended to impacts.",
        "eq (7)",
        ("mechanism_fmu/engine/contacts/impact.py",),
        _extension,
    ),
    Row(
        "P-contribution2",
        "section 1",
        "An engineering model of impacts in ratchet mechanisms.",
        "section 4",
        ("mechanism_fmu/stress/recovery.py", "models/ratchet/model.py"),
        _model,
    ),
    Row(
        "P-contribution3",
        "section 1",
        "A procedure of optimal design of ratchet mechanisms.",
        "a study of 20 wheels",
        ("harness/study.py", "harness/designs/search.py"),
        _procedure,
        STUDY,
    ),
)
