import numpy as np
import pytest
from fake_slave import FakeSlave, fake_description

from harness.analysis.impacts import ImpactCollector
from harness.errors import FmuError, Status
from harness.fmu.description import Value
from harness.fmu.interface import Observable
from harness.run.inputs import InputSignals
from harness.run.master import Ending, Recorder, TimeGrid, recorded_variables, run_fixed_step

GRID = TimeGrid.of(stop_time=1.0, step=0.3)


def test_every_step_begins_where_the_last_one_ended() -> None:
    """The clock's own test has a million."""
    slave = FakeSlave()
    outcome = run_fixed_step(slave, TimeGrid.of(stop_time=100.0, step=1e-3), {})
    assert (outcome.ending, outcome.final_time, outcome.steps) == (Ending.COMPLETED, 100.0, 10**5)
    assert [time for time, _ in slave.calls] == [k / 1000 for k in range(10**5)]
    assert slave.log == ["initialize", "terminate"]


def test_the_last_step_is_shortened_to_end_at_the_stop_time() -> None:
    slave = FakeSlave()
    outcome = run_fixed_step(slave, GRID, {})
    assert outcome.final_time == 1.0
    assert [size for _, size in slave.calls] == pytest.approx([0.3, 0.3, 0.3, 0.1])
    assert sum(slave.calls[-1]) == 1.0


def test_start_values_are_set_before_the_initialization() -> None:
    class Strict(FakeSlave):
        def initialize(self, start_time: float, stop_time: float) -> None:
            assert self.values["tooth_count"] == 20

    assert run_fixed_step(Strict(), GRID, {"tooth_count": 20}).ending is Ending.COMPLETED


def test_inputs_have_the_value_of_the_beginning_of_the_step() -> None:
    class Watching(FakeSlave):
        def step(self, time: float, size: float) -> None:
            seen.append(self.values["drive_torque"])

    seen: list[Value] = []
    torque = fake_description().variables["drive_torque"]
    signals = InputSignals((torque,), np.array([0.0, 1.0]), np.array([[0.0], [10.0]]))
    run_fixed_step(Watching(), GRID, {}, inputs=signals)
    assert seen == pytest.approx([0.0, 3.0, 6.0, 9.0])


@pytest.mark.parametrize("status", [Status.DISCARD, Status.ERROR, Status.FATAL])
def test_a_step_that_is_refused_ends_the_run_and_keeps_what_was_seen(status: Status) -> None:
    slave = FakeSlave(fail=lambda time: status if time >= 0.6 else None)
    recorder = Recorder(recorded_variables(slave.description))
    outcome = run_fixed_step(slave, GRID, {}, [recorder])
    assert outcome.ending is Ending.FAILED
    assert outcome.final_time == 0.6
    assert isinstance(outcome.error, FmuError)
    assert outcome.error.status is status
    assert "refused at 0.6 s" in str(outcome.error)
    assert list(recorder.table()["time"]) == [0.0, 0.3, 0.6]
    assert "terminate" not in slave.log


def test_a_failing_initialization_ends_the_run() -> None:
    class Broken(FakeSlave):
        def initialize(self, start_time: float, stop_time: float) -> None:
            raise FmuError("cannot be assembled")

    outcome = run_fixed_step(Broken(), GRID, {})
    assert (outcome.ending, outcome.steps, str(outcome.error)) == (Ending.FAILED, 0, "cannot be assembled")


def test_a_request_ends_the_run_at_a_communication_point() -> None:
    slave = FakeSlave()
    outcome = run_fixed_step(slave, GRID, {}, stop_requested=lambda: len(slave.calls) == 2)
    assert (outcome.ending, outcome.final_time) == (Ending.INTERRUPTED, 0.6)
    assert slave.log == ["initialize", "terminate"]


def test_a_mistake_in_an_observer_is_not_taken_for_a_failure_of_the_fmu() -> None:
    class Careless:
        def started(self, unit: Observable, time: float) -> None:
            raise ZeroDivisionError

        def stepped(self, unit: Observable, time: float) -> None: ...

    with pytest.raises(ZeroDivisionError):
        run_fixed_step(FakeSlave(), GRID, {}, [Careless()])


def test_the_recorder_keeps_types_and_leaves_arrays_out() -> None:
    slave = FakeSlave(impacts=[0.5])
    recorder = Recorder(recorded_variables(slave.description))
    run_fixed_step(slave, GRID, {}, [recorder])
    table = recorder.table()
    assert list(table.columns) == [
        *("time", "drive_torque", "gear", "brake", "wheel_angle"),
        *("impact_count", "impact", "impacts_in_step", "impacts_lost"),
    ]
    assert list(table["impact"]) == [False, False, True, False, False]
    assert table["impact_count"].dtype == "int64"
    assert list(table["wheel_angle"]) == list(table["time"])


def test_all_impacts_of_a_step_are_collected() -> None:
    times = [0.1, 0.2, 0.25, 0.95]
    slave = FakeSlave(times)
    collector = ImpactCollector(slave.description)
    run_fixed_step(slave, GRID, {}, [collector])
    assert list(collector.table()["time"]) == times
    assert list(collector.table()["velocity"]) == [-2 * time for time in times]
    assert collector.lost == 0


def test_impacts_beyond_the_buffer_are_counted_as_lost() -> None:
    times = [0.01 * k for k in range(1, 12)]
    slave = FakeSlave([*times, 0.95])
    collector = ImpactCollector(slave.description)
    run_fixed_step(slave, GRID, {}, [collector])
    assert list(collector.table()["time"]) == pytest.approx([*times[:8], 0.95])
    assert collector.lost == 3


def test_an_fmu_without_impacts_has_none() -> None:
    slave = FakeSlave()
    slave.description.variables.pop("impacts_in_step")  # type: ignore[attr-defined]
    collector = ImpactCollector(slave.description)
    run_fixed_step(slave, GRID, {}, [collector])
    assert collector.table().empty
    assert not collector.fields
