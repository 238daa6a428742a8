"""FMUs in processes of their own."""

import os
import signal
import subprocess
import sys
from collections.abc import Callable
from contextlib import AbstractContextManager, ExitStack
from pathlib import Path

import pandas as pd
import pytest

from harness.errors import FmuError, LogMessage
from harness.fmu import open_fmu
from harness.fmu.interface import Component
from harness.fmu.remote import in_own_process
from harness.machine.machine import Machine
from harness.machine.observers.component_impacts import Impacts
from harness.machine.observers.record import Recorder
from harness.machine.running import run_machine
from harness.machine.stepping import EventAware, Jacobi
from harness.run.master import Ending, TimeGrid

GAUGE = """
from pythonfmu import Fmi2Causality, Fmi2Slave, Real
from pythonfmu.enums import Fmi2Status

class {name}(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.reading = 0.0
        self.register_variable(Real("reading", causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        self.reading = {reading}
        if current_time > 0.45:
            self.log("the needle is bent", Fmi2Status.error)
            return False
        return True
"""

TOGETHER = """
import sys
from contextlib import ExitStack
from pathlib import Path
from harness.errors import FmuError
from harness.fmu import open_fmu

with ExitStack() as stack:
    try:
        for path in sys.argv[1:]:
            stack.enter_context(stack.enter_context(open_fmu(Path(path))).instantiate(path))
    except FmuError as error:
        print(error)
"""


@pytest.fixture(scope="module")
def gauges(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Two FMUs of pythonfmu whose scripts have one name, in two folders."""
    fmus = []
    for name, reading in (("First", 1.0), ("Second", 2.0)):
        folder = tmp_path_factory.mktemp(name)
        (folder / "gauge.py").write_text(GAUGE.format(name=name, reading=reading), encoding="utf-8")
        command = [sys.executable, "-m", "pythonfmu", "build", "-f", str(folder / "gauge.py"), "-d", str(folder)]
        subprocess.run(command, check=True, capture_output=True)
        fmus.append(folder / f"{name}.fmu")
    return fmus


def test_scripts_of_one_name_clash_in_one_process(gauges: list[Path]) -> None:
    """The reason why there are others: see the test below."""
    command = [sys.executable, "-c", TOGETHER, *map(str, gauges)]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    assert "module 'gauge' has no attribute 'Second'" in said


def test_scripts_of_one_name_run_in_processes_of_their_own(gauges: list[Path]) -> None:
    messages: list[LogMessage] = []
    with ExitStack() as stack:
        parts: dict[str, Component] = {
            path.stem: stack.enter_context(
                in_own_process(stack.enter_context(open_fmu(path)), path.stem, messages.append)
            )
            for path in gauges
        }
        machine = Machine(parts)
        outcome = run_machine(machine, Jacobi(), TimeGrid.of(0.4, 0.1), {})
        assert outcome.ending is Ending.COMPLETED
        assert machine.get(["First.reading", "Second.reading"]) == [1.0, 2.0]
    assert messages == []


def test_what_an_fmu_says_when_it_refuses_is_told_here(gauges: list[Path]) -> None:
    messages: list[LogMessage] = []
    with open_fmu(gauges[0]) as fmu, in_own_process(fmu, "gauge", messages.append) as gauge:
        outcome = run_machine(Machine({"gauge": gauge}), Jacobi(), TimeGrid.of(1.0, 0.1), {})
    assert outcome.ending is Ending.FAILED
    assert outcome.final_time == 0.5
    assert str(outcome.error) == "gauge failed at t = 0.5 s (fmi2DoStep, status discard): the needle is bent"
    assert [message.text for message in messages] == ["the needle is bent"]


def test_a_native_fmu_gives_the_same_numbers_there(native_ratchet_fmu: Path, tmp_path: Path) -> None:
    """With its impacts, and steps that are taken back."""

    def run(start: Callable[[], AbstractContextManager[Component]], name: str) -> tuple[pd.DataFrame, pd.DataFrame]:
        with start() as ratchet:
            machine = Machine({"ratchet": ratchet})
            impacts = Impacts(machine)
            recorder = Recorder(machine, tmp_path / name)
            outcome = run_machine(machine, EventAware(machine), TimeGrid.of(1.2, 0.01), {}, [impacts, recorder])
            assert outcome.ending is Ending.COMPLETED, outcome.error
            assert machine.parts["ratchet"].statistics.rollbacks > 0
            return pd.read_parquet(recorder.finish()), impacts.table(impacts.by_component())

    with open_fmu(native_ratchet_fmu) as fmu:
        here = run(lambda: fmu.instantiate("ratchet"), "here.parquet")
        there = run(lambda: in_own_process(fmu, "ratchet"), "there.parquet")
    assert len(here[1]) > 0
    for one, other in zip(here, there, strict=True):
        pd.testing.assert_frame_equal(one, other, check_exact=True)


def test_an_fmu_whose_process_is_killed_leaves_nothing_behind(native_ratchet_fmu: Path) -> None:
    with open_fmu(native_ratchet_fmu) as fmu:
        with in_own_process(fmu, "ratchet") as ratchet:
            ratchet.initialize(0.0, 1.0)
            ratchet.step(0.0, 0.1)
            assert ratchet.process.pid is not None
            os.kill(ratchet.process.pid, signal.SIGKILL)
            with pytest.raises(FmuError, match=r"ratchet failed at t = 0\.1 s \(advance\): its process was ended by"):
                ratchet.step(0.1, 0.1)
        folder = fmu.folder
        with in_own_process(fmu, "ratchet") as another:
            another.initialize(0.0, 1.0)
    assert not folder.exists()
