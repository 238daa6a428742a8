"""The command `ked`: the path generator, in the units of its tables."""

import json
import math
import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from chromium import PROGRAM, chromium, opened
from typer.testing import CliRunner

import build_fmu
from harness.app.cli import main
from harness.errors import UsageError
from harness.fmu import open_fmu
from harness.papers.ked.files import Result, agreement, write_result
from harness.papers.ked.ked_report import ked_report, write_ked_report
from harness.papers.ked.options import asked
from harness.papers.ked.solve import prepared, solved, swept
from harness.papers.ked.tables import cycle_rows, feedback_sentence, narrow_columns
from tests import report_page

INCH, POUND_FORCE = 0.0254, 0.45359237 * 9.80665
SPEED = 500 * math.pi / 30


@pytest.fixture(scope="module")
def mechanism():
    return build_fmu.mechanism("four_bar_path_generator")


@pytest.fixture(scope="module")
def turned(mechanism):
    return prepared(mechanism, SPEED, 0.02, 360)


@pytest.fixture(scope="module")
def solution(turned):
    return solved(turned, SPEED, 0.02, 360)


@pytest.fixture(scope="module")
def result(native_four_bar_path_generator_fmu: Path, mechanism, turned, solution):
    with open_fmu(native_four_bar_path_generator_fmu) as fmu:
        agreed = agreement(fmu, mechanism, solution, {})
        return Result(fmu, "Path generator", {}, solution, swept(turned, SPEED, lambda *_: None), agreed)


def test_largest_deviations_are_the_oracles(solution):
    """Over the continuous turn, quasi-static and periodic at 500 rpm with 2 % damping."""
    assert solution.static.largest_deviation == pytest.approx(0.0744696716 * INCH, rel=1e-9)
    assert math.degrees(solution.static.largest_at) == pytest.approx(13.309, abs=1e-3)
    assert solution.dynamic.largest_deviation == pytest.approx(0.0939424413 * INCH, rel=1e-9)
    assert math.degrees(solution.dynamic.largest_at) == pytest.approx(9.6056, abs=1e-4)


@pytest.mark.parametrize(
    ("degrees", "x", "y", "torque"),
    [(30, 0.0577198319228, -0.0239236983318, -44.65658864), (60, 0.0197192762558, -0.0126183323705, 58.03112767)],
)
def test_case_2_of_the_oracle_in_si_units(solution, degrees, x, y, torque):
    row = int(np.flatnonzero(solution.degrees == degrees)[0])
    # the oracle's g has eight digits
    assert solution.static.deflection[row, :2] == pytest.approx((x * INCH, y * INCH), rel=1e-8)
    assert solution.rigid.torque[row] == pytest.approx(torque * INCH * POUND_FORCE, rel=1e-8)


def test_frequencies_at_60_degrees_are_the_oracles(solution):
    assert solution.frequencies[60, :3] == pytest.approx((78.22308, 242.84855, 1732.59658), abs=6e-6)


def test_a_coarse_table_has_every_tenth_row_of_a_fine_one(mechanism, solution):
    coarse = solved(prepared(mechanism, SPEED, 0.02, 36), SPEED, 0.02, 36)
    np.testing.assert_allclose(coarse.dynamic.deflection, solution.dynamic.deflection[::10], rtol=0, atol=1e-15)
    np.testing.assert_allclose(coarse.rigid.torque, solution.rigid.torque[::10], rtol=1e-12)
    assert coarse.static.largest_deviation == solution.static.largest_deviation
    np.testing.assert_array_equal(coarse.static.largest_stress, solution.static.stress.max(axis=0))
    np.testing.assert_allclose(coarse.static.stress_at, solution.angle[solution.static.stress.argmax(axis=0)])
    np.testing.assert_array_equal(coarse.frequency_range[:3, 0], solution.frequencies[:, :3].min(axis=0))


def test_the_fmu_agrees_in_all_positions(result):
    assert result.agreement.positions == 24
    assert {"path_deviation", "path_x_elastic", "arm_stress", "rocker_bar_stress"} <= set(result.agreement.differences)
    assert max(result.agreement.differences.values()) < 1e-10
    assert all(check.passed for check in result.checks)


def test_another_linkage_than_the_fmus_does_not_agree(result, mechanism, native_four_bar_path_generator_fmu):
    thicker = build_fmu.mechanism("four_bar_path_generator", arm_depth=0.0128)
    other = solved(prepared(thicker, SPEED, 0.02, 36), SPEED, 0.02, 36)
    with open_fmu(native_four_bar_path_generator_fmu) as fmu:
        found = agreement(fmu, mechanism, other, {})
    assert not found.checks[0].passed
    assert found.differences["path_deviation"] > 1e-3


