"""Command: `python -m benchmarks`, from the root of the repository; see docs/project/benchmarks.md."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from .comparisons import PARTS
from .table import WIDTH_OF_A_FILE, as_json, table, this_machine
from .timing import Comparison, DisagreementError

_ROUNDS = 9


def run(
    json_file: Annotated[
        Path | None, typer.Option("--json", help="Write all times to this file as well.", dir_okay=False)
    ] = None,
) -> None:
    """Time the engine and its FMU against plain numpy and scipy, in one run, and check the ratios.

    The exit code is 1 when a requirement is missed, or when two ways disagree in what they compute.
    """
    out, progress = Console(highlight=False), Console(stderr=True, highlight=False)
    if not out.is_terminal:
        out.width = WIDTH_OF_A_FILE
    if json_file is not None:
        json_file.parent.mkdir(parents=True, exist_ok=True)
    machine = this_machine()
    out.print(", ".join(f"{name} {value}" for name, value in machine.items()), soft_wrap=True)
    try:
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
            comparisons = _compare(Path(folder), progress)
    except DisagreementError as error:
        progress.print(f"[bold red]Error:[/] {error}", soft_wrap=True)
        raise typer.Exit(1) from None
    out.print(table(comparisons))
    if json_file is not None:
        json_file.write_text(json.dumps(as_json(machine, comparisons), indent=1) + "\n", encoding="utf-8")
    if any(comparison.met is False for comparison in comparisons):
        raise typer.Exit(1)


def _compare(folder: Path, progress: Console) -> list[Comparison]:
    comparisons = []
    for k, part in enumerate(PARTS, 1):
        progress.print(f"{k}/{len(PARTS)}  {part.title}")
        own = folder / str(k)  # what a part has loaded, no other may write anew
        own.mkdir()
        try:
            comparisons += part.compare(own, _ROUNDS)
        except part.lacks as error:
            progress.print(f"     left out: {error}")
    return comparisons


if __name__ == "__main__":
    typer.run(run)
