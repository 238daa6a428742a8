"""Commands of one FMU: demo, cycle, run, modes, validate, study, new; each returns its exit code."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

import typer
from rich.markup import escape

from ...analysis.stress import card_of
from ...errors import FmuError, UsageError
from ...fmu import open_fmu
from ...fmu.instances.integration import Integrator
from ...fmu.interface import Instances
from ...fmu.values import parse_time
from ...papers.study.wheels import base_case_checks
from ...run.checks import Check, all_passed
from ...run.experiment import Experiment, Run, default_times, performing, start_values
from ...run.logic import default_parameters, read_logic
from ...run.results import prepare_folder, summary, write_run, write_text
from ...toml_file import TomlFile, as_text
from ..execution import alone_in, interruption, with_instances
from ..output import give
from ..terminal import (
    FAILED,
    INTERRUPTED,
    RunDisplay,
    console,
    name_earlier_files,
    show_checks,
    show_error,
    show_files,
    show_findings,
    show_note,
    show_progress,
    show_table,
    show_warning,
    show_wide_table,
)

if TYPE_CHECKING:
    from ...papers.study.study import Study
from .run_summary import show_ending

#: The base case of the paper is the FMU's default; the pawl strikes at 0.94 s and swings back at 4.9 s.
_DEMO = Experiment(stop_time=6.0, step=1e-3)
_CYCLE_STEP = 5e-3


def run_demo(folder: Path) -> int:
    """Build the ratchet, run the paper's base case, compare it with reference values, write everything."""
    with alone_in(folder, waits=False):
        path = _built_ratchet(folder, f"run its base case for {_DEMO.stop_time:g} s")
        with open_fmu(path) as fmu:
            return _performed(fmu, _DEMO, lambda run: _written(run, folder, base_case_checks(run.impacts)))


def run_cycle(folder: Path) -> int:
    """Build the ratchet, run a whole indexing cycle of its free pawl, check it, write everything."""
    from ...papers.study import indexing

    with alone_in(folder, waits=False):
        path = _built_ratchet(folder, f"run it through four strokes in {indexing.STOP_TIME:g} s")
        drive = indexing.write_drive(folder / "drive.csv")
        experiment = Experiment(indexing.STOP_TIME, _CYCLE_STEP, indexing.VALUES, drive)
        with open_fmu(path) as fmu:
            return _performed(fmu, experiment, lambda run: _written(run, folder, indexing.cycle_checks(run.results)))


#: What a new file is like, in words.
_LIKE = {
    "lever": "a lever that falls on a stop",
    "four_bar": "a four-bar linkage with a motor",
    "cam": "a cam with a follower that may jump",
    "ratchet": "a ratchet with two pawls",
    "blank": "a body that falls",
}


def new_mechanism(name: str, like: str) -> int:
    """Write a mechanism to begin with, and say how to go on."""
    from mechanism_fmu.fmu.own.find import Like, WrongUseError, write_new

    try:
        path = write_new(name, Path(), Like(like))
    except (WrongUseError, OSError) as error:
        raise UsageError(str(error)) from error
    console.print(
        f"Written: {path}, {_LIKE[like]}. Build its FMU, and run it:\n\n"
        f"mechanism-fmu build {path}\nmechanism-fmu run build/{path.stem}.fmu\n\n"
        "Then change the file; docs/tutorials/your-first-mechanism.md explains it, and how to begin with a model.",
        soft_wrap=True,
        markup=False,
    )
    return 0


def run_fmu(
    path: Path,
    settings: Sequence[str],
    stop_time: str | None,
    step: str | None,
    input_file: Path | None,
    material: str | None,
    folder: Path,
    in_process: bool = False,
    units_row: bool = False,
    parameters: Path | None = None,
    integrator: str | None = None,
    tolerance: float | None = None,
) -> int:
    """Run an FMU and write what comes of it; times are in seconds, or have a unit.

    Of `settings` and a file of parameters that set the same, the settings hold.

    The files are written before the instance is freed, to a folder that stays the same whatever the FMU does to the
    working folder.
    """
    card, folder = card_of("steel" if material is None else material), folder.absolute()
    with open_fmu(path, _integrator(integrator, tolerance)) as fmu:
        values = start_values([*_settings_of(parameters, settings), *settings], fmu.description)
        until = parse_time(stop_time, "--stop-time", fmu.description)
        times = default_times(fmu.description, until, parse_time(step, "--step", fmu.description))
        if step is None and fmu.description.step is None:
            show_note(f"{path.name} says no step size; {times[1]:g} s is taken. --step sets another one.")
        experiment = Experiment(*times, values, input_file, card, material is not None)

        def work(instances: Instances) -> int:
            try:
                return _performed(instances, experiment, lambda run: _written(run, folder, units_row=units_row))
            except FmuError:
                name_earlier_files(folder)
                raise

        with alone_in(folder, waits=False):
            return with_instances(fmu, in_process, work)


