"""What `ked` can be asked besides: limits, the lightest design, a flywheel, friction; forces on the frame always."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

import build_fmu
from harness.app.cli import main
from harness.errors import UsageError
from harness.fmu import open_fmu
from harness.papers.ked.files import Result, agreement, write_result
from harness.papers.ked.judged_by import JudgedBy
from harness.papers.ked.ked_report import ked_report
from harness.papers.ked.options import Limits, asked
from harness.papers.ked.solution import solution_checks
from harness.papers.ked.solve import prepared, solved, swept
from harness.papers.ked.synthesis import bounds_of, synthesised
from harness.papers.ked.tables import (
    cycle_rows,
    flywheel_sentence,
    frame_sentence,
    friction_sentence,
    joint_rows,
    synthesis_rows,
)
from mechanism_fmu.elastodynamics import with_friction
from tests.report_page import opened

MODEL, SPEED = "four_bar_path_generator", 500 * math.pi / 30
DEPTHS = ["crank_depth", "coupler_depth", "rocker_depth", "arm_depth"]


def described(values):
    return build_fmu.mechanism(MODEL, **values)


def analysed(values, samples=360):
    return solved(prepared(described(values), SPEED, 0.02, samples), SPEED, 0.02, samples)


@pytest.fixture(scope="module")
def told(native_four_bar_path_generator_fmu: Path):
    with open_fmu(native_four_bar_path_generator_fmu) as fmu:
        return fmu.description


@pytest.fixture(scope="module")
def plain():
    return analysed({}, 36)


@pytest.fixture(scope="module")
def rubbing():
    turned = prepared(with_friction(described({}), 0.1, 0.005), SPEED, 0.02, 36)
    return turned, solved(turned, SPEED, 0.02, 36, fluctuation=0.02)


@pytest.fixture(scope="module")
def lightest(told):
    """By the quasi-static solution, which is quick."""
    limits = Limits(1e-3, 60e6, JudgedBy.QUASI_STATIC)
    said = []
    found = synthesised(
        bounds_of([], described, {}, told),
        described,
        {},
        told,
        "arm.end",
        SPEED,
        0.02,
        limits,
        analysed,
        lambda text, done: said.append((text, done)),
    )
    assert said[0][0] == "Design 1: 0.4493 kg, 1.891 mm, 162.5 MPa"
    assert [done for _, done in said] == sorted(done for _, done in said)
    assert said[-1][1] < 1.0
    return found


def test_depths_of_all_members_vary_unless_told(told):
    found = bounds_of([], described, {}, told)
    assert [bound.name for bound in found] == DEPTHS
    assert [bound.least for bound in found] == pytest.approx([0.0127 / 4] * 4)
    assert [bound.largest for bound in found] == pytest.approx([0.0127 * 4] * 4)
    (arm,) = (b for b in bounds_of([], described, {"arm_depth": 0.02}, told) if b.name == "arm_depth")
    assert (arm.least, arm.largest) == pytest.approx((0.005, 0.08))


@pytest.mark.parametrize(
    ("text", "least", "largest"),
    [
        ("arm_depth=5..20 mm", 0.005, 0.02),
        ("arm_depth = 5mm..0.02", 0.005, 0.02),
        ("arm_width=0.004..0.02", 0.004, 0.02),
        ("arm_depth=0.5cm .. 20mm", 0.005, 0.02),
    ],
)
def test_bounds_are_understood_with_their_units(told, text, least, largest):
    (found,) = bounds_of([text], described, {}, told)
    assert (found.least, found.largest) == pytest.approx((least, largest), rel=1e-12)


@pytest.mark.parametrize(
    ("vary", "said"),
    [
        (["arm_depth"], "is no range; write NAME=LEAST..LARGEST"),
        (["arm_depth=5"], "is no range"),
        (["arm_deep=5..20 mm"], "has no variable 'arm_deep'"),
        (["crossed=0..1"], "is no real parameter"),
        (["drive_torque=0..1"], "is no real parameter"),
        (["arm_depth=20..5 mm"], "the lower bound must be below the upper one"),
        (["arm_depth=5..20 kg"], "unit 'kg' does not measure the same quantity"),
        (["arm_depth=5..20mm", "arm_depth=5..30mm"], "'arm_depth' is varied twice"),
        (["crank_length=90..110 mm"], "'crank_length' is no size of a section"),
        (["density=7000..8000"], "These can be varied: crank_width, crank_depth,"),
    ],
)
def test_bounds_that_cannot_be_are_refused(told, vary, said):
    with pytest.raises(UsageError, match=said.replace("(", r"\(")):
        bounds_of(vary, described, {}, told)


def test_the_lightest_design_keeps_to_its_limits_in_the_fmu(lightest, native_four_bar_path_generator_fmu):
    """Analysed anew by another program: the engine's own statics in the FMU, with the torque that keeps its speed."""
    found = solved(prepared(described(lightest.values), SPEED, 0.02, 120), SPEED, 0.02, 120)
    deviation, stress = [], []
    with open_fmu(native_four_bar_path_generator_fmu) as fmu:
        for angle, torque in zip(found.angle.tolist(), found.rigid.torque.tolist(), strict=True):
            with fmu.instantiate("one") as one:
                start = {"crank_angle_start": angle, "crank_speed_start": SPEED, "drive_torque": torque}
                one.set({**lightest.values, **start, "drive_damping": 0.0})
                one.initialize(0.0, 1.0)
                deviation += one.get(["path_deviation"])
                stress += one.get([f"{member}_stress" for member in ("arm", "crank_bar", "coupler_bar", "rocker_bar")])
    assert max(deviation) <= 1e-3
    assert 0.99 * 60e6 < max(stress) <= 60e6


