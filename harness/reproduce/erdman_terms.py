"""The terms that Erdman, Sandor and Oakberg define, with what of them this project does; and their Figs 1 to 7."""

from __future__ import annotations

from .row import Found, Row, Verdict

_KINEMATICS, _SIMULATION = "mechanism_fmu/kinematics/motion.py", "mechanism_fmu/simulation.py"
_CYCLE, _SYNTHESIS = "mechanism_fmu/elastodynamics/cycle.py", "mechanism_fmu/elastodynamics/synthesis.py"
_SEARCH = "harness/designs/search.py"
_GLOSSARY = "docs/glossary.md"
_KED = "mechanism-fmu ked four_bar_path_generator"

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
        _KED,
    ),
    (
        "kineto-elastodynamic-analysis",
        "Kineto-elastodynamic analysis",
        "the same, and deformation acts back on the inertia forces",
        "mechanism_fmu/elastodynamics/periodic.py",
        "`periodic_response`, `fed_back`",
        Verdict.TAKEN_OVER,
        _KED,
    ),
    (
        "kinematic-synthesis",
        "Kinematic synthesis",
        "a mechanism for prescribed positions or ratios",
        _SEARCH,
        "no synthesis of its own: `optimise` varies lengths of a given mechanism",
        Verdict.NOT_DETERMINED,
        "mechanism-fmu optimise docs/examples/indexing.toml",
    ),
    (
        "dynamic-synthesis",
        "Dynamic synthesis",
        "a mechanism for prescribed motion in time, of rigid members with mass",
        _SEARCH,
        "`optimise` varies masses and lengths of a given mechanism",
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
        _KED,
    ),
    (
        "kineto-elastostatic-synthesis",
        "Kineto-elastostatic synthesis",
        "a mechanism for prescribed positions and forces, of elastic members",
        _SYNTHESIS,
        "`lightest`, with loads and without masses",
        Verdict.HOLDS_IN_PART,
        _KED,
    ),
    (
        "kineto-elastodynamic-synthesis",
        "Kineto-elastodynamic synthesis",
        "a mechanism for prescribed motion and stress at its speed, of elastic members with mass",
        _SYNTHESIS,
        "`lightest`: least mass within limits of deviation and stress; the document's method is beyond the pages "
        "at hand",
        Verdict.HOLDS_IN_PART,
        f"{_KED} --synthesise --limit-deviation 1mm --limit-stress 60MPa",
    ),
    (
        "kineto-elastodynamics",
        "Kineto-elastodynamics",
        "the study of the motion of mechanisms whose elements deflect",
        "mechanism_fmu/elastodynamics/__init__.py",
        "the room `mechanism_fmu.elastodynamics`, and `ked`",
        Verdict.TAKEN_OVER,
        _KED,
    ),
)

#: Figure, what it shows, how far it is drawn, file.
_FIGURES = (
    ("1", "Models: cantilever, two-force member, simply supported beam", "erdman_fig1_elements", Verdict.REPRODUCED),
    ("2", "Models: torsion, spatial R–S member", "erdman_fig2_elements", Verdict.REPRODUCED),
    ("3", "Case I: the path generator", "erdman_fig3_generator", Verdict.HOLDS_IN_PART),
    ("4", "Case 1: element coordinates and system forces", "erdman_fig4_case1", Verdict.HOLDS_IN_PART),
    ("5", "Case 1: forces on the coupler", "", Verdict.NOT_DETERMINED),
    ("6", "Case 1: forces on element 2", "", Verdict.NOT_DETERMINED),
    ("7", "Case 2: system forces P1 to P8", "erdman_fig7_case2", Verdict.HOLDS_IN_PART),
)


def _term(key: str, term: str, definition: str, code: str, does: str, verdict: Verdict, command: str) -> Row:
    return Row(
        f"E-{key}", "definitions", f"{term}.", definition, (code, _GLOSSARY), lambda _b: Found(does, verdict), command
    )


def _figure(number: str, shows: str, file: str, verdict: Verdict) -> Row:
    text = (
        f"drawn: {file}.svg, proportions of an example with 10, 4, 10, 8, 6 in"
        if verdict is Verdict.HOLDS_IN_PART
        else f"drawn: {file}.svg"
        if file
        else "the directions of its forces are lost; the balance itself is row E-eq11"
    )
    code = ("harness/reproduce/figures_erdman.py",)
    return Row(f"E-fig{number}", f"Fig. {number}", f"{shows}.", "drawing lost", code, lambda _b: Found(text, verdict))


ROWS = (*(_term(*term) for term in _TERMS), *(_figure(*figure) for figure in _FIGURES))
