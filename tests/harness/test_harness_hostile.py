"""FMUs that harm their host: no end that the program did not ask for is a success, and what was recorded is kept."""

import json
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pandas as pd
import pytest
from nursery import Ended, Nursery, nursery

from tests.harness.hostile.build import Harm, hostile
from tests.once import once

Run = Callable[..., Ended]
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="hostile.c is for POSIX")

#: What ends the process during a step, with what is said of it where it has one of its own.
ENDS = {
    Harm.EXIT_0: "ended with exit code 0",
    Harm.QUICK_EXIT_0: "ended with exit code 0",
    Harm.END_0: "ended with exit code 0",
    Harm.ABORT: "was ended by the signal SIGABRT",
    Harm.SEGFAULT: "was ended by the signal SIGSEGV",
}


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return once(tmp_path_factory, "hostile", hostile) / "Hostile.fmu"


@pytest.fixture(scope="module")
def processes() -> Iterator[Nursery]:
    with nursery(COLUMNS="500") as processes:
        yield processes


@pytest.fixture(scope="module")
def run(fmu: Path, processes: Nursery) -> Run:
    """Run it into a folder, with that harm."""

    def run(folder: Path, harm: Harm, *more: str) -> Ended:
        ended = processes.run(["run", str(fmu), "--set", f"harm={int(harm)}", "-o", str(folder), *more])
        assert "Traceback" not in ended.err
        return ended

    return run


def results(folder: Path) -> pd.DataFrame:
    return pd.read_csv(folder / "results.csv")


@pytest.mark.parametrize("harm", ENDS)
def test_an_end_in_a_step_is_a_failure_with_the_results_so_far(harm: Harm, run: Run, tmp_path: Path) -> None:
    code, _, err = run(tmp_path, harm)
    assert code == 1
    assert f"Hostile failed at t = 0.5 s (advance): its process {ENDS[harm]}" in err
    assert results(tmp_path)["y"].tolist() == pytest.approx([0.0, 0.1, 0.2, 0.3, 0.4, 0.5])
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert (summary["ending"], summary["final_time"]) == ("failed", 0.5)


@pytest.mark.parametrize("harm", ENDS)
def test_an_end_in_the_same_process_is_a_failure_too(harm: Harm, run: Run, tmp_path: Path) -> None:
    code, _, err = run(tmp_path, harm, "--in-process")
    assert code == 1
    assert "before the program did: the FMU crashed or ended it." in err


@pytest.mark.parametrize("how", [(), ("--in-process",)], ids=["", "in process"])
@pytest.mark.parametrize("harm", [Harm.ABORT_IN_FREE, Harm.EXIT_IN_FREE])
def test_a_finished_run_is_kept_whatever_comes_when_it_is_freed(
    harm: Harm, how: tuple[str, ...], run: Run, tmp_path: Path
) -> None:
    code, out, _ = run(tmp_path, harm, *how)
    assert code == (1 if how else 0)  # the process that leads has ended as it wanted, or not
    assert len(results(tmp_path)) == 11
    files = {"results.csv", "impacts.csv", "summary.json", "report.html"}
    assert {file.name for file in tmp_path.iterdir()} - {".lock"} == files
    assert "Written to" in out


def test_an_end_before_the_first_step_is_a_failure(run: Run, tmp_path: Path) -> None:
    code, _, err = run(tmp_path, Harm.EXIT_IN_INIT)
    assert code == 1
    assert "Hostile failed before the first step (exit_initialization): its process ended with exit code 0" in err


@pytest.mark.parametrize("how", [(), ("--in-process",)], ids=["", "in process"])
def test_a_changed_working_folder_moves_no_results(
    how: tuple[str, ...], fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with nursery() as processes:
        code, out, _ = processes.run(["run", str(fmu), "--set", f"harm={int(Harm.MOVE)}", "-o", "here", *how])
    assert code == 0, out
    assert len(results(tmp_path / "here")) == 11
    assert ("Written to here:" in out) is not bool(how)


@pytest.mark.parametrize(("harm", "value"), [(Harm.NAN_OUT, "nan"), (Harm.INF_OUT, "-inf")])
@pytest.mark.parametrize("how", [(), ("--in-process",)], ids=["", "in process"])
def test_what_is_no_number_fails_a_verdict(
    harm: Harm, value: str, how: tuple[str, ...], run: Run, tmp_path: Path
) -> None:
    code, out, _ = run(tmp_path, harm, *how)
    assert code == 1
    assert f"✗ Every output is a finite number  y is {value} from t = 0.6 s" in out
    assert len(results(tmp_path)) == 11


@pytest.mark.parametrize("how", [(), ("--in-process",)], ids=["", "in process"])
def test_a_flood_of_messages_is_counted_and_cut(how: tuple[str, ...], run: Run, tmp_path: Path) -> None:
    began = time.monotonic()
    code, _, err = run(tmp_path, Harm.FLOOD, *how)
    assert code == 0
    assert err.count("the oil is hot") == 1000
    assert "99000 more messages of this instance were left out; the first 1000 of a kind are kept." in err
    assert time.monotonic() - began < 20.0
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert len(summary["messages"]) == 1001


def test_a_flood_does_not_hide_why_a_step_is_refused(run: Run, tmp_path: Path) -> None:
    code, _, err = run(tmp_path, Harm.ERROR_AFTER_FLOOD)
    assert code == 1
    assert "the shaft has broken" in err
    assert "19000 more messages of this instance were left out" in err
    assert "(And 982 messages more.)" in err


@pytest.mark.parametrize("how", [(), ("--in-process",)], ids=["", "in process"])
def test_a_long_message_is_cut(how: tuple[str, ...], run: Run, tmp_path: Path) -> None:
    code, _, err = run(tmp_path, Harm.LONG_TEXT, *how)
    assert code == 0
    assert err.count("x" * 5000 + " (... 4995000 more bytes of this message are left out.)") == 5
    assert len(err) < 50_000


@pytest.mark.parametrize("how", [(), ("--in-process",)], ids=["", "in process"])
@pytest.mark.parametrize("harm", [Harm.NOTHING, Harm.EXIT_0, Harm.END_0, Harm.NAN_OUT])
def test_validate_notices_it_too(harm: Harm, how: tuple[str, ...], fmu: Path, processes: Nursery) -> None:
    code, out, err = processes.run(["validate", str(fmu), *how], HARM=str(int(harm)))
    passed = harm is Harm.NOTHING
    assert code == (0 if passed else 1)
    assert ("The FMU keeps what it promises." in out) is passed
    if harm in ENDS and not how:
        assert f"run failed at t = 0.5 s (advance): its process {ENDS[harm]}" in out
        assert "reset failed at t = 0.5 s (advance)" in out  # it goes on with the other verdicts
    elif harm in ENDS:
        assert "The process ended with exit code 0 before the program did" in err
    elif not passed:
        assert "y is nan at t = 0.6 s." in out


def test_one_that_well_behaves_runs_alike_in_both_ways(run: Run, tmp_path: Path) -> None:
    for name, how in (("apart", ()), ("together", ("--in-process",))):
        assert run(tmp_path / name, Harm.NOTHING, *how).code == 0
    pd.testing.assert_frame_equal(results(tmp_path / "apart"), results(tmp_path / "together"), check_exact=True)


def test_wrong_use_is_told_from_the_copy_as_well(run: Run, tmp_path: Path) -> None:
    code, _, err = run(tmp_path, Harm.NOTHING, "--in-process", "--step", "0")
    assert code == 2, err
    assert "step" in err
    assert [file.name for file in tmp_path.iterdir() if file.name != ".lock"] == []