def test_the_lightest_design_is_within_its_limits_over_the_whole_turn(lightest):
    found = analysed(lightest.values)
    assert all(check.passed for check in lightest.limits.checks(found))
    assert found.static.largest_stress.max() == pytest.approx(60e6, rel=1e-3)
    assert lightest.before.deviation.max() > 1.8e-3
    # as docs/explanation/elastodynamics-dynamics.md finds it with one depth for coupler and arm: at most that heavy
    assert lightest.after.mass < 0.5091
    assert lightest.values["rocker_depth"] == pytest.approx(0.0127 / 4)


def test_no_lighter_neighbour_keeps_to_the_limits(lightest):
    """Any member thinner by half a percent, all else being the same, is out of limits or was at its bound."""
    for name in ("crank_depth", "coupler_depth", "arm_depth"):
        thinner = {**lightest.values, name: 0.995 * lightest.values[name]}
        assert not all(check.passed for check in lightest.limits.checks(analysed(thinner)))


def test_a_synthesis_that_cannot_be_says_how_near_it_came(told):
    limits = Limits(1e-3, 1e6, JudgedBy.QUASI_STATIC)
    with pytest.raises(UsageError, match=r"Widen the bounds, or allow more\. Varied were: arm_depth"):
        synthesised(
            bounds_of(["arm_depth=10..20 mm"], described, {}, told),
            described, {}, told, "arm.end", SPEED, 0.02, limits, analysed, lambda *_: None,
        )  # fmt: skip


def test_the_table_of_the_synthesis_has_parameters_mass_and_limits(lightest, told):
    rows = {row[0]: row[1:] for row in synthesis_rows(lightest, told).rows}
    assert list(rows) == [*DEPTHS, "mass of all members", "largest deviation", "largest stress"]
    assert rows["mass of all members"][0] == "0.44928"
    assert rows["largest deviation"][2:] == ["mm", "at most 1"]
    assert rows["largest stress"][3] == "at most 60"


def test_limits_alone_are_verdicts(plain):
    deviation, stress = Limits(3e-3, 100e6).checks(plain)
    assert (deviation.passed, stress.passed) == (True, False)
    assert deviation.claim.startswith("The elastodynamic deviation")
    assert "in crank_bar; limit 100 MPa" in stress.evidence
    (quasi,) = Limits(2e-3, None, JudgedBy.QUASI_STATIC).checks(plain)
    assert quasi.passed
    assert not Limits(2e-3).checks(plain)[0].passed
    assert Limits().checks(plain) == ()


def test_verdicts_of_a_turn_change_at_their_limits(plain):
    """The limits: 1e-9 of the power, 1e-8 of the force on the frame and of the motion, 1e-6 of what may grow."""

    def passed(**numbers: float) -> list[bool]:
        rigid = replace(plain.rigid, power_gap=0.1 * numbers["force"], shaking_gap=numbers["force"])
        found = replace(plain, rigid=rigid, residual=numbers["force"], jump=0.0, growth=numbers["growth"])
        return [check.passed for check in solution_checks(found)]

    assert passed(force=1e-8, growth=1 + 0.99e-6) == [True] * 4
    assert passed(force=1.01e-8, growth=1 + 1.01e-6) == [False] * 4
    assert solution_checks(replace(plain, residual=1e-3, jump=1e-3))[2].passed


def test_shaking_is_always_in_table_and_files(plain):
    shown = cycle_rows(plain)
    assert shown.headings[-2:] == ["shake F [N]", "shake M [N.m]"]
    row = shown.rows[3]
    x, y = plain.rigid.shaking.force[3]
    assert float(row[-2]) == pytest.approx(math.hypot(x, y), abs=0.05)
    whole = analysed({})
    # the largest of all calculated angles, though the table has each tenth only
    assert plain.rigid.largest_shaking == whole.rigid.largest_shaking
    assert whole.rigid.largest_shaking[0].value == whole.rigid.shaking_force.max() > plain.rigid.shaking_force.max()
    assert f"shaking force up to {whole.rigid.shaking_force.max():.4g} N at 17 deg" in frame_sentence(plain)
    assert plain.rigid.shaking_gap < 1e-10
    assert (friction_sentence(plain), flywheel_sentence(plain)) == ("", "")
    assert joint_rows(plain).headings == ["joint", "largest force [N]", "at [deg]"]


