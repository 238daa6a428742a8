"""FMUs of FMI 2.0 as parts of a machine: bound numbers, steps, early returns, states, and what is refused."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from harness.errors import FmuError, LogMessage, Status, UsageError
from harness.fmu import open_fmu
from harness.fmu.instances.common import FmuSlave
from harness.fmu.interface import whole_step
from tests.harness.machine.fake_library import Fake2

DISCARD = int(Status.DISCARD)


@pytest.fixture
def shown() -> list[LogMessage]:
    """Messages that a user has seen."""
    return []


@pytest.fixture
def ratchet(native_ratchet_fmu: Path, shown: list[LogMessage]) -> Iterator[FmuSlave]:
    with open_fmu(native_ratchet_fmu) as fmu, fmu.instantiate("ratchet", shown.append) as slave:
        slave.initialize(0.0, 6.0)
        yield slave


def go(slave: FmuSlave, begin: int, end: int) -> list[float]:
    """Steps of 10 ms, and where the wheel then is."""
    places = []
    for k in range(begin, end):
        slave.step(k / 100, (k + 1) / 100 - k / 100)
        places.append(float(slave.get(["wheel_angle"])[0]))
    return places


def test_bound_numbers_are_those_of_the_variables(ratchet: FmuSlave) -> None:
    inputs = ratchet.reals(["drive_torque", "load_torque"])
    inputs.values[:] = [2e-3, -1e-4]
    inputs.write()
    assert ratchet.get(["load_torque", "drive_torque"]) == [-1e-4, 2e-3]
    outputs = ratchet.reals(["wheel_speed", "wheel_angle"])
    assert ratchet.advance(0.0, 0.1) == 0.1
    outputs.read()
    assert list(outputs.values) == ratchet.get(["wheel_speed", "wheel_angle"])
    assert outputs.values[1] == pytest.approx(math.radians(75), abs=0.1)


def test_nothing_bound_asks_for_nothing(ratchet: FmuSlave) -> None:
    nothing = ratchet.reals([])
    nothing.read()
    nothing.write()
    assert list(nothing.values) == []


def test_what_cannot_be_told_in_the_initialization_mode_is_shown_once_when_it_ends(
    native_ratchet_fmu: Path, shown: list[LogMessage]
) -> None:
    with open_fmu(native_ratchet_fmu) as fmu, fmu.instantiate("ratchet", shown.append) as slave:
        slave.set({"crank_length": 1e-3})
        slave.enter_initialization(0.0, 6.0)
        for _ in range(2):
            with pytest.raises(FmuError, match="crank_length"):
                slave.get(["wheel_angle"])
        assert shown == slave.messages == []
        with pytest.raises(FmuError, match="crank_length"):
            slave.exit_initialization()
    assert len(shown) == 1


def test_slopes_of_inputs_are_those_set_by_fmpy(native_ratchet_fmu: Path) -> None:
    places = []
    with open_fmu(native_ratchet_fmu) as fmu:
        for bound in (False, True):
            with fmu.instantiate("ratchet") as slave:
                slave.initialize(0.0, 6.0)
                torque = slave.reals(["drive_torque"])
                for k in range(20):
                    if bound:
                        torque.values[0] = 5e-3
                        torque.write_slopes()
                    else:
                        reference = fmu.description.variable("drive_torque").reference
                        slave._instance.setRealInputDerivatives([reference], [1], [5e-3])
                    slave.step(k * 0.01, 0.01)
                places.append(slave.get(["wheel_angle", "wheel_speed"]))
    assert places[0] == places[1]


def test_slopes_of_inputs_are_refused_where_there_are_none() -> None:
    inputs = Fake2().reals(["a", "b"])
    with pytest.raises(UsageError, match=r"pump takes no slopes of inputs, here of a, b: .* Write values before each"):
        inputs.write_slopes()


def test_slopes_of_outputs_are_told_where_they_exist(ratchet: FmuSlave, shown: list[LogMessage]) -> None:
    go(ratchet, 0, 10)
    angle = ratchet.reals(["wheel_angle"])
    assert angle.read_slopes()
    assert list(angle.values) == pytest.approx(ratchet.get(["wheel_speed"]), rel=1e-12)
    assert not ratchet.reals(["wheel_angle", "contact_force"]).read_slopes()
    assert not [message for message in [*shown, *ratchet.messages] if message.needs_attention]


def test_a_snapshot_can_be_taken_over_and_over(ratchet: FmuSlave) -> None:
    go(ratchet, 0, 80)
    state = ratchet.save()
    go(ratchet, 80, 90)
    state = ratchet.save(state)
    first = go(ratchet, 90, 100)  # through the impact
    ratchet.restore(state)
    assert go(ratchet, 90, 100) == first
    ratchet.free_state(state)


def test_a_refusal_has_the_fmus_own_words(ratchet: FmuSlave) -> None:
    go(ratchet, 0, 1)
    torque = ratchet.reals(["drive_torque"])
    torque.values[0] = math.nan
    with pytest.raises(FmuError, match=r"ratchet failed at t = 0\.01 s \(fmi2SetReal, status error\): .*drive_torque"):
        torque.write()
    with pytest.raises(
        FmuError, match=r"ratchet failed at t = 5 s \(fmi2DoStep, status error\): .*5 s is not the time"
    ):
        ratchet.advance(5.0, 0.1)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_what_is_no_finite_number_ends_the_run(value: float) -> None:
    def get(_component: Any, _references: Any, _count: Any, values: Any) -> int:
        values[:] = [1.0, value]
        return 0

    pump = Fake2(fmi2GetReal=get)
    outputs = pump.reals(["a", "b"])
    pump.advance(0.0, 0.5)
    with pytest.raises(FmuError, match=rf"pump failed at t = 0\.5 s \(fmi2GetReal\): b is {value}") as caught:
        outputs.read()
    assert (caught.value.instance, caught.value.time) == ("pump", 0.5)


def test_large_numbers_are_finite() -> None:
    def get(_component: Any, _references: Any, _count: Any, values: Any) -> int:
        values[:] = [1.7e308, 1.7e308]
        return 0

    outputs = Fake2(fmi2GetReal=get).reals(["a", "b"])
    outputs.read()
    assert list(outputs.values) == [1.7e308, 1.7e308]


def test_an_fmu_that_logs_every_call_fills_no_memory_and_its_warnings_are_kept() -> None:
    pump = Fake2()
    for number in range(1500):
        pump._log(None, None, 0, b"logFMICalls", f"call {number}".encode())
    pump._log(None, None, 1, b"", b"leaks")
    assert len(pump.messages) == 1001
    assert pump.messages[999].text == "call 999 (More messages of this kind are not kept.)"
    assert pump.messages[-1].text == "leaks"


class Stops:
    """Functions of a library that discards steps at 0.3 s, where it has come to."""

    def __init__(self, reached: float = 0.3, ends: bool = False) -> None:
        self.steps: list[tuple[float, float]] = []
        self._reached, self._ends = reached, ends

    def functions(self) -> dict[str, Any]:
        return {
            "fmi2DoStep": self._step,
            "fmi2GetRealStatus": self._last_time,
            "fmi2GetBooleanStatus": self._terminated,
        }

    def _step(self, _component: Any, begin: float, size: float, _no_way_back: int) -> int:
        self.steps.append((begin, size))
        return DISCARD if begin < 0.29 < begin + size else 0

    def _last_time(self, _component: Any, _kind: int, value: Any) -> int:
        value._obj.value = self._reached
        return 0

    def _terminated(self, _component: Any, _kind: int, value: Any) -> int:
        value._obj.value = int(self._ends)
        return 0


def test_a_part_of_a_step_is_an_early_return() -> None:
    stops = Stops()
    pump = Fake2(**stops.functions())
    assert pump.advance(0.2, 0.2) == 0.3
    assert pump.advance(0.3, 0.1) == 0.4
    assert stops.steps == [(0.2, 0.2), (0.3, pytest.approx(0.1))]
    Fake2(**Stops().functions()).step(0.2, 0.2)


def test_a_step_goes_on_from_the_very_time_that_was_told() -> None:
    reached = 0.3 - 3e-10
    stops = Stops(reached)
    pump = Fake2(**stops.functions())
    assert pump.advance(0.2, 0.2) == reached
    assert pump.advance(0.3, 0.1) == 0.3 + 0.1
    assert stops.steps[1][0] == reached
    assert sum(stops.steps[1]) == pytest.approx(0.4, rel=1e-15)


@pytest.mark.parametrize(
    "stops", [Stops(reached=0.2), Stops(reached=0.5), Stops(ends=True)], ids=["back", "there", "end"]
)
def test_a_discarded_step_that_has_come_nowhere_is_an_error(stops: Stops) -> None:
    pump = Fake2(**stops.functions())
    with pytest.raises(FmuError, match=r"pump failed at t = 0\.2 s \(fmi2DoStep, status discard\)"):
        pump.advance(0.2, 0.2)


@pytest.mark.parametrize(("status", "taken"), [(0, True), (1, True), (2, False), (3, False)])
def test_where_a_discarded_step_ended_counts_unless_the_answer_is_an_error(status: int, taken: bool) -> None:
    """fmi2OK and fmi2Warning bring a value, fmi2Discard and fmi2Error bring none."""
    stops = Stops()
    functions = stops.functions()
    answer = functions["fmi2GetRealStatus"]
    functions["fmi2GetRealStatus"] = lambda *given: answer(*given) or status
    pump = Fake2(**functions)
    if taken:
        assert pump.advance(0.2, 0.2) == 0.3
    else:
        with pytest.raises(FmuError, match="status discard"):
            pump.advance(0.2, 0.2)


@pytest.mark.parametrize(("status", "ends"), [(0, True), (1, True), (2, False), (3, False)])
def test_an_end_that_an_fmu_wants_counts_unless_the_answer_is_an_error(status: int, ends: bool) -> None:
    functions = Stops(ends=True).functions()
    answer = functions["fmi2GetBooleanStatus"]
    functions["fmi2GetBooleanStatus"] = lambda *given: answer(*given) or status
    pump = Fake2(**functions)
    if ends:
        with pytest.raises(FmuError, match="status discard"):
            pump.advance(0.2, 0.2)
    else:
        assert pump.advance(0.2, 0.2) == 0.3


def test_an_fmu_that_discards_step_after_step_ends_the_run() -> None:
    """A stiff mechanism may spend seconds in each, and need thousands of them."""

    class Crawls(Stops):
        def _step(self, _component: Any, begin: float, size: float, _no_way_back: int) -> int:
            self._reached = begin + 1e-4 * size
            return DISCARD

    pump = Fake2(**Crawls().functions())
    with pytest.raises(FmuError, match=r"20 times it ended a step early that was to reach 0\.4 s"):
        whole_step(pump.advance, 0.2, 0.2)


def test_an_fmu_whose_time_stands_still_ends_the_run() -> None:
    class Still(Stops):
        def _step(self, _component: Any, begin: float, size: float, _no_way_back: int) -> int:
            return DISCARD

    pump = Fake2(**Still(reached=0.3).functions())
    assert pump.advance(0.2, 0.2) == 0.3
    with pytest.raises(FmuError, match=r"pump failed at t = 0\.3 s \(fmi2DoStep, status discard\)"):
        pump.advance(0.3, 0.1)
