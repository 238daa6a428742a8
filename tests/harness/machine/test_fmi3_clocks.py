"""The ratchet with a clock of its impacts (FMI 3.0, --clocks): run alone, in machines, and connected by its clock."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from harness.app.cli import main
from harness.designs.task import UnknownQuantityError, When, quantity
from harness.errors import FmuError
from harness.fmu import Fmu, open_fmu
from harness.fmu.description_file import read_description
from harness.fmu.remote import in_own_process
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.observers.record import chosen
from harness.machine.running import run_machine
from harness.machine.stepping import EventAware, Jacobi
from harness.run.experiment import Experiment, perform
from harness.run.master import Recorder, TimeGrid
from harness.run.validate import validate
from mechanism_fmu.fmu.native.package import build_native_fmu
from tests.fmu.native.scenes3 import ROUGH
from tests.harness.machine.foreign import in_c
from tests.once import once

IMPACT, BEHIND = 0.9399211769, 0.0227388573
CLOCK = (
    Connection("ratchet.impact.clock", "counter.poke"),
    Connection("ratchet.impact.tick.tooth", "counter.weight"),
    Connection("ratchet.impact_count", "counter.seen"),
)


@pytest.fixture(scope="module")
def clocked(built: Callable[..., Path]) -> Path:
    """The ratchet's FMU with clock and arrays."""
    return built("ratchet", build_native_fmu, fmi=3, clocks=True)


@pytest.fixture(scope="module")
def fmu(clocked: Path) -> Iterator[Fmu]:
    with open_fmu(clocked) as opened:
        yield opened


