"""Whole pages of a bending linkage, beside what they were, and its tables: see tests/kept.py."""

import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import build_fmu
from harness.fmu.description import Description, Variable
from harness.papers.ked.files import Agreement, Result, summary
from harness.papers.ked.judged_by import JudgedBy
from harness.papers.ked.ked_report import ked_report
from harness.papers.ked.options import Limits
from harness.papers.ked.solution import Solution
from harness.papers.ked.solve import prepared, solved
from harness.papers.ked.synthesis import Bounds, Synthesised
from harness.papers.ked.tables import cycle_table
from mechanism_fmu.elastodynamics import Judgement, SpeedSweep, with_friction
from tests.harness.fake_slave import UNITS
from tests.kept import plain_data, plain_page, same_as_kept

SPEED = 500 * math.pi / 30
DEPTHS = ("crank_depth", "arm_depth")
FMU: Any = SimpleNamespace(
    path=Path("FourBar.fmu"),
    description=Description(
        "FourBar",
        "FourBar",
        "{guid}",
        {name: Variable(name, k, "Real", "parameter", unit="m", start="0.0127") for k, name in enumerate(DEPTHS)},
        units=UNITS,
    ),
)
SWEEP = SpeedSweep(SPEED * np.array([0.4, 0.9, 1.4]), np.array([1e-3, 4e-3, 2e-3]), np.array([1e-3, 2e-3, 3e-3]))
AGREED = Agreement({"path_deviation": 1e-12, "arm_stress": 3e-12}, 24)


def turned(friction: float = 0.0) -> Any:
    mechanism = build_fmu.mechanism("four_bar_path_generator")
    return prepared(with_friction(mechanism, friction, 0.005) if friction else mechanism, SPEED, 0.02, 24)


@pytest.fixture(scope="module")
def plain() -> Solution:
    return quiet(solved(turned(), SPEED, 0.02, 24))


def quiet(found: Solution) -> Solution:
    """What rounding leaves is another number on each machine."""
    assert max(found.residual - found.jump, found.rigid.power_gap, found.rigid.shaking_gap) < 1e-8
    return replace(found, residual=1e-12, rigid=replace(found.rigid, power_gap=2e-12, shaking_gap=3e-12))


def test_kept_page_of_a_linkage(plain: Solution) -> None:
    found = plain
    result = Result(FMU, "Path generator", {"arm_depth": 0.0127}, found, SWEEP, AGREED, Limits(2e-3, 100e6))
    same_as_kept("ked.html", plain_page(ked_report(result)))
    _, units = cycle_table(found)
    told = {key: value for key, value in summary(result, units).items() if key != "versions"}
    same_as_kept("ked_summary.json", plain_data(told))


def test_kept_page_of_a_linkage_that_rubs_made_lighter(plain: Solution) -> None:
    found = quiet(solved(turned(friction=0.1), SPEED, 0.02, 24, fluctuation=0.02))
    angle = np.radians(30.0 + np.linspace(0.0, 360.0, 13))
    before = Judgement(0.5, 1e-3 * (2.0 + np.sin(angle)), 1e6 * np.column_stack((90 + angle, 80 - angle)))
    after = Judgement(0.4, 1e-3 * (1.0 + np.cos(angle)), 1e6 * np.column_stack((50 + angle, 60 - angle)))
    for judged_by, limits in ((JudgedBy.QUASI_STATIC, (2e-3, 100e6)), (JudgedBy.ELASTODYNAMIC, (None, 100e6))):
        lighter = Synthesised(
            tuple(Bounds(name, 0.003, 0.05) for name in DEPTHS),
            np.array([0.0127, 0.0127]),
            np.array([0.0100, 0.0064]),
            angle,
            before,
            after,
            77,
            Limits(*limits, judged_by),
        )
        result = Result(
            FMU, "Path generator", {}, found, SWEEP, replace(AGREED, frictionless=True),
            lighter.limits, lighter, plain,
        )  # fmt: skip
        same_as_kept(f"ked_lighter_{judged_by.name.lower()}.html", plain_page(ked_report(result)))
        told = {key: value for key, value in summary(result, {}).items() if key != "versions"}
        same_as_kept(f"ked_lighter_{judged_by.name.lower()}.json", plain_data(told))


def test_kept_table_of_a_turn(plain: Solution) -> None:
    table, units = cycle_table(plain)
    same_as_kept("ked_cycle.json", plain_data({"units": units} | {name: table[name].tolist() for name in table}))