def _integrator(method: str | None, tolerance: float | None) -> Integrator | None:
    """What integrates an FMU by its interface for Model Exchange, if that is wanted."""
    if method is None:
        if tolerance is not None:
            raise UsageError(
                "--tolerance is that of --integrator; give both, e.g. --integrator DOP853 --tolerance 1e-9."
            )
        return None
    return Integrator(method) if tolerance is None else Integrator(method, tolerance)


def _settings_of(path: Path | None, others: Sequence[str]) -> list[str]:
    """What a TOML file of names and values sets, but what `others` set; nothing without a file.

    Raises:
        UsageError: it cannot be read, or a value is neither number, nor true or false, nor text.
    """
    if path is None:
        return []
    file, taken = TomlFile.read(path), {one.partition("=")[0].strip() for one in others}
    for name, value in file.data.items():
        if not isinstance(value, bool | int | float | str):
            file.wrong((name,), "is no value; write name = value, e.g. drive_torque = 0.002 or drive_torque = '2 N.mm'")
    file.check()
    return [f"{name}={as_text(value)}" for name, value in file.data.items() if name not in taken]


def show_modes(path: Path, settings: Sequence[str], output: Path | None) -> int:
    """Show the modes and transitions of an FMU's mechanism for parameter values, and draw them."""
    from mechanism_fmu.statechart import definition_rows, diagram, kept_parts, rows
    from mechanism_fmu.statechart.pictures import DEFINITION_HEADINGS, HEADINGS

    with open_fmu(path) as fmu:
        values = start_values(settings, fmu.description)
        file = read_logic(fmu.folder)
    logic = file.chosen(default_parameters(fmu.description, values))
    if file.objection or logic is None:
        why = "for these parameter values" if file.variants else "in this FMU"
        raise UsageError(file.objection or f"{path.name} has no modes and transitions {why}.")
    show_wide_table("Transitions", HEADINGS, rows(logic))
    for name in kept_parts(logic):
        console.print(f"[bold]{escape(name)}[/] is closed throughout.")
    show_wide_table("Logical functions", DEFINITION_HEADINGS, definition_rows(logic))
    output = Path(f"{path.stem}_modes.svg") if output is None else output
    prepare_folder(output.parent)
    show_files([write_text(output, lambda file: file.write(diagram(logic)))])
    return 0


def validate_fmu(path: Path, in_process: bool = False) -> int:
    """Show one verdict after the other."""
    from ...run.validate import validate

    def work(instances: Instances) -> int:
        passed = True
        for check in validate(instances):
            show_checks([check])
            passed = passed and check.passed
        console.print(
            "The FMU keeps what it promises." if passed else "[bold red]The FMU has the problems marked above.[/]"
        )
        return 0 if passed else FAILED

    with open_fmu(path) as fmu:
        return with_instances(fmu, in_process, work)


def run_study(folder: Path, path: Path | None, in_process: bool = False) -> int:
    """Run the paper's study and write it, wherever an FMU moves the working folder."""
    import PIL  # noqa: F401  (its figures are pictures, too: to be missed before the work, and not after it)

    folder = folder.absolute()
    with alone_in(folder, waits=False):
        path = _built_ratchet(folder, "run the paper's study with it") if path is None else path
        with open_fmu(path) as fmu:
            return with_instances(fmu, in_process, lambda instances: _study_written(_studied(instances), folder))


