"""The terms that Erdman, Sandor and Oakberg define, with what of them this project does; and their Figs 1 to 7."""

from __future__ import annotations

from .redrawn import redrawn
from .row import KED, Found, Row, Verdict

_KINEMATICS, _SIMULATION = "mechanism_fmu/kinematics/motion.py", "mechanism_fmu/simulation.py"
_CYCLE, _SYNTHESIS = "mechanism_fmu/elastodynamics/cycle.py", "mechanism_fmu/elastodynamics/synthesis.py"
_SEARCH = "harness/designs/search.py"
_GLOSSARY = "docs/glossary.md"

#: Term, short definition, where it lives, what this project does, verdict, command.
_TERMS = (
    (
        "kinematic-analysis",
        "Kinematic analysis",
        "displacements, velocity and acceleration ratios of rigid members",
        _KINEMATICS,
        "`analyse`, with a driver's position as the variable",
        Verdict.TAKEN_OVER,
        "mechanism-fmu reproduce S-composite",
    ),
    (
        "dynamic-analysis",
        "Dynamic analysis",
        "the motion in time, with inertia forces of rigid members",
        _SIMULATION,
        "every run of an FMU",
        Verdict.TAKEN_OVER,
        "mechanism-fmu run build/Ratchet.fmu",
    ),
    (
        "elastic-analysis",
        "Elastic analysis",
        "stresses and deflections under static load",
        "mechanism_fmu/elastodynamics/configuration.py",
        "`system_flexibility`; rows E-eq10 and E-case1",
        Verdict.TAKEN_OVER,
        "mechanism-fmu reproduce E-eq10",
    ),
    (
        "elastodynamic-analysis",
        "Elastodynamic analysis",
        "an elastic mechanism under the inertia forces of the rigid one",
        _CYCLE,
        "`quasi_static`",
        Verdict.TAKEN_OVER,
        KED,
    ),
    (
        "kineto-elastodynamic-analysis",
        "Kineto-elastodynamic analysis",
        "the same, and deformation acts back on the inertia forces",
        "mechanism_fmu/elastodynamics/periodic.py",
        "`periodic_response`, `fed_back`",
        Verdict.TAKEN_OVER,
        KED,
    ),
    (
        "kinematic-synthesis",
        "Kinematic synthesis",
        "a mechanism for prescribed positions or ratios",
        _SEARCH,
        "no such synthesis here: `optimise` searches parameters of a given mechanism, and no example of it searches "
        "lengths for prescribed positions",
        Verdict.NOT_DETERMINED,
        "",
    ),
    (
        "dynamic-synthesis",
        "Dynamic synthesis",
        "a mechanism for prescribed motion in time, of rigid members with mass",
        _SEARCH,
        "`optimise` searches parameters of a given mechanism by its runs; its example searches the number of teeth "
        "and the damping of a wheel",
        Verdict.HOLDS_IN_PART,
        "mechanism-fmu optimise docs/examples/indexing.toml",
    ),
    (
        "dynamic-balancing",
        "Dynamic balancing",
        "the same with least shaking forces and moments",
        "mechanism_fmu/elastodynamics/shaking.py",
        "`ked` reports shaking force and moment; no balancing masses are proposed",
        Verdict.HOLDS_IN_PART,
        KED,
    ),
    (
        "kineto-elastostatic-synthesis",
        "Kineto-elastostatic synthesis",
        "a mechanism for prescribed positions and forces, of elastic members",
        _SYNTHESIS,
        "of sections only: `lightest` with `judge_quasi_static`; forces are those of the rigid motion and of loads",
        Verdict.HOLDS_IN_PART,
        f"{KED} --synthesise --judge quasi-static --limit-deviation 1mm --limit-stress 60MPa",
    ),
    (
        "kineto-elastodynamic-synthesis",
        "Kineto-elastodynamic synthesis",
        "a mechanism for prescribed motion and stress at its speed, of elastic members with mass",
        _SYNTHESIS,
        "`lightest`: least mass within limits of deviation and stress; the document's method is beyond the pages at "
        "hand",
        Verdict.HOLDS_IN_PART,
        f"{KED} --synthesise --limit-deviation 1mm --limit-stress 60MPa",
    ),
    (
        "kineto-elastodynamics",
        "Kineto-elastodynamics",
        "the study of the motion of mechanisms whose elements deflect",
        "mechanism_fmu/elastodynamics/__init__.py",
        "the room `mechanism_fmu.elastodynamics`, and `ked`",
        Verdict.TAKEN_OVER,
        KED,
    ),
)

#: Figure, what it shows, file, what must stand in it.
_FIGURES = (
    ("1", "Models: cantilever, two-force member, simply supported beam", "erdman_fig1_elements", ("(a)", "(b)", "(c)")),
    ("2", "Models: torsion, spatial R–S member", "erdman_fig2_elements", ("(a)", "(b)")),
    ("3", "Case I: the path generator", "erdman_fig3_generator", ("P", "1", "2", "3", "4", "α", "φ")),
    ("4", "Case 1: element coordinates and system forces", "erdman_fig4_case1", ("x₁", "x₈", "P₁", "P₂", "P₃")),
    ("7", "Case 2: system forces P1 to P8", "erdman_fig7_case2", tuple(f"P{k}" for k in "₁₂₃₄₅₆₇₈")),
)
_LOST = (("5", "Case 1: forces on the coupler"), ("6", "Case 1: forces on element 2"))


def _term(key: str, term: str, definition: str, code: str, does: str, verdict: Verdict, command: str) -> Row:
    return Row(
        f"E-{key}", "definitions", f"{term}.", definition, (code, _GLOSSARY), lambda _b: Found(does, verdict), command
    )


def _figure(number: str, shows: str, file: str, shown: tuple[str, ...]) -> Row:
    own = (
        "" if number in "12" else ", proportions of an example with 10, 4, 10, 8, 6 in; the document's arrows are lost"
    )
    return Row(
        f"E-fig{number}",
        f"Fig. {number}",
        f"{shows}.",
        "drawing lost",
        _DRAWINGS,
        lambda bench: redrawn(bench, file, shown, f"redrawn: {file}.svg{own}"),
    )


def _lost(number: str, shows: str) -> Row:
    text = "the directions of its forces are lost; the balance itself is row E-eq11"
    return Row(
        f"E-fig{number}",
        f"Fig. {number}",
        f"{shows}.",
        "drawing lost",
        _DRAWINGS,
        lambda _bench: Found(text, Verdict.NOT_DETERMINED),
    )


_DRAWINGS = ("harness/reproduce/figures_erdman.py",)

ROWS = (
    *(_term(*term) for term in _TERMS),
    *(_figure(*figure) for figure in _FIGURES),
    *(_lost(*figure) for figure in _LOST),
)
