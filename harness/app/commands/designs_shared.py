"""Shared by `sweep` and `optimise`: the FMU, the executor of the designs, progress, and the design shown in motion."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TypeVar

from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from mechanism_fmu.fmu.disk.user_cache import was_built_here
from mechanism_fmu.processors import processors
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
from ...fmu.description import Description
from ...fmu.instances.workspace import temporary_folder
from ...run.master import seconds
from ...run.results import UNFINISHED, sweep_up
from ...toml_file import TomlFile
from ..execution import alone_in, instances_of, interruption
from ..terminal import RunDisplay, console, show_note

#: What is said when somebody presses Ctrl-C.
ENDING = "Ending: designs on their way are awaited and kept; Ctrl-C again to break off."


@dataclass(frozen=True)
class Runners:
    """Who runs the designs, as the options of the commands say.

    Attributes:
        workers: how many; None: as many as this process may use (`mechanism_fmu.processors`).
        scheduler: address of a cluster's; None: this machine.
        fast: whether the designs run in this process, by the Python sources in the FMU.
        trust: whether these may be run, though no build of this user has made the FMU.
    """

    workers: int | None = None
    scheduler: str | None = None
    fast: bool = False
    trust: bool = False


_Asked = TypeVar("_Asked", Sweep, Optimum)


@contextmanager
def opened(
    path: Path, folder: Path | None, runners: Runners, read: Callable[[TomlFile, Description], _Asked]
) -> Iterator[tuple[_Asked, Fmu, Store, Runners]]:
    """What the file of a command asks for, its FMU, the results, and the runners, who trust an FMU that is built here.

    Args:
        path: of the file.
        folder: where the results are, or will be; nobody else writes them meanwhile. None: named like the file.
        runners: of the designs.
        read: reads the file for an FMU.

    Raises:
        UsageError: mistakes in the file, no FMU, other results, somebody else who writes them, or the disk refuses.
    """
    folder = Path(path.stem) if folder is None else folder
    file = TomlFile.read(path)
    wanted = source(file)
    with fmu_file(wanted) as found, open_fmu(found) as fmu:
        asked, built = read(file, fmu.description), wanted.path is None
        known = identity(contents(fmu), asked.task, asked.axes, asked.how, asked.designs)
        with alone_in(folder):
            store = Store(folder, known, asked.axes, asked.task.quantities)
            if built:
                _keep_built(fmu, folder)
            yield asked, fmu, store, replace(runners, trust=runners.trust or built)


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
def fmu_file(wanted: Source) -> Iterator[Path]:
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
def executor_of(fmu: Fmu, task: Task, runners: Runners) -> Iterator[Executor]:
    """Those who run the designs: processes, a cluster, or (`fast`) threads of this process.

    Args:
        fmu: that they run.
        task: of every design.
        runners: who they are.

    Raises:
        UsageError: the cluster cannot be used, the designs of this FMU cannot run in one call, or `fast` would run
            Python that nobody trusts.
    """
    if runners.fast:
        if runners.scheduler is not None:
            raise UsageError(
                "--fast uses the threads of this machine, --scheduler the machines of a cluster; choose one."
            )
        if not runners.trust and not was_built_here(fmu.path):
            raise UsageError(
                f"--fast runs the Python sources in '{fmu.path}' in this very process, and no build of yours has made "
                "this file. Build it here, name its model in [fmu], or add --trust if you trust whoever made it; "
                "without --fast, the FMU runs in processes of its own."
            )
        from ...designs.by_batch import require_batch

        require_batch(fmu.path)
        yield partial(here, Work(fmu, task, by_batch_in(runners.workers)))
        return
    if runners.scheduler is None:
        with Processes(Work(fmu, task, BY_FMU), runners.workers or processors()) as processes:
            yield processes.run
        return
    try:
        from ...designs.cluster import connected, on_cluster
    except ModuleNotFoundError as error:
        if error.name != "distributed":
            raise
        raise UsageError(
            '--scheduler needs Dask, which is not installed: python -m pip install -e ".[cluster]"'
        ) from None
    with connected(runners.scheduler) as client:
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
