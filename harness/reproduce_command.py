"""What the command `reproduce` does."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path

from rich.markup import escape

import build_fmu

from .fmu import Fmu, open_fmu
from .occupied import alone_in
from .reproduce.bench import Bench
from .reproduce.figures import write_figures
from .reproduce.page import FIGURE_FOLDER, frame, markdown, summary_rows
from .reproduce.perform import Reproduction, chosen, perform
from .reproduce.report import write_reproduce_report
from .reproduce.row import Document, Row
from .results import prepare_folder, write_text
from .terminal import FAILED, console, show_files, show_progress, show_table


def run_reproduce(asked: Sequence[str], folder: Path) -> int:
    """Work the rows, tell and write what comes of it, and return the exit code."""
    chosen(asked)
    with alone_in(folder, waits=False), ExitStack() as stack:
        opened: list[Fmu] = []

        def fmu() -> Fmu:
            """The paper's ratchet, built when a row first needs it."""
            if not opened:
                opened.append(stack.enter_context(open_fmu(build_fmu.built("ratchet", folder))))
            return opened[0]

        with show_progress("Working the rows; the engine is compiled first ...") as progress:

            def on_row(row: Row, number: int, of: int) -> None:
                progress(f"{row.id}, {row.place}", (number - 1) / of)

            made = perform(asked, Bench(fmu), on_row)
        files = _written(made, folder)
    _show(made)
    show_files(files)
    return FAILED if made.failed else 0


def _written(made: Reproduction, folder: Path) -> list[Path]:
    files = []
    if made.figures:
        prepare_folder(folder / FIGURE_FOLDER)
        write_figures(made.figures, folder / FIGURE_FOLDER)
    files.append(write_text(folder / "papers-reproduced.md", lambda file: file.write(markdown(made))))
    files.append(write_text(folder / "rows.csv", lambda file: frame(made).to_csv(file, index=False)))
    return [*files, write_reproduce_report(made, folder / "report.html")]


def _show(made: Reproduction) -> None:
    """Verdicts in the terminal; of some rows, also their numbers."""
    if made.whole:
        headings = ["verdict", *(document.short for document in Document)]
        rows = [line[:-1] for line in summary_rows(made)]
        show_table("Rows by verdict", headings, rows, numeric=(1, 2, 3))
        console.print(f"{len(made.errata)} errata with proof, {len(made.choices)} choices.")
        shown = made.failed
    else:
        shown = made.everything
    for result in shown:
        row, found = result.row, result.found
        console.print(f"[bold]{row.id}[/] {escape(row.place)}: {escape(row.says)}", soft_wrap=True)
        console.print(f"    printed  {escape(row.printed)}", soft_wrap=True)
        console.print(f"    here     {escape(found.ours)}", soft_wrap=True)
        for line in found.worked:
            console.print(f"             {escape(line)}", soft_wrap=True)
        console.print(
            f"    [bold]{escape(str(found.verdict))}[/]  [dim]{escape(', '.join(row.code))}[/]", soft_wrap=True
        )
