"""What the command `sweep` does."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from pathlib import Path

import pyarrow as pa
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from mechanism_fmu.fmu.native.alone import alone

from .clock import seconds
from .designs import sweep as sweeps
from .designs.identity import identity
from .designs.in_motion import InMotion, design_with_largest, in_motion
from .designs.plan import Source, source
from .designs.store import Store, failures
from .designs.sweep_file import Sweep, read_sweep
from .designs.task import Design, Task
from .designs.toml_file import TomlFile
from .designs.ways import BY_FMU, by_batch_in
from .designs.workers import Crew, Processes, Work, here
from .errors import UsageError
from .fmu import Fmu, open_fmu
from .interrupt import interruption
from .results import prepare_folder
from .terminal import FAILED, INTERRUPTED, RunDisplay, console, show_error, show_files, show_table, show_wide_table

#: Failed designs that fit a terminal; the file has all.
_MOST_SHOWN = 10


def run_sweep(path: Path, folder: Path | None, workers: int | None, scheduler: str | None, fast: bool) -> int:
    """Run the designs of a file that are not there yet, keep them as they come, and write table and report."""
    file = TomlFile.read(path)
    wanted = source(file)
    folder = Path(path.stem) if folder is None else folder
    prepare_folder(folder)
    with alone_in(folder), open_fmu(fmu_file(wanted, folder)) as fmu:
        sweep = read_sweep(file, fmu.description)
        how = ("sweep", {"method": sweep.method})
        known = identity(fmu.description, sweep.task, sweep.axes, how, sweep.designs)
        store = Store(folder, known, sweep.axes, sweep.task.quantities)
        with crew_of(fmu, sweep.task, workers, scheduler, fast) as crew:
            progress, table = _performed(sweep, store, crew)
        return _ending(fmu, sweep, store, progress, table)


def alone_in(folder: Path) -> AbstractContextManager[None]:
    """Wait until no other command works in a folder."""
    return alone(
        folder, lambda: console.print(f"Another command is at work in {folder}: waiting for it.", markup=False)
    )


def fmu_file(wanted: Source, folder: Path) -> Path:
    """The FMU's file; a model is built into the folder.

    It is built each time: the same sources give the same GUID, and others another one, which the folder then refuses.

    Raises:
        UsageError: there is no such model.
    """
    if wanted.path is not None:
        return wanted.path
    import build_fmu

    place = folder / "fmu"
    for earlier in place.glob("*.fmu"):
        earlier.unlink()
    console.print(f"Building {wanted.model} ...", markup=False)
    build_fmu.build(wanted.model, place)
    (found,) = place.glob("*.fmu")
    return found


def _performed(sweep: Sweep, store: Store, crew: Crew) -> tuple[sweeps.Progress, pa.Table]:
    console.print(f"[bold]{escape(sweep.title)}[/]: {len(sweep.designs)} designs ({sweep.method})", soft_wrap=True)
    asked = "Ending: designs on their way are awaited and kept; Ctrl-C again to break off."
    with DesignsBar(len(sweep.designs)) as bar, interruption(lambda: console.print(asked)) as stop_requested:
        return sweeps.perform_sweep(sweep, store, crew, bar.show, stop_requested)


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
def crew_of(fmu: Fmu, task: Task, workers: int | None, scheduler: str | None, fast: bool) -> Iterator[Crew]:
    """Those who run the designs: processes, a cluster, or (`fast`) threads of this process.

    Raises:
        UsageError: the cluster cannot be used, or the designs of this FMU cannot run in one call.
    """
    if fast:
        if scheduler is not None:
            raise UsageError(
                "--fast uses the threads of this machine, --scheduler the machines of a cluster; choose one."
            )
        from .designs.by_batch import require_batch

        require_batch(fmu.path)
        yield partial(here, Work(fmu, task, by_batch_in(workers)))
        return
    if scheduler is None:
        with Processes(Work(fmu, task, BY_FMU), workers or os.cpu_count() or 1) as processes:
            yield processes.run
        return
    try:
        from .designs.cluster import connected, on_cluster
    except ModuleNotFoundError as error:
        if error.name != "distributed":
            raise
        raise UsageError(
            '--scheduler needs Dask, which is not installed: python -m pip install "mechanism_fmu[cluster]"'
        ) from None
    with connected(scheduler) as client:
        yield partial(on_cluster, client, fmu.path, task, BY_FMU)


def _ending(fmu: Fmu, sweep: Sweep, store: Store, progress: sweeps.Progress, table: pa.Table) -> int:
    """Say what came of it, write the report, and return the exit code."""
    if not progress.complete:
        console.print(
            f"[yellow]Interrupted[/]: {progress.done} of {progress.total} designs are kept in "
            f"{escape(str(store.folder))}. The same command goes on with the others.",
            soft_wrap=True,
        )
        return INTERRUPTED
    from .report.sweep_report import write_sweep_report

    new = progress.total - progress.earlier
    console.print(f"{progress.total} designs, {new} of them run now, {progress.earlier} there before.")
    _show_ranges(sweep, table)
    seen = seen_again(fmu, sweep.task, *design_with_largest(sweep.task.quantities[0], sweep.designs, table))
    report = write_sweep_report(sweep, fmu, table, seen, store.folder / "report.html")
    failed = failures(table)
    show_files([store.table_file, store.identity_file, report])
    show_failures(failed)
    return FAILED if failed else 0


def seen_again(fmu: Fmu, task: Task, design: Design | None, which: str) -> InMotion | None:
    """A design in motion for a report (`in_motion`), with a sign of life while it runs."""
    with RunDisplay(seconds(task.grid.stop), "Running a design once more, to be seen in the report ...") as display:
        return in_motion(fmu, task, design, which, [display])


def _show_ranges(sweep: Sweep, table: pa.Table) -> None:
    """Between which values each quantity lies, and in which designs it has them."""
    numbers = table["design"].to_pylist()
    rows = []
    for quantity in sweep.task.quantities:
        values = zip(table[quantity.column].to_pylist(), numbers, strict=True)
        there = [(float(value), number) for value, number in values if value is not None]
        ends = [text for pair in (min(there), max(there)) for text in _end(*pair)] if there else [""] * 4
        rows.append([quantity.column, quantity.unit or "1", *ends])
    headings = ["quantity", "unit", "smallest", "no.", "largest", "no."]
    show_table(f"Results of {len(table)} designs", headings, rows, numeric=range(2, len(headings)))


def _end(value: float, number: int) -> list[str]:
    return [f"{value:.6g}", str(number)]


def show_failures(failed: Sequence[tuple[int, str]]) -> None:
    """The designs that failed, each with its message."""
    if not failed:
        return
    rows = [[str(number), message] for number, message in failed[:_MOST_SHOWN]]
    more = f", the first {_MOST_SHOWN}" if len(failed) > _MOST_SHOWN else ""
    show_wide_table(f"Failed designs: {len(failed)}{more}", ["design", "message"], rows)
    show_error(f"{len(failed)} designs failed; results.parquet has them with status 'failed' and a message.")
