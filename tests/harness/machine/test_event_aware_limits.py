"""What `EventAware` does where it cannot do what it is for: parts that cannot be put back, and steps without an end."""

import pytest

from harness.machine import stepping
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.part import Extrapolation
from harness.machine.stepping import EventAware
from harness.run.master import SECOND
from tests.harness.machine.fakes import Wheel

STEP = SECOND // 10
#: What the step after an impact has of a whole one.
SHORTER = STEP // 16


def of(*wheels: Wheel, extrapolation: Extrapolation = Extrapolation.DERIVATIVES) -> tuple[Machine, EventAware]:
    machine = Machine({wheel.name: wheel for wheel in wheels}, [Connection("other.drag", "one.torque")], extrapolation)
    machine.initialize(0, SECOND)
    return machine, EventAware(machine)


class Hasty(Wheel):
    """Returns early from every step, at a part of it; one of a few nanoseconds it takes as a whole."""

    def __init__(self, name: str, speed: float, share: float) -> None:
        super().__init__(name, speed=speed)
        self._share = share

    def advance(self, time: float, size: float) -> float:
        size = size if size < 50e-9 else self._share * size
        return super().advance(time, size)


def test_after_an_impact_of_one_that_cannot_be_put_back_the_next_step_is_shorter() -> None:
    machine, algorithm = of(Wheel("one", (0.05,), restores=False), Wheel("other"))
    assert algorithm.advance(machine, 0, STEP) == STEP
    assert algorithm.advance(machine, STEP, 2 * STEP) == STEP + SHORTER
    assert algorithm.advance(machine, STEP + SHORTER, 2 * STEP) == 2 * STEP


def test_after_a_quiet_step_of_one_that_cannot_be_put_back_it_is_not() -> None:
    machine, algorithm = of(Wheel("one", (0.95,), restores=False), Wheel("other"))
    assert algorithm.advance(machine, 0, STEP) == STEP
    assert algorithm.advance(machine, STEP, 2 * STEP) == 2 * STEP


def test_held_inputs_need_no_shorter_step() -> None:
    machine, algorithm = of(Wheel("one", (0.05,), restores=False), Wheel("other"), extrapolation=Extrapolation.CONSTANT)
    assert algorithm.advance(machine, 0, STEP) == STEP
    assert algorithm.advance(machine, STEP, 2 * STEP) == 2 * STEP


def test_an_impact_of_either_kind_counts() -> None:
    """One that is put back strikes, one that cannot be does not: the step is not quiet for that."""
    machine, algorithm = of(Wheel("one", (0.95,), restores=False), Wheel("other", (0.05,)))
    assert algorithm.advance(machine, 0, STEP) == SECOND // 20
    assert algorithm.advance(machine, SECOND // 20, STEP) == SECOND // 20 + (STEP - SECOND // 20) // 16


def test_the_outputs_of_all_have_jumped_after_it(monkeypatch: pytest.MonkeyPatch) -> None:
    machine, algorithm = of(Wheel("one", (0.05,), restores=False), Wheel("other"))
    jumped: list[str] = []
    for name, part in machine.parts.items():
        monkeypatch.setattr(part.outputs, "jumped", lambda name=name: jumped.append(name))
    algorithm.advance(machine, 0, STEP)
    assert sorted(jumped) == ["one", "other"]
    algorithm.advance(machine, STEP, 2 * STEP)
    assert sorted(jumped) == ["one", "other"]


def test_a_step_that_is_never_agreed_on_ends_after_twenty_repeats() -> None:
    """Each time one of two takes it again, it returns before the other; in the end both go where the last goal was."""
    one, other = Hasty("one", 2.0, 0.9), Hasty("other", 3.0, 0.8)
    machine, algorithm = of(one, other)
    end = algorithm.advance(machine, 0, STEP)
    assert stepping._MOST_REPEATS == 20
    assert end == pytest.approx(STEP * (0.9 * 0.8) ** 10, abs=20)
    assert [part.statistics.rollbacks for part in machine.parts.values()] == [10, 10]
    # both are at the end, whoever returned early on the way
    assert one.values["angle"] == pytest.approx(2.0 * end / SECOND, rel=1e-6)
    assert other.values["angle"] == pytest.approx(3.0 * end / SECOND, rel=1e-6)
    # and the next step is a careful one: a sixteenth, of which the earlier one has four fifths
    asked = (STEP - end) // 16
    assert algorithm.advance(machine, end, STEP) <= end + 0.8 * asked
