"""Damaged FMUs end every command that opens them with one line and exit code 2, and nothing is written."""

from pathlib import Path

import pytest
from damaged import DAMAGES, DESCRIPTION, sound
from typer.testing import CliRunner, Result

from harness.app.cli import main
from harness.errors import UsageError
from harness.fmu import open_fmu
from harness.fmu.description_file import read_description


def invoked(*arguments: str | Path) -> Result:
    result = CliRunner().invoke(main, [str(argument) for argument in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def test_the_file_that_is_damaged_was_sound(tmp_path: Path) -> None:
    with open_fmu(sound(tmp_path / "Sound.fmu")) as fmu:
        assert fmu.description.step == 0.1
        assert fmu.description.variable("p").maximum == 9.0


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_fmu_is_refused_in_one_line(damage: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TMPDIR", str(tmp_path / "temporary"))
    folder = tmp_path / "there"
    folder.mkdir()
    path = DAMAGES[damage].make(folder / "Damaged.fmu")
    result = invoked("run", path, "-o", tmp_path / "result")
    assert result.exit_code == 2
    message = result.stderr.strip()
    assert DAMAGES[damage].says in message
    assert str(path) in message
    assert "copy or build it anew" in message
    assert len(message.splitlines()) == 1
    assert len(message) < 800
    assert [entry.name for entry in tmp_path.iterdir()] == ["there"]


@pytest.mark.parametrize("damage", ["traversal", "checksum", "step size", "reference beyond 32 bits"])
@pytest.mark.parametrize("command", ["validate", "modes", "machine run", "machine check", "sweep", "study ratchet"])
def test_so_it_is_by_every_command(command: str, damage: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    DAMAGES[damage].make(tmp_path / "Damaged.fmu")
    file = tmp_path / "file.toml"
    if command == "sweep":
        file.write_text(
            '[fmu]\nfile = "Damaged.fmu"\n[run]\nstop_time = "1 s"\n[sweep]\nmethod = "grid"\n'
            '[vary.p]\nvalues = [1, 2]\n[record]\nlast = ["y"]\n'
        )
    else:
        file.write_text('[run]\nstop_time = "1 s"\nstep = "1 ms"\n[component.a]\nfile = "Damaged.fmu"\n')
    fmu = ["Damaged.fmu"] if command in ("validate", "modes") else ["--fmu", "Damaged.fmu"]
    result = invoked(*command.split(), *([file] if command.split()[0] in ("machine", "sweep") else fmu))
    assert result.exit_code == 2
    assert DAMAGES[damage].says in result.stderr
    assert "Damaged.fmu" in result.stderr
    assert len(result.stderr.strip().splitlines()) == 1


@pytest.mark.parametrize(
    "command",
    [
        "run",
        "validate",
        "modes",
        "machine run",
        "machine check",
        "machine import",
        "sweep",
        "optimise",
        "cycle",
        "gradient",
        "study",
        "build",
    ],
)
@pytest.mark.parametrize("name", ["x" * 300, "x/" * 3000])
def test_a_name_that_no_file_can_have_is_no_file(
    command: str, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The system objects to such a name with an error of its own, not by saying that there is none."""
    monkeypatch.chdir(tmp_path)
    if command in ("sweep", "optimise"):
        (tmp_path / "file.toml").write_text(f'[fmu]\nfile = "{name}.fmu"\n')
        result = invoked(command, "file.toml")
    else:
        more = {"study": ["ratchet", "--fmu"], "gradient": ["--of", "end.x"], "cycle": ["--section", "x"]}.get(
            command, []
        )
        result = invoked(*command.split(), *more, f"{name}.py" if command == "build" else name)
    assert result.exit_code == 2
    assert "xx" in result.stderr or "x/x" in result.stderr
    assert "Traceback" not in result.stderr


def test_arrays_beyond_all_memory_are_refused(tmp_path: Path) -> None:
    text = (
        '<fmiModelDescription fmiVersion="3.0" modelName="Big" instantiationToken="1">'
        '<CoSimulation modelIdentifier="Big"/><ModelVariables>'
        '<Float64 name="y" valueReference="1" causality="output"><Dimension start="100000000000"/></Float64>'
        "</ModelVariables><ModelStructure/></fmiModelDescription>"
    )
    with pytest.raises(UsageError, match="more than 1,000,000 elements, at y"):
        read_description(sound(tmp_path / "Big.fmu", text))
    with pytest.raises(UsageError, match="the array y has a negative size"):
        read_description(sound(tmp_path / "Big.fmu", text.replace('start="1', 'start="-1')))


def test_infinite_limits_are_none(tmp_path: Path) -> None:
    text = DESCRIPTION.replace('min="0" max="9"', 'min="-INF" max="INF"')
    variable = read_description(sound(tmp_path / "Sound.fmu", text)).variable("p")
    assert (variable.minimum, variable.maximum) == (None, None)
