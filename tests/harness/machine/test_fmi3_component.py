"""FMUs of FMI 3.0: as FMUs of FMI 2.0 are run alone, and with early returns in a machine."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from harness.errors import FmuError
from harness.fmu import Fmu, open_fmu
from harness.fmu.description_file import read_description
from harness.fmu.instances.common import FmuSlave
from harness.fmu.interface import Observable
from harness.machine.machine import Machine
from harness.machine.running import run_machine
from harness.machine.stepping import EventAware
from harness.run.experiment import Experiment, perform
from harness.run.master import SECOND, TimeGrid
from harness.run.validate import validate
from mechanism_fmu.fmu.native.package import build_native_fmu
from tests.fmu.native.scenes3 import ROUGH

IMPACT = 0.939921176932


@pytest.fixture(scope="module")
def path3(built: Callable[..., Path]) -> Path:
    """The ratchet's FMU of FMI 3.0."""
    return built("ratchet", build_native_fmu, fmi=3)


@pytest.fixture(scope="module")
def fmu3(path3: Path) -> Iterator[Fmu]:
    with open_fmu(path3) as fmu:
        yield fmu


@pytest.fixture
def early(fmu3: Fmu) -> Iterator[FmuSlave]:
    """An instance that returns at its impacts."""
    with fmu3.instantiate("ratchet", early_return=True) as slave:
        slave.initialize(0.0, 6.0)
        yield slave


def test_variables_are_those_of_fmi_2(path3: Path, native_ratchet_fmu: Path) -> None:
    three, two = read_description(path3), read_description(native_ratchet_fmu)
    assert (three.fmi, two.fmi) == (3, 2)
    indicators = {name for name in three.variables if name.startswith("event_indicator[")}
    assert three.variables.keys() - {"time"} - indicators == two.variables.keys()
    for name in three.variables.keys() & two.variables.keys():
        one, other = three.variables[name], two.variables[name]
        assert (one.type, one.unit, one.causality, one.start) == (other.type, other.unit, other.causality, other.start)
    assert not three.has_clocks
    assert (three.has_event_mode, three.returns_early, three.saves_state, three.takes_slopes) == (
        True,
        True,
        True,
        False,
    )


def test_a_run_is_that_of_fmi_2(fmu3: Fmu, native_ratchet_fmu: Path, tmp_path: Path) -> None:
    torque = tmp_path / "drive.csv"
    torque.write_text("time [s],load_torque [N.mm]\n0,0\n2,0.1\n")
    experiment = Experiment(2.0, 0.01, ROUGH, torque)
    with open_fmu(native_ratchet_fmu) as fmu2:
        two = perform(fmu2, experiment)
    three = perform(fmu3, experiment)
    assert len(three.impacts) > 3
    assert three.impacts.equals(two.impacts)
    assert three.events.equals(two.events)
    assert three.results.equals(two.results)
    assert three.parameters == two.parameters
    assert three.checks == two.checks


def test_it_is_validated(fmu3: Fmu) -> None:
    checks = list(validate(fmu3))
    assert len(checks) == 7
    assert all(check.passed for check in checks), checks


def test_a_step_ends_at_an_impact_and_goes_on_from_there(fmu3: Fmu, early: FmuSlave) -> None:
    reached = early.advance(0.0, 1.2)
    assert reached == pytest.approx(IMPACT, abs=1e-10)
    assert early.get(["impacts_in_step", "impacts[1].time", "time"]) == [1, reached, reached]
    rounded = round(reached * SECOND) / SECOND
    assert early.advance(rounded, 1.2 - rounded) == 1.2
    assert early.get(["impacts_in_step", "time"]) == [0, 1.2]
    names = ["wheel_angle", "wheel_speed", "impact_time"]
    with fmu3.instantiate("whole") as whole:
        whole.initialize(0.0, 6.0)
        assert whole.advance(0.0, 1.2) == 1.2
        assert whole.get(names) == early.get(names)


def test_a_whole_step_goes_on_behind_impacts(early: FmuSlave) -> None:
    early.step(0.0, 1.2)
    assert early.get(["time", "impact_count"]) == [1.2, 1]


def test_bound_numbers(early: FmuSlave) -> None:
    torque, angles = early.reals(["drive_torque"]), early.reals(["wheel_angle", "crank_angle"])
    torque.values[0] = 2e-3
    torque.write()
    assert early.get(["drive_torque"]) == [2e-3]
    early.advance(0.0, 0.1)
    angles.read()
    assert list(angles.values) == early.get(["wheel_angle", "crank_angle"])
    assert angles.read_slopes()
    assert list(angles.values) == pytest.approx(early.get(["wheel_speed", "crank_speed"]), rel=1e-12)
    assert not early.reals(["contact_force"]).read_slopes()
    times = early.reals(["impacts[1].time", "impacts[8].time"])
    times.read()
    assert list(times.values) == early.get(["impacts[1].time", "impacts[8].time"])
    assert not times.read_slopes()


def test_a_snapshot_knows_where_a_step_was_left(early: FmuSlave) -> None:
    reached = early.advance(0.0, 1.0)
    state = early.save()
    rounded = round(reached * SECOND) / SECOND
    early.advance(rounded, 1.1 - rounded)
    first = early.get(["wheel_angle", "wheel_speed"])
    early.restore(state)
    early.advance(rounded, 1.1 - rounded)
    assert early.get(["wheel_angle", "wheel_speed"]) == first
    early.free_state(state)


def test_a_refusal_has_the_fmus_own_words(early: FmuSlave) -> None:
    early.advance(0.0, 0.1)
    with pytest.raises(
        FmuError, match=r"ratchet failed at t = 0\.1 s \(fmi3SetFloat64, status error\): .*drive_torque"
    ):
        early.set({"drive_torque": float("nan")})
    with pytest.raises(FmuError, match=r"ratchet failed at t = 3 s \(fmi3DoStep, status error\): .*is not the time"):
        early.advance(3.0, 0.1)


def test_a_machine_ends_its_step_at_the_impact(early: FmuSlave) -> None:
    class Times:
        def __init__(self) -> None:
            self.seen: list[float] = []

        def started(self, unit: Observable, time: float) -> None:
            pass

        def stepped(self, unit: Observable, time: float) -> None:
            self.seen.append(time)

    early.reset()
    machine, times = Machine({"ratchet": early}), Times()
    outcome = run_machine(machine, EventAware(machine), TimeGrid.of(1.2, 0.1), {}, [times])
    assert outcome.error is None
    between = [time for time in times.seen if round(time * 10, 6) % 1]
    assert between == [pytest.approx(IMPACT, abs=1e-9)]
    assert machine.parts["ratchet"].statistics.rollbacks == 0
