"""Components with clocks in machines: one event iteration for all that share time, FMI 2.0 and 3.0 mixed."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, ExitStack
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from harness.app.cli import main
from harness.errors import FmuError, UsageError
from harness.fmu import Fmu, open_fmu
from harness.fmu.interface import Component
from harness.fmu.remote import in_own_process
from harness.machine.connection import Connection
from harness.machine.event_iteration import event_mode_of
from harness.machine.machine import Machine
from harness.machine.part import Extrapolation
from harness.machine.running import run_machine
from harness.machine.stepping import Adaptive, Algorithm, EventAware, GaussSeidel, Jacobi
from harness.run.master import Recorder, TimeGrid
from tests.harness.machine.foreign import build, in_c
from tests.once import once

#: A strikes, B counts its strikes at the instants when they happen, C those of B; B's sum is a force on a mass.
CHAIN = (
    Connection("a.tick", "b.poke"),
    Connection("a.number", "b.weight"),
    Connection("b.echoed", "c.weight"),  # before the clock by which it comes: the order of connections does not matter
    Connection("b.echo", "c.poke"),
    Connection("a.strikes", "b.seen"),
    Connection("b.seen_now", "c.seen"),
    Connection("b.sum", "mass.force"),
)
SIGNALS = ("a.strikes", "b.sum", "c.sum", "b.seen_now", "c.seen_now", "mass.v", "mass.force")
START = {"a.period": 0.25, "b.period": 0.0, "c.period": 0.0}

Opener = Callable[[Fmu, str, bool], AbstractContextManager[Component]]
ALGORITHMS: dict[str, Callable[[Machine], Algorithm]] = {
    "jacobi": lambda _: Jacobi(),
    "gauss_seidel": lambda _: GaussSeidel(),
    "event_aware": EventAware,
}


def here(fmu: Fmu, name: str, early: bool) -> AbstractContextManager[Any]:
    """An instance in this process."""
    return fmu.instantiate(name, early_return=early)


def apart(fmu: Fmu, name: str, early: bool) -> AbstractContextManager[Any]:
    """An instance in a process of its own."""
    return in_own_process(fmu, name, early_return=early)


@pytest.fixture(scope="module")
def pulse(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """FMI 3.0, in C, with clocks."""
    pytest.importorskip("ziglang")
    return once(tmp_path_factory, "foreign_pulse", in_c.pulse) / "Pulse.fmu"


@pytest.fixture(scope="module")
def mass(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """FMI 2.0, by pythonfmu."""
    folder = once(tmp_path_factory, "foreign_mass", lambda folder: build.by_pythonfmu("mass.py", folder))
    return folder / "Mass.fmu"


@pytest.fixture
def parts(pulse: Path, mass: Path) -> Iterator[Callable[..., Mapping[str, Component]]]:
    """A function that makes the chain's components; they are freed after the test."""
    with ExitStack() as stack:

        def make(opener: Opener = here, early: bool = False) -> Mapping[str, Component]:
            clocked, plain = (stack.enter_context(open_fmu(path)) for path in (pulse, mass))
            fmus = {"mass": plain, "c": clocked, "b": clocked, "a": clocked}
            return {name: stack.enter_context(opener(fmu, name, early)) for name, fmu in fmus.items()}

        yield make


def at_instants(table: Any, strikes: Any) -> None:
    """Everything behind a strike has happened at the same instant."""
    sums = strikes * (strikes + 1) / 2
    for name in ("b.sum", "c.sum", "mass.force"):
        assert table[name].to_numpy() == pytest.approx(sums, abs=0), name
    for name in ("a.strikes", "b.seen_now", "c.seen_now"):
        assert table[name].to_numpy() == pytest.approx(strikes, abs=0), name


@pytest.mark.parametrize("opener", [here, apart])
@pytest.mark.parametrize("algorithm", ["jacobi", "gauss_seidel"])
def test_ticks_pass_through_a_chain_at_the_communication_point(
    parts: Callable[..., Mapping[str, Component]], algorithm: str, opener: Opener
) -> None:
    """Without early return, what happens within a step is told at its end; gauss_seidel passes it on there, too."""
    machine = Machine(parts(opener), CHAIN)
    recorder = Recorder([machine.description.variable(name) for name in SIGNALS])
    outcome = run_machine(machine, ALGORITHMS[algorithm](machine), TimeGrid.of(1.5, 0.1), START, [recorder])
    assert outcome.error is None
    table = recorder.table()
    at_instants(table, np.floor(table["time"].to_numpy() / 0.25 + 1e-6))
    force = table["mass.force"].to_numpy()[:-1]
    assert table["mass.v"].to_numpy()[1:] == pytest.approx(np.cumsum(force * 0.1), abs=1e-12)


