"""Command: `python -m benchmarks.world [NAME ...]`, from the root of the repository; see docs/validation."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import track
from rich.table import Table

from .case import SHOWN, TOLERANCES, work
from .cases import CASES
from .pages import FOLDER, Result, drawings, index, page, picture


def run(
    names: Annotated[list[str] | None, typer.Argument(help="Cases; all of them, and their index, without any.")] = None,
    pages: Annotated[bool, typer.Option(help="Write docs/validation.")] = True,
) -> None:
    """Run published problems, print how far the engine is off, and write the pages of docs/validation.

    The exit code is 1 where a case is off by more than it says itself.
    """
    unknown = sorted(set(names or ()) - set(CASES))
    if unknown:
        raise typer.BadParameter(f"there is no case {unknown[0]!r}; there are {', '.join(CASES)}.")
    results = []
    for case in track([CASES[name] for name in names or CASES], "cases", console=Console(stderr=True)):
        works = tuple(work(case, tolerance) for tolerance in TOLERANCES)
        results.append(Result(case, tuple(case.run(tolerance) for tolerance in SHOWN), works))
    table = Table("case", "quantities", *(f"at {tolerance:.0e}" for tolerance in SHOWN), "allowed", "", box=None)
    missed = False
    for result in results:
        deviations = [result.case.deviation(one) for one in result.runs]
        off = not deviations[-1] <= result.case.within
        missed |= off
        shown = [f"{deviation:.1e}" for deviation in deviations]
        allowed = f"{result.case.within:.0e}"
        table.add_row(result.case.title, str(len(result.case.known)), *shown, allowed, "missed" if off else "")
    Console().print(table)
    if pages:
        today = datetime.now(UTC).date()
        FOLDER.mkdir(exist_ok=True)
        for result in results:
            (FOLDER / f"{result.case.name}.md").write_text(page(result, today), encoding="utf-8")
            (FOLDER / f"{result.case.name}.svg").write_text(picture(result), encoding="utf-8")
            if (more := drawings(result.case)) is not None:
                (FOLDER / f"{result.case.name}_more.svg").write_text(more, encoding="utf-8")
        if not names:
            (FOLDER / "index.md").write_text(index(results, today), encoding="utf-8")
    if missed:
        raise typer.Exit(1)


if __name__ == "__main__":
    typer.run(run)
