"""A design through the FMU gives the numbers of `mechanism-fmu run`, and its failures are told."""

import math
from pathlib import Path

import numpy as np
import pytest
from fake_slave import FakeFmu, FakeSlave

from harness.designs.by_fmu import run_designs
from harness.designs.task import Design, Quantity, Result, Task, When, column, of_impacts
from harness.errors import FmuError, Status
from harness.fmu import open_fmu
from harness.run.experiment import Experiment, perform
from harness.run.master import TimeGrid
from mechanism_fmu.stress import material_card

WHEEL = Quantity(When.END, "wheel_angle", "Real", "rad")
TIME = Quantity(When.FIRST_IMPACT, "time", "Real", "s")
VELOCITY = Quantity(When.LARGEST_IMPACT, "velocity", "Real", "m/s")


def task_of(*quantities: Quantity, step: float = 0.1) -> Task:
    return Task(TimeGrid.of(1.0, step), {"gear": 2}, None, quantities)


def result_of(slave: FakeSlave, *quantities: Quantity, step: float = 0.1) -> Result:
    design = Design(3, {"tooth_count": 12})
    (result,) = run_designs(FakeFmu(slave), task_of(*quantities, step=step), [design])  # type: ignore[arg-type]
    assert slave.values["gear"] == 2
    assert slave.values["tooth_count"] == 12
    assert (result.number, result.way) == (3, "fmu")
    return result


def test_quantities_are_taken_at_their_times() -> None:
    highest = Quantity(When.MAX, "wheel_angle", "Real", "rad")
    lowest = Quantity(When.MIN, "wheel_angle", "Real", "rad")
    pitch = Quantity(When.PARAMETER, "tooth_pitch", "Real", "rad")
    result = result_of(FakeSlave(impacts=[0.25, 0.75]), VELOCITY, highest, TIME, lowest, WHEEL, pitch)
    assert result.values == (-1.5, 1.0, 0.25, 0.0, 1.0, 0)


def test_the_largest_impact_is_one_of_them_with_all_that_is_known_of_it() -> None:
    """Not each field's own maximum: the time is that of the impact with the largest |velocity|."""
    fields = [Quantity(When.LARGEST_IMPACT, name, "Real", "") for name in ("time", "velocity")]
    impacts = {"time": np.array([0.1, 0.2, 0.3]), "velocity": np.array([-0.5, -2.0, 1.0])}
    assert of_impacts(task_of(*fields), impacts, None, {}) == {
        "largest_impact.time": 0.2,
        "largest_impact.velocity": -2.0,
    }


def test_without_an_impact_there_is_nothing_of_it() -> None:
    assert result_of(FakeSlave(), TIME, WHEEL, VELOCITY) == Result(3, "fmu", (None, 1.0, None))


def test_a_design_that_fails_says_why() -> None:
    result = result_of(FakeSlave(fail=lambda time: Status.ERROR if time > 0.45 else None), WHEEL, TIME)
    assert result == Result(3, "fmu", (None, None), "refused at 0.5 s")


def test_a_design_that_cannot_begin_says_why() -> None:
    class Broken(FakeSlave):
        def initialize(self, start_time: float, stop_time: float) -> None:
            raise FmuError("cannot be assembled")

    assert result_of(Broken(), WHEEL).failure == "cannot be assembled"


def test_lost_impacts_are_a_failure_with_the_way_out() -> None:
    slave = FakeSlave(impacts=[0.01 * k for k in range(1, 20)])
    assert "choose a smaller run.step" in (result_of(slave, TIME, step=1.0).failure or "")


def test_whatever_else_goes_wrong_is_a_failure_of_this_design_only() -> None:
    class Odd(FakeSlave):
        def step(self, time: float, size: float) -> None:
            raise ZeroDivisionError("division by zero")

    assert result_of(Odd(), WHEEL).failure == "ZeroDivisionError: division by zero"


@pytest.mark.parametrize(("material", "stress"), [("steel", 6552.677), ("42CrMo4", 6615.989)])
def test_the_numbers_are_those_of_a_run(material: str, stress: float, native_ratchet_fmu: Path) -> None:
    """Of the whole chain, stress included, to the last bit."""
    columns = [
        "end.wheel_angle",
        "max.contact_force",
        "min.kinetic_energy",
        "first_impact.time",
        "first_impact.stress_max",
        "largest_impact.stress_max",
        "parameter.tooth_length",
        "all_impacts.stress",
        "all_impacts.fatigue_safety",
    ]
    values = {"tooth_count": 20, "tooth_slope_angle": math.radians(95)}
    with open_fmu(native_ratchet_fmu) as fmu:
        quantities = tuple(column(name, fmu.description) for name in columns)
        task = Task(TimeGrid.of(1.2, 0.05), {}, None, quantities, material_card(material))
        (result,) = run_designs(fmu, task, [Design(1, values)])
        run = perform(fmu, Experiment(1.2, 0.05, values, material=material_card(material)))
    assert run.damage is not None
    expected = [
        run.results["wheel_angle"].iloc[-1],
        run.results["contact_force"].max(),
        run.results["kinetic_energy"].min(),
        run.impacts["time"].iloc[0],
        run.impacts["stress_max"].iloc[0],
        run.impacts["stress_max"].max(),
        run.parameters["tooth_length"],
        run.damage.stress,
        run.damage.fatigue_safety,
    ]
    np.testing.assert_array_equal(result.values, expected)
    assert result.values[4] == pytest.approx(stress, abs=0.5)  # that of steel: the paper's wheel, see models/ratchet
