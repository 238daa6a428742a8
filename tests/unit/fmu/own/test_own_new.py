"""A new file for a mechanism of one's own: its name, and what is there already."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from harness.app.cli import main


@pytest.mark.parametrize("name", ["my-lever", "2nd", "class", "größe", "a/b", ""])
def test_a_new_mechanism_needs_a_name_that_an_fmu_can_have(name: str, folder: Path) -> None:
    result = CliRunner().invoke(main, ["new", name])
    assert result.exit_code == 2
    assert f"{name!r} cannot name an FMU; use the letters a to z" in result.stderr
    better = result.stderr.split()[-1]
    assert CliRunner().invoke(main, ["new", better]).exit_code == 0
    assert (folder / f"{better}.py").is_file()


def test_a_file_that_is_there_already_is_kept(folder: Path) -> None:
    (folder / "lever.py").write_text("mine")
    for name in ("lever", "lever.py"):
        result = CliRunner().invoke(main, ["new", name])
        assert result.exit_code == 2
        assert "lever.py is there already" in result.stderr
    assert (folder / "lever.py").read_text() == "mine"
