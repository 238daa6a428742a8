"""Designs in one compiled call give the numbers of designs through the FMU, to the last bit."""

import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from harness.designs import by_batch, by_fmu
from harness.designs.task import Design, Task, column
from harness.errors import FmuError, UsageError
from harness.fmu import Fmu, open_fmu
from harness.fmu.description import Variable
from harness.run.inputs import InputSignals
from harness.run.master import TimeGrid

COLUMNS = (
    "end.wheel_angle",
    "end.slope_active",
    "end.impact_count",
    "end.drive_torque",
    "max.contact_force",
    "max.drive_torque",
    "min.kinetic_energy",
    "first_impact.time",
    "first_impact.contact",
    "first_impact.stress_max",
    "largest_impact.velocity",
    "largest_impact.tooth",
    "largest_impact.stress_max",
    "parameter.tooth_length",
    "parameter.tooth_count",
    "parameter.restitution",
    "all_impacts.stress",
    "all_impacts.fatigue_safety",
)
DESIGNS = [
    Design(number, {"tooth_count": count, "tooth_slope_angle": math.radians(angle), "restitution": bounce})
    for number, (count, angle, bounce) in enumerate([(10, 90, 0.0), (20, 95, 0.5), (2, 95, 0.0), (25, 101.5, 0.2)], 1)
]


def task_of(fmu: Fmu, inputs: InputSignals | None = None) -> Task:
    quantities = tuple(column(name, fmu.description) for name in COLUMNS)
    return Task(TimeGrid.of(2.5, 0.03), {"friction": 0.1}, inputs, quantities)


def swing(fmu: Fmu) -> InputSignals:
    times = np.linspace(0.0, 2.5, 26)
    values = 1e-3 * (1 + 0.5 * np.sin(5 * times))
    return InputSignals((fmu.description.variable("drive_torque"),), times, values[:, None])


@pytest.mark.parametrize("driven", [False, True])
def test_the_numbers_are_those_of_the_fmu(ratchet_fmu: Path, driven: bool) -> None:
    with open_fmu(ratchet_fmu) as fmu:
        task = task_of(fmu, swing(fmu) if driven else None)
        found = by_batch.run_designs(fmu, task, DESIGNS)
        expected = by_fmu.run_designs(fmu, task, DESIGNS)
    for mine, other in zip(found, expected, strict=True):
        assert (mine.number, mine.way) == (other.number, "batch")
        assert mine.values == other.values
        assert [type(value) for value in mine.values] == [type(value) for value in other.values]
        assert (other.failure or "").endswith(mine.failure or "")  # the FMU says first who speaks
        assert (mine.failure is None) == (other.failure is None)
    assert [mine.failure is None for mine in found] == [True, True, False, True]
    assert "tooth_count = 2" in (found[2].failure or "")


def test_without_an_impact_there_is_nothing_of_it(ratchet_fmu: Path) -> None:
    with open_fmu(ratchet_fmu) as fmu:
        task = replace(task_of(fmu), grid=TimeGrid.of(0.5, 0.1))
        (found,) = by_batch.run_designs(fmu, task, DESIGNS[:1])
        (expected,) = by_fmu.run_designs(fmu, task, DESIGNS[:1])
    assert found.values == expected.values
    assert found.values[COLUMNS.index("first_impact.time")] is None


def test_a_native_fmu_has_no_such_way_and_says_so(native_ratchet_fmu: Path) -> None:
    with pytest.raises(UsageError, match=r"--fast: .* holds no Python model"):
        by_batch.require_batch(native_ratchet_fmu)


def test_an_input_out_of_its_limits_fails_the_designs_and_not_the_command(ratchet_fmu: Path) -> None:
    with open_fmu(ratchet_fmu) as fmu:
        drive = fmu.description.variable("drive_torque")
        inputs = InputSignals((drive,), np.array([0.0, 2.5]), np.array([[1e9], [1e9]]))
        found = by_batch.run_designs(fmu, task_of(fmu, inputs), DESIGNS[:2])
    assert len(found) == 2
    assert all("drive_torque" in (one.failure or "") for one in found)


