"""Impacts are felt by the neighbours when they happen."""

import math

import numpy as np
import pytest

from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.part import Extrapolation
from harness.machine.running import run_machine
from harness.machine.stepping import Algorithm, EventAware, Jacobi
from harness.run.master import TimeGrid
from tests.harness.machine.ball import Ball, G
from tests.harness.machine.linear import Linear, mass, mass_and_spring

STOP, STEP = 1.9, 5e-3
RATE = 2.0


def follower(**how: bool) -> Linear:
    """A lag behind the ball's speed."""
    return Linear("lag", ([[-RATE]], [[RATE]], [[1]], [[0]]), {"u": "m/s"}, {"y": "m/s"}, (0.0,), **how)


def felt(time: float) -> tuple[float, list[float]]:
    """The exact lag, and the times of the impacts: the speed is a straight line between them."""
    y, v, now, impacts = 0.0, 0.0, 0.0, []
    fall = math.sqrt(2.0 / G)
    while True:
        span = min(fall, time - now)
        decay = math.exp(-RATE * span)
        # y' = RATE (v - G t - y)
        y = y * decay + (v + G / RATE) * (1 - decay) - G * span
        now += span
        if span < fall:
            return y, impacts
        impacts.append(now)
        v = -0.7 * (v - G * fall)
        fall = 2 * v / G


class Collected:
    """All impacts that could be read at ends of steps."""

    def __init__(self) -> None:
        self.times: list[float] = []
        self.ends: list[float] = []

    def started(self, unit: Machine, time: float) -> None:
        pass

    def stepped(self, unit: Machine, time: float) -> None:
        self.ends.append(time)
        if unit.get(["ball.impacts_in_step"])[0]:
            self.times.append(float(unit.get(["ball.impacts[1].time"])[0]))


def machine_of(ball: Ball, lag: Linear) -> Machine:
    return Machine({"lag": lag, "ball": ball}, [Connection("ball.v", "lag.u")], Extrapolation.DERIVATIVES)


def error(machine: Machine, algorithm: Algorithm, collected: Collected | None = None) -> float:
    run_machine(machine, algorithm, TimeGrid.of(STOP, STEP), {}, [collected or Collected()])
    return abs(float(machine.get(["lag.y"])[0]) - felt(STOP)[0])


def test_a_neighbour_feels_an_impact_when_it_happens() -> None:
    """To the nanosecond of the clock, where fixed steps are off by a good part of the step."""
    machine = machine_of(Ball(), follower())
    collected = Collected()
    aware = error(machine, EventAware(machine), collected)
    assert aware < 1e-7
    assert error(machine_of(Ball(), follower()), Jacobi()) > 1e-3
    _, impacts = felt(STOP)
    assert len(impacts) == 4
    np.testing.assert_allclose(collected.times, impacts, rtol=0, atol=1e-12)
    for time in impacts:
        assert min(end - time for end in collected.ends if end >= time) <= 1.001e-9
    assert machine.parts["lag"].statistics.rollbacks == len(impacts)


def test_one_that_returns_early_is_not_put_back() -> None:
    machine = machine_of(Ball(early=True), follower())
    assert error(machine, EventAware(machine)) < 1e-7
    assert machine.parts["ball"].statistics.rollbacks == 0
    assert machine.parts["lag"].statistics.rollbacks == 4


def test_one_that_cannot_be_put_back_waits_until_the_end_is_known() -> None:
    machine = machine_of(Ball(), follower(restores=False))
    algorithm = EventAware(machine)
    assert error(machine, algorithm) < 1e-7
    assert algorithm.felt_late == []
    assert machine.parts["lag"].statistics.rollbacks == 0


@pytest.mark.parametrize("extrapolation", list(Extrapolation))
def test_one_that_waits_is_given_what_the_others_were_at_the_beginning(extrapolation: Extrapolation) -> None:
    """Without impacts, it is Jacobi's scheme, though the source has gone on when the last one takes the step."""
    seen = []
    for scheme in (EventAware, lambda _: Jacobi()):
        parts = {"one": mass("one", told=False), "two": mass_and_spring("two", restores=False)}
        machine = Machine(parts, [Connection("one.x", "two.led", rate="one.v")], extrapolation)
        run_machine(machine, scheme(machine), TimeGrid.of(1.0, 0.1), {})
        seen.append(machine.get(["one.x", "two.x", "two.v", "two.led"]))
    assert seen[0] == seen[1]


def test_impacts_of_one_that_cannot_be_put_back_are_felt_at_the_end_of_the_step() -> None:
    machine = machine_of(Ball(restores=False), follower())
    algorithm = EventAware(machine)
    assert algorithm.felt_late == ["ball"]
    assert error(machine, algorithm) == pytest.approx(error(machine_of(Ball(), follower()), Jacobi()), rel=1e-12)


def test_the_first_of_two_impacts_in_a_step_decides() -> None:
    high, low = Ball("high", height=1.0), Ball("low", height=0.99)
    machine = Machine({"high": high, "low": low})
    ends = Collected()
    ends.stepped = lambda unit, time: ends.ends.append(time)  # type: ignore[method-assign]
    run_machine(machine, EventAware(machine), TimeGrid.of(0.5, 0.5), {}, [ends])
    expected = [math.sqrt(2 * height / G) for height in (0.99, 1.0)]
    assert ends.ends[:2] == pytest.approx(expected, abs=1.001e-9)
    assert ends.ends[2] == 0.5
