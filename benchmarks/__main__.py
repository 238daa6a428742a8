"""Command: `python -m benchmarks`, from the root of the repository; see docs/project/benchmarks.md."""

from __future__ import annotations

import json
import os
import tempfile
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from mechanism_fmu.fmu.start import CACHE_VARIABLE
from mechanism_fmu.model import MechanismError

from . import acceleration, bending, cams, cycle, elastodynamics, fmu_step, fmus, impacts, master, startup, step
from .c_limit import compare as c_limit
from .c_limit.library import NoCompilerError
from .native_surface import compare as native_surface
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
    cache = folder / "cache"
    progress.print("1/11  one acceleration (compiles the engine first)")
    comparisons = acceleration.compare(_ROUNDS)
    progress.print("2/11  one acceleration of ten bodies with four cams")
    comparisons += cams.compare(_ROUNDS)
    progress.print("3/11  one step")
    comparisons += step.compare(_ROUNDS)
    progress.print("4/11  one impact")
    comparisons += impacts.compare(_ROUNDS)
    progress.print("5/11  one simulated second of the free ratchet")
    comparisons += cycle.compare(_ROUNDS)
    progress.print("6/11  a linkage that bends")
    comparisons += elastodynamics.compare(_ROUNDS) + bending.compare(_ROUNDS)
    progress.print("7/11  the same algorithm by hand in C")
    try:
        comparisons += c_limit.compare(folder, _ROUNDS)
    except NoCompilerError as error:
        progress.print(f"     left out: {error}")
    progress.print("8/11  the native FMU, from C (builds it; a first build compiles the engine ahead of time)")
    try:
        comparisons += native_surface.compare(folder, _ROUNDS)
    except (NoCompilerError, MechanismError) as error:
        progress.print(f"     left out: {error}")
    progress.print("9/11  a machine of native FMUs")
    try:
        comparisons += master.compare(folder, _ROUNDS)
    except MechanismError as error:
        progress.print(f"     left out: {error}")
    progress.print("10/11  start of the FMU by pythonfmu (and one that compiles the engine)")
    ratchet, plain = fmus.build_ratchet(folder), fmus.build_plain(folder)
    starts = startup.compare(ratchet, folder, cache)
    progress.print("11/11  one step of the FMU by pythonfmu")
    os.environ[CACHE_VARIABLE] = str(cache)
    return [*comparisons, *fmu_step.compare(plain, ratchet, folder, _ROUNDS), *starts]


if __name__ == "__main__":
    typer.run(run)