def test_friction_and_flywheel_are_in_files_and_report(rubbing, native_four_bar_path_generator_fmu, tmp_path):
    turned, found = rubbing
    frictionless = analysed({}, 36)
    with open_fmu(native_four_bar_path_generator_fmu) as fmu:
        agreed = agreement(fmu, described({}), frictionless, {})
        sweep = swept(turned, SPEED, lambda *_: None)
        result = Result(fmu, "Path generator", {}, found, sweep, agreed, frictionless=frictionless)
        files = write_result(result, tmp_path)
        page = opened(ked_report(result))
    assert all(check.passed for check in result.checks)
    table = pd.read_csv(files[0])
    torque = table["friction_torque_crank_hinge [N.m]"]
    np.testing.assert_allclose(torque, -0.1 * 0.005 * table["joint_force_crank_hinge [N]"], rtol=1e-12)
    speed = table["crank_speed_with_flywheel [rad/s]"]
    assert abs(speed / SPEED - 1.0).max() <= 0.01 + 1e-9
    summary = json.loads(files[2].read_text())
    assert summary["flywheel"]["inertia"] == pytest.approx(found.rigid.fluctuation.energy / (0.02 * SPEED**2))
    assert summary["flywheel"]["largest_speed"] == pytest.approx(1.01 * SPEED)
    lost = sum(summary["friction"]["lost_energy"].values())
    assert lost == pytest.approx(2 * math.pi * summary["input_torque"]["mean"], rel=1e-9)
    assert abs(summary["friction"]["input_torque_without"]["mean"]) < 1e-9
    assert summary["shaking"]["largest_force"] == pytest.approx(
        frictionless.rigid.largest_shaking[0].value, rel=1e-9
    )  # friction within the linkage has no say
    assert summary["synthesis"] is None
    for heading in ("On the frame and in the joints", "Friction in the joints", "Flywheel"):
        assert f"<h2>{heading}</h2>" in page
    assert "Shaking force: hodograph" in page
    assert "Shaking moment about (0, 0) mm" in page


@pytest.mark.parametrize("coefficient", [0.03, 0.3])
def test_what_a_series_leaves_at_jumps_is_a_part_of_the_jump(coefficient, plain):
    """As of any jump: a share of it that does not depend on its height, nor on the number of angles."""
    turned = prepared(with_friction(described({}), coefficient, 0.005), SPEED, 0.02, 36)
    found = solved(turned, SPEED, 0.02, 36)
    assert found.residual / found.jump == pytest.approx(0.41, abs=0.02)
    assert plain.jump == 0.0
    assert any("Coulomb friction jumps" in note for note in found.notes)


def test_the_report_shows_the_lightest_design(lightest, plain, native_four_bar_path_generator_fmu):
    with open_fmu(native_four_bar_path_generator_fmu) as fmu:
        turned = prepared(described({}), SPEED, 0.02, 36)
        agreed = agreement(fmu, described({}), plain, {})
        sweep = swept(turned, SPEED, lambda *_: None)
        page = opened(ked_report(Result(fmu, "", {}, plain, sweep, agreed, lightest.limits, lightest)))
    assert "<h2>The lightest design within the limits</h2>" in page
    assert "Deviation, quasi-static" in page
    assert "Friction in the joints" not in page
    assert "Flywheel" not in page


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--synthesise"], "add --limit-deviation '1 mm' and --limit-stress '60 MPa'"),
        (["--synthesise", "--limit-stress", "60MPa"], "add --limit-deviation '1 mm'."),
        (["--vary", "arm_depth=5..20mm"], "add --synthesise"),
        (["--limit-deviation", "1 kg"], "unit 'kg' does not measure the same quantity"),
        (["--limit-deviation", "0"], "--limit-deviation is 0 m; give more than 0"),
        (["--limit-stress", "much"], "is not a number"),
        (["--fluctuation", "0"], "--fluctuation 0 cannot be"),
        (["--friction", "-1"], "--friction -1 cannot be"),
        (["--pin-radius", "5mm"], "add its coefficient, e.g. --friction 0.1"),
        (["--friction", "0.1", "--pin-radius", "-5mm"], "--pin-radius is -0.005 m; give more than 0"),
        (["--judge", "eye"], "Invalid value for '--judge'"),
    ],
)
def test_wrong_use_is_said_before_anything_is_built(arguments, said, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = CliRunner().invoke(main, ["ked", MODEL, *arguments])
    assert found.exit_code == 2
    assert said in " ".join(found.output.replace("│", " ").split())
    assert list(tmp_path.iterdir()) == []


def test_options_are_understood():
    found = asked("1mm", "60MPa", JudgedBy.QUASI_STATIC, True, ["arm_depth=5..20mm"], 0.02, 0.1, "5 mm")
    assert found.limits == Limits(pytest.approx(1e-3), pytest.approx(60e6), JudgedBy.QUASI_STATIC)
    assert (found.fluctuation, found.friction, found.pin_radius) == (0.02, 0.1, pytest.approx(5e-3))
    assert asked().limits == Limits()
