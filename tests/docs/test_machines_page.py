"""The page about machines: its example is the file that it names, and runs as it says."""

import re
from pathlib import Path

import pandas as pd
import pytest
from typer.testing import CliRunner

from harness.app.cli import main
from harness.machine.file.machine_plan import Scheme
from harness.machine.file.read_file import TABLES

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "how-to" / "machines.md").read_text(encoding="utf-8")
KEYS = (DOCS / "reference" / "toml.md").read_text(encoding="utf-8")
EXAMPLE = DOCS / "examples" / "geared_cam.toml"


def test_the_example_is_the_file():
    assert f"```toml\n{EXAMPLE.read_text(encoding='utf-8')}```" in PAGE


def test_the_output_is_that_of_the_example(tmp_path, native_gear_train_fmu, native_cam_drive_fmu, monkeypatch):
    """But for times and the lines about building."""
    text = EXAMPLE.read_text(encoding="utf-8")
    for model, fmu in (("gear_train", native_gear_train_fmu), ("cam_drive", native_cam_drive_fmu)):
        text = text.replace(f'model = "{model}"', f'file = "{fmu}"')
    (tmp_path / "geared_cam.toml").write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(main, ["machine", "run", "geared_cam.toml"])
    assert result.exit_code == 0
    written = PAGE.partition("```text\n")[2].partition("```")[0]
    kept = [line for line in written.splitlines() if not line.startswith("Building")]
    assert timeless("\n".join(kept)) == timeless(result.output)
    assert pd.read_parquet("geared_cam/results.parquet")["time"].iloc[-1] == 6.0


def timeless(text: str) -> list[str]:
    """Words, without those that depend on how fast the computer is."""
    lines = [re.sub(r"in \S+ s: \S+ x", "in some time", line) for line in text.splitlines()]
    lines = [" ".join(line.split()[:4]) if re.match(r"│ (gears|cam|\(the rest)", line) else line for line in lines]
    words = " ".join(lines).split()
    return [word for word in words if not set(word) <= set("┏┳┓┃┡╇┩│└┴┘─━")]


@pytest.mark.parametrize("name", [name for name in TABLES if name != "title"])
def test_all_tables_are_on_the_page(name):
    assert f"`[{name}" in KEYS or f"`[[{name}]]" in KEYS


@pytest.mark.parametrize("scheme", Scheme)
def test_all_algorithms_are_on_the_page(scheme):
    assert f"`{scheme}`" in KEYS
