"""The table of the last run, as it stands in docs/how-to/plug-it-into-your-tool.md."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from datetime import date
from pathlib import Path

from tests.importers.forms import FORMS
from tests.importers.matrix import Cell
from tests.importers.tools import TOOLS

PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "plug-it-into-your-tool.md"
BEGIN = "<!-- made by python -m tests.importers, not by hand -->"
END = "<!-- end of what is made -->"


def table(cells: Sequence[Cell], models: int, today: date) -> str:
    """Lines in Markdown."""
    found = {(cell.tool, cell.form): cell for cell in cells}
    head = ["tool", *(form.title for form in FORMS.values())]
    lines = [f"| {' | '.join(head)} |", f"|{' --- |' * len(head)}"]
    for key, tool in TOOLS.items():
        missing = tool.missing()
        name = tool.name if missing else f"{tool.name} {tool.version()}"
        row = [_text(found[key, form], missing) for form in FORMS]
        lines.append(f"| {' | '.join([name, *row])} |")
    notes = [f"{tool.name}: {tool.otherwise}" for tool in TOOLS.values() if tool.otherwise]
    when = f"{today.day} {today:%B %Y}, {platform.system()} {platform.machine()}"
    return "\n".join([f"{when}, {models} models.", "", *lines, "", f"What \u2013 means: {'; '.join(notes)}."])


def head_and_rows(text: str) -> tuple[list[str], list[str]]:
    """Titles of the columns and names of the rows (with versions) of the table in the page's text."""
    rows = [line.strip("| ").split(" | ") for line in made(text).splitlines() if line.startswith("|")]
    return rows[0], [row[0] for row in rows[2:]]


def made(text: str) -> str:
    """What stands between the markers."""
    return text.split(BEGIN)[1].split(END)[0].strip()


def put_in(text: str, lines: str) -> str:
    """The page with another table."""
    before, rest = text.split(BEGIN)
    return f"{before}{BEGIN}\n{lines}\n{END}{rest.split(END)[1]}"


def _text(cell: Cell, missing: str) -> str:
    if cell.trouble:
        return "**wrong**"
    if cell.deviation is None:
        return "not installed" if missing and cell.form in TOOLS[cell.tool].forms else "\u2013"
    return f"{cell.deviation:.0e}" if cell.deviation else "0"
