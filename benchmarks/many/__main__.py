"""Command: `python -m benchmarks.many`, from the root of the repository, with the extra `bench`: designs per second.

The sweep varies slope, spring and torque of the paper's ratchet; see docs/project/benchmarks.md.
"""

from __future__ import annotations

import json
import tempfile
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from ..table import WIDTH_OF_A_FILE, as_json, table, this_machine
from ..timing import DisagreementError
from .compare import ROUNDS, Accuracy, compare


def run(
    json_file: Annotated[
        Path | None, typer.Option("--json", help="Write all times to this file as well.", dir_okay=False)
    ] = None,
) -> None:
    """Time a sweep by the fast path, by MuJoCo's batched rollout and by solve_ivp in a process pool.

    The exit code is 1 when a requirement is missed, or when a way is less accurate than it should be.
    """
    out, progress = Console(highlight=False), Console(stderr=True, highlight=False)
    if not out.is_terminal:
        out.width = WIDTH_OF_A_FILE
    machine = this_machine()
    out.print(", ".join(f"{name} {value}" for name, value in machine.items()), soft_wrap=True)
    try:
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
            comparisons, accuracies = compare(Path(folder), ROUNDS, progress.print)
    except DisagreementError as error:
        progress.print(f"[bold red]Error:[/] {error}", soft_wrap=True)
        raise typer.Exit(1) from None
    out.print(table(comparisons))
    out.print(_accuracy(accuracies))
    if json_file is not None:
        told = {**as_json(machine, comparisons), "accuracy": [asdict(accuracy) for accuracy in accuracies]}
        json_file.write_text(json.dumps(told, indent=1) + "\n", encoding="utf-8")
    if any(comparison.met is False for comparison in comparisons):
        raise typer.Exit(1)


def _accuracy(accuracies: list[Accuracy]) -> Table:
    result = Table("largest error", box=None, padding=(0, 1), header_style="bold")
    for heading in ("time of impact [s]", "wheel speed after it [rad/s]", "at the end [rad/s]"):
        result.add_column(heading, justify="right", no_wrap=True)
    for one in accuracies:
        errors = (f"{error:.1e}" for error in (one.time, one.speed_after, one.speed_at_end))
        result.add_row(f"{one.way}, to {one.stop_time:g} s", *errors)
    return result


if __name__ == "__main__":
    typer.run(run)
