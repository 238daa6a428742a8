"""Commands `sweep` and `optimise`: many designs run, their table and report written."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import pyarrow as pa
from rich.markup import escape

from ...designs import sweep as sweeps
from ...designs.by_fmu import design_with_largest
from ...designs.optimum_file import Optimum, read_optimum
from ...designs.search import Best, History, InterruptedSearchError, best_of, search
from ...designs.sensitivity import NoIndicesError, Sensitivity, sensitivity
from ...designs.store import Store, failures, numbers_of
from ...designs.sweep import Progress, Sweep, range_cells, read_sweep
from ...designs.workers import Executor
from ...fmu import Fmu
from ...fmu.values import shown
from ...run.master import seconds
from ...run.results import write_json
from ..execution import interruption
from ..terminal import FAILED, INTERRUPTED, console, show_error, show_files, show_table, show_wide_table
from .designs_shared import (
    ENDING,
    DesignsBar,
    Runners,
    executor_of,
    opened,
    seen_again,
    show_beam_theory,
    show_input_note,
)

# What the command `sweep` does.

#: Failed designs that fit a terminal; the file has all.
_MOST_SHOWN = 10


def run_sweep(path: Path, folder: Path | None, runners: Runners) -> int:
    """Run the designs of a file that are not there yet, keep them as they come, and write table and report."""
    with opened(path, folder, runners, read_sweep) as (sweep, fmu, store, trusted):
        with executor_of(fmu, sweep.task, trusted) as executor:
            progress, table = _performed(sweep, store, executor)
        return _ending(fmu, sweep, store, progress, table)


def _performed(sweep: Sweep, store: Store, executor: Executor) -> tuple[sweeps.Progress, pa.Table]:
    console.print(f"[bold]{escape(sweep.title)}[/]: {len(sweep.designs)} designs ({sweep.method})", soft_wrap=True)
    show_input_note(sweep.task)
    with DesignsBar(len(sweep.designs)) as bar, interruption(lambda: console.print(ENDING)) as stop_requested:
        return sweeps.perform_sweep(sweep, store, executor, bar.show, stop_requested)


def _ending(fmu: Fmu, sweep: Sweep, store: Store, progress: sweeps.Progress, table: pa.Table) -> int:
    """Say what came of it, write the report, and return the exit code."""
    if not progress.complete:
        console.print(
            f"[yellow]Interrupted[/]: {progress.done} of {progress.total} designs are kept in "
            f"{escape(str(store.folder))}. The same command goes on with the others.",
            soft_wrap=True,
        )
        return INTERRUPTED
    from ...report.sweep_report import write_sweep_report

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


# What the command `optimise` does.


def run_optimise(path: Path, folder: Path | None, runners: Runners) -> int:
    """Look for the best design of a file, go on where it stopped, and write history, optimum and report."""
    with opened(path, folder, runners, read_optimum) as (optimum, fmu, store, trusted):
        what = "largest" if optimum.goal.largest else "smallest"
        console.print(
            f"[bold]{escape(optimum.title)}[/]: the {what} {escape(optimum.goal.objective.column)} in up to "
            f"{optimum.total} designs ({optimum.method})",
            soft_wrap=True,
        )
        show_input_note(optimum.task)
        with (
            executor_of(fmu, optimum.task, trusted) as executor,
            DesignsBar(optimum.total) as bar,
            interruption(lambda: console.print(ENDING)) as stop_requested,
        ):
            history = History(
                store,
                executor,
                optimum.count,
                stop_requested,
                lambda history: bar.show(_progress(history, optimum)),
            )
            try:
                best = search(optimum, history)
                near_it = _sensitivity(optimum, best, history)
            except InterruptedSearchError:
                return _interrupted(optimum, history, store)
        return _ending_of_search(fmu, optimum, history, best, near_it, store)


def _sensitivity(optimum: Optimum, best: Best, history: History) -> Sensitivity | None:
    try:
        return sensitivity(optimum, best, history)
    except NoIndicesError as error:
        console.print(f"No Sobol indices: {error}.", markup=False)
        return None


def _progress(history: History, optimum: Optimum) -> Progress:
    failed = sum(result.failure is not None for result in history.results)
    done = len(history.results)
    return Progress(optimum.total, min(history.earlier, done), done, failed)


def _interrupted(optimum: Optimum, history: History, store: Store) -> int:
    so_far = ""
    if history.results:
        value = optimum.goal.value(best_of(optimum, history).result, optimum.task)
        so_far = "" if value is None else f" Best so far: {value:.9g} {optimum.goal.objective.unit or '1'}."
    console.print(
        f"[yellow]Interrupted[/]: {len(store.pairs())} designs are kept in {escape(str(store.folder))}.{so_far} "
        "The same command goes on.",
        soft_wrap=True,
    )
    return INTERRUPTED


def _ending_of_search(
    fmu: Fmu, optimum: Optimum, history: History, best: Best, near_it: Sensitivity | None, store: Store
) -> int:
    """Say what was found, write everything, and return the exit code."""
    from ...report.optimum_report import Found, write_optimum_report

    table = store.finish()
    asked, failed = len(history.designs), len(failures(table))
    of_which = f", {failed} failed (status and message are in {store.table_file.name})" if failed else ""
    console.print(f"{asked} designs, {min(history.earlier, asked)} of them there before{of_which}.", soft_wrap=True)
    description = optimum.axes[0].description
    values = best.design.values.items()
    rows = [[name, shown(value, name, description), "free"] for name, value in values]
    for quantity, value in zip(optimum.task.quantities, best.result.values, strict=True):
        if quantity in optimum.events:
            continue
        role = "objective" if quantity == optimum.goal.objective else "found"
        rows.append([quantity.column, "none" if value is None else f"{value:.9g} {quantity.unit}".strip(), role])
    show_table(f"Best design: number {best.design.number}", ["quantity", "value", ""], rows)
    if near_it is not None:
        indices = zip(near_it.names, near_it.first, near_it.total, strict=True)
        lines = [[name, f"{first:.3f}", f"{total:.3f}"] for name, first, total in indices]
        show_table("Sobol indices near it", ["variable", "first order [1]", "total [1]"], lines, numeric=(1, 2))
    after = best_of(optimum, history)
    if after.feasible and after.design.number > optimum.count:
        console.print(
            f"A neighbour, design {after.design.number}, is better still: a larger count would find such.",
            soft_wrap=True,
        )
    files = [
        store.table_file,
        store.identity_file,
        write_json(store.folder / "optimum.json", _summary(optimum, best, near_it)),
    ]
    which = "the best" if best.feasible else "the one that misses the constraints least"
    seen = seen_again(fmu, optimum.task, best.design if best.result.failure is None else None, which)
    show_beam_theory(optimum.task, seen)
    files += [
        write_optimum_report(optimum, Found(best, near_it, history, table, seen), fmu, store.folder / "report.html"),
    ]
    show_files(files)
    if best.feasible:
        return 0
    column = optimum.goal.objective.column
    if optimum.goal.value(best.result, optimum.task) is None:
        show_error(
            f"No design gave a value of {column}: all failed, or there was nothing to take it of, as an impact before "
            f"{seconds(optimum.task.grid.stop):g} s."
        )
    else:
        show_error("No design keeps all constraints; the one shown misses them least. Give it more freedom.")
    return FAILED


def _summary(optimum: Optimum, best: Best, near_it: Sensitivity | None) -> dict[str, object]:
    pairs = zip(optimum.task.quantities, best.result.values, strict=True)
    return {
        "design": best.design.number,
        "keeps_constraints": best.feasible,
        "values": dict(best.design.values),
        "found": {
            quantity.column: value if value is not None and math.isfinite(float(value)) else None
            for quantity, value in pairs
        },
        "sobol_indices": None
        if near_it is None
        else {
            name: {"first_order": float(first), "total": float(total)}
            for name, first, total in zip(near_it.names, near_it.first, near_it.total, strict=True)
        },
    }
