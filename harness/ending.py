"""What is said at the end of a run."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from rich.markup import escape

from .checks import Check, all_passed
from .experiment import Run
from .impacts import WHEEL_HELD
from .master import Ending
from .messages import Status
from .numbers import shown
from .results import final_values
from .terminal import FAILED, INTERRUPTED, console, show_checks, show_error, show_files, show_table
from .tooth_damage import HEADINGS, damage_note, damage_row

#: Columns of the impacts that fit a terminal, with their headings; the file has all.
_IMPACT_COLUMNS = {
    "time": "t",
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
        console.print("No impacts." if len(run.impacts.columns) else "The FMU does not tell of impacts.")
        return
    columns = [name for name in _IMPACT_COLUMNS if name in run.impacts.columns]
    shown_impacts = run.impacts[columns].head(_MOST_IMPACTS)
    rows = [[f"{time:.9g}", *map(_cell, rest)] for time, *rest in shown_impacts.itertuples(index=False)]
    title = f"Impacts: {len(run.impacts)}" + (
        f", the first {_MOST_IMPACTS}" if len(run.impacts) > _MOST_IMPACTS else ""
    )
    headings = [f"{_IMPACT_COLUMNS[name]} [{run.units['impacts'][name]}]" for name in columns]
    show_table(title, headings, rows, numeric=range(len(columns)))
    if run.tooth is None:
        console.print("[dim]No stress: the FMU does not describe a tooth (tooth_length, tooth_apex_angle).[/]")


def _cell(value: float) -> str:
    """Four digits; a stress of more has no power of ten."""
    if math.isnan(value):
        return WHEEL_HELD
    return f"{value:.0f}" if abs(value) >= _LARGE else f"{value:.4g}"


def _show_damage(run: Run) -> None:
    if run.damage is None or run.tooth is None:
        return
    row = damage_row(run.damage, run.experiment.material)
    show_table("Fatigue of the tooth", HEADINGS, [row], numeric=range(1, len(HEADINGS)))
    console.print(f"[dim]{escape(damage_note(run.damage, run.tooth))}[/]", soft_wrap=True)
