"""`machine run`, `check` and `new`: a machine from its file to its results."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rich.markup import escape

from mechanism_fmu import __version__
from mechanism_fmu.stress import SequenceDamage, beam_theory_note

from ...analysis.stress import HEADINGS as DAMAGE_HEADINGS, beam_summary, damage_row, damage_summary
from ...errors import HarnessError, UsageError
from ...fmu.values import real_time_factor
from ...machine.connection import changes
from ...machine.file.machine_plan import NO_CHANGES, Changes
from ...machine.file.write_file import write_new
from ...machine.observers.bonds import HEADINGS as BOND_HEADINGS, bond_rows, bond_summary
from ...machine.observers.component_impacts import Cycles, cycles_of
from ...machine.observers.growing_table import FORMATS
from ...machine.observers.record import chosen
from ...machine.observers.watched import HEADINGS as PART_HEADINGS, STATISTICS_UNITS
from ...machine.running import MachineRun, Prepared
from ...machine.structure import structure_of
from ...report.machine_report import write_machine_report
from ...run.master import Ending
from ...run.results import write_json, write_text
from ..execution import alone_in, watched
from ..terminal import (
    FAILED,
    INTERRUPTED,
    console,
    name_earlier_files,
    show_error,
    show_files,
    show_note,
    show_table,
    show_warning,
    show_wide_table,
)
from .machine_performed import perform
from .machine_ready import machine_file, prepared

# The files of a machine's run, beside the recorded signals.

#: What a run may leave in its folder.
_NAMES = (*(f"results{suffix}" for suffix in FORMATS), "impacts.csv", "summary.json", "report.html")


@dataclass(frozen=True)
class Written:
    """What is in the folder of a run.

    Attributes:
        files: of this run; a report that is there comes last.
        refused: what the disk refused.
        earlier: names of files of an earlier run.
    """

    files: list[Path]
    refused: list[UsageError]
    earlier: list[str]


def write_files(run: MachineRun, folder: Path) -> Written:
    """Write impacts.csv, summary.json and report.html: each of them, though the disk may refuse another one.

    A report needs the whole results.
    """
    impacts, files, refused = folder / "impacts.csv", [run.results], []
    whole = run.results.is_file()
    writers: list[Callable[[], Path]] = [
        lambda: write_text(impacts, lambda file: run.impacts.to_csv(file, index=False, lineterminator="\n")),
        lambda: write_json(folder / "summary.json", summary(run)),
        *([lambda: write_machine_report(run, folder / "report.html")] if whole else []),
    ]
    for write in writers:
        try:
            files.append(write())
        except UsageError as error:
            refused.append(error)
    names = {file.name for file in files}
    return Written(files, refused, [name for name in _NAMES if name not in names and (folder / name).exists()])


def summary(run: MachineRun) -> dict[str, Any]:
    """What the tables do not say, ready for JSON."""
    plan, outcome = run.machine.plan, run.outcome
    policy = asdict(plan.policy)
    policy["algorithm"] = policy.pop("scheme")
    return {
        "harness_version": __version__,
        "title": plan.title,
        "run": {**policy, "material": plan.material},
        "components": {component.name: _component(run, component.name) for component in plan.components},
        "connections": [asdict(connection) for connection in plan.connections],
        "bonds": bond_summary(run.bonds),
        "ending": outcome.ending.value,
        "error": None if outcome.error is None else str(outcome.error),
        "final_time": outcome.final_time,
        "steps": outcome.steps,
        "wall_time": run.wall_time,
        "results": run.results.name,
        "units": {table: dict(units) for table, units in run.units.items()} | {"statistics": STATISTICS_UNITS},
        "notes": run.machine.notes,
        "cautions": [caution.text for caution in run.cautions],
    }


def _of_cycles(cycles: Cycles, damage: SequenceDamage) -> dict[str, Any]:
    """What is repeated in the run, and what a thousand of it do to the beam."""
    return {
        "cycles_in_run": cycles.count,
        "a_cycle": cycles.counted,
        "damage_per_1000_cycles": cycles.damage_of_thousand(damage.damage),
    }


def _component(run: MachineRun, name: str) -> dict[str, Any]:
    """One component: where it is from, what was set, how it fared, what struck it."""
    plan = next(component for component in run.machine.plan.components if component.name == name)
    description = run.machine.fmus[name].description
    struck = run.by_component.get(name)
    damage = None
    if struck is not None and struck.damage is not None:
        counter = "" if struck.struck is None else struck.struck.strokes
        damage = damage_summary(struck.damage, run.card) | _of_cycles(
            cycles_of(name, counter, run.seen.table), struck.damage
        )
    return {
        "fmu": str(plan.source.path or plan.source.model),
        "model": description.model,
        "guid": description.guid,
        "start_values": dict(plan.values),
        "statistics": dict(run.statistics[name]),
        "impacts": None if struck is None else {"collected": len(struck.impacts), "lost": struck.lost},
        "tooth": None if struck is None else beam_summary(struck.struck, struck.beam),
        "fatigue": damage,
    }


# `machine run`: a machine from its file to its results.


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
                name_earlier_files(folder)
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


# `machine check`: what is in a machine's file, without running it.


def check_file(name: str) -> int:
    """Show the components of a machine in their order, its connections, and what is to be said of it."""
    with prepared(name) as machine:
        _show(machine)
        console.print("The file has no mistakes.")
    return 0


def _show(machine: Prepared) -> None:
    plan = machine.plan
    order = structure_of(machine.descriptions, plan.connections).order
    rows = []
    for name in order:
        fmu = machine.fmus[name]
        abilities = {
            "rollback": fmu.description.saves_state,
            "input derivatives": fmu.description.takes_slopes,
            "output derivatives": fmu.description.gives_slopes,
            "event mode": fmu.description.has_event_mode,
        }
        can = ", ".join(ability for ability, there in abilities.items() if there)
        rows.append([name, fmu.path.name, fmu.description.generation_tool, can])
    show_wide_table(f"{plan.title}: components, in the order of who follows whom", _COMPONENTS, rows)
    connections = [[c.source, c.target, changes(c, machine.description), c.rate] for c in plan.connections]
    show_wide_table("Connections", ["from", "to", "by", "rate"], connections)
    policy = plan.policy
    pairs = [
        ("stop time", f"{policy.stop_time:g} s"),
        ("step", f"{policy.step:g} s"),
        ("algorithm", policy.scheme.value + ("" if policy.tolerance is None else f", {policy.tolerance:g}")),
        ("extrapolation", policy.extrapolation.value),
        ("bonds", ", ".join(bond.name for bond in plan.bonds) or "none"),
        ("recorded", f"{len(chosen(plan.recording.signals, machine.description))} signals"),
    ]
    show_table("Run", ["what", "value"], pairs)
    show_notes(machine)


_COMPONENTS = ["component", "FMU", "made by", "can be or do"]


# `machine new`: a machine's file to begin with.


def new_file(name: str) -> int:
    """Write it, and say how to go on."""
    path = write_new(name, Path())
    console.print(f"Written: {escape(str(path))}", soft_wrap=True)
    console.print(f"mechanism-fmu machine run {path}", soft_wrap=True, markup=False)
    return 0
