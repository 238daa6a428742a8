"""`machine run`: a machine from its file to its results."""

from __future__ import annotations

from pathlib import Path

from rich.markup import escape

from mechanism_fmu.stress import beam_theory_note

from ..errors import HarnessError
from ..isolation import watched
from ..machine.bonds import HEADINGS as BOND_HEADINGS
from ..machine.bonds import bond_rows
from ..machine.file.changes import NO_CHANGES, Changes
from ..machine.performed import MachineRun
from ..machine.prepared import Prepared
from ..machine.statistics import HEADINGS as PART_HEADINGS
from ..master import Ending
from ..occupied import alone_in
from ..terminal import (
    FAILED,
    INTERRUPTED,
    console,
    real_time_factor,
    show_error,
    show_files,
    show_note,
    show_table,
    show_warning,
    tell_of_earlier_files,
)
from ..tooth_damage import HEADINGS as DAMAGE_HEADINGS
from ..tooth_damage import damage_row
from .files import Written, write_files
from .performed import perform
from .prepare import machine_file, prepared


def run_file(
    name: str, table: Path | None, folder: Path | None, changes: Changes = NO_CHANGES, in_process: bool = False
) -> int:
    """Run a machine with a table of inputs and changes, write what comes of it, and return the exit code.

    Args:
        name: of the machine or its file.
        table: of inputs, instead of the file's own.
        folder: for the results; its name stays the same whatever an FMU does to the working folder.
        changes: of the command, for this run.
        in_process: whether components of which the file does not say it have no process of their own.
    """
    folder = (Path(machine_file(name).stem) if folder is None else folder).absolute()
    with prepared(name, table, changes, in_process) as machine, alone_in(folder, waits=False):
        console.print(f"[bold]{escape(machine.plan.title)}[/]: {', '.join(machine.fmus)}", soft_wrap=True)
        show_notes(machine)

        def work() -> int:
            try:
                run = perform(machine, folder)
            except HarnessError:
                tell_of_earlier_files(folder)
                raise
            return _ending(run, write_files(run, folder), folder)

        return watched(work, any(part.foreign and not part.apart for part in machine.plan.components))


def show_notes(machine: Prepared) -> None:
    """What is to be said of a machine, before it runs."""
    for note in machine.notes:
        show_note(note)


def _ending(run: MachineRun, written: Written, folder: Path) -> int:
    """Show how a run ended, and return the exit code."""
    _show_parts(run)
    if run.bonds:
        title = "Energy over bonds"
        show_table(title, BOND_HEADINGS, bond_rows(run.bonds), numeric=range(1, len(BOND_HEADINGS)))
    _show_damage(run)
    for caution in run.cautions:
        show_warning(caution)
    outcome = run.outcome
    console.print(
        f"{outcome.steps} steps in {run.wall_time:.3g} s: {real_time_factor(outcome.final_time, run.wall_time)}."
    )
    _show_written(written, folder)
    reached = f"{outcome.final_time:.9g} s of {run.machine.plan.policy.stop_time:.9g} s"
    if outcome.ending is Ending.FAILED:
        show_error(f"{outcome.error} The files hold what was recorded up to {reached}.")
        return FAILED
    if written.refused:
        return FAILED
    if outcome.ending is Ending.INTERRUPTED:
        console.print(f"[yellow]Interrupted[/]: the files hold what was recorded up to {reached}.")
        return INTERRUPTED
    return 0


def _show_written(written: Written, folder: Path) -> None:
    """What there is of this run, and what is not."""
    if written.files[-1].suffix == ".html":
        show_files(written.files)
    else:
        names = ", ".join(file.name for file in written.files)
        console.print(f"Written to {escape(str(folder))}: {escape(names)}", soft_wrap=True)
    for error in written.refused:
        show_error(str(error))
    if written.earlier:
        names = ", ".join(written.earlier)
        console.print(f"[yellow]Of an earlier run[/] in {escape(str(folder))}: {escape(names)}", soft_wrap=True)


def _show_parts(run: MachineRun) -> None:
    """How each component fared, and how many impacts it reports."""
    struck = {name: f"{len(one.impacts)}" for name, one in run.by_component.items()}
    rows = [[*row, struck.get(row[0], "")] for row in run.rows]
    headings = [heading.replace(" ", "\n") for heading in (*PART_HEADINGS, "impacts [1]")]
    show_table("Components", headings, rows, numeric=range(1, len(headings)))


def _show_damage(run: MachineRun) -> None:
    """What impacts have done to the beams of components that have any."""
    for name, struck in run.by_component.items():
        if struck.damage is not None:
            row = damage_row(struck.damage, run.card)
            what = struck.struck.name if struck.struck is not None else "beam"
            show_table(f"Fatigue of the {what} of {name}", DAMAGE_HEADINGS, [row], range(1, len(DAMAGE_HEADINGS)))
            if struck.beam is not None:
                console.print(f"[dim]{escape(beam_theory_note(struck.beam))}[/]", soft_wrap=True)
        if struck.objection:
            console.print(f"[yellow]Warning[/] ({escape(name)}): {escape(struck.objection)}", soft_wrap=True)
