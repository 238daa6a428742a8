"""FMUs that this project did not build: run alone by the command line, and coupled by every algorithm."""

import json
import math
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from harness.app.commands.machine_ready import instantiated, prepared
from harness.errors import FmuError
from harness.fmu import open_fmu
from harness.fmu.instances.common import FmuSlave
from harness.fmu.instances.message_log import discard_message
from harness.fmu.interface import Observable
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.running import run_machine
from harness.machine.stepping import Algorithm, EventAware, GaussSeidel, Jacobi, algorithm_of
from harness.run.master import Recorder, TimeGrid
from tests.harness.machine.foreign import build
from tests.once import once

G, STIFFNESS = 9.81, 4.0
SPRING = (Connection("mass.x", "spring.x"), Connection("spring.force", "mass.force"))
ALGORITHMS: dict[str, Callable[[Machine], Algorithm]] = {
    "jacobi": lambda _: Jacobi(),
    "gauss_seidel": lambda _: GaussSeidel(),
    "event_aware": EventAware,
}


@pytest.fixture(scope="module")
def mass(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """FMI 2.0, by pythonfmu."""
    folder = once(tmp_path_factory, "foreign_mass", lambda folder: build.by_pythonfmu("mass.py", folder))
    return folder / "Mass.fmu"


@pytest.fixture(scope="module")
def spring(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """FMI 3.0, by pythonfmu3."""
    folder = once(tmp_path_factory, "foreign_spring", lambda folder: build.by_pythonfmu3("spring.py", folder))
    return folder / "Spring.fmu"


@pytest.fixture(scope="module")
def ball(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """FMI 3.0, in C, with event mode and early return."""
    pytest.importorskip("ziglang")
    return once(tmp_path_factory, "foreign_ball", build.ball) / "Ball.fmu"


@pytest.fixture(scope="module")
def container(mass: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """FMI 2.0, fmpy's container of two masses."""
    folder = once(tmp_path_factory, "foreign_container", lambda folder: build.oscillator(mass, folder))
    return folder / "Oscillator.fmu"


@pytest.fixture
def together() -> Iterator[Callable[..., dict[str, FmuSlave]]]:
    """A function that makes instances of FMUs by name; they are freed after the test."""
    with ExitStack() as stack:

        def make(early_return: bool = False, **paths: Path) -> dict[str, FmuSlave]:
            fmus = {name: stack.enter_context(open_fmu(path)) for name, path in paths.items()}
            return {
                name: stack.enter_context(fmu.instantiate(name, early_return=early_return))
                for name, fmu in fmus.items()
            }

        yield make


def run_alone(fmu: Path, folder: Path, *more: str) -> pd.DataFrame:
    """`mechanism-fmu run` in a process of its own: results."""
    command = [sys.executable, "-c", "from harness.app.cli import main; main()", "run", str(fmu), "-o", str(folder)]
    done = subprocess.run([*command, *more], capture_output=True, text=True, check=False, env=os.environ)
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    assert json.loads((folder / "summary.json").read_text(encoding="utf-8"))["ending"] == "completed"
    return pd.read_csv(folder / "results.csv")


def oscillation(steps: int, size: float) -> list[tuple[float, float]]:
    """Mass and spring by Jacobi's scheme: the force is that of each step's beginning."""
    places, x, v = [(1.0, 0.0)], 1.0, 0.0
    for _ in range(steps):
        a = -STIFFNESS * x
        x, v = x + v * size + a * size**2 / 2, v + a * size
        places.append((x, v))
    return places


@pytest.mark.parametrize("algorithm", ["jacobi", "event_aware"])
def test_mass_and_spring_of_two_tools_and_two_standards(
    mass: Path, spring: Path, together: Callable[..., dict[str, FmuSlave]], algorithm: str
) -> None:
    machine = Machine(together(mass=mass, spring=spring), SPRING)
    recorder = Recorder([machine.description.variable(name) for name in ("mass.x", "mass.v", "spring.force")])
    values = {"mass.mass": 1.0, "spring.stiffness": STIFFNESS}
    outcome = run_machine(machine, ALGORITHMS[algorithm](machine), TimeGrid.of(1.0, 0.01), values, [recorder])
    assert outcome.error is None
    table = recorder.table()
    assert table[["mass.x", "mass.v"]].to_numpy() == pytest.approx(np.array(oscillation(100, 0.01)), abs=1e-12)
    assert table["spring.force"].to_numpy() == pytest.approx(-STIFFNESS * table["mass.x"].to_numpy(), abs=1e-12)


@pytest.mark.parametrize("algorithm", list(ALGORITHMS))
def test_their_error_is_of_first_order(
    mass: Path, spring: Path, together: Callable[..., dict[str, FmuSlave]], algorithm: str
) -> None:
    errors = []
    for size in (0.02, 0.01):
        machine = Machine(together(mass=mass, spring=spring), SPRING)
        outcome = run_machine(machine, ALGORITHMS[algorithm](machine), TimeGrid.of(1.0, size), {})
        assert outcome.error is None
        errors.append(abs(float(machine.get(["mass.x"])[0]) - math.cos(2.0)))
    assert errors[0] < 0.05
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.15)


def test_a_container_is_a_part_like_others(
    container: Path, spring: Path, together: Callable[..., dict[str, FmuSlave]]
) -> None:
    """Of its two masses the first swings on a spring outside."""
    links = (Connection("pair.one_x", "spring.x"), Connection("spring.force", "pair.force"))
    machine = Machine(together(pair=container, spring=spring), links)
    recorder = Recorder([machine.description.variable("pair.one_x")])
    outcome = run_machine(machine, Jacobi(), TimeGrid.of(1.0, 0.01), {}, [recorder])
    assert outcome.error is None
    expected = [x for x, _ in oscillation(100, 0.01)]
    assert recorder.table()["pair.one_x"].to_numpy() == pytest.approx(np.array(expected), abs=1e-12)


class Times:
    """An observer of communication points."""

    def __init__(self) -> None:
        self.seen: list[float] = []

    def started(self, unit: Observable, time: float) -> None:
        pass

    def stepped(self, unit: Observable, time: float) -> None:
        self.seen.append(time)


def bounces(until: float) -> list[float]:
    """When a ball that falls from 1 m strikes the floor, e = 1/2."""
    fall = math.sqrt(2 / G)
    times, span = [fall], fall
    while times[-1] + span < until:
        times.append(times[-1] + span)
        span /= 2
    return times


def test_steps_end_where_a_foreign_ball_bounces(
    ball: Path, mass: Path, together: Callable[..., dict[str, FmuSlave]]
) -> None:
    """The ball's speed pulls a mass, which therefore feels each bounce when it happens."""
    machine = Machine(together(early_return=True, ball=ball, mass=mass), [Connection("ball.speed", "mass.force")])
    times, recorder = Times(), Recorder([machine.description.variable(n) for n in ("ball.speed", "mass.force")])
    outcome = run_machine(machine, EventAware(machine), TimeGrid.of(1.2, 0.1), {}, [times, recorder])
    assert outcome.error is None
    expected = bounces(1.2)
    between = [time for time in times.seen if round(time * 10, 6) % 1]
    assert between == pytest.approx(expected, abs=1e-9)
    assert machine.get(["ball.bounces"]) == [len(expected)]
    table = recorder.table()
    assert table["mass.force"].to_numpy() == pytest.approx(table["ball.speed"].to_numpy(), abs=1e-12)
    first = table[table["time"] == between[0]]["mass.force"].iloc[0]
    assert first == pytest.approx(math.sqrt(2 * G) / 2, rel=1e-9)


@pytest.mark.parametrize("algorithm", ["jacobi", "gauss_seidel"])
def test_whole_steps_go_on_behind_bounces(
    ball: Path, mass: Path, together: Callable[..., dict[str, FmuSlave]], algorithm: str
) -> None:
    ends = []
    for early in (False, True):
        parts = together(early_return=early, ball=ball, mass=mass)
        machine = Machine(parts, [Connection("ball.speed", "mass.force")])
        outcome = run_machine(machine, ALGORITHMS[algorithm](machine), TimeGrid.of(1.2, 0.05), {})
        assert outcome.error is None
        ends.append(machine.get(["ball.height", "ball.speed", "ball.bounces", "mass.x"]))
    assert ends[0] == pytest.approx(ends[1], abs=1e-12)
    assert ends[0][2] == len(bounces(1.2))


@pytest.mark.parametrize("process", ["false", "true"])
def test_a_command_lets_it_end_a_step_at_its_event(ball: Path, tmp_path: Path, process: str) -> None:
    """Also in a process of its own; other algorithms keep their steps."""
    file = tmp_path / "ball.toml"
    reached = {}
    for algorithm in ("event_aware", "jacobi"):
        run = f'[run]\nstop_time = 0.6\nstep = "50 ms"\nalgorithm = "{algorithm}"\n'
        file.write_text(f"{run}[component.ball]\nfile = '{ball}'\nprocess = {process}\n", encoding="utf-8")
        with prepared(str(file)) as machine, instantiated(machine, discard_message) as parts:
            unit = Machine(parts)
            recorder = Recorder([unit.description.variable("ball.bounces")])
            outcome = run_machine(unit, algorithm_of(machine.plan.policy, unit), TimeGrid.of(0.6, 0.05), {}, [recorder])
        assert outcome.error is None
        reached[algorithm] = recorder.table()["time"].to_numpy()
    assert np.abs(reached["event_aware"] - bounces(0.6)[0]).min() < 1e-8
    assert np.abs(reached["jacobi"] - bounces(0.6)[0]).min() > 1e-3


def test_a_discrete_input_is_set_in_event_mode(ball: Path, together: Callable[..., dict[str, FmuSlave]]) -> None:
    one = together(early_return=True, ball=ball)["ball"]
    one.initialize(0.0, 1.0)
    one.step(0.0, 0.1)
    one.set({"kicks": 2})
    assert one.get(["kicks", "speed"]) == [2, pytest.approx(2.0 - 0.1 * G)]
    one.step(0.1, 0.1)


def test_a_foreign_refusal_is_told_without_its_words(ball: Path, together: Callable[..., dict[str, FmuSlave]]) -> None:
    one = together(ball=ball)["ball"]
    one.initialize(0.0, 1.0)
    with pytest.raises(FmuError, match=r"ball failed at t = 0\.5 s \(fmi3DoStep, status error\): it gave no reason"):
        one.step(0.5, 0.1)


@pytest.mark.slow
def test_each_runs_alone_by_the_command_line(mass: Path, spring: Path, ball: Path, tmp_path: Path) -> None:
    forced = tmp_path / "force.csv"
    forced.write_text("time,force\n0,2\n1,2\n")
    times = ("--stop-time", "1", "--step", "0.1")
    moved = run_alone(mass, tmp_path / "mass", *times, "--input", str(forced), "--set", "mass=4")
    assert moved["x"].iloc[-1] == pytest.approx(1.25, rel=1e-12)
    pulled = run_alone(spring, tmp_path / "spring", *times, "--set", "stiffness=3", "--set", "x=0.5")
    assert pulled["force"].to_numpy() == pytest.approx(-1.5)
    fallen = run_alone(ball, tmp_path / "ball")
    assert fallen["bounces"].iloc[-1] == len(bounces(1.0))
    assert fallen["height"].iloc[40] == pytest.approx(1 - G * 0.4**2 / 2, rel=1e-12)
