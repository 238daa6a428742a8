"""Command: `python -m benchmarks.numbers`: the numbers of this project in one table, and their history in one file.

Sizes, times of builds and starts, speed beside other programs, deviations from known values, designs at the limits,
tests by kind; with `--all` what every other benchmark finds. Each run adds its numbers to docs/project/numbers.csv,
with the date, the commit and the machine, and makes docs/project/numbers.md anew.
"""

from __future__ import annotations

import os
import platform
import subprocess
import tempfile
from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from ..fmus import ROOT
from . import longer, quick
from .history import HISTORY, Entry, add_to_history, read_history
from .number import Found, Part, find
from .page import PAGE, page_of, shown


def run(
    everything: Annotated[
        bool,
        typer.Option("--all", help=f"What every other benchmark finds as well, in {longer.MINUTES} minutes in all."),
    ] = False,
    only: Annotated[
        str | None, typer.Option("--part", help="Only parts in whose name this stands, those of --all too.")
    ] = None,
    pages: Annotated[bool, typer.Option(help="Add to docs/project/numbers.csv and make numbers.md anew.")] = True,
) -> None:
    """Measure sizes, times, speed, deviations, limits and tests, in some three minutes, and keep them.

    A part for which something is not installed is left out, and named at the end. Where one fails, the exit code is 1.
    """
    parts = quick.parts() + (longer.parts() if everything or only else [])
    if only:
        names = [part.name for part in parts]
        parts = [part for part in parts if only in part.name]
        if not parts:
            raise typer.BadParameter(f"no part is called {only!r}; there are {', '.join(names)}.")
    found = _find(parts)
    _print(found)
    if pages and found.numbers:
        today, commit = datetime.now(UTC).date().isoformat(), _commit()
        machine = (
            f"{platform.system()} {platform.machine()}, {os.cpu_count()} processors, Python {platform.python_version()}"
        )
        add_to_history(HISTORY, (Entry(today, commit, machine, number) for number in found.numbers))
        PAGE.write_text(page_of(read_history(HISTORY)), encoding="utf-8")
    if found.failed:
        raise typer.Exit(1)


def _find(parts: list[Part]) -> Found:
    with (
        tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder,
        Progress(console=Console(stderr=True)) as progress,
    ):
        task = progress.add_task("", total=len(parts))
        begun = 0

        def say(name: str) -> None:
            nonlocal begun
            progress.update(task, description=name, completed=begun)
            begun += 1

        found = find(parts, Path(folder), say)
        progress.update(task, description="", completed=len(parts))
    return found


def _print(found: Found) -> None:
    table = Table("", "", "unit", "value", box=None)
    for number in found.numbers:
        table.add_row(number.group, number.name, number.unit, shown(number.value))
    Console().print(table)
    said = Console(stderr=True, highlight=False)
    for name, why in found.left_out.items():
        said.print(f"Left out: {name}: {why}", soft_wrap=True, markup=False)
    for name, why in found.failed.items():
        said.print(f"Failed: {name}: {why}", soft_wrap=True, markup=False)


def _commit() -> str:
    def git(*arguments: str) -> str:
        return subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=False).stdout.strip()

    return git("rev-parse", "--short=8", "HEAD") + ("+" if git("status", "--porcelain") else "")


if __name__ == "__main__":
    typer.run(run)
