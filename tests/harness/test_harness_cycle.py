"""The indexing cycle that `validate` runs: its motion by hand, and verdicts on tables that are right or wrong."""

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from harness.papers.study.indexing import CLICKS, PERIOD, STOP_TIME, VALUES, cycle_checks, write_drive


def test_the_cycle_is_the_one_of_the_docs() -> None:
    """models/ratchet/README.md: 20 teeth of 95 deg, a shaft that swings as 84.3 - 10.4 cos(2 pi t / 8 s) deg."""
    expected = {
        "guided": False,
        "tooth_count": 20,
        "tooth_slope_angle": pytest.approx(1.6580627893946132, rel=1e-15),
        "crank_angle_start": pytest.approx(math.radians(73.9), rel=1e-15),
        "drive_stiffness": 2.0,
        "drive_damping": 0.1,
        "pawl_spring_torque": 5e-3,
        "wheel_damping": 0.1,
        "spring_preload": 3e-3,
        "drive_torque": 0.0,
    }
    assert dict(VALUES) == expected
    assert (STOP_TIME, PERIOD, CLICKS) == (34.0, 8.0, 4)


def test_the_driven_end_swings_between_its_ends(tmp_path: Path) -> None:
    table = pd.read_csv(write_drive(tmp_path / "drive.csv"))
    assert list(table) == ["time [s]", "drive_angle [rad]", "drive_speed [rad/s]"]
    time, angle, speed = table.to_numpy().T
    np.testing.assert_allclose(time, np.arange(0, 1701) / 50, atol=1e-12)
    by_time = dict(zip(np.round(time, 9).tolist(), np.degrees(angle).tolist(), strict=True))
    assert [by_time[t] for t in (0.0, 2.0, 4.0, 6.0, 8.0)] == pytest.approx([73.9, 84.3, 94.7, 84.3, 73.9], abs=1e-9)
    np.testing.assert_allclose(speed[1:-1], (angle[2:] - angle[:-2]) / (time[2:] - time[:-2]), atol=1e-4)


def results(clicks_at: tuple[float, ...] = (3.0, 11.0, 19.0, 27.0), latched: float = 147.0, residual: float = 0.0):
    time = np.arange(0.0, 34.5, 0.5)
    table = {
        "time": time,
        "clicks": (time[:, None] >= np.array(clicks_at)).sum(axis=1),
        "latched_angle": np.full(len(time), math.radians(latched)),
        "kinetic_energy": np.zeros(len(time)),
        "spring_energy": 0.5 * time,
        "work_done": 0.5 * time + residual,
        "energy_lost": np.zeros(len(time)),
    }
    table["work_done"][0] = 0.0
    return pd.DataFrame(table)


def failed(table: pd.DataFrame) -> list[str]:
    return [check.claim for check in cycle_checks(table) if not check.passed]


def test_verdicts_on_a_cycle() -> None:
    assert len(cycle_checks(results())) == 4
    assert failed(results()) == []
    assert failed(results(clicks_at=(3.0, 11.0, 19.0))) == ["The holding pawl clicks four times", "One tooth a stroke"]
    assert failed(results(clicks_at=(3.0, 4.0, 19.0, 27.0))) == ["One tooth a stroke"]
    assert failed(results(latched=147.0 + 1e-9)) == ["The wheel is latched at 147 deg"]
    # 17 J of work
    assert failed(results(residual=1.6e-7)) == []
    assert failed(results(residual=1.8e-7)) == ["The energy ledger closes to 1e-8 of the work"]
    assert failed(results().drop(columns="work_done").assign(work_done=0.0).drop(columns="energy_lost")) == [
        "The energy ledger closes to 1e-8 of the work"
    ]
    assert "clicks in each stroke: [1, 1, 1, 1]" in cycle_checks(results())[1].evidence


def test_nothing_recorded_is_no_cycle() -> None:
    assert failed(results().head(0)) == ["The wheel indexes"]
