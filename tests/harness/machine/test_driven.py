"""Inputs of a machine that a table drives: when they are set, and how they go on."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from harness.fmu.description import Value, Variable
from harness.fmu.interface import Observable
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.part import Extrapolation
from harness.machine.running import run_machine
from harness.machine.stepping import Adaptive, EventAware, GaussSeidel, Jacobi
from harness.run.inputs import InputSignals
from harness.run.master import Ending, TimeGrid
from tests.harness.machine.fakes import Wheel
from tests.harness.machine.linear import mass

SECOND_ORDER = 3.9  # of the errors of a step and its half


def ramp(machine: Machine, name: str) -> InputSignals:
    """From 0 to 1 within a second."""
    return InputSignals((machine.description.variable(name),), np.array([0.0, 1.0]), np.array([[0.0], [1.0]]))


class Looks:
    """An observer that notes variables at communication points."""

    def __init__(self, *names: str) -> None:
        self.names, self.seen = names, list[list[Value]]()

    def started(self, unit: Observable, time: float) -> None:
        self.stepped(unit, time)

    def stepped(self, unit: Observable, time: float) -> None:
        self.seen.append([time, *unit.get(self.names)])


@pytest.mark.parametrize("extrapolation", list(Extrapolation))
def test_what_follows_a_driven_input_at_once_is_passed_on_at_once(extrapolation: Extrapolation) -> None:
    machine = Machine(
        {"one": Wheel("one"), "two": Wheel("two")}, [Connection("one.drag", "two.torque", gain=-1.0)], extrapolation
    )
    looks = Looks("one.torque", "two.torque")
    run_machine(machine, Jacobi(), TimeGrid.of(1.0, 0.1), {}, [looks], ramp(machine, "one.torque"))
    assert looks.seen == [pytest.approx([k / 10] * 3) for k in range(11)]


@pytest.mark.parametrize("slopes", [True, False])
@pytest.mark.parametrize("algorithm", [Jacobi, GaussSeidel, EventAware, Adaptive])
def test_a_driven_input_goes_on_with_the_table(algorithm: type, slopes: bool) -> None:
    """A ramp of the force moves a mass by t^3 / 6."""

    def error(step: float) -> float:
        one = mass("one", k=0.0, start=(0.0, 0.0), slopes=slopes)
        machine = Machine({"one": one}, [], Extrapolation.DERIVATIVES)
        made = {Adaptive: lambda: Adaptive(machine, 0.5), EventAware: lambda: EventAware(machine)}
        outcome = run_machine(
            machine, made.get(algorithm, algorithm)(), TimeGrid.of(1.0, step), {}, (), ramp(machine, "one.force")
        )
        assert outcome.ending is Ending.COMPLETED
        assert machine.get(["one.v"])[0] == pytest.approx(0.5, rel=1e-12)
        return abs(float(machine.get(["one.x"])[0]) - 1 / 6)

    if slopes:
        assert error(0.1) < 1e-12
    else:
        assert error(0.1) > SECOND_ORDER * error(0.05) > 0.0


def test_held_inputs_are_those_of_the_beginning() -> None:
    machine = Machine({"one": mass("one", k=0.0, start=(0.0, 0.0))})
    run_machine(machine, Jacobi(), TimeGrid.of(1.0, 0.25), {}, (), ramp(machine, "one.force"))
    assert machine.get(["one.v"]) == [pytest.approx((0.0 + 0.25 + 0.5 + 0.75) / 4)]


def test_what_is_no_real_changes_when_the_table_does_and_is_put_back_with_its_part() -> None:
    told = []

    class Switched(Wheel):
        def __init__(self) -> None:
            super().__init__(impacts=(0.52,))
            self.description.variables["brake"] = Variable("brake", 99, "Boolean", "input")
            self.values["brake"] = False

        def set(self, values: Mapping[str, Value]) -> None:
            told.append(dict(values))
            super().set(values)

        def restore(self, state: object) -> None:
            told.append({"restored": self.values["brake"]})
            super().restore(state)

    machine = Machine({"one": Switched()}, [], Extrapolation.DERIVATIVES)
    table = InputSignals(
        (machine.description.variable("one.brake"),), np.array([0.0, 0.3, 1.0]), np.array([[0.0], [1.0], [1.0]])
    )
    looks = Looks("one.brake")
    run_machine(machine, EventAware(machine), TimeGrid.of(1.0, 0.1), {}, [looks], table)
    assert [bool(brake) for _, brake in looks.seen] == [float(str(time)) >= 0.3 for time, _ in looks.seen]
    assert told == [{"brake": False}, {"brake": True}, {"restored": True}, {"brake": True}]


class Told(Wheel):
    """Notes what it is told, and which of its variables are bound as Reals for that."""

    def __init__(self, fmi: int, *, continuous: bool) -> None:
        super().__init__("one", speed=0.0)
        variables = dict(self.description.variables)
        variables["torque"] = replace(variables["torque"], continuous=continuous)
        self.description = replace(self.description, variables=variables, fmi=fmi, takes_slopes=False)
        self.told: list[float] = []

    def set(self, values: Mapping[str, Value]) -> None:
        self.told.append(float(values["torque"]))
        super().set(values)


@pytest.mark.parametrize("algorithm", [Jacobi, GaussSeidel, EventAware])
def test_a_discrete_real_of_fmi_3_changes_at_communication_points_only(algorithm: type) -> None:
    """Its values may change in the event mode only (FMI 3.0, section 2.4.7.4): held in each step."""
    one = Told(3, continuous=False)
    machine = Machine({"one": one}, [], Extrapolation.DERIVATIVES)
    table = InputSignals(
        (machine.description.variable("one.torque"),), np.array([0.0, 0.3, 1.0]), np.array([[0.0], [0.3], [0.3]])
    )
    made = EventAware(machine) if algorithm is EventAware else algorithm()
    run_machine(machine, made, TimeGrid.of(0.5, 0.1), {}, (), table)
    assert one.told == pytest.approx([0.0, 0.1, 0.2, 0.3])
    assert one.values["speed"] == pytest.approx(0.1 * (0.0 + 0.1 + 0.2 + 0.3 + 0.3))


@pytest.mark.parametrize(("fmi", "continuous"), [(3, True), (2, False), (2, True)])
def test_any_other_real_goes_on_during_a_step(fmi: int, continuous: bool) -> None:
    """Held at the mean of its values at both ends, it turns the wheel as the ramp itself does."""
    one = Told(fmi, continuous=continuous)
    machine = Machine({"one": one}, [], Extrapolation.DERIVATIVES)
    run_machine(machine, Jacobi(), TimeGrid.of(0.5, 0.1), {}, (), ramp(machine, "one.torque"))
    assert one.values["speed"] == pytest.approx(0.125, rel=1e-12)
    assert {0.05, 0.15, 0.25, 0.35, 0.45} <= {round(value, 12) for value in one.told}
