"""One of many designs in motion, and what else their reports tell."""

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
from cheap_designs import SQUARE, axis, cheap_sweep, run_cheap, store_of
from fake_slave import FakeFmu, FakeSlave, fake_description

from harness.designs.by_fmu import InMotion, design_with_largest, in_motion
from harness.designs.task import Design, Task
from harness.errors import FmuError, Status
from harness.report.parameters import input_plots
from harness.report.sweep_report import animation_of_design, sweep_report
from harness.run.inputs import InputSignals, read_inputs
from harness.run.master import TimeGrid

TASK = Task(TimeGrid.of(1.0, 0.1), {"tooth_count": 20}, None, (SQUARE,))
DESIGN = Design(3, {"tooth_slope_angle": np.pi / 2})
DISC = {"kind": "disc", "name": "eye", "at": [0.0, "wheel_angle"], "radius": 1.0}
TORQUES = InputSignals(
    (fake_description().variable("drive_torque"),), np.array([0.0, 2.0]), np.array([[0.0], [1.0]]), "drive.csv", "ab12"
)


def fmu_of(slave: FakeSlave, folder: Path, text: str | None = None) -> FakeFmu:
    (folder / "resources").mkdir()
    drawing = json.dumps({"format": 1, "shapes": [DISC]}) if text is None else text
    (folder / "resources" / "drawing.json").write_text(drawing)
    return FakeFmu(slave, folder)


def seen(fmu: FakeFmu, task: Task = TASK, design: Design | None = DESIGN) -> InMotion | None:
    return in_motion(fmu, task, design, "the best")  # type: ignore[arg-type]


def caption(fmu: FakeFmu, design: Design | None = DESIGN) -> str:
    found = seen(fmu, TASK, design)
    assert found is not None
    return found.caption


def test_a_design_is_run_as_it_was_but_in_shorter_steps(tmp_path: Path) -> None:
    slave = FakeSlave(impacts=[0.25])
    found = seen(fmu_of(slave, tmp_path))
    assert found is not None
    assert found.run is not None
    assert (slave.values["tooth_count"], slave.values["tooth_slope_angle"]) == (20, np.pi / 2)
    assert len(found.run.results) == 201
    assert found.run.results["time"].iloc[-1] == 1.0
    html = animation_of_design(found)
    assert "</h2></summary><p>Design 3, the best: tooth_slope_angle = 1.5708 rad (90 deg). It was run once" in html
    assert '<button type="button" class="play">Play</button>' in html


def test_with_signals_of_a_table_the_steps_stay_as_they_are(tmp_path: Path) -> None:
    slave = FakeSlave()
    seen(fmu_of(slave, tmp_path), replace(TASK, inputs=TORQUES))
    assert len(slave.calls) == 10
    assert slave.values["drive_torque"] == pytest.approx(0.45)


def test_an_fmu_without_a_drawing_is_not_run() -> None:
    slave = FakeSlave()
    assert seen(FakeFmu(slave)) is None
    assert slave.log == []
    assert animation_of_design(None) == ""


def test_a_drawing_that_cannot_be_used_is_told(tmp_path: Path) -> None:
    slave = FakeSlave()
    assert "cannot be shown: it is no JSON" in caption(fmu_of(slave, tmp_path, "{"))
    assert slave.log == []


def test_without_a_good_design_there_is_nothing_to_see(tmp_path: Path) -> None:
    slave = FakeSlave()
    assert caption(fmu_of(slave, tmp_path), None) == "No design ran to its end, so there is none to be seen in motion."
    assert slave.log == []


def test_a_failure_is_told_and_what_there_is_of_the_motion_is_shown(tmp_path: Path) -> None:
    found = seen(fmu_of(FakeSlave(fail=lambda time: Status.ERROR if time > 0.5 else None), tmp_path))
    html = animation_of_design(found)
    assert "It failed when it was run once more, to be seen here: refused at 0.50" in html
    assert 'class="play"' in html


def test_a_run_that_takes_too_long_can_be_stopped_and_is_shown_up_to_there(tmp_path: Path) -> None:
    asked = iter([False] * 30 + [True])
    fmu = fmu_of(FakeSlave(), tmp_path)
    found = in_motion(fmu, TASK, DESIGN, "the best", stop_requested=lambda: next(asked))  # type: ignore[arg-type]
    assert found is not None
    assert "in steps of 0.005 s, and stopped at 0.15 s." in found.caption
    assert 'class="play"' in animation_of_design(found)


