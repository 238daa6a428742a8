"""Both ways of a design give the same, to the last bit."""

import math
from dataclasses import replace
from pathlib import Path

import pytest

from harness.clock import TimeGrid
from harness.designs import by_batch, by_fmu
from harness.designs.quantities import column
from harness.designs.task import Design, Task
from harness.fmu import open_fmu

COLUMNS = (
    "end.wheel_angle",
    "end.impact_count",
    "end.face_active",
    "max.contact_force",
    "min.wheel_speed",
    "first_impact.time",
    "first_impact.tooth",
    "first_impact.stress_max",
    "largest_impact.stress_max",
    "all_impacts.damage",
    "parameter.tooth_length",
    "parameter.crank_length",
)
DESIGNS = [
    Design(number, {"tooth_count": count, "tooth_slope_angle": math.radians(angle)})
    for number, (count, angle) in enumerate([(10, 90), (20, 95), (10, 105), (2, 90)], start=1)
]


@pytest.mark.parametrize("stop_time", [1.2, 0.3], ids=["impact", "none"])
def test_both_ways_agree(stop_time: float, ratchet_fmu: Path) -> None:
    """A wheel of two teeth cannot be; and there is no impact until 0.3 s."""
    with open_fmu(ratchet_fmu) as fmu:
        quantities = tuple(column(name, fmu.description) for name in COLUMNS)
        task = Task(TimeGrid.of(stop_time, 0.1), {"drive_torque": 1e-3, "guided": True}, None, quantities)
        assert by_batch.can_run(fmu, task, DESIGNS[0])
        through, at_once = by_fmu.run_designs(fmu, task, DESIGNS), by_batch.run_designs(fmu, task, DESIGNS)
    for one, other in zip(through, at_once, strict=True):
        assert (one.way, other.way) == ("fmu", "batch")
        assert (one.failure is None) == (other.failure is None)
        assert (one.warnings is None) == (other.warnings is None)
        assert replace(one, way="", failure=None, warnings=None) == replace(other, way="", failure=None, warnings=None)
        assert [type(value) for value in one.values] == [type(value) for value in other.values]
    assert "at least 3" in (at_once[3].failure or "")
    assert (at_once[0].values[5] is None) == (stop_time < 0.9)


def test_what_cannot_run_this_way_is_known_before(native_ratchet_fmu: Path, ratchet_fmu: Path) -> None:
    with open_fmu(native_ratchet_fmu) as fmu:
        task = Task(TimeGrid.of(1.2, 0.1), {}, None, (column("end.wheel_angle", fmu.description),))
        assert not by_batch.can_run(fmu, task, DESIGNS[0])
    with open_fmu(ratchet_fmu) as fmu:
        driven = replace(task, quantities=(column("end.drive_torque", fmu.description),))  # an input
        assert not by_batch.can_run(fmu, driven, DESIGNS[0])
