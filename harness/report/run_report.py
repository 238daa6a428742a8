"""report.html of one run, on a phone's screen, too."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

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
from .motion import contacts, motion_plots, still
from .page import HOW_TO_ZOOM, cards, chart, charts, checks_list, page, section, table, versions_section
from .parameters import Origin, Row, parameters_section, table_note
from .plot import interactive

#: Of a chart of one quantity [px].
_HEIGHT = 220


def write_report(run: Run, path: Path, more_checks: Sequence[Check] = (), live: str = "") -> Path:
    """Write the report of a run as one file that works offline; arguments as of `run_report`.

    Raises:
        UsageError: the disk refuses.
    """
    return write_text(path, lambda file: file.write(run_report(run, more_checks, live)))


def run_report(run: Run, more_checks: Sequence[Check] = (), live: str = "") -> str:
    """The report as HTML.

    Args:
        run: it is of.
        more_checks: join those of the run.
        live: the section in which the engine runs, as of `page.live_section`; "" for none.
    """
    description, experiment = run.description, run.experiment
    subtitle = f"{description.text}  ·  {run.fmu.name}  ·  {experiment.stop_time:g} s in steps of {experiment.step:g} s"
    body = [_banner(run), cards(_key_figures(run)), section("Verdicts", checks_list([*run.checks, *more_checks]))]
    body += [
        animation(run),
        live,
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
    plots, level = motion_plots(run), still(run)
    if not plots:
        return section("Motion", note=level) if level else ""
    bands = "Bands below the curves show which contacts are active. " if contacts(run) else ""
    note = f"Dotted red lines mark impacts. {bands}{HOW_TO_ZOOM} {level}".strip()
    drawn = (chart(interactive(plot, height=_HEIGHT)) for plot in plots)
    return section("Motion", charts(*drawn, kind="stacked"), note=note)


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