@pytest.fixture(scope="module")
def pulse(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """FMI 3.0, in C, with clocks."""
    pytest.importorskip("ziglang")
    return once(tmp_path_factory, "foreign_pulse", in_c.pulse) / "Pulse.fmu"


def test_the_description_knows_clocks_and_what_ticks(clocked: Path) -> None:
    description = read_description(clocked)
    assert description.has_clocks
    clock, tick = description.variable("impact.clock"), description.variable("impact.tick.velocity")
    assert (clock.type, clock.causality, clock.interval) == ("Clock", "output", "triggered")
    assert (tick.type, tick.clocks, tick.settable) == ("Real", ("impact.clock",), False)
    assert not {"impact.clock", "impact.tick.velocity"} & {variable.name for variable in description.of("output")}
    assert description.variable("impacts[3].time").element == 2


def test_a_run_is_that_of_the_plain_form(fmu: Fmu, built: Callable[..., Path]) -> None:
    """It uses the event mode, which the standard wants; it was refused once."""
    experiment = Experiment(2.0, 0.01, ROUGH)
    with open_fmu(built("ratchet", build_native_fmu, fmi=3)) as other:
        plain = perform(other, experiment)
    own = perform(fmu, experiment)
    assert own.outcome.error is None
    assert len(own.impacts) > 3
    assert own.impacts.equals(plain.impacts)
    assert own.events.equals(plain.events)
    names = [name for name in plain.results if name in own.results]
    assert set(plain.results) - set(own.results) <= {"impact"}
    assert own.results[names].equals(plain.results[names])


def test_it_is_validated(fmu: Fmu) -> None:
    checks = list(validate(fmu))
    assert len(checks) == 7
    assert all(check.passed for check in checks), checks


def test_what_ticks_is_refused_in_words(fmu: Fmu) -> None:
    with fmu.instantiate("one") as one:
        one.initialize(0.0, 1.0)
        with pytest.raises(
            FmuError, match=r"impact\.tick\.velocity is clocked; read it in event mode, or read impact_vel"
        ):
            one.get(["impact.tick.velocity"])
    with pytest.raises(UnknownQuantityError, match=r"ticks by impact\.clock: it has a value at events only"):
        quantity(When.END, "impact.tick.velocity", fmu.description)
    with pytest.raises(UnknownQuantityError, match=r"is a clock, which ticks at events"):
        quantity(When.END, "impact.clock", fmu.description)
    with fmu.instantiate("ratchet") as one:
        machine = Machine({"ratchet": one})
        assert chosen(["ratchet.impact.tick.tooth", "ratchet.*"], machine.description)
        assert not chosen(["ratchet.impact.tick.tooth"], machine.description)


@pytest.mark.parametrize("process", [False, True])
@pytest.mark.parametrize("algorithm", ["jacobi", "event_aware"])
def test_a_machine_passes_each_impact_on_by_its_clock(fmu: Fmu, pulse: Path, algorithm: str, process: bool) -> None:
    """The neighbour adds the tooth that was struck, at the impact's own communication point."""
    with ExitStack() as stack:
        other = stack.enter_context(open_fmu(pulse))
        parts = {
            name: stack.enter_context(in_own_process(one, name) if process else one.instantiate(name))
            for name, one in {"counter": other, "ratchet": fmu}.items()
        }
        machine = Machine(parts, CLOCK)
        names = ["impact_count", "impact_time", "impact_tooth", "wheel_speed", "impact_wheel_speed_before"]
        watched = [*(f"ratchet.{name}" for name in names), "counter.sum", "counter.seen_now"]
        recorder = Recorder([machine.description.variable(name) for name in watched])
        scheme = EventAware(machine) if algorithm == "event_aware" else Jacobi()
        start = {f"ratchet.{name}": value for name, value in ROUGH.items()} | {"counter.period": 0.0}
        outcome = run_machine(machine, scheme, TimeGrid.of(1.5, 0.01), start, [recorder])
    assert outcome.error is None
    table = recorder.table()
    struck = np.diff(table["ratchet.impact_count"].to_numpy())
    assert struck.sum() > 2
    ticked = np.diff(table["counter.sum"].to_numpy())
    tooth = table["ratchet.impact_tooth"].to_numpy()[1:]
    assert (ticked == np.where(struck > 0, tooth, 0)).all()
    assert (table["counter.seen_now"] == table["ratchet.impact_count"]).all()


def at_the_impact(table: pd.DataFrame) -> "pd.Series[float]":
    """The row of the first communication point that is not before the impact."""
    return table[table["time"] >= IMPACT - 1e-10].iloc[0]


def test_a_row_at_an_impact_shows_what_comes_after_it(fmu: Fmu, built: Callable[..., Path]) -> None:
    """Right limits, in all forms; what was before is in the outputs that are named so (docs/how-to/machines.md)."""
    for path in (fmu.path, built("ratchet", build_native_fmu, fmi=3), built("ratchet", build_native_fmu)):
        with open_fmu(path) as one, one.instantiate("ratchet") as ratchet:
            machine = Machine({"ratchet": ratchet})
            names = ("wheel_speed", "impact_wheel_speed_before", "impact_wheel_speed")
            recorder = Recorder([machine.description.variable(f"ratchet.{name}") for name in names])
            outcome = run_machine(machine, EventAware(machine), TimeGrid.of(1.2, 0.1), {}, [recorder])
        assert outcome.error is None
        row = at_the_impact(recorder.table())
        assert row["time"] == pytest.approx(IMPACT, abs=2e-9)
        assert row["ratchet.wheel_speed"] == pytest.approx(BEHIND, abs=1e-9)
        assert row["ratchet.impact_wheel_speed"] == pytest.approx(BEHIND, abs=1e-9)
        with open_fmu(path) as one, one.instantiate("before") as ratchet:
            ratchet.initialize(0.0, 1.2)
            ratchet.step(0.0, IMPACT - 1e-8)
            before = ratchet.get(["wheel_speed"])[0]
        assert before == pytest.approx(-7.795e-4, abs=1e-6)  # the spring turns it back
        assert row["ratchet.impact_wheel_speed_before"] == pytest.approx(before, abs=1e-9)


def test_it_is_swept(clocked: Path, tmp_path: Path) -> None:
    sweep = tmp_path / "sweep.toml"
    sweep.write_text(
        f"""[fmu]
file = '{clocked}'
[run]
stop_time = 1.2
step = 0.01
[sweep]
method = "grid"
[vary.restitution]
values = [0.0, 0.3]
[record]
end = ["wheel_speed"]
first_impact = ["time"]
""",
        encoding="utf-8",
    )
    done = CliRunner().invoke(main, ["sweep", str(sweep), "-o", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    table = pd.read_parquet(tmp_path / "out" / "results.parquet")
    assert table["first_impact.time"].tolist() == [pytest.approx(IMPACT, abs=1e-9)] * 2
