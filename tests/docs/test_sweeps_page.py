"""docs/how-to/sweeps.md: what its example prints, and what its results hold, are what it says."""

import re
from pathlib import Path

import pandas as pd
import pytest
from typer.testing import CliRunner

from harness.app.cli import main

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "how-to" / "sweeps.md").read_text(encoding="utf-8")


def _after(heading: str) -> list[str]:
    """The blocks of code behind a heading, up to the next one."""
    found = re.search(rf"^## {heading}\n(.*?)(?=^## )", PAGE, re.MULTILINE | re.DOTALL)
    assert found is not None
    blocks: list[str] = re.findall(r"```\w*\n(.*?)```", found[1], re.DOTALL)
    return blocks


def test_the_example_is_the_file_without_its_first_lines() -> None:
    text = (ROOT / "docs" / "examples" / "teeth.toml").read_text(encoding="utf-8")
    assert text.endswith(_after("The file")[0])


@pytest.mark.slow
def test_the_example_prints_what_the_page_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """By the fast path, which gives the numbers of the FMU to the last bit."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "teeth.toml").write_text(_after("The file")[0], encoding="utf-8")
    result = CliRunner(env={"COLUMNS": "200"}).invoke(main, ["sweep", "teeth.toml", "--fast"])
    assert result.exit_code == 0, result.output
    shown = _after("The file")[1].splitlines()
    table = [line for line in shown if line.startswith("│")]
    assert len(table) == 5
    printed = [line.strip() for line in result.output.splitlines()]
    assert [line for line in table if line not in printed] == []
    assert [line for line in shown if not line.startswith("Building") and line not in printed] == []
    program, told = _after("The results")[:2]
    exec(program, {"pd": pd, "__name__": "__main__"})
    assert capsys.readouterr().out == told
