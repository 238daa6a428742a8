"""report.html of the papers reproduced."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path

from ..report.page import cards, page, section, table
from ..results import write_text
from .figures import FIGURES
from .page import summary_rows
from .perform import Reproduction
from .row import Document, Result, Verdict

_HEADINGS = ("id and place", "verdict", "what it says", "this project")
_COLOURS = {
    Verdict.REPRODUCED: "#1b7f4b",
    Verdict.HOLDS: "#1b7f4b",
    Verdict.HOLDS_IN_PART: "#9a6700",
    Verdict.DOES_NOT_HOLD: "#b3261e",
    Verdict.ERRATUM: "#6b3fa0",
    Verdict.FAILED: "#b3261e",
}


def write_reproduce_report(made: Reproduction, path: Path) -> Path:
    """Write the report as one file that works offline.

    Raises:
        UsageError: the disk refuses.
    """
    return write_text(path, lambda file: file.write(reproduce_report(made)))


def reproduce_report(made: Reproduction) -> str:
    """The report as HTML."""
    counted = [
        (str(verdict), str(sum(r.found.verdict is verdict for r in made.rows)))
        for verdict in Verdict
        if verdict != "choice"
    ]
    body = [cards([(what, count) for what, count in counted if count != "0"])]
    if made.whole:
        headings = ["verdict", *(document.short for document in Document), "which means"]
        body.append(section("Verdicts by document", table(headings, summary_rows(made), numeric=(1, 2, 3))))
    if made.errata:
        body.append(section("Errata", *map(_proof, made.errata), note="What is printed cannot be right; with proof."))
    if made.choices:
        body.append(section("Choices", *map(_proof, made.choices), note="What the documents leave open."))
    for document in Document:
        rows = made.of(document)
        if rows:
            body.append(section(document.short, _rows(rows)))
        drawn = [f for f in FIGURES if f.name in made.figures and f.row.startswith(document.value)]
        if drawn:
            pictures = "".join(
                f"<figure>{_fitting(made.figures[f.name])}"
                f"<figcaption>{escape(f'{f.place}: {f.caption}')}</figcaption></figure>"
                for f in drawn
            )
            body.append(section(f"{document.short}: figures", f'<div class="charts">{pictures}</div>'))
    subtitle = "every equation, table, figure, example and claim of three documents"
    return page("The papers reproduced", subtitle if made.whole else "some rows", body)


def _fitting(svg: str) -> str:
    """A drawing that is no wider than its place."""
    return svg.replace("<svg ", '<svg style="max-width:100%;height:auto" ', 1)


def _verdict(result: Result) -> str:
    verdict = result.found.verdict
    return f'<b style="color:{_COLOURS.get(verdict, "#444444")}">{escape(str(verdict))}</b>'


def _worked(lines: Sequence[str]) -> str:
    if not lines:
        return ""
    return "<details><summary>worked</summary>" + "<br>".join(map(escape, lines)) + "</details>"


def _rows(results: Sequence[Result]) -> str:
    """A table with verdicts in colour and worked numbers that unfold."""
    head = "".join(f"<th>{heading}</th>" for heading in _HEADINGS)
    lines = []
    for r in results:
        said = f"{escape(r.row.says)}<br><small>Printed: {escape(r.row.printed)}</small>"
        shown = (
            f"{escape(r.found.ours)}<br><small><code>{escape(r.row.shown_by)}</code></small>{_worked(r.found.worked)}"
        )
        lines.append(
            f'<tr><td id="{r.row.id}">{r.row.id}<br><small>{escape(r.row.place)}</small></td><td>{_verdict(r)}</td>'
            f'<td class="long">{said}</td><td class="long">{shown}</td></tr>'
        )
    return f'<div class="scroll"><table><thead><tr>{head}</tr></thead><tbody>{"".join(lines)}</tbody></table></div>'


def _proof(result: Result) -> str:
    row, found = result.row, result.found
    worked = "".join(f"<li>{escape(line)}</li>" for line in found.worked)
    return (
        f"<h3>{row.id} · {escape(row.place)}</h3><p>{escape(row.says)} Printed: {escape(row.printed)}.<br>"
        f'{escape(found.ours)}</p><ul class="points">{worked}<li><code>{escape(row.shown_by)}</code></li></ul>'
    )
