"""Recording a machine: what is kept, in which unit, with how much memory, and what is left by a run that is killed."""

import os
import subprocess
import sys
import time as clock
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest

from harness.errors import UsageError
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.observers import record
from harness.machine.observers.component_impacts import Impacts
from harness.machine.observers.record import Recorder
from harness.machine.part import Extrapolation
from harness.machine.running import run_machine
from harness.machine.stepping import Adaptive, Algorithm, EventAware, Jacobi
from harness.run.master import Recorder as RecorderInMemory, TimeGrid, recorded_variables
from tests.harness.machine.fakes import Wheel
from tests.harness.machine.linear import mass, mass_and_spring

SIGNALS = ["two.angle", "one.steps", "one.speed", "two.forward", "one.torque"]


def machine() -> Machine:
    return Machine({"one": Wheel("one", (0.234,)), "two": Wheel("two")}, [Connection("two.drag", "one.torque")])


@pytest.mark.parametrize("suffix", [".parquet", ".csv"])
@pytest.mark.parametrize("chunk", [1 << 17, 18])
def test_a_file_has_the_chosen_signals_with_units_and_types(
    suffix: str, chunk: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(record, "_CHUNK", chunk)
    parts = machine()
    recorder = Recorder(parts, tmp_path / f"results{suffix}", SIGNALS)
    known = RecorderInMemory([parts.description.variable(name) for name in SIGNALS])
    run_machine(parts, Jacobi(), TimeGrid.of(1.0, 0.1), {"two.torque": 0.1}, [recorder, known])
    path = recorder.finish()
    table = pd.read_parquet(path) if suffix == ".parquet" else pd.read_csv(path)
    if suffix == ".csv":
        assert list(table)[:3] == ["time [s]", "two.angle [rad]", "one.steps"]
        table.columns = pd.Index([name.split(" [")[0] for name in table])
    else:
        units = {field.name: field.metadata[b"unit"].decode() for field in pq.read_schema(path)}
        assert units == recorder.units
        assert units["one.speed"] == "rad/s"
        assert units["one.steps"] == "1"
    pd.testing.assert_frame_equal(table, known.table())
    assert list(tmp_path.iterdir()) == [path]


def test_all_numbers_that_come_and_go_are_recorded_unless_one_says_which(tmp_path: Path) -> None:
    parts = machine()
    Recorder(parts, tmp_path / "results.parquet").finish()
    table = pd.read_parquet(tmp_path / "results.parquet")
    assert list(table) == ["time", *(v.name for v in recorded_variables(parts.description))]
    assert table.empty
    assert "one.torque" in table


@pytest.mark.parametrize("every", [1, 2, 3, 7, 100])
def test_every_so_many_points_and_always_the_first_and_the_last(every: int, tmp_path: Path) -> None:
    parts = machine()
    recorder = Recorder(parts, tmp_path / "results.parquet", ["one.angle"], every)
    run_machine(parts, Jacobi(), TimeGrid.of(1.0, 0.1), {}, [recorder])
    times = pd.read_parquet(recorder.finish())["time"]
    assert list(np.round(times * 10)) == sorted({*range(0, 11, every), 10})


def test_the_jump_of_an_impact_is_kept(tmp_path: Path) -> None:
    parts = machine()
    impacts = Impacts(parts)
    recorder = Recorder(parts, tmp_path / "results.parquet", ["one.speed"], 100, impacts)
    run_machine(parts, EventAware(parts), TimeGrid.of(1.0, 0.1), {}, [impacts, recorder])
    table = pd.read_parquet(recorder.finish())
    assert list(table["time"]) == [0.0, 0.2, 0.234, 1.0]
    assert list(table["one.speed"]) == pytest.approx([1.0, 1.0, 2.0, 2.0], rel=0.2)


@pytest.mark.parametrize("algorithm", [EventAware, lambda machine: Adaptive(machine, 1e-7)])
def test_rows_stay_on_the_grid_whatever_steps_are_taken_between(
    algorithm: Callable[[Machine], Algorithm], tmp_path: Path
) -> None:
    coupling = [Connection("two.x", "three.led"), Connection("three.force", "two.force")]
    parts = Machine(
        {"one": Wheel("one", (0.123,)), "two": mass("two"), "three": mass_and_spring("three")},
        coupling,
        Extrapolation.LINEAR,
    )
    impacts = Impacts(parts)
    recorder = Recorder(parts, tmp_path / "results.parquet", ["one.angle"], 5, impacts)
    outcome = run_machine(parts, algorithm(parts), TimeGrid.of(1.0, 0.02), {}, [impacts, recorder])
    assert outcome.steps > 50
    times = list(pd.read_parquet(recorder.finish())["time"])
    struck = next(time for time in times if time >= 0.123 - 1e-12)
    assert len(times) == 13
    assert set(times) == {k / 10 for k in range(11)} | {times[times.index(struck) - 1], struck}


def test_the_memory_is_that_of_one_part_however_long_the_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(record, "_CHUNK", 60)
    parts = machine()
    recorder = Recorder(parts, tmp_path / "results.parquet", ["one.angle", "two.angle"])
    waiting: list[int] = []

    class Watch:
        def started(self, unit: object, time: float) -> None:
            waiting.append(len(recorder._numbers))

        stepped = started

    run_machine(parts, Jacobi(), TimeGrid.of(1.0, 0.01), {}, [recorder, Watch()])
    assert max(waiting) < 60
    assert len(list(recorder._table.parts.iterdir())) == 101 // 20
    assert len(pd.read_parquet(recorder.finish())) == 101


def test_rows_do_not_wait_long(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(record, "_PATIENCE", 0.0)
    parts = machine()
    recorder = Recorder(parts, tmp_path / "results.csv", ["one.angle"])
    run_machine(parts, Jacobi(), TimeGrid.of(0.5, 0.1), {}, [recorder])
    assert len(list(recorder._table.parts.iterdir())) == 6
    assert len(pd.read_csv(recorder.finish())) == 6


@pytest.mark.parametrize(
    ("signals", "path", "every", "message"),
    [
        (["one.anglo"], "results.parquet", 1, "no variable 'one.anglo'. Did you mean one.angle"),
        (["one.note"], "results.parquet", 1, "'one.note' is of type String; only numbers"),
        (["one.angle"], "results.xlsx", 1, "none of the files that can be recorded: .parquet, .csv"),
        (["one.angle"], "results.csv", 0, "Every 0-th communication point cannot be recorded"),
        (["one.angle"], "file/results.csv", 1, "cannot be made"),
    ],
)
def test_what_cannot_be_recorded_is_refused(
    signals: list[str], path: str, every: int, message: str, tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("not a folder", encoding="utf-8")
    with pytest.raises(UsageError) as refusal:
        Recorder(machine(), tmp_path / path, signals, every)
    assert message in str(refusal.value)


def test_a_table_of_an_earlier_run_stays_until_the_new_one_is_there(tmp_path: Path) -> None:
    path = tmp_path / "results.csv"
    path.write_text("an old one", encoding="utf-8")
    recorder = Recorder(machine(), path, ["one.angle"])
    assert path.read_text(encoding="utf-8") == "an old one"
    recorder.finish()
    assert path.read_text(encoding="utf-8") == "time [s],one.angle [rad]\n"


ENDLESS = """
import sys
from pathlib import Path
from harness.run.master import TimeGrid
from harness.machine.observers import record
from harness.machine.stepping import Jacobi
from harness.machine.machine import Machine
from harness.machine.running import run_machine
from tests.harness.machine.fakes import Wheel

record._CHUNK = 2000
machine = Machine({"one": Wheel("one")})
recorder = record.Recorder(machine, Path(sys.argv[1]), ["one.angle"])
run_machine(machine, Jacobi(), TimeGrid.of(1e4, 1e-3), {}, [recorder])
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no signal 9 there")
def test_a_run_that_is_killed_leaves_what_it_recorded(tmp_path: Path) -> None:
    """Nothing is half written, no row is missing in between, and the next run begins anew."""
    path = tmp_path / "results.parquet"
    command = [sys.executable, "-c", ENDLESS, str(path)]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    with subprocess.Popen(command, env=environment) as process:
        parts, began = tmp_path / "results.parts", clock.monotonic()
        while not (parts / "000003.parquet").exists() and clock.monotonic() < began + 60.0:
            clock.sleep(0.01)
        process.kill()
    assert not path.exists()
    table = pd.read_parquet(parts)
    assert len(table) >= 3000
    assert len(table) % 1000 == 0
    assert list(np.round(table["time"] * 1000)) == list(range(len(table)))
    assert all(later > sooner for sooner, later in pairwise(table["one.angle"]))
    recorder = Recorder(machine(), path, ["one.angle"])
    assert list(parts.iterdir()) == []
    assert pd.read_parquet(recorder.finish()).empty
