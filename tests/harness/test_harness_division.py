"""Steps with more impacts than the FMU's buffer holds: taken in parts, or their impacts are counted."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import pytest

from harness.analysis.impacts import ImpactCollector
from harness.errors import LogMessage, Status
from harness.run.checks import all_passed, run_checks
from harness.run.division import Division, HeldMessages
from harness.run.master import Recorder, TimeGrid, recorded_variables, run_fixed_step
from tests.harness.fake_slave import FakeSlave

GRID = TimeGrid.of(1.0, 0.25)
#: Nine in the second step, and twenty that come ever faster in the third.
CROWDED = [0.3 + 0.01 * k for k in range(9)] + [0.7 - 0.15 * 0.7**k for k in range(20)]


class Restorable(FakeSlave):
    """A `FakeSlave` that can be put back, and says of each step how many impacts were lost."""

    def __init__(self, impacts: Sequence[float], messages: HeldMessages | None = None) -> None:
        super().__init__(impacts)
        self.description = replace(self.description, saves_state=True)
        self.shown = messages or HeldMessages()
        self.states = 0

    def step(self, time: float, size: float) -> None:
        lost = self._lost
        super().step(time, size)
        held = sorted(t for t in self._impacts if time < t <= time + size)[-8:]  # the newest
        for slot, instant in enumerate(held, start=1):
            self.values[f"impacts[{slot}].time"] = instant
        if self._lost != lost:
            message = LogMessage("Fake", time, Status.WARNING, "", f"{self._lost - lost} lost")
            self.messages.append(message)
            self.shown(message)

    def save(self, state: Any = None) -> Any:
        self.states += state is None
        return dict(self.values), self._count, self._lost

    def restore(self, state: Any) -> None:
        values, self._count, self._lost = state
        self.values = dict(values)

    def free_state(self, state: Any) -> None:
        self.states -= 1


def test_every_impact_is_reported_once_and_in_order() -> None:
    shown: list[LogMessage] = []
    messages = HeldMessages(shown.append)
    slave = Restorable(CROWDED, messages)
    collector, recorder = ImpactCollector(slave.description), Recorder(recorded_variables(slave.description))
    outcome = run_fixed_step(slave, GRID, {}, [recorder], collectors=[collector], messages=messages)
    assert collector.table()["time"].tolist() == CROWDED
    assert (collector.lost, outcome.divided, slave.states) == (0, 2, 0)
    assert shown == slave.messages == []
    assert recorder.table()["time"].tolist() == [0.0, 0.25, 0.5, 0.75, 1.0]  # the grid is what was asked for


def test_steps_without_too_many_are_taken_as_they_were_asked_for() -> None:
    slave = Restorable(CROWDED[:8])
    outcome = run_fixed_step(slave, GRID, {})
    assert slave.calls == [(0.0, 0.25), (0.25, 0.25), (0.5, 0.25), (0.75, 0.25)]
    assert outcome.divided == 0


def test_more_at_one_instant_than_there_is_room_for_are_counted_and_no_others_lost() -> None:
    impacts = [*[0.3 + 0.001 * k for k in range(5)], *[0.4] * 11, 0.45]
    slave = Restorable(impacts)
    collector = ImpactCollector(slave.description)
    outcome = run_fixed_step(slave, GRID, {}, collectors=[collector])
    assert collector.table()["time"].tolist() == sorted([*impacts[:5], *[0.4] * 8, 0.45])
    assert collector.lost == 3
    assert [message.text for message in slave.messages] == ["3 lost"]
    checks = run_checks(outcome, 1.0, Recorder([]).table(), collector.table(), collector.lost)
    assert all_passed(checks)


def test_who_cannot_be_put_back_counts() -> None:
    slave = FakeSlave(CROWDED)
    collector, recorder = ImpactCollector(slave.description), Recorder(recorded_variables(slave.description))
    outcome = run_fixed_step(slave, GRID, {}, [recorder], collectors=[collector])
    checks = run_checks(outcome, 1.0, recorder.table(), collector.table(), collector.lost)
    counted = next(check for check in checks if check.claim == "Every impact is counted")
    assert counted.passed
    assert counted.evidence.startswith("16 collected, 29 counted by the FMU, 13 lost")
    assert outcome.divided == 0


def test_messages_of_a_step_that_fails_are_shown() -> None:
    shown: list[LogMessage] = []
    messages = HeldMessages(shown.append)
    slave = Restorable(CROWDED, messages)

    def fail(_time: float, _size: float) -> None:
        messages(LogMessage("Fake", 0.0, Status.ERROR, "", "too stiff"))
        raise RuntimeError

    slave.step = fail  # type: ignore[method-assign]
    with pytest.raises(RuntimeError):
        list(Division(slave, messages).take(0.0, 1.0))
    assert [message.text for message in shown] == ["too stiff"]