def test_an_fmu_that_cannot_be_put_into_positions_is_not_compared(mechanism, solution):
    mine = SimpleNamespace(description=SimpleNamespace(variables={"crank_angle_start": None}, model="Mine"))
    found = agreement(mine, mechanism, solution, {})
    assert found.checks == ()
    assert found.refusal.endswith("it lacks crank_speed_start")
    silent = agreement(mine, replace(mechanism, inputs=(), outputs=()), solution, {})
    assert silent.refusal.endswith(
        "it lacks crank_speed_start, an input of the torque on 'crank', outputs of elastic members"
    )


def test_sweep_meets_the_turn_at_its_speed_and_grows_with_the_square(result):
    sweep, found = result.sweep, result.solution
    here = int(np.argmin(np.abs(sweep.speed - SPEED)))
    assert sweep.speed[here] == pytest.approx(SPEED, rel=1e-12)
    assert sweep.dynamic[here] == pytest.approx(found.dynamic.deviation.max(), rel=1e-6)
    np.testing.assert_allclose(sweep.static / sweep.speed**2, found.static.deviation.max() / SPEED**2, rtol=1e-12)


def test_files_hold_the_turn(result, tmp_path):
    files = write_result(result, tmp_path)
    assert [file.name for file in files] == ["cycle.csv", "cycle.parquet", "summary.json"]
    table, plain = pd.read_csv(files[0]), pd.read_parquet(files[1])
    assert table.columns[0] == "crank_angle [rad]"
    assert len(table) == len(plain) == 360
    np.testing.assert_array_equal(plain["quasi_static_deviation"], result.solution.static.deviation)
    np.testing.assert_array_equal(table["quasi_static_deviation [m]"], plain["quasi_static_deviation"])
    summary = json.loads(files[2].read_text())
    assert summary["elastodynamic"]["largest_deviation"] == result.solution.dynamic.largest_deviation
    assert max(summary["agreement_with_fmu"]["differences"].values()) < 1e-10
    assert summary["units"] == {name.split(" [")[0]: name.split(" [")[1][:-1] for name in table}


def test_rows_for_people_are_in_millimetres_and_megapascals(solution):
    shown = cycle_rows(solution)
    row = dict(zip(shown.headings, shown.rows[30], strict=True))
    assert row["phi [deg]"] == "30"
    assert float(row["dev qs [mm]"]) == pytest.approx(25.4 * math.hypot(0.0577198319, 0.0239236983), abs=5e-5)
    narrow = shown.without(narrow_columns(solution))
    kept = ["phi [deg]", "dev qs [mm]", "dev ed [mm]", "crank_bar [MPa]", "torque [N.m]"]
    assert narrow.headings == [*kept, "shake F [N]", "shake M [N.m]"]


def test_speeds_that_are_asked_for_are_a_file_and_peak_at_a_critical_speed(result, turned, tmp_path):
    """Harmonic 8 of the crank meets the first mode at 590 rpm: (K7) of docs/explanation/elastodynamics-dynamics.md."""
    speeds = asked(speeds=("530 rpm", "650 rpm", 25)).speeds
    assert speeds[0] * 30 / math.pi == pytest.approx(530)
    done = []
    sweep = swept(turned, SPEED, lambda text, part: done.append((text, part)), speeds)
    assert done[-1] == ("Speed 25 of 25", 1.0)
    files = write_result(replace(result, sweep=sweep, speeds_asked=True), tmp_path)
    table = pd.read_csv(files[2])
    assert files[2].name == "speeds.csv"
    np.testing.assert_allclose(table["crank_speed [rad/s]"], speeds, rtol=1e-12)
    magnification = table["elastodynamic_deviation [m]"] / table["quasi_static_deviation [m]"]
    critical = result.solution.critical[0, 7]
    assert critical * 30 / math.pi == pytest.approx(590, abs=0.5)
    assert table["crank_speed [rad/s]"][magnification.argmax()] == pytest.approx(critical, rel=0.03)


def test_the_report_marks_the_critical_speeds_within_the_sweep(result):
    found = result.solution
    html = ked_report(result)
    assert len(html) < 2.4e6  # with 0.1 MB of the animation
    shown = report_page.opened(html)
    assert "critical, mode 1" in shown
    assert "critical, mode 3" not in shown  # its eighth harmonic is at 12,762 rpm
    assert found.critical[2, 7] > result.sweep.speed[-1]


