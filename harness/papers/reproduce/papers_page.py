"""The page docs/papers-reproduced.md, the table rows.csv, and report.html of the papers reproduced."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from pathlib import Path

import pandas as pd

from ...report.page import cards, page, section, table
from ...run.checks import Verdict
from ...run.results import write_text
from .figures.all_figures import FIGURES, Figure
from .perform import Reproduction
from .row import Document, Result

# The page docs/papers-reproduced.md, and the table rows.csv.

#: The folder of the figures beside the page.
FIGURE_FOLDER = "papers-reproduced"

_TITLES = {
    Document.PENNESTRI: "Pennestrì, Valentini, Vita: *Dynamic Analysis of Intermittent-Motion Mechanisms Through the "
    "Combined Use of Gauss Principle and Logical Functions*",
    Document.ERDMAN: "Erdman, Sandor, Oakberg: *A General Method for Kineto-Elastodynamic Analysis and Synthesis of "
    "Mechanisms* (1972)",
    Document.ME451: "ME451, *Kinematics and Dynamics of Machine Systems*: composite joints, gears, cam followers "
    "(2010, after Haug)",
}

_INTRODUCTION = """\
# The papers reproduced

Three documents are at the root of this project. Below is every equation, table, figure, example and claim of theirs:
what it says, what this project finds, and whether the two agree. One command works it all out anew and writes this
page, a report and the figures; a test compares:

```sh
mechanism-fmu reproduce -o papers-reproduced/
mechanism-fmu reproduce P-eq7 E-eq13 S-3.4.1        # some rows only, with their worked numbers
```

What is at hand are the documents' texts, without their drawings, and of Erdman, Sandor and Oakberg only the first
pages, which end with eq (14). Commands that name `build/Ratchet.fmu` need it first:
`mechanism-fmu build ratchet -o build/`.