def test_a_design_with_more_impacts_than_are_kept_goes_through_the_fmu(ratchet_fmu: Path, monkeypatch) -> None:
    monkeypatch.setattr(by_batch, "_MOST_IMPACTS", 2)
    with open_fmu(ratchet_fmu) as fmu:
        once, often = by_batch.run_designs(fmu, task_of(fmu), DESIGNS[:2])
        (expected,) = by_fmu.run_designs(fmu, task_of(fmu), DESIGNS[1:2])
    assert once.way == "batch"
    assert often == expected
    assert often.way == "fmu"


def test_more_impacts_in_a_step_than_an_fmu_can_tell_are_all_there(ratchet_fmu: Path) -> None:
    bouncing = [Design(1, {"restitution": 0.8})]
    with open_fmu(ratchet_fmu) as fmu:
        small, large = (replace(task_of(fmu), fixed={}, grid=TimeGrid.of(8.0, step)) for step in (0.5, 8.0))
        (divided,) = by_fmu.run_designs(fmu, large, bouncing)
        (found,) = by_batch.run_designs(fmu, large, bouncing)
        (expected,) = by_fmu.run_designs(fmu, small, bouncing)
    of_impacts = [k for k, name in enumerate(COLUMNS) if "impact" in name]
    assert found.values[COLUMNS.index("end.impact_count")] > 8
    assert [found.values[k] for k in of_impacts] == pytest.approx([expected.values[k] for k in of_impacts], rel=1e-4)
    assert [found.values[k] for k in of_impacts] == pytest.approx([divided.values[k] for k in of_impacts], rel=1e-12)


def test_warnings_are_those_of_the_fmu_a_line_each(ratchet_fmu: Path) -> None:
    warned = [Design(1, {"pawl_angle_start": 0.1, "tooth_count": 25, "tooth_slope_angle": math.radians(85)})]
    with open_fmu(ratchet_fmu) as fmu:
        (found,), (expected,) = (way.run_designs(fmu, task_of(fmu), warned) for way in (by_batch, by_fmu))
    assert found.warnings == expected.warnings
    assert len((found.warnings or "").splitlines()) == 2


@pytest.mark.parametrize(
    ("error", "says"),
    [(ZeroDivisionError("by zero"), "ZeroDivisionError: by zero"), (FmuError("no tooth."), "no tooth.")],
)
def test_an_error_in_what_comes_after_the_batch_fails_its_design_alone(
    monkeypatch: pytest.MonkeyPatch, error: Exception, says: str
) -> None:
    def refuse(*_: object) -> None:
        raise error

    monkeypatch.setattr(by_batch, "of_impacts", refuse)
    monkeypatch.setattr(by_batch, "_impacts", lambda *_: None)
    task = Task(TimeGrid.of(1.0, 0.1), {}, None, ())
    found = SimpleNamespace(failures=["", "jammed."], impact_count=[0, 0], warnings=["", ""])
    fmu = SimpleNamespace(description=None)
    results = [by_batch._result(fmu, task, DESIGNS[place], found, place, {}) for place in range(2)]  # type: ignore[arg-type]
    assert [result.failure for result in results] == [says, "jammed."]
    assert [result.number for result in results] == [1, 2]


@pytest.mark.parametrize(
    ("kind", "text", "value"),
    [
        ("Boolean", "true", 1.0),
        ("Boolean", "1", 1.0),
        ("Boolean", "false", 0.0),
        ("Boolean", "0", 0.0),
        ("Boolean", None, 0.0),
        ("Integer", "3", 3.0),
        ("Real", "2.5", 2.5),
        ("Real", None, 0.0),
    ],
)
def test_a_start_value_is_that_of_the_description(kind: str, text: str | None, value: float) -> None:
    assert by_batch._started(Variable("x", 0, kind, "parameter", start=text)) == value
