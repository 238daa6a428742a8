"""What the command `sweep` does."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pyarrow as pa
from rich.markup import escape

from ..designs import sweep as sweeps
from ..designs.identity import contents, identity
from ..designs.in_motion import design_with_largest
from ..designs.ranges import range_cells
from ..designs.store import Store, failures, numbers_of
from ..designs.sweep_file import Sweep, read_sweep
from ..designs.workers import Crew
from ..fmu import Fmu
from ..interrupt import interruption
from ..occupied import alone_in
from ..terminal import FAILED, INTERRUPTED, console, show_error, show_files, show_table, show_wide_table
from .shared import ENDING, DesignsBar, crew_of, keep_built, prepared, seen_again, show_beam_theory, show_input_note

#: Failed designs that fit a terminal; the file has all.
_MOST_SHOWN = 10


def run_sweep(
    path: Path, folder: Path | None, workers: int | None, scheduler: str | None, fast: bool, trust: bool = False
) -> int:
    """Run the designs of a file that are not there yet, keep them as they come, and write table and report."""
    folder = Path(path.stem) if folder is None else folder
    with prepared(path) as (file, fmu, built):
        sweep = read_sweep(file, fmu.description)
        known = identity(contents(fmu), sweep.task, sweep.axes, sweep.how, sweep.designs)
        with alone_in(folder):
            store = Store(folder, known, sweep.axes, sweep.task.quantities)
            if built:
                keep_built(fmu, folder)
            with crew_of(fmu, sweep.task, workers, scheduler, fast, trust or built) as crew:
                progress, table = _performed(sweep, store, crew)
            return _ending(fmu, sweep, store, progress, table)


def _performed(sweep: Sweep, store: Store, crew: Crew) -> tuple[sweeps.Progress, pa.Table]:
    console.print(f"[bold]{escape(sweep.title)}[/]: {len(sweep.designs)} designs ({sweep.method})", soft_wrap=True)
    show_input_note(sweep.task)
    with DesignsBar(len(sweep.designs)) as bar, interruption(lambda: console.print(ENDING)) as stop_requested:
        return sweeps.perform_sweep(sweep, store, crew, bar.show, stop_requested)


def _ending(fmu: Fmu, sweep: Sweep, store: Store, progress: sweeps.Progress, table: pa.Table) -> int:
    """Say what came of it, write the report, and return the exit code."""
    if not progress.complete:
        console.print(
            f"[yellow]Interrupted[/]: {progress.done} of {progress.total} designs are kept in "
            f"{escape(str(store.folder))}. The same command goes on with the others.",
            soft_wrap=True,
        )
        return INTERRUPTED
    from ..report.sweep_report import write_sweep_report

    new = progress.total - progress.earlier
    console.print(f"{progress.total} designs, {new} of them run now, {progress.earlier} there before.")
    _show_ranges(sweep, table)
    seen = seen_again(fmu, sweep.task, *design_with_largest(sweep.task.quantities[0], sweep.designs, table))
    show_beam_theory(sweep.task, seen)
    report = write_sweep_report(sweep, fmu, table, seen, store.folder / "report.html")
    failed = failures(table)
    show_files([store.table_file, store.identity_file, report])
    show_failures(failed)
    return FAILED if failed else 0


def _show_ranges(sweep: Sweep, table: pa.Table) -> None:
    """Between which values each quantity lies, and in which designs it has them."""
    numbers = table["design"].to_pylist()
    rows = [
        [quantity.column, quantity.unit or "1", *range_cells(numbers_of(table, quantity.column), numbers)]
        for quantity in sweep.task.quantities
    ]
    headings = ["quantity", "unit", "smallest", "no.", "largest", "no."]
    show_table(f"Results of {len(table)} designs", headings, rows, numeric=range(2, len(headings)))


def show_failures(failed: Sequence[tuple[int, str]]) -> None:
    """The designs that failed, each with its message."""
    if not failed:
        return
    rows = [[str(number), message] for number, message in failed[:_MOST_SHOWN]]
    more = f", the first {_MOST_SHOWN}" if len(failed) > _MOST_SHOWN else ""
    show_wide_table(f"Failed designs: {len(failed)}{more}", ["design", "message"], rows)
    show_error(f"{len(failed)} designs failed; results.parquet has them with status 'failed' and a message.")
