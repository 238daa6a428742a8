"""What a command leaves behind when it is ended or killed at a bad moment, and two commands in one folder."""

import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from damaged import sound
from typer.testing import CliRunner

from harness.app.cli import main
from harness.app.execution import alone_in
from harness.errors import UsageError
from harness.fmu import Fmu
from harness.papers.study import study
from harness.run.results import sweep_up, write_text
from mechanism_fmu.fmu.disk.folders import remove_abandoned

#: Opens an FMU and waits in it, as a command does while it builds, validates or draws.
_OPEN = """
import sys, time
from pathlib import Path
import typer
from harness.app.cli_group import Group
from harness.fmu import open_fmu
main = typer.Typer(cls=Group)
@main.command()
def wait():
    with open_fmu(Path(sys.argv[1])) as fmu:
        print(fmu.folder, flush=True)
        time.sleep(60)
@main.command()
def other(): pass
main(["wait"])
"""
#: Starts a process that makes a temporary folder, says all that lies about, and waits.
_PROCESS = """
import tempfile, time
from pathlib import Path
from harness.fmu.processes import starting_from
work = "import tempfile as t; from harness.fmu.processes import serve_only as f; f(None); print(t.mkdtemp(), flush=1)"
context = starting_from("harness.fmu.processes")
process = context.Process(target=exec, args=(work,), daemon=True)
process.start()
process.join()
print(*(path.name for path in Path(tempfile.gettempdir()).iterdir()), flush=True)
time.sleep(60)
"""
#: Is killed in the middle of writing a report.
_WRITE = """
import os, signal, sys
from pathlib import Path
from harness.run.results import write_text
def write(file):
    file.write("<html>")
    file.flush()
    os.kill(os.getpid(), signal.SIGKILL)
write_text(Path(sys.argv[1], "report.html"), write)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGTERM there")
def test_sigterm_outside_a_run_leaves_no_temporary_folder(tmp_path: Path) -> None:
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    fmu = sound(tmp_path / "Sound.fmu")
    with subprocess.Popen(
        [sys.executable, "-c", _OPEN, str(fmu)],
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | {"TMPDIR": str(temporary)},
    ) as process:
        assert process.stdout is not None
        folder = Path(process.stdout.readline().strip())
        assert folder.parent == temporary
        assert folder.is_dir()
        process.send_signal(signal.SIGTERM)
        process.wait(timeout=30)
    assert process.returncode == 130
    assert list(temporary.iterdir()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL there")
def test_what_a_killed_command_left_unfinished_goes_with_the_next_one(tmp_path: Path) -> None:
    (tmp_path / "report.html").write_text("an earlier one")
    ended = subprocess.run([sys.executable, "-c", _WRITE, str(tmp_path)], check=False)
    assert ended.returncode == -signal.SIGKILL
    assert [path.name[:13] for path in tmp_path.glob(".report*")] == [".report.html."]
    assert (tmp_path / "report.html").read_text() == "an earlier one"
    with alone_in(tmp_path):
        assert sorted(path.name for path in tmp_path.iterdir()) == [".lock", "report.html"]


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="processes start from nothing elsewhere")
@pytest.mark.parametrize("copies", [True, False], ids=["copies", "from nothing"])
def test_what_processes_beside_a_killed_command_left_goes_too(tmp_path: Path, copies: bool) -> None:
    """The socket of the one that they are copies of, and what an FMU in them has made."""
    if not copies:
        _left_by_processes(tmp_path)
        return
    with tempfile.TemporaryDirectory() as place:  # of a socket the path must be short
        _left_by_processes(Path(place))


def _left_by_processes(temporary: Path) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", _PROCESS], stdout=subprocess.PIPE, text=True, env=os.environ | {"TMPDIR": str(temporary)}
    ) as process:
        assert process.stdout is not None
        made, about = Path(process.stdout.readline().strip()), process.stdout.readline().split()
        process.kill()
    assert [name.rpartition("-")[0] for name in about] == [f"mechanism-fmu-{process.pid}"]
    assert made.parent == temporary / about[0]
    assert made.is_dir()
    remove_abandoned(temporary)
    assert list(temporary.iterdir()) == []


def test_nobody_else_s_file_is_swept_up(tmp_path: Path) -> None:
    names = ["report.html", ".report.html", "a.unfinished", ".hidden"]
    for name in names:
        (tmp_path / name).touch()
    (tmp_path / ".results.csv.x.unfinished").touch()
    sweep_up(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(names)


def test_a_refused_file_leaves_nothing(tmp_path: Path) -> None:
    def full(_file: object) -> None:
        raise OSError("no space left")

    with pytest.raises(UsageError, match="no space left"):
        write_text(tmp_path / "report.html", full)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "arguments",
    [
        lambda folder: ["run", str(sound(folder / "Sound.fmu")), "-o", str(folder / "out")],
        lambda folder: ["demo", "-o", str(folder / "out")],
        lambda folder: ["demo", "--full", "-o", str(folder / "out")],
        lambda folder: ["study", "ratchet", "-o", str(folder / "out")],
    ],
    ids=["run", "demo", "demo --full", "study ratchet"],
)
def test_the_second_command_in_a_folder_is_refused(tmp_path: Path, arguments: Callable[[Path], list[str]]) -> None:
    before = time.monotonic()
    with alone_in(tmp_path / "out"):
        result = CliRunner().invoke(main, arguments(tmp_path))
    assert result.exit_code == 2
    message = " ".join(result.stderr.split())
    assert f"Another command is at work in '{tmp_path / 'out'}', and two would mix their files." in message
    assert "Choose another folder with -o" in message
    assert [path.name for path in (tmp_path / "out").iterdir()] == [".lock"]
    assert time.monotonic() - before < 10.0


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGTERM there")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_study_ends_after_the_wheel_at_hand(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: signal.Signals
) -> None:
    """It is interrupted between its runs, so the FMU's folder goes, and nothing half done is written."""
    wheels: list[int] = []

    def three_wheels(fmu: Fmu, on_wheel: Callable[[int, int], None]) -> None:
        assert fmu.folder.is_dir()
        for wheel in (1, 2, 3):
            wheels.append(wheel)
            if wheel == 2:
                os.kill(os.getpid(), number)
            on_wheel(wheel, 3)

    monkeypatch.setattr(study, "ratchet_study", three_wheels)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    fmu = sound(tmp_path / "Sound.fmu")
    result = CliRunner().invoke(main, ["study", "ratchet", "--fmu", str(fmu), "-o", str(tmp_path / "out")])
    assert (result.exit_code, wheels) == (130, [1, 2])
    assert "Interrupted: nothing was written" in result.stdout
    assert sorted(path.name for path in tmp_path.iterdir()) == ["Sound.fmu", "out"]
    assert [path.name for path in (tmp_path / "out").iterdir()] == [".lock"]
