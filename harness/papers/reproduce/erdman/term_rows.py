"""What Erdman, Sandor and Oakberg promise, Case 3, the terms that they define, and their Figs 1 to 7."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

import build_fmu
from mechanism_fmu.elastodynamics import (
    DRIVE,
    Cycle,
    deflection_of,
    deformed_links,
    elastic_cycle,
    flywheel,
    periodic_response,
    quasi_static,
    torque_fluctuation,
    turn,
    with_friction,
)
from mechanism_fmu.model import Mechanism

from ..bench import Bench, FloatArray
from ..figures.all_figures import redrawn
from ..row import KED, Found, Row, Verdict, judged

# What the abstract and the introduction of Erdman, Sandor and Oakberg promise, and Case 3.

#: Of this project's own example: crank of 4 in [m], 500 rpm [rad/s].
_CRANK, _SPEED = 0.1016, 500 * math.pi / 30


def _operators(_bench: Bench) -> Found:
    link, u = np.array([0.3, 0.1]), np.array([2e-3, -1e-3])
    errors = [float(np.linalg.norm(deformed_links(link, u / k) - link - u / k)) for k in (1, 2)]
    order = math.log2(errors[0] / errors[1])
    return judged(
        abs(order - 2) < 0.02,
        f"derived beyond the pages at hand; this project's own agree with linear theory to order {order:.2f}",
        f"link (0.3, 0.1) m, u = (2, −1) mm: off by {errors[0]:.3e} m, half of u: {errors[1]:.3e} m",
        verdict=Verdict.NOT_DETERMINED,
    )


def _largest_deviations(rpm: int) -> tuple[float, float]:
    """Of the path point, quasi-static and by the periodic solution [m]."""
    cycle = quasi_static(turn(build_fmu.mechanism("four_bar_path_generator"), rpm * math.pi / 30, 360))
    equations = elastic_cycle(cycle, 0.02)
    response = periodic_response(equations).samples(equations.samples)
    moved = deflection_of(cycle.configurations, np.vstack([response, response[:1]]), "arm.end")[:, :2]
    return float(cycle.deviation("arm.end").max()), float(np.linalg.norm(moved, axis=1).max())


def _speeds(_bench: Bench) -> Found:
    (slow_static, slow), (fast_static, fast) = map(_largest_deviations, (50, 500))
    apart = abs(slow / slow_static - 1), abs(fast / fast_static - 1)
    return judged(
        slow < 1e-3 * _CRANK and fast > 1e-2 * _CRANK and apart[0] < 0.1 < apart[1],
        f"path generator: {1e6 * slow:.1f} µm at 50 rpm, {1e3 * fast:.2f} mm at 500 rpm, of a crank of "
        f"{1e3 * _CRANK:.1f} mm; below a thousandth of it and above a hundredth. The quasi-static solution is off by "
        f"{100 * apart[0]:.1f} % at 50 rpm and by {100 * apart[1]:.0f} % at 500 rpm",
        "periodic solution, 2 % damping of each mode, at each degree",
    )


def _beyond(text: str) -> Found:
    return Found(f"beyond the pages at hand; {text}", Verdict.NOT_DETERMINED)


def _motor(mechanism: Mechanism) -> tuple[Cycle, FloatArray, FloatArray]:
    """A turn of the example at its speed, with the crank's angles [rad] and the motor's torque [N m] at them."""
    cycle = quasi_static(turn(mechanism, _SPEED, 360))
    torque = cycle.reactions.of(DRIVE)[:, 0]
    return cycle, np.linspace(0.0, 2 * math.pi, len(torque)), torque


def _friction(_bench: Bench) -> Found:
    """Of the example, without friction and with 0.1 on pins of 5 mm: what the motor gives, and what friction takes."""
    mechanism = build_fmu.mechanism("four_bar_path_generator")
    mean = [torque_fluctuation(*_motor(of)[1:]).mean for of in (mechanism, with_friction(mechanism, 0.1, 5e-3))]
    return judged(
        abs(mean[0]) < 1e-6 < mean[1],
        f"beyond the pages at hand; here, 0.1 on pins of 5 mm takes a mean torque of {mean[1]:.4f} N m of the example "
        "at 500 rpm, none without",
        verdict=Verdict.NOT_DETERMINED,
    )


def _fluctuation(_bench: Bench) -> Found:
    cycle, angle, torque = _motor(build_fmu.mechanism("four_bar_path_generator"))
    found, wheel = torque_fluctuation(angle, torque), flywheel(angle, torque, _SPEED, 0.02)
    gap = float(np.abs(cycle.power.balance).max() / np.abs(cycle.power.drives).max())
    return judged(
        gap < 1e-9 and abs(wheel.inertia * 0.02 * _SPEED**2 / found.energy - 1) < 1e-9,
        f"beyond the pages at hand; here, input torque {found.least:.3f} to {found.largest:.3f} N m, power balanced; "
        f"a flywheel of {1e3 * wheel.inertia:.3f}·10⁻³ kg m² makes the coefficient of fluctuation 0.02",
        f"energy of the fluctuation {found.energy:.5f} J",
        verdict=Verdict.NOT_DETERMINED,
    )


ROWS = (
    Row(
        "E-case3",
        "Case 3",
        "The third model.",
        "named",
        ("docs/explanation/elastodynamics-dynamics.md",),
        Found("named (“three cases”) and not described in the pages at hand", Verdict.NOT_DETERMINED),
    ),
    Row(
        "E-speed",
        "claim, introduction",
        "Elasticity matters at high speed, not at low.",
        "in words",
        ("mechanism_fmu/elastodynamics/responses.py",),
        _speeds,
    ),
    Row(
        "E-any",
        "claim, abstract",
        "Applies to any planar or spatial mechanism.",
        "in words",
        ("mechanism_fmu/elastodynamics/structure/linkage.py",),
        Found(
            "any planar linkage of revolute joints, guides, rods and drivers; no gears, no cams; of spatial ones only "
            "the elements (6), (9) and the operators",
            Verdict.HOLDS_IN_PART,
        ),
    ),
    Row(
        "E-friction",
        "claim, abstract",
        "Coulomb and viscous friction are indicated.",
        "announced",
        ("mechanism_fmu/elastodynamics/reaction_forces.py",),
        _friction,
        f"{KED} --friction 0.1 --pin-radius 5mm",
    ),
    Row(
        "E-operators",
        "claim, abstract",
        "Stretch–rotation operators are derived.",
        "announced",
        ("mechanism_fmu/elastodynamics/stretch_rotation.py",),
        _operators,
    ),
    Row(
        "E-synthesis",
        "claim, introduction",
        "A general method of synthesis.",
        "announced",
        ("mechanism_fmu/elastodynamics/synthesis.py",),
        _beyond("`lightest`, sequential quadratic programming over sections, is this project's"),
        f"{KED} --synthesise --limit-deviation 1mm --limit-stress 60MPa",
    ),
    Row(
        "E-fluctuation",
        "claim, abstract",
        "Inertia fluctuations, power input and output.",
        "announced",
        ("mechanism_fmu/elastodynamics/cycle.py", "mechanism_fmu/elastodynamics/reaction_forces.py"),
        _fluctuation,
        f"{KED} --fluctuation 0.02",
    ),
    Row(
        "E-example",
        "claim, abstract",
        "A numerical example.",
        "announced",
        ("models/four_bar_path_generator/model.py",),
        _beyond("an example with 10, 4, 10, 8, 6 in at 500 rpm is this project's"),
        KED,
    ),
)


# The terms that Erdman, Sandor and Oakberg define, with what of them this project does; and their Figs 1 to 7.

_CYCLE, _SYNTHESIS = "mechanism_fmu/elastodynamics/cycle.py", "mechanism_fmu/elastodynamics/synthesis.py"
_SEARCH, _GLOSSARY = "harness/designs/search.py", "docs/explanation/glossary.md"

#: Term, short definition, where it lives, what this project does, verdict, command.
_TERMS = (
    (
        "kinematic-analysis",
        "Kinematic analysis",
        "displacements, velocity and acceleration ratios of rigid members",
        "mechanism_fmu/kinematics/motion.py",
        "`analyse`, with a driver's position as the variable",
        Verdict.TAKEN_OVER,
        "mechanism-fmu reproduce S-composite",
    ),
    (
        "dynamic-analysis",
        "Dynamic analysis",
        "the motion in time, with inertia forces of rigid members",
        "mechanism_fmu/moving.py",
        "every run of an FMU",
        Verdict.TAKEN_OVER,
        "mechanism-fmu run build/Ratchet.fmu",
    ),
    (
        "elastic-analysis",
        "Elastic analysis",
        "stresses and deflections under static load",
        "mechanism_fmu/elastodynamics/structure/configuration.py",
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
        "mechanism_fmu/elastodynamics/responses.py",
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
        "mechanism_fmu/elastodynamics/cycle.py",
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
        "the package `mechanism_fmu.elastodynamics`, and `ked`",
        Verdict.TAKEN_OVER,
        KED,
    ),
)


def _term(key: str, term: str, definition: str, code: str, does: str, verdict: Verdict, command: str) -> Row:
    return Row(f"E-{key}", "definitions", f"{term}.", definition, (code, _GLOSSARY), Found(does, verdict), command)


def _figure(number: str, shows: str, find: Callable[[Bench], Found] | Found) -> Row:
    code = ("harness/papers/reproduce/figures/erdman_figures.py",)
    return Row(f"E-fig{number}", f"Fig. {number}", f"{shows}.", "drawing lost", code, find)


def _drawn(file: str, shown: Sequence[str], more: str = "") -> Callable[[Bench], Found]:
    return lambda bench: redrawn(bench, file, shown, f"redrawn: {file}.svg{more}")


_SIZES = ", proportions of an example with 10, 4, 10, 8, 6 in; the document's arrows are lost"
_LOST = Found("the directions of its forces are lost; the balance itself is row E-eq11", Verdict.NOT_DETERMINED)

TERMS = (
    *(_term(*term) for term in _TERMS),
    _figure(
        "1",
        "Models: cantilever, two-force member, simply supported beam",
        _drawn("erdman_fig1_elements", ("(a)", "(b)", "(c)")),
    ),
    _figure("2", "Models: torsion, spatial R–S member", _drawn("erdman_fig2_elements", ("(a)", "(b)"))),
    _figure(
        "3", "Case I: the path generator", _drawn("erdman_fig3_generator", ("P", "1", "2", "3", "4", "α", "φ"), _SIZES)
    ),
    _figure(
        "4",
        "Case 1: element coordinates and system forces",
        _drawn("erdman_fig4_case1", ("x₁", "x₈", "P₁", "P₂", "P₃"), _SIZES),
    ),
    _figure(
        "7", "Case 2: system forces P1 to P8", _drawn("erdman_fig7_case2", tuple(f"P{k}" for k in "₁₂₃₄₅₆₇₈"), _SIZES)
    ),
    _figure("5", "Case 1: forces on the coupler", _LOST),
    _figure("6", "Case 1: forces on element 2", _LOST),
)
