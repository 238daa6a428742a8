"""FMUs that fail: each in a process of its own, because what is tested is that it survives."""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from nursery import Ended, nursery

Run = Callable[..., Ended]

_RUN = "from harness.app.cli import main; main()"


@pytest.fixture(scope="module")
def troublesome_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    source = Path(__file__).with_name("troublesome.py")
    folder = tmp_path_factory.mktemp("troublesome")
    command = [sys.executable, "-m", "pythonfmu", "build", "-f", str(source), "-d", str(folder)]
    subprocess.run(command, check=True, capture_output=True)
    return folder / "Troublesome.fmu"


@pytest.fixture(scope="module")
def run(troublesome_fmu: Path) -> Iterator[Run]:
    """Run it into a folder, with that trouble: code, and what was said."""
    with nursery(COLUMNS="500") as processes:

        def run(folder: Path, trouble: int, **environment: str) -> Ended:
            times = ["--stop-time", "1", "--step", "0.1"]
            arguments = ["run", str(troublesome_fmu), *times, "--set", f"trouble={trouble}", "-o", str(folder)]
            ended = processes.run(arguments, **environment)
            assert "Traceback" not in ended.err
            return ended

        yield run


def ending(folder: Path) -> tuple[str, float]:
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    return summary["ending"], summary["final_time"]


def test_a_well_behaved_run(run: Run, tmp_path: Path) -> None:
    code, out, err = run(tmp_path, 0)
    assert (code, err) == (0, "")
    assert "The FMU reports no impacts." in out
    assert ending(tmp_path) == ("completed", 1.0)


def test_a_discarded_step_is_a_failure(run: Run, tmp_path: Path) -> None:
    code, _, err = run(tmp_path, 1)
    assert code == 1
    assert "Troublesome failed at t = 0.5 s (fmi2DoStep, status discard)" in err
    assert "recorded up to 0.5 s of 1 s" in err
    assert ending(tmp_path) == ("failed", 0.5)


def test_an_exception_in_a_step_shows_the_fmu_s_own_message(run: Run, tmp_path: Path) -> None:
    code, _, err = run(tmp_path, 2)
    assert code == 1
    assert "(fmi2DoStep, status fatal): the pawl has left the wheel." in err
    assert "Fatal py exception" not in err
    assert ending(tmp_path) == ("failed", 0.5)


def test_an_exception_without_a_message_still_ends_well(run: Run, tmp_path: Path) -> None:
    code, _, err = run(tmp_path, 3)
    assert code == 1
    assert "failed at t = 0.5 s (fmi2DoStep, status fatal)" in err
    assert ending(tmp_path) == ("failed", 0.5)


def test_a_message_is_text_whatever_it_contains(run: Run, tmp_path: Path) -> None:
    code, _, err = run(tmp_path, 4)
    assert code == 0
    assert err.count("Warning (Troublesome, t = 0.5 s): loaded to 100%, %s and %n are only text") == 1


def test_an_error_that_the_fmu_only_talks_about_is_shown(run: Run, tmp_path: Path) -> None:
    code, _, err = run(tmp_path, 6)
    assert code == 0
    assert "Troublesome said so, but went on at t = 0.4 s: the oil is hot." in err


def test_a_failure_at_the_start_writes_nothing(run: Run, tmp_path: Path) -> None:
    code, out, err = run(tmp_path, 5)
    assert code == 1
    assert "failed before the first step (fmi2ExitInitializationMode, status fatal): the crank is too short" in err
    assert out.startswith("Note: Troublesome")  # it has no default step
    assert "Written" not in out
    assert [path.name for path in tmp_path.iterdir()] == [".lock"]


def test_an_fmu_that_cannot_be_instantiated(run: Run, tmp_path: Path) -> None:
    code, _, err = run(tmp_path, 0, STILLBORN="1")
    assert code == 1
    assert "Troublesome failed before the first step (fmi2Instantiate)" in err


def test_a_temporary_folder_that_crashes_fmus_is_avoided(run: Run, tmp_path: Path) -> None:
    hostile = tmp_path / "50% + ä#"
    hostile.mkdir()
    code, _, _ = run(tmp_path, 0, TMPDIR=str(hostile))
    assert code == 0
    assert list(hostile.iterdir()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C cannot be sent to one process there")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_and_sigterm_keep_what_was_recorded(
    troublesome_fmu: Path, tmp_path: Path, number: signal.Signals
) -> None:
    folder, temporary = tmp_path / "results", tmp_path / "temporary"
    temporary.mkdir()
    long = ["--stop-time", "1e3", "--step", "1e-3", "--set", "trouble=4", "-o", str(folder)]
    with subprocess.Popen(
        [sys.executable, "-c", _RUN, "run", str(troublesome_fmu), *long],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"TMPDIR": str(temporary)},
    ) as process:
        assert process.stderr is not None
        try:
            assert "Warning (Troublesome, t = 0.45" in process.stderr.readline()  # so it runs
            process.send_signal(number)
            out, _ = process.communicate(timeout=120)
        finally:
            process.kill()
    assert process.returncode == 130
    assert "the files hold what was recorded up to" in out
    how, reached = ending(folder)
    assert how == "interrupted"
    assert 0.0 < reached < 1e3
    assert len((folder / "results.csv").read_text().splitlines()) == round(reached / 1e-3) + 2
    assert {path.name for path in folder.iterdir()} >= {"results.csv", "impacts.csv", "summary.json", "report.html"}
    assert list(temporary.iterdir()) == []
