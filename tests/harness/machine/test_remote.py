"""Components in processes of their own: the same numbers, one round trip a step, and a clear end of every trouble."""

import os
import signal
import subprocess
import sys
import time as clock
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from harness.errors import FmuError, LogMessage, Status, UsageError
from harness.fmu.description import Value, Variable
from harness.fmu.interface import Component, Observable
from harness.fmu.remote import remote
from harness.fmu.remote.far_side import Request
from harness.fmu.remote.near_side import RemoteComponent
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.part import Extrapolation
from harness.machine.running import run_machine
from harness.machine.stepping import Adaptive, Algorithm, EventAware, Jacobi
from harness.run.master import Ending, TimeGrid
from tests.harness.machine.fakes import Trouble, Wheel, WheelOpener

CONNECTIONS = [Connection("one.drag", "two.torque", gain=-0.5), Connection("two.brake", "one.torque", offset=0.1)]


class Watch:
    """An observer that keeps some values."""

    def __init__(self) -> None:
        self.rows: list[list[Any]] = []

    def started(self, unit: Observable, time: float) -> None:
        self.rows.append([time, *unit.get(["one.angle", "two.speed", "one.steps", "two.forward", "two.torque"])])

    stepped = started


class Braked(Wheel):
    """Its brake's torque follows its speed, not its own torque: a loop through it has a delay, and a solution."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.description.variables["brake"] = Variable(
            "brake", 99, "Real", "output", unit="N.m", depends_on=frozenset()
        )

    def get(self, names: Sequence[str]) -> list[Value]:
        self.values["brake"] = -0.1 * float(self.values["speed"])
        return super().get(names)


def algorithms() -> dict[str, Any]:
    return {"jacobi": lambda _: Jacobi(), "event_aware": EventAware, "adaptive": lambda m: Adaptive(m, 1e-4)}


def rows(components: dict[str, Component], algorithm: str, extrapolation: Extrapolation) -> list[list[Any]]:
    machine = Machine(components, CONNECTIONS, extrapolation)
    watch, how = Watch(), algorithms()[algorithm](machine)
    outcome = run_machine(machine, how, TimeGrid.of(0.5, 0.1), {"one.inertia": 2.0}, [watch])
    assert outcome.ending is Ending.COMPLETED, outcome.error
    return watch.rows


@pytest.fixture(scope="module")
def start() -> Iterator[Any]:
    """A function that starts a wheel's process; all end with the module."""
    with ExitStack() as stack:
        yield lambda *a, **k: stack.enter_context(remote("wheel", WheelOpener(*a, **k)))


@pytest.mark.parametrize("extrapolation", [Extrapolation.CONSTANT, Extrapolation.DERIVATIVES])
@pytest.mark.parametrize("algorithm", algorithms())
def test_a_machine_runs_as_if_its_parts_were_here(start: Any, algorithm: str, extrapolation: Extrapolation) -> None:
    here = {"one": Wheel("one", (0.234,)), "two": Braked("two")}
    there = {"one": start("one", (0.234,)), "two": Braked("two")}
    assert rows(there, algorithm, extrapolation) == rows(here, algorithm, extrapolation)


