"""The page has a table of the forms and tools that exist. Its numbers are those of the last run, whenever that was."""

from datetime import date

from tests.importers.forms import FORMS
from tests.importers.matrix import Cell
from tests.importers.table import PAGE, head_and_rows, made, put_in, table
from tests.importers.tools import TOOLS

CELLS = [Cell(key, form, 1.2e-14 if form in tool.forms else None) for key, tool in TOOLS.items() for form in FORMS]


def test_the_page_has_the_forms_and_tools_that_exist() -> None:
    head, rows = head_and_rows(PAGE.read_text(encoding="utf-8"))
    assert head == ["tool", *(form.title for form in FORMS.values())]
    assert len(rows) == len(TOOLS)
    assert all(row.startswith(tool.name) for row, tool in zip(rows, TOOLS.values(), strict=True))
    assert "**wrong**" not in made(PAGE.read_text(encoding="utf-8"))


def test_a_table_goes_between_the_markers_and_nothing_else_changes() -> None:
    page = PAGE.read_text(encoding="utf-8")
    lines = table(CELLS, 9, date(2026, 1, 2))
    again = put_in(page, lines)
    assert made(again) == lines.strip()
    assert put_in(again, made(page)) == page
    assert lines.startswith("2 January 2026, ")


def test_what_went_wrong_stands_in_the_table() -> None:
    wrong = [Cell("fmpy", cell.form, 0.5, ("ratchet: so and so",)) if cell.tool == "fmpy" else cell for cell in CELLS]
    row = next(line for line in table(wrong, 9, date(2026, 1, 2)).splitlines() if line.startswith("| FMPy"))
    assert row.count("**wrong**") == len(FORMS)
