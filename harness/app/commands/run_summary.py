"""Summary of a run in the terminal: final values, impacts, damage, checks, files, and the exit code."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd
from rich.markup import escape

from ...analysis.impacts import UNITS_OF_STOPS, contact_name
from ...analysis.stress import BY_TWO_MODES, HEADINGS, damage_note, damage_row
from ...errors import Status
from ...fmu.declared import NO_BEAM
from ...fmu.values import shown
from ...run.checks import Check, all_passed
from ...run.experiment import Run, may_have_beam
from ...run.master import Ending
from ...run.results import final_values
from ..terminal import (
    FAILED,
    INTERRUPTED,
    console,
    show_checks,
    show_error,
    show_files,
    show_table,
)

#: Columns of the impacts that fit a terminal, with their headings; the file has all.
_IMPACT_COLUMNS = {
    "time": "t",
    "contact": "contact",
    "closing_speed": "closing\nspeed",
    "impulse": "impulse",
    "energy_lost": "energy\nlost",
    "velocity": "v_I",
    "stress_max": "sigma_max",
}
_MOST_IMPACTS = 20
_LARGE = 1e4


def show_ending(run: Run, files: Sequence[Path], more_checks: Sequence[Check] = ()) -> int:
    """Show how a run ended, and return the exit code."""
    _show_final_values(run)
    _show_impacts(run)
    _show_damage(run)
    checks = [*run.checks, *more_checks]
    show_checks(checks)
    show_files(files)
    reached = f"{run.outcome.final_time:.9g} s of {run.experiment.stop_time:.9g} s"
    if run.outcome.ending is Ending.FAILED:
        show_error(f"{run.outcome.error} The files hold what was recorded up to {reached}.")
        return FAILED
    if run.outcome.ending is Ending.INTERRUPTED:
        console.print(f"[yellow]Interrupted[/]: the files hold what was recorded up to {reached}.")
        return INTERRUPTED
    for message in run.messages:
        if message.needs_attention and message.status is not Status.WARNING:  # warnings were shown when they came
            show_error(f"{message.instance} said so, but went on at t = {message.time:.6g} s: {message.text}")
    return 0 if all_passed(checks) else FAILED


def _show_final_values(run: Run) -> None:
    values = {name: v for name, v in final_values(run).items() if name != "time" and not name.startswith("impact")}
    if values:
        rows = [(name, shown(value, name, run.description)) for name, value in values.items()]
        show_table(f"Values at t = {run.outcome.final_time:.9g} s", ["variable", "value"], rows)


def _show_impacts(run: Run) -> None:
    if run.impacts.empty:
        console.print("No impacts." if len(run.impacts.columns) else "The FMU reports no impacts.")
        return
    columns = [name for name in _IMPACT_COLUMNS if name in run.impacts.columns]
    rows = [[_cell(name, row, run.logic.contacts) for name in columns] for row in _records(run.impacts)]
    title = f"Impacts: {len(run.impacts)}" + (
        f", the first {_MOST_IMPACTS}" if len(run.impacts) > _MOST_IMPACTS else ""
    )
    headings = [_heading(name, run.units["impacts"][name]) for name in columns]
    numbers = [place for place, name in enumerate(columns) if name != "contact"]
    show_table(title, headings, rows, numeric=numbers)
    if "contact" in columns:
        console.print(f"[dim]{escape(UNITS_OF_STOPS)}[/]", soft_wrap=True)
    declared = run.description.analysis
    if declared.struck is None and not declared.objection:
        if may_have_beam(run):
            console.print(f"[dim]No stress: {escape(NO_BEAM)}[/]", soft_wrap=True)
    elif run.beam is None:
        console.print("[dim]No stress: see the verdicts.[/]")
    else:
        console.print(f"[dim]sigma_max of an impact: {escape(BY_TWO_MODES)}[/]", soft_wrap=True)


def _records(impacts: pd.DataFrame) -> list[dict[str, Any]]:
    """The first impacts."""
    return [{str(name): value for name, value in row.items()} for row in impacts.head(_MOST_IMPACTS).to_dict("records")]


def _heading(name: str, unit: str) -> str:
    return _IMPACT_COLUMNS[name] + (f" [{unit}]" if name != "contact" else "")


def _cell(name: str, row: Mapping[str, Any], contacts: Sequence[str]) -> str:
    """Times to nine digits, others to four, but a stress of more has no power of ten."""
    value = row[name]
    if name == "contact":
        return contact_name(int(value), contacts)
    if name == "stress_max" and row.get("remark"):
        return str(row["remark"])
    if name == "time":
        return f"{value:.9g}"
    return f"{value:.0f}" if abs(value) >= _LARGE else f"{value:.4g}"


def _show_damage(run: Run) -> None:
    struck = run.description.analysis.struck
    if run.damage is None or run.beam is None or struck is None:
        return
    row = damage_row(run.damage, run.experiment.material)
    show_table(f"Fatigue of the {struck.name}", HEADINGS, [row], numeric=range(1, len(HEADINGS)))
    console.print(f"[dim]{escape(damage_note(run.damage, struck, run.beam))}[/]", soft_wrap=True)
