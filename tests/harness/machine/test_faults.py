"""What goes wrong ends clearly, with everything recorded so far on the disk, and nothing half written."""

import os
import signal
import subprocess
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import pandas as pd
import pytest

from harness.errors import FmuError, Status, UsageError
from harness.fmu.interface import Observable
from harness.fmu.remote import remote
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.observers import record
from harness.machine.observers.component_impacts import Impacts
from harness.machine.observers.record import Recorder
from harness.machine.running import cautions, run_machine
from harness.machine.stepping import EventAware, GaussSeidel, Jacobi
from harness.run.master import Ending, Outcome, TimeGrid
from tests.harness.machine.fakes import Trouble, Wheel, WheelOpener

resource = pytest.importorskip("resource", reason="a full disk is imitated by what POSIX offers")

CONNECTIONS = [Connection("one.drag", "two.torque"), Connection("two.drag", "one.torque")]
ALGORITHMS: dict[str, Any] = {
    "jacobi": lambda _: Jacobi(),
    "gauss_seidel": lambda _: GaussSeidel(),
    "event": EventAware,
}


def ran(parts: dict[str, Any], folder: Path, algorithm: str = "event", *more: Any) -> tuple[Outcome, pd.DataFrame]:
    """A run of 1 s in steps of 0.1 s with all observers, and what is on the disk then."""
    machine = Machine(parts, CONNECTIONS)
    impacts = Impacts(machine)
    recorder = Recorder(machine, folder / "results.parquet", ["one.angle", "two.angle"], impacts=impacts)
    outcome = run_machine(
        machine, ALGORITHMS[algorithm](machine), TimeGrid.of(1.0, 0.1), {}, [impacts, recorder, *more]
    )
    impacts.table(impacts.by_component())
    return outcome, pd.read_parquet(recorder.finish())


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_a_component_s_process_is_killed_mid_run(algorithm: str, tmp_path: Path) -> None:
    with remote("one", WheelOpener("one", (0.15,))) as one:

        class Killer:
            def started(self, unit: Observable, time: float) -> None:
                pass

            def stepped(self, unit: Observable, time: float) -> None:
                if time == 0.5:
                    assert one.process.pid is not None
                    os.kill(one.process.pid, signal.SIGKILL)

        outcome, table = ran({"one": one, "two": Wheel("two")}, tmp_path, algorithm, Killer())
    assert outcome.ending is Ending.FAILED
    assert outcome.final_time == 0.5
    assert isinstance(outcome.error, FmuError)
    assert (outcome.error.instance, outcome.error.status) == ("one", Status.FATAL)
    assert str(outcome.error).startswith(
        "one failed at t = 0.5 s (advance): its process was ended by the signal SIGKILL"
    )
    assert table["time"].iloc[-1] == 0.5
    assert table["two.angle"].iloc[-1] > 0.3


@pytest.mark.parametrize("algorithm", ALGORITHMS)
@pytest.mark.parametrize("kind", ["discard", "error", "fatal", "nan"])
def test_a_component_that_refuses_or_gives_no_number_ends_the_run(kind: str, algorithm: str, tmp_path: Path) -> None:
    outcome, table = ran({"one": Wheel("one", trouble=Trouble(0.5, kind)), "two": Wheel("two")}, tmp_path, algorithm)
    assert outcome.ending is Ending.FAILED
    assert outcome.final_time == 0.5
    assert "one failed" in str(outcome.error)
    assert list(table["time"]) == pytest.approx([k / 10 for k in range(6)])


def test_a_component_whose_states_cannot_even_be_freed_any_more_is_told_for_its_first_failure(tmp_path: Path) -> None:
    class Dead(Wheel):
        def free_state(self, state: Any) -> None:
            raise FmuError("one failed again")

    outcome, _ = ran({"one": Dead("one", trouble=Trouble(0.5, "fatal")), "two": Wheel("two")}, tmp_path)
    assert "status fatal): it stalls" in str(outcome.error)


def test_one_that_refuses_to_be_put_back_ends_the_run(tmp_path: Path) -> None:
    """It says that it can, but it cannot."""

    class Liar(Wheel):
        def restore(self, state: Any) -> None:
            raise FmuError(f"{self.name} failed (fmi2SetFMUstate, status error): no way back", instance=self.name)

    outcome, table = ran({"one": Liar("one"), "two": Wheel("two", (0.55,))}, tmp_path)
    assert outcome.ending is Ending.FAILED
    assert "one failed (fmi2SetFMUstate, status error)" in str(outcome.error)
    assert table["time"].iloc[-1] == pytest.approx(0.5)