A verdict follows from a calculation of this run, and becomes FAILED when the numbers do not bear it out. Where an
asterisk stands behind it, it is a judgement by a person who read the document: there is nothing to calculate, or the
calculation says how much and not whether.
"""

_MEANINGS = {
    Verdict.REPRODUCED: "the printed equation or number comes out, calculated in another way than it is stated",
    Verdict.ANSWERED: "a question, a task or a joint that the document names and leaves open: worked out, checked",
    Verdict.REDRAWN: "the drawing is lost; drawn from text and tables, flow charts from what the program does",
    Verdict.HOLDS: "a claim that is true, with numbers",
    Verdict.HOLDS_IN_PART: "true, but not all of it, or not all of it can be compared",
    Verdict.DOES_NOT_HOLD: "a claim that is not true",
    Verdict.MISPRINT: "what is printed cannot be right; see Misprints",
    Verdict.ASSUMPTION: "what the document assumes or leaves unsaid is not so; see Assumptions that fail",
    Verdict.TAKEN_OVER: "data, definitions and assumptions: used as printed",
    Verdict.NOT_DETERMINED: "what it would take to compare is not at hand; the reason is given",
}
#: Behind a verdict that no calculation stands behind.
_JUDGEMENT = "\\*"


#: Of the numbers of verdicts.
_COUNTED = ["verdict", *(document.short for document in Document), "which means"]


def markdown(made: Reproduction) -> str:
    """The page; of some rows only, one with their worked numbers."""
    if not made.whole:
        return "# Some rows of the papers reproduced\n\n" + "\n".join(map(_worked_of_page, made.everything))
    calculated = "all numbers are calculated.\n"
    parts = [
        _INTRODUCTION,
        f"## Summary\n\n{_table(_COUNTED, summary_rows(made), right=(1, 2, 3))}\n{judgements(made)}\n",
        "## Misprints\n",
        f"What is printed, why it cannot be right, and what this project takes; {calculated}",
        *map(_proof_of_page, made.misprints),
        "## Assumptions that fail\n",
        f"Nothing is misprinted here, but what is assumed or left unsaid is not so; {calculated}",
        *map(_proof_of_page, made.assumptions),
        _choices(made),
    ]
    for document, title in _TITLES.items():
        parts += [f"## {title}\n", _rows_of_page(made.of(document)), _figures(document, made.figures)]
    return "\n".join(part for part in parts if part)


def summary_rows(made: Reproduction) -> list[list[str]]:
    """Verdicts, and how many rows of each document have it; the last line counts all."""
    weighed = [made.weighed(document) for document in Document]
    counts = {verdict: [_count(of, verdict) for of in weighed] for verdict in Verdict if verdict is not Verdict.CHOICE}
    lines = [[str(v), *map(str, of), _MEANINGS.get(v, "")] for v, of in counts.items() if any(of)]
    return [*lines, ["all", *(str(len(of)) for of in weighed), ""]]


def _count(results: Iterable[Result], verdict: Verdict) -> int:
    return sum(result.found.verdict is verdict for result in results)


def judgements(made: Reproduction) -> str:
    """How many verdicts are judgements, in words."""
    weighed = made.weighed()
    by_person = sum(not result.found.calculated for result in weighed)
    return f"{by_person} of {len(weighed)} verdicts are judgements by a person, the others follow from calculations."


def _proof_of_page(result: Result) -> str:
    row, said = result.row, result.found.ours
    return "\n".join(
        (
            f"**{row.id}** {row.place}: {row.says} Printed: {row.printed}.",
            f"{said[0].upper()}{said[1:]}.\n",
            *(f"- {line}" for line in (*result.found.worked, f"shown by `{row.shown_by}`\n")),
        )
    )


def _choices(made: Reproduction) -> str:
    headings = ["id", "where it acts", "open is", "printed", "this project", "code"]
    lines = [
        [r.row.id, r.row.place, r.row.says, r.row.printed, "; ".join((r.found.ours, *r.found.worked)), _code(r)]
        for r in made.choices
    ]
    return f"## Choices\n\nWhat the documents leave open.\n\n{_table(headings, lines)}"


def _rows_of_page(results: Sequence[Result]) -> str:
    headings = ["id", "place", "what it says", "printed", "this project", "verdict", "code", "shown by"]
    lines = [
        [*(r.row.id, r.row.place, r.row.says, r.row.printed, r.found.ours), _verdict_of_page(r), _code(r), _shown_by(r)]
        for r in results
    ]
    return _table(headings, lines)


def _shown_by(result: Result) -> str:
    return f"`{result.row.shown_by}`"


def _verdict_of_page(result: Result) -> str:
    return f"**{result.found.verdict}**{'' if result.found.calculated else _JUDGEMENT}"


def _code(result: Result) -> str:
    return ", ".join(f"[{path.rsplit('/', 1)[-1]}](../{path})" for path in result.row.code)


def _drawn(document: Document, drawn: dict[str, str]) -> list[Figure]:
    return [figure for figure in FIGURES if figure.name in drawn and figure.row.startswith(document.value)]


def _figures(document: Document, drawn: dict[str, str]) -> str:
    parts = [
        f"**{f.place}**, {f.caption}:\n\n![{f.place}: {f.caption}]({FIGURE_FOLDER}/{f.name}.svg)\n"
        for f in _drawn(document, drawn)
    ]
    return "\n".join(["### Figures\n", *parts]) if parts else ""


def _worked_of_page(result: Result) -> str:
    row, found = result.row, result.found
    said = f"{row.says} Printed: {row.printed}.\n\n{_verdict_of_page(result)}: {found.ours}\n"
    worked = (f"- {line}" for line in (*found.worked, f"code: {', '.join(row.code)}\n"))
    return "\n".join((f"## {row.id}: {row.place}\n", said, *worked))


def _table(headings: Sequence[str], lines: Iterable[Sequence[str]], right: Sequence[int] = ()) -> str:
    rule = ["---:" if column in right else "---" for column in range(len(headings))]
    rows = [headings, rule, *([cell.replace("|", "\\|") for cell in line] for line in lines)]
    return "\n".join(f"| {' | '.join(row)} |" for row in rows) + "\n"


def frame(made: Reproduction) -> pd.DataFrame:
    """All rows as a table."""
    return pd.DataFrame(
        {
            "id": r.row.id,
            "place": r.row.place,
            "says": r.row.says,
            "printed": r.row.printed,
            "this_project": r.found.ours,
            "verdict": str(r.found.verdict),
            "calculated": r.found.calculated,
            "worked": "; ".join(r.found.worked),
            "code": ", ".join(r.row.code),
            "command": r.row.shown_by,
        }
        for r in made.everything
    )


_HEADINGS = ("id and place", "verdict", "what it says", "this project")
_COLOURS = {
    Verdict.REPRODUCED: "#1b7f4b",
    Verdict.HOLDS: "#1b7f4b",
    Verdict.HOLDS_IN_PART: "#9a6700",
    Verdict.DOES_NOT_HOLD: "#b3261e",
    Verdict.ANSWERED: "#1b7f4b",
    Verdict.MISPRINT: "#6b3fa0",
    Verdict.ASSUMPTION: "#6b3fa0",
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
    counts = {verdict: _count(made.weighed(), verdict) for verdict in Verdict if verdict is not Verdict.CHOICE}
    body = [cards([(str(verdict), str(count)) for verdict, count in counts.items() if count])]
    if made.whole:
        counted = table(_COUNTED, summary_rows(made), numeric=(1, 2, 3))
        body.append(section("Verdicts by document", counted, note=judgements(made)))
    proven = (
        ("Misprints", made.misprints, "What is printed cannot be right."),
        ("Assumptions that fail", made.assumptions, "What is assumed or left unsaid is not so."),
        ("Choices", made.choices, "What the documents leave open."),
    )
    body += [section(title, *map(_proof, results), note=note) for title, results, note in proven if results]
    for document in Document:
        rows, drawn = made.of(document), _drawn(document, made.figures)
        if rows:
            body.append(section(document.short, _rows(rows)))
        if drawn:
            pictures = "".join(_picture(figure, made.figures[figure.name]) for figure in drawn)
            body.append(section(f"{document.short}: figures", f'<div class="charts">{pictures}</div>'))
    subtitle = "every equation, table, figure, example and claim of three documents"
    return page("The papers reproduced", subtitle if made.whole else "some rows", body)


def _picture(figure: Figure, svg: str) -> str:
    """A drawing that is no wider than its place, with its caption."""
    fitting = svg.replace("<svg ", '<svg style="max-width:100%;height:auto" ', 1)
    return f"<figure>{fitting}<figcaption>{escape(f'{figure.place}: {figure.caption}')}</figcaption></figure>"


def _verdict(result: Result) -> str:
    verdict = result.found.verdict
    mark = "" if result.found.calculated else "<br><small>judgement</small>"
    return f'<b style="color:{_COLOURS.get(verdict, "#444444")}">{escape(str(verdict))}</b>{mark}'


def _worked(lines: Sequence[str]) -> str:
    unfolded = "<details><summary>worked</summary>" + "<br>".join(map(escape, lines)) + "</details>"
    return unfolded if lines else ""


def _rows(results: Sequence[Result]) -> str:
    """A table with verdicts in colour and worked numbers that unfold."""
    head = "".join(f"<th>{heading}</th>" for heading in _HEADINGS)
    lines = "".join(
        f'<tr><td id="{r.row.id}">{r.row.id}<br><small>{escape(r.row.place)}</small></td><td>{_verdict(r)}</td>'
        f'<td class="long">{escape(r.row.says)}<br><small>Printed: {escape(r.row.printed)}</small></td>'
        f'<td class="long">{escape(r.found.ours)}<br><small><code>{escape(r.row.shown_by)}</code></small>'
        f"{_worked(r.found.worked)}</td></tr>"
        for r in results
    )
    return f'<div class="scroll"><table><thead><tr>{head}</tr></thead><tbody>{lines}</tbody></table></div>'


def _proof(result: Result) -> str:
    row, found = result.row, result.found
    worked = "".join(f"<li>{escape(line)}</li>" for line in found.worked)
    return (
        f"<h3>{row.id} · {escape(row.place)}</h3><p>{escape(row.says)} Printed: {escape(row.printed)}.<br>"
        f'{escape(found.ours)}</p><ul class="points">{worked}<li><code>{escape(row.shown_by)}</code></li></ul>'
    )
