"""Terminal output: progress, tables, checks, warnings and errors."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path

import typer
from rich import box
from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn
from rich.table import Table

from ..errors import HarnessError, LogMessage, Status, UsageError
from ..fmu.interface import Observable
from ..fmu.values import real_time_factor
from ..run.checks import Check, Finding, Verdict
from .output import note

#: Exit codes of the command line; Ctrl-C has the shell's own.
FAILED, USAGE, INTERRUPTED = 1, 2, 130

#: A bar for less than this [s] would only flicker.
_PATIENCE = 2.0
#: Nobody sees a bar move more often than this [s].
_FLICKER = 0.1

_VERDICT_STYLES = {Verdict.HOLDS: "green", Verdict.HOLDS_IN_PART: "yellow", Verdict.DOES_NOT_HOLD: "bold red"}
_PLAIN = "cyan"

#: No table is wider.
_MOST_COLUMNS = 1000

#: An FMU may change the working folder.
_STARTED_IN = Path.cwd()

console = Console(highlight=False)
error_console = Console(stderr=True, highlight=False)


@contextmanager
def user_errors() -> Iterator[None]:
    """Show what the user can put right as a message, and leave with the right exit code."""
    try:
        yield
    except HarnessError as error:
        show_error(str(error))
        raise typer.Exit(USAGE if isinstance(error, UsageError) else FAILED) from None


def show_error(text: str) -> None:
    """An error on stderr."""
    note("errors", text)
    error_console.print(f"[bold red]Error:[/] {escape(text)}", soft_wrap=True)


def show_warning(message: LogMessage) -> None:
    """A warning of an FMU on stderr, at once; its errors come with the failure they cause."""
    if message.status is Status.WARNING:
        note("warnings", message.text)
        where = f"{message.instance}, t = {message.time:.6g} s"
        error_console.print(f"[yellow]Warning[/] ({escape(where)}): {escape(message.text)}", soft_wrap=True)


def show_note(text: str) -> None:
    """What is to be known of a run, and no mistake."""
    note("notes", text)
    console.print(f"[dim]Note:[/] {escape(text)}", soft_wrap=True)


def show_checks(checks: Iterable[Check]) -> None:
    """Verdicts, one line each."""
    for check in checks:
        note("checks", asdict(check))
        mark = "[green]✓[/]" if check.passed else "[bold red]✗[/]"
        console.print(f"{mark} {escape(check.claim)}  [dim]{escape(check.evidence)}[/]", soft_wrap=True)


def show_findings(heading: str, findings: Iterable[Finding]) -> None:
    """What became of the claims of a source, one line each."""
    console.print(f"[bold]{escape(heading)}[/]")
    for finding in findings:
        verdict = f"[{_VERDICT_STYLES.get(finding.verdict, _PLAIN)}]{finding.verdict:<14}[/]"
        console.print(f"{verdict} {escape(finding.claim)}  [dim]{escape(finding.evidence)}[/]", soft_wrap=True)


def show_files(files: Sequence[Path]) -> None:
    """Where the results are; the last file is the one to look at."""
    for path in files:
        note("files", str(path))
    names = ", ".join(path.name for path in files)
    console.print(f"Written to {escape(_from_here(files[0].parent))}: {escape(names)}", soft_wrap=True)
    console.print(f"Open in a browser: [bold]{escape(_from_here(files[-1]))}[/]", soft_wrap=True)


def _from_here(path: Path) -> str:
    """A path as the user knows it: from the working folder, if it is below that."""
    try:
        here = Path.cwd()
    except OSError:  # an FMU has changed it to one that is no more
        return str(path)
    return str(path.relative_to(here) if path.is_relative_to(here) else path)


def name_earlier_files(folder: Path) -> None:
    """Nothing has been written: say so where something lies that could be taken for it."""
    if (folder / "summary.json").exists():
        console.print(
            f"[yellow]Nothing was written[/]: the files in {escape(_from_here(folder))} are an earlier run's."
        )


def show_table(title: str, headings: Sequence[str], rows: Iterable[Sequence[str]], numeric: Sequence[int] = ()) -> None:
    """A table; `numeric` columns stand right, and the unit of a heading stands below its name."""
    rows = [list(row) for row in rows]
    note("tables", {"title": title, "headings": list(headings), "rows": rows})
    table = Table(title=escape(title), title_justify="left", title_style="bold", header_style="dim")
    for i, heading in enumerate(headings):
        table.add_column(
            escape(heading.replace(" [", "\n[")), justify="right" if i in numeric else "left", no_wrap=True
        )
    for row in rows:
        table.add_row(*map(escape, row))
    unlimited = console.options.update(width=_MOST_COLUMNS)
    if console.measure(table, options=unlimited).maximum > console.width:  # a number that is cut off is a wrong one
        table.box, table.padding, table.pad_edge = box.SIMPLE_HEAD, (0, 1, 0, 0), False
    console.print(table)


def show_wide_table(title: str, headings: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """A table of texts that fold where the terminal is narrow."""
    rows = [list(row) for row in rows]
    note("tables", {"title": title, "headings": list(headings), "rows": rows})
    table = Table(title=escape(title), title_justify="left", title_style="bold", header_style="dim", show_lines=False)
    for heading in headings:
        table.add_column(escape(heading), overflow="fold")
    for row in rows:
        table.add_row(*map(escape, row))
    console.print(table)


@contextmanager
def show_progress(waiting: str) -> Iterator[Callable[[str, float], None]]:
    """A bar for work in parts, gone when it is done.

    Args:
        waiting: said until the first part is done.

    Yields:
        A function to be called after each part, with what to say and the fraction that is done.
    """
    columns = TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeRemainingColumn()
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(escape(waiting), total=1.0)
        yield lambda text, done: bar.update(task, description=escape(text), completed=done)


class RunDisplay:
    """An observer that says what is going on: a spinner until the first step, a bar when the steps take long.

    The bar shows the real-time factor, too: how many seconds are simulated in one of the clock on the wall.
    """

    def __init__(self, stop_time: float, loading: str, now: Callable[[], float] = clock.monotonic) -> None:
        self._now = now
        self._began = now()
        self._spinner = console.status(loading)
        time = TextColumn("t = {task.completed:.4g} s, {task.description}")
        columns = time, BarColumn(), TaskProgressColumn(), TimeRemainingColumn()
        self._bar = Progress(*columns, console=console, transient=True)
        self._task = self._bar.add_task("", total=stop_time)
        self._start_time = 0.0
        self._next = 0.0
        self.bar_shown = False

    def __enter__(self) -> RunDisplay:
        self._spinner.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._spinner.stop()
        if self.bar_shown:
            self._bar.stop()

    def started(self, unit: Observable, time: float) -> None:
        """The FMU is ready."""
        self._spinner.stop()
        self._began = self._now()
        self._next = self._began + _PATIENCE
        self._start_time = time

    def stepped(self, unit: Observable, time: float) -> None:
        """Move the bar, now and then."""
        now = self._now()
        if now < self._next:
            return
        self._next = now + _FLICKER
        if not self.bar_shown:
            self.bar_shown = True
            self._bar.start()
        pace = real_time_factor(time - self._start_time, now - self._began)
        self._bar.update(self._task, completed=time, description=pace)
