"""The walks of docs/project/how-it-flows.md pass functions that are where the page says."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "project" / "how-it-flows.md"
ROW = re.compile(r"\| (`[^|]*`) \| (`[^|]*`) \| [^|]+ \|")


def names(cell: str) -> list[str]:
    return re.findall(r"`([^`]+)`", cell)


STEPS = [(names(row[1]), names(row[2])) for row in map(ROW.fullmatch, PAGE.read_text("utf-8").splitlines()) if row]


def definition(function: str, file: str) -> str:
    """A pattern for the definition of a function, in Python or in C."""
    return rf"^ *(def|class) {function}\(" if file.endswith(".py") else rf"^\w[\w *]*\b{function}\("


def test_the_page_has_five_walks() -> None:
    assert PAGE.read_text("utf-8").count("\n## ") == 6
    assert len(STEPS) > 40


@pytest.mark.parametrize(("functions", "files"), STEPS)
def test_functions_are_where_the_page_says(functions: list[str], files: list[str]) -> None:
    texts = {}
    for file in files:
        path = ROOT / file if file.startswith(("harness/", "models/")) else ROOT / "mechanism_fmu" / file
        texts[file] = path.read_text("utf-8")
    for function in functions:
        found = [file for file, text in texts.items() if re.search(definition(function, file), text, re.M)]
        assert found, f"{function} is not defined in {', '.join(files)}"
