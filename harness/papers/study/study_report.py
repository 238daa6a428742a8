"""study.html: the paper's case studies with Figs 8 to 11."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from ...analysis.stress import stress_along
from ...fmu.values import engineering
from ...report.animation import animation
from ...report.page import cards, chart, charts, checks_list, page, section, table, versions_section
from ...report.parameters import Origin, Row, parameters_section, range_shown
from ...report.plot import Curve, Plot, interactive
from ...report.style import COLOURS
from ...run.checks import Finding
from ...run.results import versions, write_text
from .accuracy import ACCURACY
from .study import Study
from .wheels import BASE_CASE, Wheel

# Figs 8 to 11 of the paper, from a study: the same charts for the report and for the files.

#: The slope angle of Fig. 8 [deg].
_WHEELS_ANGLE = 95

_STEEL = "#5b6875"


@dataclass(frozen=True)
class PaperFigure:
    """One figure of the paper.

    Attributes:
        name: of its files, without ending.
        heading, note: for the reader.
        plots: beside each other.
    """

    name: str
    heading: str
    note: str
    plots: Sequence[Plot]


def paper_figures(study: Study) -> tuple[PaperFigure, ...]:
    """Figs 8, 9, 10 and 11."""
    return (
        PaperFigure(
            "fig08_wheels",
            f"Wheel shapes (β₀ = {_WHEELS_ANGLE}°)",
            "Fig. 8 of the paper: the wheel for each number of teeth.",
            _wheel_shapes(study),
        ),
        PaperFigure(
            "fig09_teeth",
            "Tooth shapes",
            "Fig. 9 of the paper: one tooth from its root to the next, the wheel's radius through the root upright.",
            _tooth_shapes(study),
        ),
        PaperFigure(
            "fig10_stress",
            "Stress along the tooth",
            "Fig. 10 of the paper: at the instant of the largest stress, over the normalised length; dots mark the "
            "maximum.",
            _stress_along_tooth(study),
        ),
        PaperFigure(
            "fig11_maximum",
            "Maximum bending stress",
            "Fig. 11 of the paper: over the slope angle and over the number of teeth.",
            _maximum_stress(study.wheels),
        ),
    )


def _wheel_shapes(study: Study) -> list[Plot]:
    return [
        Plot(
            f"{wheel.tooth_count} teeth",
            "x [mm]",
            "y [mm]",
            [Curve("wheel", 1e3 * x, 1e3 * y, _STEEL, filled=True)],
            to_scale=True,
            legend=False,
        )
        for wheel, rim in zip(study.wheels, study.rims, strict=True)
        if wheel.slope_angle_deg == _WHEELS_ANGLE
        for x, y in [rim.wheel()]
    ]


def _tooth_shapes(study: Study) -> list[Plot]:
    rims = dict(zip(study.wheels, study.rims, strict=True))
    return [
        Plot(
            f"{count} teeth",
            "along the rim [mm]",
            "outwards [mm]",
            [
                Curve(_angle_name(wheel), 1e3 * x, 1e3 * y, colour)
                for wheel, colour in zip(group, COLOURS, strict=False)
                for x, y in [rims[wheel].tooth()]
            ],
            to_scale=True,
        )
        for count, group in _by_count(study.wheels)
    ]


def _stress_along_tooth(study: Study) -> list[Plot]:
    plots = []
    for count, group in _by_count(study.wheels):
        curves = []
        for wheel, colour in zip(group, COLOURS, strict=False):
            position, stress = stress_along(wheel.tooth, wheel.impact_velocity)
            curves += [
                Curve(_angle_name(wheel), position, stress / 1e3, colour),
                Curve(_angle_name(wheel), [wheel.stress_position], [wheel.stress_max / 1e3], colour, False, True),
            ]
        plots.append(Plot(f"{count} teeth", "x / length, from the root [1]", "stress [kPa]", curves, from_zero=True))
    return plots


def _maximum_stress(wheels: Sequence[Wheel]) -> list[Plot]:
    by_angle = [
        _stress_over([wheel.slope_angle_deg for wheel in group], group, f"{count} teeth", colour)
        for (count, group), colour in zip(_by_count(wheels), COLOURS, strict=False)
    ]
    by_count = [
        _stress_over([wheel.tooth_count for wheel in group], group, _angle_name(group[0]), colour)
        for (_, group), colour in zip(_by_angle(wheels), COLOURS, strict=False)
    ]
    return [
        Plot("Over the slope angle", "slope angle β₀ [deg]", "maximum stress [kPa]", by_angle, from_zero=True),
        Plot("Over the number of teeth", "number of teeth [1]", "maximum stress [kPa]", by_count, from_zero=True),
    ]


def _stress_over(places: list[int], wheels: Sequence[Wheel], name: str, colour: str) -> Curve:
    return Curve(name, places, [wheel.stress_max / 1e3 for wheel in wheels], colour, dots=True)


def _angle_name(wheel: Wheel) -> str:
    return f"β₀ = {wheel.slope_angle_deg}°"


def _grouped(wheels: Sequence[Wheel], by: Callable[[Wheel], int]) -> list[tuple[int, list[Wheel]]]:
    return [(value, [wheel for wheel in wheels if by(wheel) == value]) for value in sorted(set(map(by, wheels)))]


def _by_count(wheels: Sequence[Wheel]) -> list[tuple[int, list[Wheel]]]:
    return _grouped(wheels, lambda wheel: wheel.tooth_count)


def _by_angle(wheels: Sequence[Wheel]) -> list[tuple[int, list[Wheel]]]:
    return _grouped(wheels, lambda wheel: wheel.slope_angle_deg)


_FINDINGS_NOTE = "Findings, not checks: this project computes what the paper computes, and says here how far that goes."


def write_study_report(study: Study, figures: Sequence[PaperFigure], path: Path) -> Path:
    """Write the report of the study as one file that works offline.

    Raises:
        UsageError: the disk refuses.
    """
    return write_text(path, lambda file: file.write(study_report(study, figures)))


def study_report(study: Study, figures: Sequence[PaperFigure]) -> str:
    """The report as HTML; `figures` as of `paper_figures`."""
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
