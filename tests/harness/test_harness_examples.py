"""`mechanism-fmu examples` lists what lies in docs/examples, copies it, and overwrites nothing."""

import shlex
from pathlib import Path

import pytest
from typer.testing import CliRunner

from harness.app.cli import main
from harness.app.commands import examples

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
NAMES = [
    path.relative_to(EXAMPLES).as_posix()
    for folder in (EXAMPLES, EXAMPLES / "gallery")
    for path in sorted(folder.iterdir())
    if path.is_file()
]


def invoke(*arguments: str | Path) -> tuple[int, str]:
    result = CliRunner().invoke(main, ["examples", *map(str, arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit)
    return result.exit_code, result.output


def test_each_example_is_listed_with_what_it_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    code, output = invoke()
    assert code == 0
    lines = output.splitlines()[: len(NAMES)]
    assert [line.split()[0] for line in lines] == NAMES
    assert all(len(line.split(maxsplit=1)[1]) > 5 for line in lines)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(("arguments", "folder"), [((), "examples"), (("mine/now",), "mine/now")])
def test_they_are_copied_as_they_are(
    arguments: tuple[str, ...], folder: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert invoke("--copy", *arguments)[0] == 0
    there = (path for path in Path(folder).rglob("*") if path.is_file())
    copied = {path.relative_to(folder).as_posix(): path.read_bytes() for path in there}
    assert copied == {name: (EXAMPLES / name).read_bytes() for name in NAMES}


def test_the_commands_for_the_copies_are_those_that_there_are(tmp_path: Path) -> None:
    """Every file but the signals has one, which names the copy; it exists, and a program has its arguments."""
    folder = tmp_path / "examples"
    output = invoke("--copy", folder)[1]
    commands = [shlex.split(line) for line in output.splitlines() if line.startswith(("mechanism-fmu", "python"))]
    files = [next(word for word in words if word.startswith(str(folder))) for words in commands]
    names = [Path(file).relative_to(folder).as_posix() for file in files]
    assert names == [name for name in NAMES if not name.endswith(".csv")]
    for words in commands:
        if words[0] == "mechanism-fmu":
            assert CliRunner().invoke(main, [*words[1:-1], "--help"]).exit_code == 0
    assert ["python", str(folder / "ssp_in_fmpy.py"), "machine.ssp", "4", "2e-3"] in commands


def test_where_they_are_not_installed_that_is_said(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(examples, "FOLDER", tmp_path / "none")
    code, output = invoke()
    assert code == 2
    assert "docs/examples of the project's sources" in " ".join(output.split())


def test_nothing_is_overwritten(tmp_path: Path) -> None:
    (tmp_path / "teeth.toml").write_text("mine")
    code, output = invoke("--copy", tmp_path)
    assert code == 2
    assert "teeth.toml already; nothing was copied" in output
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {"teeth.toml": "mine"}


def test_a_folder_that_cannot_be_made_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    code, output = invoke("--copy", tmp_path / "file" / "below")
    assert code == 2
    assert "give another folder" in output


def test_a_folder_alone_copies_nothing(tmp_path: Path) -> None:
    code, output = invoke(tmp_path / "examples")
    assert code == 2
    assert "--copy" in output
    assert not list(tmp_path.iterdir())