def trips(component: RemoteComponent, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What is asked of a component from now on."""
    asked: list[str] = []
    ask = component._link.ask

    def spy(request: Request, *rest: Any) -> Any:
        asked.append(request[1])
        return ask(request, *rest)

    monkeypatch.setattr(component._link, "ask", spy)
    return asked


def test_a_step_with_inputs_outputs_and_observers_is_one_round_trip(
    start: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    one = start("one")
    machine = Machine({"one": one, "two": Wheel()}, [Connection("two.drag", "one.torque")])

    class Look:
        def started(self, unit: Observable, time: float) -> None:
            unit.get(["one.angle", "one.steps"])

        stepped = started

    machine.initialize(0.0, 1.0)
    machine.get(["one.angle", "one.steps"])
    asked = trips(one, monkeypatch)
    algorithm: Algorithm = EventAware(machine)
    for k in range(6):
        algorithm.advance(machine, k * 10**8, (k + 1) * 10**8)
        machine.get(["one.angle", "one.steps"])
        machine.set({"two.torque": 0.1 * k})
    # in the first two, the process learns what is wanted after each step
    assert asked[-4:] == ["advance"] * 4
    assert asked.count("advance") == 6
    assert len(asked) <= 10


def test_what_follows_an_input_at_once_is_asked_for_again(start: Any) -> None:
    wheel = start()
    reals = wheel.reals(["drag", "speed"])
    reals.read()
    torque = wheel.reals(["torque"])
    torque.values[0] = 0.25
    torque.write()
    reals.read()
    assert list(reals.values) == [-0.25, 1.0]
    wheel.set({"torque": 0.5})
    assert wheel.get(["drag"]) == [-0.5]


def test_states_stay_in_the_process(start: Any) -> None:
    wheel = start()
    wheel.initialize(0.0, 1.0)
    first = wheel.save()
    wheel.step(0.0, 0.1)
    second = wheel.save()
    assert wheel.get(["angle", "steps"]) == [0.1, 1]
    wheel.restore(first)
    assert wheel.get(["angle", "steps"]) == [0.0, 0]
    wheel.restore(second)
    assert wheel.get(["angle", "steps"]) == [0.1, 1]
    assert wheel.save(first) == first
    wheel.step(0.1, 0.1)
    wheel.restore(first)
    assert wheel.get(["steps"]) == [1]
    wheel.free_state(first)
    wheel.restore(first)
    with pytest.raises(FmuError, match="KeyError"):
        wheel.get(["steps"])


def test_messages_come_with_the_reply_and_the_end_is_heard() -> None:
    said: list[LogMessage] = []
    with remote("wheel", WheelOpener(trouble=Trouble(0.1, "warn")), said.append) as wheel:
        wheel.initialize(0.0, 1.0)
        wheel.advance(0.0, 0.1)
        assert said == []
        wheel.advance(0.1, 0.1)
        assert [(m.time, m.status, m.text) for m in said] == [(0.1, Status.WARNING, "the oil is hot")]
        wheel.terminate()
    assert said[-1].text == "ended: terminated"
    assert wheel.messages == said
    assert wheel.process.exitcode == 0


def test_one_that_cannot_be_made_says_why() -> None:
    with pytest.raises(FmuError, match="no licence"), remote("wheel", WheelOpener(refusal="no licence")):
        pass


def test_what_does_not_exist_is_told_by_name(start: Any) -> None:
    with pytest.raises(UsageError, match="no variable 'anglo'"):
        start().get(["anglo"])


@pytest.mark.parametrize(
    ("kind", "message"),
    [
        ("crash", r"one failed at t = 0\.3 s \(advance\): its process was ended by the signal SIGKILL"),
        ("exit", r"one failed at t = 0\.3 s \(advance\): its process ended with exit code 3"),
        ("hang", r"one failed at t = 0\.3 s \(advance\): it has not answered for 0\.5 s, the time limit"),
        ("discard", r"one failed at t = 0\.3 s \(fmi2DoStep, status discard\): it stalls"),
        ("fatal", r"one failed at t = 0\.3 s \(fmi2DoStep, status fatal\): it stalls"),
        ("bug", r"one failed in its process: ZeroDivisionError: a gear of no teeth"),
        ("nan", r"one failed: its output drag is nan"),
    ],
)
def test_trouble_ends_the_run_with_name_time_and_reason(kind: str, message: str) -> None:
    watch = Watch()
    with remote("one", WheelOpener("one", trouble=Trouble(0.3, kind)), time_limit=0.5) as one:
        machine = Machine({"one": one, "two": Wheel("two")}, CONNECTIONS[:1])
        outcome = run_machine(machine, EventAware(machine), TimeGrid.of(1.0, 0.1), {}, [watch])
    assert outcome.ending is Ending.FAILED
    assert outcome.final_time == 0.3
    assert [row[0] for row in watch.rows] == pytest.approx([0.0, 0.1, 0.2, 0.3])
    with pytest.raises(FmuError, match=message):
        raise outcome.error  # type: ignore[misc]
    assert not one.process.is_alive()


def test_a_process_killed_by_somebody_else_is_missed_at_the_next_step() -> None:
    with remote("one", WheelOpener("one")) as one:
        one.initialize(0.0, 1.0)
        one.advance(0.0, 0.1)
        assert one.process.pid is not None
        os.kill(one.process.pid, signal.SIGKILL)
        with pytest.raises(FmuError, match=r"one failed at t = 0\.1 s \(advance\): .* SIGKILL") as failure:
            one.advance(0.1, 0.1)
    assert (failure.value.instance, failure.value.time, failure.value.status) == ("one", 0.1, Status.FATAL)


LEADER = """
import sys, time
from harness.fmu.remote import remote
from pathlib import Path
from tests.harness.machine.fakes import Trouble, WheelOpener

if __name__ == "__main__":
    hanging, waiting = (Path(folder) for folder in sys.argv[1:])
    with (
        remote("one", WheelOpener("one", trouble=Trouble(0.0, "hang")), folder=hanging) as one,
        remote("two", WheelOpener("two"), folder=waiting) as two,
    ):
        one.initialize(0.0, 1.0)
        one._link.send(((), "advance", (0.0, 0.1), ()))
        print(one.process.pid, two.process.pid, flush=True)
        time.sleep(600.0)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no signal 9 there")
def test_no_process_outlives_the_one_that_leads(tmp_path: Path) -> None:
    """Neither one that hangs nor one that waits; and the extracted FMUs go with them, whole."""
    script, folders = tmp_path / "leader.py", [tmp_path / "hanging", tmp_path / "waiting"]
    script.write_text(LEADER, encoding="utf-8")
    for folder in folders:
        folder.mkdir()
        for k in range(400):  # their removal takes longer than the end of a process
            (folder / f"{k}.txt").touch()
    command = [sys.executable, str(script), *map(str, folders)]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as leader:
        assert leader.stdout is not None
        numbers = [int(number) for number in leader.stdout.readline().split()]
        leader.kill()
    assert len(numbers) == 2
    began = clock.monotonic()
    while any(map(is_alive, numbers)) and clock.monotonic() < began + 60.0:
        clock.sleep(0.02)
    assert not any(map(is_alive, numbers))
    assert not any(folder.exists() for folder in folders)


def is_alive(number: int) -> bool:
    """Whether a process runs; one that waits to be fetched does not."""
    try:
        return Path(f"/proc/{number}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def test_the_numbers_are_the_same_to_the_last_bit(start: Any) -> None:
    wheel, value = start(), float(np.nextafter(0.1, 1.0))
    wheel.set({"torque": value})
    reals = wheel.reals(["torque"])
    reals.read()
    assert reals.values[0] == value
