"""report.html of one run, on a phone's screen, too."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import plotly.graph_objects as go

from ..fmu.declared import NO_BEAM
from ..fmu.description import Variable
from ..fmu.values import engineering, in_display_unit
from ..run.checks import Check
from ..run.experiment import Run, may_have_beam
from ..run.master import Ending
from ..run.results import settings, versions, write_text
from .animation import animation
from .impact_sections import compliance_section, fatigue_section, impacts_section, severity_section, stress_section
from .modes_and_events import events_section, modes_section
from .motion import contacts, motion_chart, still
from .page import cards, chart, checks_list, page, section, table, versions_section
from .parameters import Origin, Row, parameters_section, table_note

# Charts above each other on a phone's screen, where there is no space for legends beside them.

#: Of a line of a legend, between two charts, and around them all [px].
_LINE, _GAP, _TOP, _BOTTOM = 17, 34, 10, 46
#: Two names that are no longer stand beside each other in a legend.
_SHORT = 11


def stacked(figure: go.Figure) -> dict[str, Any]:
    """The layout of a stack of charts with a common x axis for `page.chart`: each legend stands above its chart.

    The charts keep their heights. Each is on a y axis of its own, the first at the top, and its legend, if it has
    one, has the number of the axis.
    """
    layout = figure.layout
    inner = layout.height - layout.margin.t - layout.margin.b
    numbers = range(1, len({trace.yaxis for trace in figure.data}) + 1)
    heights = [inner * (axis.domain[1] - axis.domain[0]) for axis in (layout[_name("yaxis", n)] for n in numbers)]
    legends = [_LINE * _lines(figure, n) for n in numbers]
    total = sum(heights) + sum(legends) + _GAP * (len(heights) - 1)
    changed: dict[str, Any] = {"height": total + _TOP + _BOTTOM, "margin": {"t": _TOP, "b": _BOTTOM}}
    bottom = total
    for number, height, legend in zip(numbers, heights, legends, strict=True):
        top = bottom - legend
        bottom = top - height
        changed[_name("yaxis", number)] = {"domain": [max(bottom, 0.0) / total, top / total]}
        if legend:
            place = {"x": 0, "xanchor": "left", "y": top / total, "yanchor": "bottom"}
            changed[_name("legend", number)] = {"orientation": "h", "font": {"size": 11}} | place
        bottom -= _GAP
    return changed


def _name(kind: str, number: int) -> str:
    return kind if number == 1 else f"{kind}{number}"


def _lines(figure: go.Figure, number: int) -> int:
    names = [
        trace.name
        for trace in figure.data
        if (trace.yaxis or "y") == _name("y", number) and trace.showlegend is not False
    ]
    if all(len(name) <= _SHORT for name in names):
        return math.ceil(len(names) / 2)
    return sum(1 + name.count("<br>") for name in names)


# report.html of one run.


def write_report(run: Run, path: Path, more_checks: Sequence[Check] = ()) -> Path:
    """Write the report of a run as one file that works offline.

    Raises:
        UsageError: the disk refuses.
    """
    return write_text(path, lambda file: file.write(run_report(run, more_checks)))


def run_report(run: Run, more_checks: Sequence[Check] = ()) -> str:
    """The report as HTML; `more_checks` join those of the run."""
    description, experiment = run.description, run.experiment
    subtitle = f"{description.text}  ·  {run.fmu.name}  ·  {experiment.stop_time:g} s in steps of {experiment.step:g} s"
    body = [_banner(run), cards(_key_figures(run)), section("Verdicts", checks_list([*run.checks, *more_checks]))]
    body += [
        animation(run),
        _motion(run),
        _stress(run),
        _severity(run),
        _fatigue(run),
    ]
    body += [
        compliance_section(run.description.analysis.chain, run.compliance),
        impacts_section(run.impacts, run.units["impacts"], contacts=run.logic.contacts),
    ]
    body += [modes_section(run), events_section(run)]
    body += [_parameters(run), _messages(run), versions_section(versions(run.fmu, run.description))]
    return page(description.model, subtitle, [part for part in body if part])


def _banner(run: Run) -> str:
    if run.outcome.ending is Ending.COMPLETED:
        return ""
    reason = str(run.outcome.error) if run.outcome.error else "It was interrupted by the user."
    heading = f"This run ended early, at {run.outcome.final_time:.9g} s"
    return section(heading, note=reason, banner=True)


def _key_figures(run: Run) -> list[tuple[str, str]]:
    figures = [("impacts", str(len(run.impacts)))]
    if run.impacts.empty:
        return figures
    figures.append(("first impact", f"{run.impacts['time'].iloc[0]:.7g} s"))
    if "velocity" in run.impacts:
        figures.append(("largest impact velocity", engineering(float(run.impacts["velocity"].abs().max()), "m/s")))
    if "stress_max" in run.impacts and run.impacts["stress_max"].notna().any():
        figures.append(("largest bending stress", engineering(float(run.impacts["stress_max"].max()), "Pa")))
    return figures


def _motion(run: Run) -> str:
    figure, level = motion_chart(run), still(run)
    if figure is None:
        return section("Motion", note=level) if level else ""
    bands = "Bands below the curves show which contacts are active. " if contacts(run) else ""
    note = f"Dotted red lines mark impacts. {bands}Drag to zoom, double-click to return. {level}".strip()
    return section("Motion", chart(figure, stacked(figure)), note=note)


def _stress(run: Run) -> str:
    declared = run.description.analysis
    struck = declared.struck
    if struck is None and not declared.objection and may_have_beam(run):
        return section("Stress", note=f"Nothing is to be analysed: {NO_BEAM}")
    if struck is None or run.beam is None:
        return ""
    return stress_section(run.impacts, struck, run.beam, run.experiment.material)


def _severity(run: Run) -> str:
    return severity_section(run.impacts, run.units["impacts"], run.description.analysis.struck, run.logic.contacts)


def _fatigue(run: Run) -> str:
    struck = run.description.analysis.struck
    if struck is None or run.beam is None or run.damage is None:
        return ""
    return fatigue_section(run.impacts, struck, run.beam, run.experiment.material, run.damage)


def _parameters(run: Run) -> str:
    rows = []
    for name, value in settings(run).items():
        variable = run.description.variable(name)
        shown = in_display_unit(value, name, run.description)
        rows.append(Row(variable, *shown, _origin(variable, run), marked=name in run.experiment.start_values))
    note = "Values set for this run are marked."
    if not any(row.marked for row in rows):
        note = "All values are the FMU's defaults."
    if run.inputs is not None:
        note += f" Inputs of the table are shown with their first values. {table_note(run.inputs)}"
    return parameters_section(rows, note)


def _origin(variable: Variable, run: Run) -> Origin:
    if run.inputs is not None and variable in run.inputs.variables:
        return Origin.TABLE
    if variable.causality == "calculatedParameter":
        return Origin.CALCULATED
    return Origin.SET if variable.name in run.experiment.start_values else Origin.DEFAULT


def _messages(run: Run) -> str:
    said = [m for m in run.messages if m.needs_attention]
    if not said:
        return ""
    rows = [[f"{m.time:.9g}", m.status.name.lower(), m.text] for m in said]
    return section("Warnings of the FMU", table(["t [s]", "status", "message"], rows, numeric=[0]))
