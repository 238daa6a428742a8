"""Full memory, and full disks where no file of results is written: a line, exit code 1, no traceback."""

import errno
import os
import subprocess
import sys
from pathlib import Path

import fmpy
import pytest
import typer
from damaged import sound
from typer.testing import CliRunner

from harness.app.cli import main
from harness.app.cli_group import Group
from harness.errors import UsageError
from harness.fmu import open_fmu

FULL = {
    "memory": (MemoryError(), "The memory is full."),
    "memory for an array": (MemoryError("Unable to allocate 8 GiB"), "The memory is full."),
    "memory for a process": (OSError(errno.ENOMEM, "Cannot allocate memory"), "The memory is full: "),
    "memory for a library": (ImportError("libx.so: failed to map segment from shared object"), "The memory is full: "),
    "disk": (OSError(errno.ENOSPC, "No space left on device"), "There is no space for what is printed or written: "),
    "share of a disk": (OSError(errno.EDQUOT, "Disk quota exceeded"), "There is no space for what is printed"),
}


def raising(error: Exception) -> typer.Typer:
    """A program whose command fails."""
    program = typer.Typer(cls=Group)

    @program.command()
    def fail() -> None:
        raise error

    @program.command()
    def other() -> None:
        pass

    return program


@pytest.mark.parametrize("what", FULL)
def test_what_is_full_is_told_in_a_line(what: str) -> None:
    error, said = FULL[what]
    result = CliRunner().invoke(raising(error), ["fail"])
    assert result.exit_code == 1
    assert isinstance(result.exception, SystemExit)
    assert result.stderr.startswith(f"Error: {said}")
    assert result.stderr.endswith("What was recorded before is kept.\n")
    assert result.stderr.count("\n") == 1


@pytest.mark.parametrize(
    "error", [OSError(errno.ENOENT, "No such file"), ImportError("No module named 'x'"), ValueError("memory")]
)
def test_other_errors_are_mistakes_of_the_program_and_pass(error: Exception) -> None:
    result = CliRunner().invoke(raising(error), ["fail"])
    assert result.exception is error


@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full here")
def test_a_console_that_takes_nothing_more(tmp_path: Path, unbuffered: str) -> None:
    fmu = sound(tmp_path / "Sound.fmu")
    command = [sys.executable, "-c", "from harness.app.cli import main; main()", "validate", str(fmu)]
    with open("/dev/full", "w") as full:
        ended = subprocess.run(
            command,
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
            env=os.environ | {"PYTHONUNBUFFERED": unbuffered},
        )
    assert ended.returncode == 1
    assert "Error: There is no space for what is printed or written" in ended.stderr
    assert "Traceback" not in ended.stderr


def test_no_room_to_unpack_an_fmu_is_no_damage_of_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    fmu = sound(tmp_path / "Sound.fmu")
    monkeypatch.setattr(fmpy, "extract", full)
    with (
        pytest.raises(UsageError, match=r"space left on device\. Make space there, or set .* TMPDIR"),
        open_fmu(fmu),
    ):
        pass


def test_a_temporary_folder_that_cannot_be_made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(**_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    fmu = sound(tmp_path / "Sound.fmu")
    monkeypatch.setattr("tempfile.mkdtemp", full)
    result = CliRunner().invoke(main, ["validate", str(fmu)])
    assert result.exit_code == 2
    assert "No temporary folder can be made" in result.stderr