def _studied(fmu: Instances) -> Study:
    """The study, under the eyes of the user."""
    from ...papers.study.study import ratchet_study

    with (
        show_progress(f"Loading {fmu.path.name} ...") as progress,
        interruption(lambda: console.print("Ending after this wheel; Ctrl-C again to break off.")) as stop_requested,
    ):

        def on_wheel(number: int, of: int) -> None:
            progress(f"{number} of {of} wheels", number / of)
            if stop_requested():
                console.print("[yellow]Interrupted[/]: nothing was written; the same command begins anew.")
                raise typer.Exit(INTERRUPTED)

        return ratchet_study(fmu, on_wheel)


def _study_written(study: Study, folder: Path) -> int:
    """Show and write a study, and return the exit code."""
    from mechanism_fmu.stress import LEAST_SLENDERNESS

    from ...papers.study.accuracy import ACCURACY
    from ...papers.study.study import write_study
    from ...papers.study.study_report import paper_figures, write_study_report
    from ...report.static import write_static

    rows = [wheel.cells() for wheel in study.wheels]
    headings = ["nt", "beta_0 [deg]", "t_I [s]", "omega(t_I+) [rad/s]", "v_I [m/s]", "sigma_max [Pa]", "l/h [1]"]
    show_table("First impact of each wheel", headings, rows, numeric=range(len(headings)))
    slender = [wheel.slenderness for wheel in study.wheels]
    outside = sum(ratio < LEAST_SLENDERNESS for ratio in slender)
    console.print(
        f"[dim]l/h, length over root height of a tooth, is {min(slender):.2f} to {max(slender):.2f}: {outside} of "
        f"{len(slender)} are outside beam theory ({LEAST_SLENDERNESS:g} or more). sigma_max: the paper's two modes.[/]",
        soft_wrap=True,
    )
    for warning in study.warnings:
        console.print(f"[yellow]Warning[/]: {escape(warning)}", soft_wrap=True)
    show_checks(study.checks)
    show_findings(ACCURACY, study.findings)
    figures = paper_figures(study)
    files = write_study(study, folder)
    for figure in figures:
        files += write_static(figure.plots, folder / figure.name)
    show_files([*files, write_study_report(study, figures, folder / "study.html")])
    return 0 if all_passed(study.checks) else FAILED


def _built_ratchet(folder: Path, purpose: str) -> Path:
    """Build the ratchet into `folder`, after saying so and what for."""
    import build_fmu

    path = folder / "Ratchet.fmu"
    console.print(f"Building the paper's ratchet, {escape(str(path))}, to {purpose}.", soft_wrap=True)
    build_fmu.build("ratchet", folder)
    return path


def _performed(fmu: Instances, experiment: Experiment, then: Callable[[Run], int]) -> int:
    """Perform an experiment under the eyes of the user; the exit code of what is done `then`.

    The instance is freed after that only: what has been recorded is written by then.

    Raises:
        FmuError: as of `performing`.
    """
    loading = f"Loading {fmu.path.name}; a first start may take a while ..."
    with ExitStack() as instance:
        with (
            RunDisplay(experiment.stop_time, loading) as display,
            interruption(lambda: console.print("Ending at the next step; Ctrl-C again to break off.")) as stop,
        ):
            performance = performing(fmu, experiment, on_message=show_warning, observers=[display], stop_requested=stop)
            run = instance.enter_context(performance)
        return then(run)


def _live(run: Run) -> str:
    """The section of the report in which the engine runs, or that says why it does not."""
    import build_fmu
    from mechanism_fmu.batch import MechanismError

    from ...page.live_section import live_section, no_live_section

    try:
        return live_section(run, build_fmu.web_of(run.fmu))
    except (LookupError, MechanismError) as error:
        return no_live_section(str(error).rstrip("."))


def _written(run: Run, folder: Path, more_checks: Sequence[Check] = (), units_row: bool = False) -> int:
    """Write the files of a run, unless it never began, and show in the terminal how it ended."""
    from ...report.run_report import write_report

    if run.outcome.error is not None and run.results.empty:
        name_earlier_files(folder)
        show_error(str(run.outcome.error))
        return FAILED
    if run.inputs is not None and run.inputs.note:
        show_note(run.inputs.note)
    give(summary(run))
    files = [*write_run(run, folder, units_row), write_report(run, folder / "report.html", more_checks, _live(run))]
    return show_ending(run, files, more_checks)