@pytest.mark.parametrize(
    ("speeds", "said"),
    [
        (("0", "800 rpm", 3), "a positive speed, a larger one"),
        (("800 rpm", "200 rpm", 3), "a positive speed, a larger one"),
        (("200 rpm", "nan", 3), "nan"),
        (("200 rpm", "8 m", 3), "8 m"),
        (("200 rpm", "800 rpm", 1), "1 of them cannot be; give 2 to 1000"),
        (("200 rpm", "800 rpm", 1001), "1001 of them cannot be"),
    ],
)
def test_speeds_that_cannot_be_are_refused(speeds, said):
    with pytest.raises(UsageError, match=said):
        asked(speeds=speeds)


def test_disturbances_die_out_as_fast_as_another_integrator_has_it(solution):
    # 0.304634: an integrator of another kind, in tests/unit/elastodynamics/test_stability.py
    assert solution.growth == pytest.approx(0.304634, rel=1e-5)


def test_the_papers_feedback_settles_at_low_speed_and_stalls_at_500_rpm(mechanism, solution):
    assert not solution.feedback.converged
    assert "settles to 0.064 of the quasi-static deviation after 3 rounds and no further" in feedback_sentence(solution)
    slow = solved(prepared(mechanism, SPEED / 10, 0.02, 36), SPEED / 10, 0.02, 36)
    assert slow.feedback.converged
    assert slow.feedback.largest_deviation == pytest.approx(slow.dynamic.largest_deviation, rel=1e-4)
    assert re.search(r"settles in \d rounds, with", feedback_sentence(slow))


@pytest.mark.parametrize("change", [{"mass": 2.0}, {"inertia": 0.1}])
def test_a_body_that_its_members_do_not_make_up_is_named(mechanism, solution, change):
    assert solution.notes == ()
    crank, coupler, rocker = mechanism.bodies
    other = replace(mechanism, bodies=(crank, replace(coupler, **change), rocker))
    (note,) = solved(prepared(other, SPEED, 0.02, 8), SPEED, 0.02, 8).notes
    assert "Body 'coupler' has" in note
    assert "lumped_body" in note


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["four_bar"], "Linkages with members: four_bar_path_generator."),
        (["four_bar_path_generator", "--step", "7"], "--step 7 deg cannot be"),
        (["four_bar_path_generator", "--damping", "2"], "The damping ratio is 2"),
        (["nothing_of_the_kind"], "There is no model 'nothing_of_the_kind'"),
    ],
)
def test_wrong_use_is_said(arguments, said, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = CliRunner().invoke(main, ["ked", *arguments])
    assert found.exit_code == 2
    assert said in " ".join(found.output.split())


@pytest.mark.slow
@pytest.mark.skipif(PROGRAM is None, reason="no chromium is installed (on Debian: apt install chromium)")
def test_the_reader_exaggerates_the_deflection_in_the_report(result, tmp_path):
    path = write_ked_report(result, tmp_path / "report.html")
    tip = "document.querySelector('.bent').getAttribute('points').split(' ').pop().split(',').map(Number)"
    with chromium(tmp_path / "profile") as browser, opened(browser, path, 1200) as page:
        page.wait_until("document.documentElement.classList.contains('drawn')")
        assert page.errors == []
        assert page.requests == [path.resolve().as_uri()]
        assert page.value("document.querySelectorAll('.plot > svg').length") >= 6
        once, twice = (
            (page.value(_exaggerate(factor)), page.value(tip), page.value(RIGID_TIP))[1:] for factor in (50, 100)
        )
        assert once[1] == twice[1]
        assert np.subtract(twice[0], twice[1]) == pytest.approx(2 * np.subtract(once[0], once[1]), abs=0.05)
        assert math.hypot(*np.subtract(once[0], once[1])) > 5
        page.click(".deflected .play")
        page.wait_until(f"{tip}.join() !== '{','.join(map(repr, twice[0]))}'")
        assert page.value("document.querySelector('.play').textContent") == "Pause"
    with chromium(tmp_path / "profile") as browser, opened(browser, path, 360) as page:
        assert page.value("document.documentElement.scrollWidth <= document.documentElement.clientWidth")


RIGID_TIP = "['x2', 'y2'].map((k) => Number(document.querySelector('.deflected line').getAttribute(k)))"


def _exaggerate(factor: int) -> str:
    """Moves the slider."""
    return (
        f"(() => {{ const s = document.querySelector('.times'); s.value = {factor};"
        " s.dispatchEvent(new Event('input')); return s.value; })()"
    )