def test_one_that_cannot_be_put_back_goes_on_with_a_caution(tmp_path: Path) -> None:
    """Its own impact is felt at the end of the step, that of the other when it happens."""
    parts = {"one": Wheel("one", (0.55,), restores=False), "two": Wheel("two", (0.25,))}
    said = cautions(EventAware(Machine(parts, CONNECTIONS)))
    assert [(message.instance, message.status) for message in said] == [("one", Status.WARNING)]
    outcome, table = ran(parts, tmp_path)
    assert outcome.ending is Ending.COMPLETED
    assert 0.25 in list(table["time"])
    assert 0.55 not in list(table["time"])


@contextmanager
def largest_file(size: int) -> Iterator[None]:
    """As a full disk: nothing can be written beyond."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


class Full:
    """An observer that lets the disk be full from some time on."""

    def __init__(self, disk: ExitStack, time: float) -> None:
        self._disk, self._time = disk, time

    def started(self, unit: Observable, time: float) -> None:
        pass

    def stepped(self, unit: Observable, time: float) -> None:
        if time == self._time:
            self._disk.enter_context(largest_file(100))


@pytest.mark.parametrize("suffix", ["csv", "parquet"])
def test_a_disk_that_becomes_full_ends_the_run_and_keeps_what_was_written(
    suffix: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(record, "_CHUNK", 20)
    machine = Machine({"one": Wheel("one")})
    recorder = Recorder(machine, tmp_path / f"results.{suffix}", ["one.angle"])
    with ExitStack() as disk, pytest.raises(UsageError) as refusal:
        run_machine(machine, Jacobi(), TimeGrid.of(1.0, 0.01), {}, [recorder, Full(disk, 0.35)])
    parts = tmp_path / "results.parts"
    assert f"000004.{suffix}' cannot be written: [Errno 27]" in str(refusal.value)
    assert f"What was recorded before is whole: 3 file(s) in '{parts}'" in str(refusal.value)
    assert sorted(path.name for path in parts.iterdir()) == [f"00000{k}.{suffix}" for k in (1, 2, 3)]
    # Once there is room again, nothing is missing, not even what could not be written.
    path = recorder.finish()
    table = pd.read_csv(path) if suffix == "csv" else pd.read_parquet(path)
    assert len(table) == 40
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("suffix", ["csv", "parquet"])
def test_a_disk_without_room_for_the_whole_table_keeps_its_parts(
    suffix: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(record, "_CHUNK", 200)
    machine = Machine({"one": Wheel("one")})
    path = tmp_path / f"results.{suffix}"
    path.write_text("an old one", encoding="utf-8")
    recorder = Recorder(machine, path, ["one.angle"])
    run_machine(machine, Jacobi(), TimeGrid.of(9.99, 0.01), {}, [recorder])
    parts = tmp_path / "results.parts"
    largest = max(part.stat().st_size for part in parts.iterdir())
    with largest_file(largest + 10), pytest.raises(UsageError, match=r"What was recorded before is whole: 10 file"):
        recorder.finish()
    assert sorted(tmp_path.iterdir()) == sorted([path, parts])
    assert path.read_text(encoding="utf-8") == "an old one"
    assert recorder.finish() == path
    assert len(pd.read_csv(path) if suffix == "csv" else pd.read_parquet(path)) == 1000


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A disk of 256 kB; only root can have one."""
    command = ["mount", "-t", "tmpfs", "-o", "size=256k", "tmpfs", str(tmp_path)]
    try:
        mounted = subprocess.run(command, capture_output=True, check=False).returncode == 0
    except OSError:
        mounted = False
    if not mounted:
        pytest.skip("no disk can be mounted here")
    yield tmp_path
    subprocess.run(["umount", str(tmp_path)], check=True)


def test_a_real_disk_that_is_full(small_disk: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(record, "_CHUNK", 2000)
    machine = Machine({"one": Wheel("one")})
    recorder = Recorder(machine, small_disk / "results.parquet", ["one.angle"])
    with pytest.raises(UsageError, match=r"cannot be written: \[Errno 28\] No space left on device"):
        run_machine(machine, Jacobi(), TimeGrid.of(100.0, 1e-3), {}, [recorder])
    table = pd.read_parquet(small_disk / "results.parts")
    assert len(table) % 1000 == 0
    assert len(table) > 5000
    assert table["time"].is_monotonic_increasing