@pytest.mark.parametrize("error", [FmuError("cannot be assembled"), MemoryError("full")])
def test_a_design_that_does_not_even_begin_leaves_a_report(error: Exception, tmp_path: Path) -> None:
    class Broken(FakeSlave):
        def initialize(self, start_time: float, stop_time: float) -> None:
            raise error

    html = animation_of_design(seen(fmu_of(Broken(), tmp_path)))
    assert f"to be seen here: {error}</p>" in html
    assert "class=" not in html


def test_of_a_sweep_the_largest_of_what_is_recorded_first() -> None:
    designs = [Design(number, {}) for number in range(1, 6)]

    def chosen(values: list[float | None], status: str = "ok") -> tuple[int | None, str]:
        table = pa.table({"design": [1, 2, 3, 4, 5], "status": ["ok", *[status] * 4], SQUARE.column: values})
        design, which = design_with_largest(SQUARE, designs, table)
        return design and design.number, which

    assert chosen([1.0, np.nan, 7.0, None, 7.0]) == (3, "the one with the largest end.square of all")
    assert chosen([1.0, None, None, None, None], status="failed")[0] == 1
    assert chosen([None, np.nan, None, None, None]) == (1, "the first")
    assert design_with_largest(SQUARE, designs, pa.table({"design": [], "status": [], SQUARE.column: []}))[0] is None


def test_a_report_of_designs_tells_inputs_parameters_and_versions(tmp_path: Path) -> None:
    run_cheap(4, tmp_path)
    sweep = cheap_sweep(4)
    table = store_of(sweep, tmp_path).finish()
    listed = replace(axis("tooth_slope_angle", unit="deg"), values=(np.pi / 2, np.pi / 3))
    task = replace(sweep.task, fixed={"crank_inertia": 1e-4}, inputs=TORQUES)
    columns = table.append_column("tooth_slope_angle", pa.array([1.5] * 4))
    sweep = replace(sweep, task=task, axes=(*sweep.axes, listed))
    html = sweep_report(sweep, FakeFmu(FakeSlave()), columns, None)  # type: ignore[arg-type]
    rows = [
        re.findall("<td[^>]*>(.*?)</td>", line) for line in re.findall("<tr.*?</tr>", html.split("<h2>Parameters")[1])
    ]
    origin = {row[0]: row[1:4] for row in rows if len(row) == 5}
    assert origin["restitution"] == ["0 … 1", "1", "varied"]
    assert origin["tooth_slope_angle"] == ["90, 60", "deg", "varied"]
    assert origin["crank_inertia"] == ["0.0001", "kg.m2", "set"]
    assert origin["drive_torque"] == ["see Inputs", "N.m", "table of inputs"]
    assert origin["tooth_count"] == ["10", "1", "default"]
    assert origin["guided"] == ["true", "", "default"]
    assert (
        "<h2>Inputs</h2></summary><p>From the table drive.csv: 2 rows, from 0 s to 2 s. SHA-256 of the file: ab12</p>"
        in html
    )
    assert {"FMU", "mechanism_fmu", "pyarrow", "scipy"} <= {row[0] for row in rows if len(row) == 2}


def test_inputs_are_drawn_in_display_units_and_those_that_jump_jump() -> None:
    variables = fake_description().variables
    slope, gear = variables["tooth_slope_angle"], variables["gear"]
    values = np.array([[0.0, 1.0], [np.pi, 2.0]])
    smooth, jumping = input_plots(InputSignals((slope, gear), np.array([0.0, 1.0]), values), fake_description())
    assert smooth.y_label == "tooth_slope_angle [deg]"
    np.testing.assert_allclose(smooth.curves[0].y, [0.0, 180.0])
    assert jumping.y_label == "gear [1]"
    assert (list(jumping.curves[0].x), list(jumping.curves[0].y)) == ([0.0, 1.0, 1.0], [1.0, 1.0, 2.0])


def test_a_table_of_inputs_keeps_its_name_and_digest(tmp_path: Path) -> None:
    path = tmp_path / "drive.csv"
    path.write_bytes(b"time,drive_torque\n0,1\n1,2\n")
    signals = read_inputs(path, fake_description(), 0.0, 1.0)
    assert signals.file == "drive.csv"
    # as of sha256sum
    assert signals.digest == "896c05bc89e49a4d8c5a5f312a4cfa16279785f011d37c6e5aa33bda058e023d"
