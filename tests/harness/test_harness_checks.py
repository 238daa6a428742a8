import math
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd
import pytest

from harness.papers.study.wheels import SLOPE_ANGLES_DEG, TOOTH_COUNTS, Wheel, base_case_checks, study_checks
from harness.run.checks import energy_residual, run_checks
from harness.run.master import Ending, Outcome

#: sigma_max [Pa] as 1e6 * (1 / nt) * (beta_0 / 90 deg): falls with the first, rises with the second.
WHEELS = [
    Wheel(nt, math.radians(beta), 0.9, 0.02, 1e-3, 1e6 / nt * beta / 90, 0.3956, 2e-6, 0.02, 1.0)
    for nt in TOOTH_COUNTS
    for beta in SLOPE_ANGLES_DEG
]


def falling_mass(mass: float = 2.0, leak: float = 0.0) -> pd.DataFrame:
    """A mass on a spring, energies exact but for a leak."""
    time = np.linspace(0.0, 1.0, 50)
    kinetic = 0.5 * mass * np.sin(time) ** 2
    spring = 0.5 * mass * np.cos(time) ** 2 + 3.0 * time
    return pd.DataFrame(
        {
            "kinetic_energy": kinetic,
            "spring_energy": spring,
            "work_done": 4.0 * time,
            "energy_lost": time * (1.0 + leak),
        }
    )


def test_the_energy_balance_of_a_conservative_system_closes() -> None:
    residual = energy_residual(falling_mass())
    assert residual is not None
    assert residual.abs().max() < 1e-14


@pytest.mark.parametrize(("leak", "passed"), [(0.0, True), (1e-6, True), (1e-5, False), (math.nan, False)])
def test_a_leak_fails_the_energy_verdict(leak: float, passed: bool) -> None:
    outcome = Outcome(Ending.COMPLETED, 1.0, 49)
    verdicts = run_checks(outcome, 1.0, falling_mass(leak=leak), pd.DataFrame(), 0)
    assert {v.claim: v.passed for v in verdicts}["The energy balance closes"] is passed


def test_without_a_ledger_there_is_no_energy_verdict() -> None:
    table = falling_mass().drop(columns="energy_lost")
    assert energy_residual(table) is None
    assert len(run_checks(Outcome(Ending.COMPLETED, 1.0, 49), 1.0, table, pd.DataFrame(), 0)) == 1


def test_the_claims_of_the_paper_with_their_margins() -> None:
    place, falls, rises = study_checks(WHEELS)
    assert place.passed
    assert "x/l = 0.3956" in place.evidence
    assert falls.passed
    assert "20.0% (to nt = 25" in falls.evidence  # 1/25 after 1/20
    assert rises.passed
    assert "5.0% (to" in rises.evidence  # 105 after 100
    assert "beta_0 = 105 deg" in rises.evidence


@pytest.mark.parametrize(
    ("number", "change", "fails"),
    [
        (7, {"stress_position": 0.0}, 0),
        (15, {"stress_max": 1e6}, 1),
        (12, {"stress_max": 1.0}, 2),
    ],
)
def test_one_wheel_that_disagrees_fails_its_claim(number: int, change: dict[str, Any], fails: int) -> None:
    wheels = [replace(wheel, **change) if i == number else wheel for i, wheel in enumerate(WHEELS)]
    checks = study_checks(wheels)
    assert not checks[fails].passed


def test_the_base_case_is_compared_with_the_reference() -> None:
    exact = {"time": [0.9399211769], "wheel_speed": [0.0227388573], "velocity": [5.084569462e-4]}
    exact["stress_max"] = [16080.32]
    assert all(check.passed for check in base_case_checks(pd.DataFrame(exact)))
    off = pd.DataFrame(exact | {"time": [0.93992138]})
    assert [check.passed for check in base_case_checks(off)] == [False, True, True, True]
    assert not base_case_checks(pd.DataFrame(columns=list(exact)))[0].passed
