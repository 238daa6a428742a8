"""Whole pages of a kept run, beside what they were: see tests/kept.py."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from harness.papers.study.study import Study, rim_of
from harness.papers.study.study_report import paper_figures, study_report
from harness.papers.study.wheels import Wheel
from harness.report.run_report import run_report
from harness.report.static import svg_text
from harness.run.checks import Check, Finding, Verdict
from harness.run.experiment import Experiment, Run, perform
from harness.run.inputs import InputSignals
from harness.run.results import settings
from tests.kept import plain_data, plain_page, same_as_kept
from tests.replayed import EXPERIMENT, ReplayedFmu


def run(fail: float = np.inf, **more: object) -> Run:
    return perform(ReplayedFmu(fail), replace(EXPERIMENT, **more))  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def whole() -> Run:
    return run()


def test_kept_page_of_a_run(whole: Run) -> None:
    same_as_kept("run.html", plain_page(run_report(whole, [Check("It is quiet", False, "70 dB")])))


def test_kept_page_of_a_run_with_a_table_that_ends_early() -> None:
    fmu = ReplayedFmu()
    torque = fmu.description.variable("drive_torque")
    signals = InputSignals((torque,), np.array([0.0, 2.0]), np.array([[2e-3], [2e-3]]), "drive.csv", "ab12", "odd")
    values = {name: value for name, value in EXPERIMENT.start_values.items() if name != "drive_torque"}
    asked = Experiment(1.2, 0.02, values)
    early = perform(ReplayedFmu(0.9), asked, inputs=signals)  # type: ignore[arg-type]
    same_as_kept("run_early.html", plain_page(run_report(early)))


def wheel(count: int, degrees: int) -> Wheel:
    """Numbers of no wheel in particular, each of them another."""
    size = count * degrees
    return Wheel(
        count, np.radians(degrees), 1e-3 * size, 1e-2 * size, -1e-5 * size, 30.0 * size, 1e-4 * degrees, 1e-6 * size,
        0.5 / count, 1e-2 * degrees,
    )  # fmt: skip


@pytest.fixture(scope="module")
def study(whole: Run) -> Study:
    wheels = tuple(wheel(count, degrees) for count in (10, 20) for degrees in (90, 95))
    rims = []
    for one in wheels:
        rim = rim_of(whole.drawing, whole.parameters | {"tooth_count": one.tooth_count})
        assert rim is not None
        rims.append(rim)
    values = {name: (value,) * 4 for name, value in settings(whole).items()}
    values |= {"tooth_count": (10, 10, 20, 20), "tooth_slope_angle": tuple(one.tooth_slope_angle for one in wheels)}
    return Study(
        Path("Ratchet.fmu"),
        whole.description,
        wheels,
        tuple(rims),
        values,
        whole,
        ("the pawl <creaks>",),
        (Check("Stress rises", True, "always"), Check("Stress falls", False, "never")),
        (Finding("It is exact", Verdict.HOLDS_IN_PART, "1 of 2 digits"),),
    )


def test_kept_page_of_a_study(study: Study) -> None:
    same_as_kept("study.html", plain_page(study_report(study, paper_figures(study))))


def test_kept_figures_of_a_study(study: Study) -> None:
    same_as_kept("study_figures.svg", "".join(svg_text(figure.plots) for figure in paper_figures(study)))


def test_kept_units_of_a_run(whole: Run) -> None:
    same_as_kept("run_units.json", plain_data({table: dict(units) for table, units in whole.units.items()}))
