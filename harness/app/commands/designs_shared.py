"""Shared by `sweep` and `optimise`: the FMU, the executor of the designs, progress, and the design shown in motion."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from mechanism_fmu.fmu.disk.user_cache import was_built_here
from mechanism_fmu.stress import beam_theory_note

from ...designs import sweep as sweeps
from ...designs.by_fmu import InMotion, in_motion
from ...designs.optimum_file import Optimum
from ...designs.store import Store, contents, identity
from ...designs.sweep import Sweep
from ...designs.task import Design, Task, wants_stress
from ...designs.variation import Source, source
from ...designs.workers import BY_FMU, Executor, Processes, Work, by_batch_in, here
from ...errors import UsageError
from ...fmu import Fmu, open_fmu
from ...fmu.instances.workspace import temporary_folder
from ...run.master import seconds
from ...run.results import UNFINISHED, sweep_up
from ...toml_file import TomlFile
from ..execution import alone_in, instances_of, interruption
from ..terminal import RunDisplay, console, show_note

#: What is said when somebody presses Ctrl-C.
ENDING = "Ending: designs on their way are awaited and kept; Ctrl-C again to break off."


@contextmanager
def prepared(path: Path) -> Iterator[tuple[TomlFile, Fmu, bool]]:
    """The file of a command, its FMU, and whether that was built for it, from a ready-made model.

    Raises:
        UsageError: the file says no FMU, or there is none.
    """
    file = TomlFile.read(path)
    wanted = source(file)
    with _fmu_file(wanted) as found, open_fmu(found) as fmu:
        yield file, fmu, wanted.path is None


@contextmanager
def opened_store(
    folder: Path, fmu: Fmu, built: bool, file: Sweep | Optimum, designs: Sequence[Design] = ()
) -> Iterator[Store]:
    """The results of a sweep or an optimum, which nobody else writes meanwhile.

    Args:
        folder: where they are, or will be.
        fmu: whose designs they are.
        built: whether it was built for them, and is kept beside them.
        file: what the command's file says.
        designs: the list, if it is known from the beginning.

    Raises:
        UsageError: there are other results, somebody else writes them, or the disk refuses.
    """
    known = identity(contents(fmu), file.task, file.axes, file.how, designs)
    with alone_in(folder):
        store = Store(folder, known, file.axes, file.task.quantities)
        if built:
            _keep_built(fmu, folder)
        yield store


def _keep_built(fmu: Fmu, folder: Path) -> None:
    """Leave an FMU that was built beside its results, once these are known to be its own.

    Raises:
        UsageError: the disk refuses.
    """
    place = folder / "fmu"
    try:
        place.mkdir(exist_ok=True)
        sweep_up(place)
        shutil.copyfile(fmu.path, place / f".{fmu.path.name}{UNFINISHED}")
        os.replace(place / f".{fmu.path.name}{UNFINISHED}", place / fmu.path.name)
    except OSError as error:
        raise UsageError(f"'{place / fmu.path.name}' cannot be written: {error}.") from error


@contextmanager
def _fmu_file(wanted: Source) -> Iterator[Path]:
    """The FMU's file; that of a model is built each time, into a folder that goes.

    The same sources give the same GUID, and others another one, which a folder with results then refuses.

    Raises:
        typer.Exit: it cannot be built; the reason has been said.
    """
    if wanted.path is not None:
        yield wanted.path
        return
    import build_fmu

    with temporary_folder() as place:
        console.print(f"Building {wanted.model} ...", markup=False)
        found = build_fmu.built(wanted.model, place)
        build_fmu.advise(build_fmu.Flavour.PYTHONFMU)
        yield found


class DesignsBar:
    """A bar for many designs, with rate and time left."""

    def __init__(self, total: int) -> None:
        self._bar = Progress(
            MofNCompleteColumn(),
            BarColumn(),
            TextColumn("{task.fields[rate]}"),
            TimeElapsedColumn(),
            TextColumn("left:"),
            TimeRemainingColumn(),
            TextColumn("[red]{task.fields[failed]}[/]"),
            console=console,
            transient=True,
            disable=not console.is_terminal,
        )
        self._task = self._bar.add_task("", total=total, rate="", failed="")
        self._earlier = 0

    def __enter__(self) -> DesignsBar:
        self._bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._bar.stop()

    def show(self, progress: sweeps.Progress) -> None:
        """Move the bar."""
        task = self._bar.tasks[0]
        seconds = task.elapsed or 0.0
        new = progress.done - progress.earlier
        self._bar.update(
            self._task,
            completed=progress.done,
            rate=f"{new / seconds:.3g} designs/s" if new and seconds > 0.0 else "",
            failed=f"{progress.failed} failed" if progress.failed else "",
        )


@contextmanager
def executor_of(
    fmu: Fmu, task: Task, workers: int | None, scheduler: str | None, fast: bool, trusted: bool
) -> Iterator[Executor]:
    """Those who run the designs: processes, a cluster, or (`fast`) threads of this process.

    Args:
        fmu: that they run.
        task: of every design.
        workers: how many; None: as many as there are processors.
        scheduler: address of a cluster's; None: this machine.
        fast: whether the designs run in this process, by the Python sources in the FMU.
        trusted: whether these may be run, though no build of this user has made the FMU.

    Raises:
        UsageError: the cluster cannot be used, the designs of this FMU cannot run in one call, or `fast` would run
            Python that nobody trusts.
    """
    if fast:
        if scheduler is not None:
            raise UsageError(
                "--fast uses the threads of this machine, --scheduler the machines of a cluster; choose one."
            )
        if not trusted and not was_built_here(fmu.path):
            raise UsageError(
                f"--fast runs the Python sources in '{fmu.path}' in this very process, and no build of yours has made "
                "this file. Build it here, name its model in [fmu], or add --trust if you trust whoever made it; "
                "without --fast, the FMU runs in processes of its own."
            )
        from ...designs.by_batch import require_batch

        require_batch(fmu.path)
        yield partial(here, Work(fmu, task, by_batch_in(workers)))
        return
    if scheduler is None:
        with Processes(Work(fmu, task, BY_FMU), workers or os.cpu_count() or 1) as processes:
            yield processes.run
        return
    try:
        from ...designs.cluster import connected, on_cluster
    except ModuleNotFoundError as error:
        if error.name != "distributed":
            raise
        raise UsageError(
            '--scheduler needs Dask, which is not installed: python -m pip install "mechanism_fmu[cluster]"'
        ) from None
    with connected(scheduler) as client:
        yield partial(on_cluster, client, fmu.path, task, BY_FMU)


def show_input_note(task: Task) -> None:
    """How the table of inputs was understood, where it is not as usual."""
    if task.inputs is not None and task.inputs.note:
        show_note(task.inputs.note)


def show_beam_theory(task: Task, seen: InMotion | None) -> None:
    """Where stresses are asked for: whether beam theory covers the beam of the design that is shown."""
    if wants_stress(task) and seen is not None and seen.run is not None and seen.run.beam is not None:
        struck = seen.run.description.analysis.struck
        name = struck.name if struck else "beam"
        note = f"The {name} of the design in motion: {beam_theory_note(seen.run.beam)}"
        console.print(f"[dim]{escape(note)}[/]", soft_wrap=True)


def seen_again(fmu: Fmu, task: Task, design: Design | None, which: str) -> InMotion | None:
    """A design in motion for a report (`in_motion`), with a sign of life while it runs; Ctrl-C ends it."""
    running = "Running a design once more, to be seen in the report ..."
    with (
        RunDisplay(seconds(task.grid.stop), running) as display,
        interruption(lambda: console.print("The report will show it up to here.")) as stop_requested,
    ):
        return in_motion(instances_of(fmu), task, design, which, [display], stop_requested)
