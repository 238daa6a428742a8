import json
import math
from dataclasses import replace
from pathlib import Path
from typing import TextIO

import pandas as pd
import pytest
from fake_slave import FakeFmu, FakeSlave

from harness.errors import Status, UsageError
from harness.fmu.description import Variable
from harness.run.checks import run_checks
from harness.run.experiment import Experiment, Run, default_times, perform
from harness.run.results import prepare_folder, write_run, write_text
from tests.declared import TEETH


def run_of(slave: FakeSlave, stop_time: float = 1.0) -> Run:
    return perform(FakeFmu(slave), Experiment(stop_time, 0.1, {"tooth_count": 20}))  # type: ignore[arg-type]


def test_the_tables_read_back_as_they_were(tmp_path: Path) -> None:
    run = run_of(FakeSlave(impacts=[1 / 3, 2 / 3]))
    write_run(run, tmp_path)
    results = pd.read_csv(tmp_path / "results.csv", dtype=str)
    impacts = pd.read_csv(tmp_path / "impacts.csv", dtype=str)
    assert list(results.columns) == list(run.results.columns)
    assert [float(text) for text in results["wheel_angle"]] == list(run.results["wheel_angle"])
    assert [text == "True" for text in results["impact"]] == list(run.results["impact"])
    assert [float(text) for text in impacts["time"]] == [1 / 3, 2 / 3]


def test_the_summary_has_settings_ending_units_and_verdicts(tmp_path: Path) -> None:
    write_run(run_of(FakeSlave(impacts=[0.5])), tmp_path)
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert summary["ending"] == "completed"
    assert summary["final_time"] == 1.0
    assert summary["experiment"]["start_values"] == {"tooth_count": 20}
    assert summary["final_values"]["impact_count"] == 1
    assert summary["final_values"]["impact"] is False
    assert summary["units"]["results"]["wheel_angle"] == "rad"
    assert summary["units"]["results"]["time"] == "s"
    assert summary["units"]["impacts"] == {"time": "s", "velocity": "m/s"}
    assert all(check["passed"] for check in summary["checks"])


def test_a_failed_run_is_written_up_to_its_failure(tmp_path: Path) -> None:
    write_run(run_of(FakeSlave(fail=lambda time: Status.ERROR if time > 0.45 else None)), tmp_path)
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert (summary["ending"], summary["final_time"]) == ("failed", 0.5)
    assert "refused at 0.5 s" in summary["error"]
    assert not summary["checks"][0]["passed"]
    assert len(pd.read_csv(tmp_path / "results.csv")) == 6


def test_lost_impacts_are_counted_and_an_impact_that_is_not_fails_the_verdict() -> None:
    run = run_of(FakeSlave(impacts=[0.5 + 1e-3 * k for k in range(1, 12)]))
    verdict = next(check for check in run.checks if check.claim == "Every impact is counted")
    assert verdict.passed
    assert verdict.evidence.startswith("8 collected, 11 counted by the FMU, 3 lost")
    checks = run_checks(run.outcome, 1.0, run.results, run.impacts.iloc[1:], 3)
    assert not next(check for check in checks if check.claim == verdict.claim).passed
    checks = run_checks(run.outcome, 1.0, run.results, run.impacts, 0)
    assert not next(check for check in checks if check.claim == "Every impact is collected").passed


def test_a_broken_write_leaves_the_old_file_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "results.csv"
    path.write_text("old")

    def breaks(file: TextIO) -> None:
        file.write("half of it")
        raise OSError("disk full")

    with pytest.raises(UsageError, match=r"results\.csv' cannot be written: disk full"):
        write_text(path, breaks)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_folder_that_cannot_be_made_is_refused_before_any_work(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(UsageError, match="cannot be made"):
        prepare_folder(tmp_path / "file" / "below")
    with pytest.raises(UsageError, match="cannot be made"):
        prepare_folder(tmp_path / "file")


def test_times_come_from_the_default_experiment() -> None:
    description = FakeSlave().description
    assert default_times(description, None, None) == (1.0, 1e-3)
    assert default_times(description, 2.0, 0.5) == (2.0, 0.5)


def test_a_step_that_nobody_says_is_a_thousandth_of_the_run() -> None:
    description = replace(FakeSlave().description, step=None)
    assert default_times(description, 3.0, None) == (3.0, 3e-3)
    assert default_times(description, 1e-7, None) == (1e-7, 1e-9)


def test_a_stop_time_without_a_default_must_be_given() -> None:
    description = replace(FakeSlave().description, stop_time=None)
    with pytest.raises(UsageError, match="no default experiment to take it from; give --stop-time"):
        default_times(description, None, 0.1)


def with_tooth(slave: FakeSlave, length: float) -> FakeSlave:
    variables = [
        Variable(name, 200 + k, "Real", "calculatedParameter")
        for k, name in enumerate(("tooth_length", "tooth_apex_angle"))
    ]
    known = {**slave.description.variables, **{variable.name: variable for variable in variables}}
    slave.description = replace(slave.description, variables=known, analysis=TEETH)
    slave.values |= {"tooth_length": length, "tooth_apex_angle": 1.0}
    return slave


def test_impacts_of_a_tooth_come_with_their_stress() -> None:
    run = run_of(with_tooth(FakeSlave(impacts=[0.1, 0.2]), length=0.02))
    # stress = C v sqrt(rho E) with C = 0.786452 for any wedge; the fake's velocities are -2 t
    expected = [0.786452 * velocity * math.sqrt(7850 * 2.06e11) for velocity in (0.2, 0.4)]
    assert list(run.impacts["stress_max"]) == pytest.approx(expected, rel=1e-6)
    assert list(run.impacts["stress_position"]) == pytest.approx([0.3956, 0.3956], abs=1e-4)
    assert run.units["impacts"]["stress_max"] == "Pa"


def test_an_fmu_without_a_tooth_leaves_no_stress() -> None:
    run = run_of(FakeSlave(impacts=[0.1]))
    assert run.beam is None
    assert "stress_max" not in run.impacts


def test_an_impossible_tooth_is_a_verdict_and_costs_no_result() -> None:
    run = run_of(with_tooth(FakeSlave(impacts=[0.1]), length=-1.0))
    (verdict,) = [check for check in run.checks if check.claim == "The struck tooth has a stress model"]
    assert not verdict.passed
    assert "describe no tooth: tooth length = -1 m" in verdict.evidence
    assert len(run.impacts) == 1
    assert not run.results.empty
