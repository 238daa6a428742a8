"""Command: `python -m benchmarks.peers [CASE ...]`, from the root of the repository; see docs/validation/peers.md."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import track

from .cases import CASES
from .pages import FIGURE, PAGE, absent, ahead, page, picture
from .programs import peers
from .result import Result, run_all


def run(
    names: Annotated[list[str] | None, typer.Argument(metavar="[CASE]...", help="Cases; all without any.")] = None,
    pages: Annotated[bool, typer.Option(help="Write docs/validation/peers.md and its figure, if all run.")] = True,
) -> None:
    """Run the same problems by this engine, MuJoCo, scipy, pymunk and Exudyn: error and time of each.

    A peer that is not installed is left out; all come with the extra `bench`.
    """
    unknown = sorted(set(names or ()) - set(CASES))
    if unknown:
        raise typer.BadParameter(f"there is no case {unknown[0]!r}; there are {', '.join(CASES)}.")
    found = peers()
    for peer in found:
        if peer.version is None:
            typer.echo(absent(peer), err=True)
    cases = [CASES[name] for name in names or CASES]
    results = run_all(cases, lambda runs: track(runs, "runs", console=Console(stderr=True)))
    typer.echo(ahead(results) + "\n")
    for result in results:
        _print(result)
    if pages and not names:
        PAGE.write_text(page(results, found, datetime.now(UTC).date()), encoding="utf-8")
        FIGURE.write_text(picture(results), encoding="utf-8")


def _print(result: Result) -> None:
    typer.echo(f"{result.case.title}\n  {'peer at its own best accuracy':48s} {'[ms]':>8s} {'error':>8s} ratio to ours")
    for one in result.verdicts:
        peer = one.peer
        name = f"{peer.code}, {peer.method}"
        typer.echo(f"  {name:48s} {1e3 * peer.seconds:8.3g} {peer.error:8.1e} {one.ratio:8.3g}")


if __name__ == "__main__":
    typer.run(run)
