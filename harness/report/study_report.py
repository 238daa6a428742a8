"""study.html: the paper's case studies with Figs 8 to 11."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from ..accuracy import ACCURACY
from ..findings import Finding
from ..numbers import engineering
from ..paper import BASE_CASE
from ..results import write_text
from ..study import Study
from ..versions import versions
from ..wheels import Wheel
from .animation import animation
from .interactive import interactive
from .page import cards, chart, charts, checks_list, page, section, table, versions_section
from .paper_figures import PaperFigure
from .parameters import Origin, Row, parameters_section, range_shown

_FINDINGS_NOTE = "Findings, not checks: this project computes what the paper computes, and says here how far that goes."


def write_study_report(study: Study, figures: Sequence[PaperFigure], path: Path) -> Path:
    """Write the report of the study as one file that works offline.

    Raises:
        UsageError: the disk refuses.
    """
    return write_text(path, lambda file: file.write(study_report(study, figures)))


def study_report(study: Study, figures: Sequence[PaperFigure]) -> str:
    """The report as HTML; `figures` as of `paper_figures.paper_figures`."""
    largest = max(study.wheels, key=lambda wheel: wheel.stress_max)
    smallest = min(study.wheels, key=lambda wheel: wheel.stress_max)
    key_figures = [
        ("wheels", str(len(study.wheels))),
        (f"largest stress: {largest}", engineering(largest.stress_max, "Pa")),
        (f"smallest stress: {smallest}", engineering(smallest.stress_max, "Pa")),
    ]
    body = [
        cards(key_figures),
        section("What the paper claims", checks_list(study.checks)),
        section(ACCURACY, _findings_table(study.findings), note=_FINDINGS_NOTE),
        section("First impact of each wheel", _wheels_table(study.wheels)),
    ]
    for figure in figures:
        drawn = charts(*(chart(interactive(plot)) for plot in figure.plots))
        body.append(section(figure.heading, drawn, note=figure.note))
    body.append(animation(study.base_case, f"The base case in motion (nt = {BASE_CASE[0]}, β₀ = {BASE_CASE[1]}°)"))
    body.append(_parameters(study))
    if study.warnings:
        body.append(section("Warnings of the FMU", table(["message"], [[text] for text in study.warnings])))
    body.append(versions_section(versions(study.fmu, study.description)))
    return page("The paper's ratchet study", f"{study.fmu.name}  ·  first impact of each wheel", body)


def _findings_table(findings: Sequence[Finding]) -> str:
    rows = [[finding.claim, finding.verdict, finding.evidence] for finding in findings]
    return table(("the paper says", "verdict", "numbers"), rows)


def _wheels_table(wheels: Sequence[Wheel]) -> str:
    headings = (
        "teeth [1]",
        "β₀ [deg]",
        "t_I [s]",
        "ω(t_I+) [rad/s]",
        "v_I [m/s]",
        "σ_max [Pa]",
        "at x/l [1]",
        "l [mm]",
        "α [deg]",
        "l / root height [1]",
    )
    rows = [
        [
            *wheel.cells(),
            f"{wheel.stress_position:.4f}",
            f"{wheel.tooth_length * 1e3:.3f}",
            f"{math.degrees(wheel.tooth_apex_angle):.3f}",
            f"{wheel.slenderness:.3f}",
        ]
        for wheel in wheels
    ]
    return table(headings, rows, numeric=range(len(headings)))


def _parameters(study: Study) -> str:
    rows = []
    for name, values in study.parameters.items():
        variable = study.description.variable(name)
        differs = len(set(values)) > 1
        origin = Origin.VARIED if differs else Origin.DEFAULT
        if variable.causality == "calculatedParameter":
            origin = Origin.CALCULATED
        rows.append(Row(variable, *range_shown(values, name, study.description), origin, marked=differs))
    note = (
        "The FMU's defaults, but for those that are marked, which differ from wheel to wheel: the least … the largest."
    )
    return parameters_section(rows, note)