@pytest.mark.parametrize("opener", [here, apart])
@pytest.mark.parametrize("extrapolation", [Extrapolation.CONSTANT, Extrapolation.LINEAR])
def test_steps_end_at_ticks_where_events_count(
    parts: Callable[..., Mapping[str, Component]], opener: Opener, extrapolation: Extrapolation
) -> None:
    machine = Machine(parts(opener, early=True), CHAIN, extrapolation)
    recorder = Recorder([machine.description.variable(name) for name in SIGNALS])
    outcome = run_machine(machine, EventAware(machine), TimeGrid.of(1.5, 0.1), START, [recorder])
    assert outcome.error is None
    table = recorder.table()
    times = table["time"].to_numpy()
    assert {0.25, 0.75, 1.25} <= set(np.round(times, 9))
    at_instants(table, np.floor(times / 0.25 + 1e-6))
    n = np.floor(times / 0.25 + 1e-6)
    speed = n * (n - 1) * (n + 1) / 24 + n * (n + 1) / 2 * (times - n / 4)  # force n (n + 1) / 2, since n / 4 s
    assert table["mass.v"].to_numpy() == pytest.approx(speed, abs=1e-8)


def test_steps_that_are_taken_back_do_not_strike_twice(parts: Callable[..., Mapping[str, Component]]) -> None:
    machine = Machine(parts(), CHAIN)
    outcome = run_machine(machine, Adaptive(machine, 1e-3), TimeGrid.of(1.0, 0.1), START)
    assert outcome.error is None
    assert sum(part.statistics.rollbacks for part in machine.parts.values()) > 10
    assert machine.get(["a.strikes", "b.sum", "c.sum", "c.seen_now"]) == [4, 10.0, 10.0, 4]


def test_an_instance_alone_goes_through_its_events(pulse: Path) -> None:
    with open_fmu(pulse) as fmu, fmu.instantiate("alone") as alone:
        alone.initialize(0.0, 1.0)
        alone.step(0.0, 0.6)
        assert alone.get(["strikes"]) == [1]
        alone.set({"seen": 7})
        assert alone.get(["seen_now"]) == [7]
        state = alone.save()
        alone.step(0.6, 0.4)
        alone.restore(state)
        alone.step(0.6, 0.4)
        assert alone.get(["strikes"]) == [2]
        alone.free_state(state)
        with pytest.raises(FmuError, match="fmi3GetInt32"):
            alone.get(["number"])


def test_an_instance_alone_stops_at_events_that_it_announces(pulse: Path) -> None:
    """By nextEventTime of fmi3UpdateDiscreteStates; steps beyond them are refused by this FMU."""
    with open_fmu(pulse) as fmu, fmu.instantiate("alone") as alone:
        alone.set({"alarm": 0.15, "period": 0.0})
        alone.initialize(0.0, 1.0)
        alone.step(0.0, 0.1)
        state = alone.save()
        for _ in range(2):
            alone.step(0.1, 0.4)
            assert alone.get(["alarms"]) == [3]
            alone.restore(state)
        alone.free_state(state)
        assert alone.advance(0.1, 0.4) == pytest.approx(0.15, abs=1e-12)
        assert alone.get(["alarms"]) == [1]


@pytest.mark.parametrize("opener", [here, apart])
@pytest.mark.parametrize("algorithm", list(ALGORITHMS))
def test_machines_stop_at_announced_events(
    parts: Callable[..., Mapping[str, Component]], algorithm: str, opener: Opener
) -> None:
    """What follows hears of them at once where events count, else at the end of the step."""
    links = (Connection("a.alarms", "b.seen"),)
    machine = Machine(parts(opener), links)
    recorder = Recorder([machine.description.variable(name) for name in ("a.alarms", "b.seen_now")])
    start = {**START, "a.period": 0.0, "a.alarm": 0.15}
    outcome = run_machine(machine, ALGORITHMS[algorithm](machine), TimeGrid.of(1.0, 0.1), start, [recorder])
    assert outcome.error is None
    table = recorder.table()
    times = table["time"].to_numpy()
    assert ({0.15, 0.45, 0.75} <= set(np.round(times, 9))) == (algorithm == "event_aware")
    for name in ("a.alarms", "b.seen_now"):
        assert table[name].to_numpy() == pytest.approx(np.floor(times / 0.15 + 1e-6)), name


def test_an_iteration_without_end_is_told(
    parts: Callable[..., Mapping[str, Component]], monkeypatch: pytest.MonkeyPatch
) -> None:
    components = parts()
    mode = event_mode_of(components["a"])
    monkeypatch.setattr(mode, "update", lambda: True)
    outcome = run_machine(Machine(components), Jacobi(), TimeGrid.of(1.0, 0.1), START)
    assert outcome.error is not None
    assert "do not settle in 1000 updates" in str(outcome.error)


@pytest.mark.parametrize(
    ("source", "target", "message"),
    [
        ("a.tick", "b.weight", "Clock to Integer cannot be converted"),
        ("a.strikes", "b.poke", "Integer to Clock cannot be converted"),
        ("a.poke", "b.poke", "the source is no output"),
        ("a.tick", "b.echo", "the target is no input"),
    ],
)
def test_clocks_go_to_clocks(
    parts: Callable[..., Mapping[str, Component]], source: str, target: str, message: str
) -> None:
    with pytest.raises(UsageError, match=message):
        Machine(parts(), [Connection(source, target)])


def test_a_clock_has_one_connection(parts: Callable[..., Mapping[str, Component]]) -> None:
    with pytest.raises(UsageError, match=r"b\.poke has two connections"):
        Machine(parts(), [Connection("a.tick", "b.poke"), Connection("c.tick", "b.poke")])


FILE = """
[run]
stop_time = 1.0
step = 0.1
algorithm = "event_aware"
[component.a]
file = "{path}"
[component.b]
file = "{path}"
[component.b.set]
period = 0.0
[[connect]]
from = "a.tick"
to = "b.poke"
[[connect]]
from = "a.number"
to = "b.weight"
"""


def command(*words: str) -> tuple[int, str]:
    done = CliRunner().invoke(main, list(words))
    return done.exit_code, " ".join(done.output.split())


def test_a_file_connects_clocks(pulse: Path, tmp_path: Path) -> None:
    file = tmp_path / "chain.toml"
    file.write_text(FILE.format(path=pulse), encoding="utf-8")
    code, said = command("machine", "run", str(file), "-o", str(tmp_path / "out"))
    assert code == 0, said
    assert "By clocks: a.tick -> b.poke, a.number -> b.weight. They are passed on in event mode" in said
    assert "No derivative is known" not in said
    table = pd.read_parquet(tmp_path / "out" / "results.parquet")
    n = np.floor(table["time"].to_numpy() / 0.25 + 1e-6)
    assert table["b.sum"].to_numpy() == pytest.approx(n * (n + 1) / 2)
    assert "a.number" not in table
    code, said = command("machine", "export", str(file), "-o", str(tmp_path / "x.ssp"))
    assert (code, "a.tick -> b.poke is one of clocks, which SSP 1.0 does not know" in said) == (2, True)
    code, said = command("machine", "container", str(file), "-o", str(tmp_path / "X.fmu"))
    assert (code, "The FMU of a has clocks, so it needs event mode, which fmpy's container does not" in said) == (
        2,
        True,
    )


@pytest.mark.parametrize(
    ("signal", "message"),
    [("a.number", "'a.number' ticks by a.tick: it has a value at events only"), ("a.tick", "'a.tick' is a clock")],
)
def test_what_ticks_is_not_recorded(pulse: Path, tmp_path: Path, signal: str, message: str) -> None:
    file = tmp_path / "chain.toml"
    file.write_text(FILE.format(path=pulse) + f'[record]\nsignals = ["{signal}"]\n', encoding="utf-8")
    code, said = command("machine", "check", str(file))
    assert code == 2
    assert message in said
