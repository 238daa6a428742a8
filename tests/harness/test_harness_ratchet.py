"""The harness around the real FMU; numbers from the reference table of the paper's ratchet."""

import json
import math
from html import escape
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from harness.app.cli import main
from harness.errors import UsageError
from harness.fmu import Fmu, open_fmu
from harness.papers.study.study import Study, ratchet_study
from harness.report.animation import animation, animation_data
from harness.run.drawing import Drawing
from harness.run.experiment import Experiment, Run, perform
from harness.run.master import Ending
from harness.run.validate import validate

DOCS = Path(__file__).parents[2] / "docs"

#: By beta_0 [deg]: t_I [s] and omega just after the impact [rad/s], from two independent implementations.
IMPACTS = {
    85: (0.9573080523, 0.0228046146),
    90: (0.9399211769, 0.0227388573),
    95: (0.9277144372, 0.0227178290),
    100: (0.9194210908, 0.0227425265),
    105: (0.9143304857, 0.0228158202),
}
#: By nt and beta_0 [deg]: sigma_max [Pa], from the same sources.
#: By the plain implementation in `benchmarks.ratchet` at 1e-12 (and C of decision 003).
STRESSES = {(10, 90): 16080.32337, (20, 95): 6552.67683, (25, 85): 2270.30220, (10, 105): 22966.82150}


@pytest.fixture(scope="module")
def fmu(ratchet_fmu: Path) -> Fmu:  # type: ignore[misc]
    with open_fmu(ratchet_fmu) as fmu:
        yield fmu


@pytest.fixture(scope="module")
def base_case(fmu: Fmu) -> Run:
    return perform(fmu, Experiment(6.0, 1e-3))


@pytest.fixture(scope="module")
def study(fmu: Fmu) -> Study:
    return ratchet_study(fmu, lambda *_: None)


def invoke(*arguments: str | Path) -> tuple[int, str]:
    result = CliRunner().invoke(main, [str(a) for a in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit)
    return result.exit_code, " ".join(result.output.split())


def test_the_base_case(base_case: Run) -> None:
    first = base_case.impacts.iloc[0]
    assert base_case.outcome.ending is Ending.COMPLETED
    assert first["time"] == pytest.approx(IMPACTS[90][0], rel=1e-7)
    assert first["wheel_speed"] == pytest.approx(IMPACTS[90][1], rel=1e-7)
    assert first["impulse"] == pytest.approx(7.7895902699e-3, rel=1e-7)
    assert first["stress_max"] == pytest.approx(STRESSES[10, 90], rel=1e-7)
    assert all(check.passed for check in base_case.checks)


def test_the_animation_puts_the_pawl_into_the_root_when_they_meet(base_case: Run) -> None:
    data = animation_data(base_case)
    assert data is not None
    after = int(np.searchsorted(data["time"], data["impacts"][0]))
    columns = [column[after] for column in data["columns"]]
    wheel, crank, pawl = (shape for shape in data["shapes"] if "angle" in shape)
    psi, phi, gamma = (columns[shape["angle"][0]] for shape in (wheel, crank, pawl))
    tip = crank["at"][0] + crank["length"] * np.exp(1j * phi) + pawl["length"] * np.exp(1j * gamma)
    root = wheel["outline"][0][0] * np.exp(1j * psi)
    # angles are rounded to 1e-4 rad
    assert abs(tip - root) < 2e-5
    assert (wheel["count"], pawl["at"], data["shapes"][-1]) == (
        10,
        "crank",
        {"kind": "striker", "name": "", "at": "pawl"},
    )
    assert len(animation(base_case)) < 300_000


def test_impact_velocity_is_the_jump_of_the_wheels_speed_times_tooth_length(base_case: Run) -> None:
    first = base_case.impacts.iloc[0]
    jump = first["wheel_speed"] - first["wheel_speed_before"]
    assert first["velocity"] == pytest.approx(jump * base_case.parameters["tooth_length"], rel=1e-12)


@pytest.mark.parametrize("step", [1e-4, 7e-3, 0.05, 1.0])
def test_the_impact_does_not_depend_on_the_communication_step(fmu: Fmu, base_case: Run, step: float) -> None:
    run = perform(fmu, Experiment(1.0, step))
    assert run.impacts["time"].iloc[0] == pytest.approx(base_case.impacts["time"].iloc[0], rel=1e-9)
    assert run.impacts["impulse"].iloc[0] == pytest.approx(base_case.impacts["impulse"].iloc[0], rel=1e-7)


def test_inputs_from_a_table_act(fmu: Fmu, tmp_path: Path) -> None:
    table = tmp_path / "torque.csv"
    table.write_text("time [ms],drive_torque [N.mm]\n0,1\n6000,1\n")
    driven = perform(fmu, Experiment(1.0, 1e-3, input_file=table))
    assert driven.impacts["time"].iloc[0] == pytest.approx(IMPACTS[90][0], rel=1e-7)
    table.write_text("time [ms],drive_torque [N.mm]\n0,4\n6000,4\n")
    stronger = perform(fmu, Experiment(1.0, 1e-3, input_file=table))
    assert stronger.impacts["time"].iloc[0] < driven.impacts["time"].iloc[0]


def test_the_study_reproduces_the_paper(fmu: Fmu) -> None:
    numbers: list[int] = []
    study = ratchet_study(fmu, lambda number, of: numbers.append(number))
    assert numbers == list(range(1, 21))
    for wheel in study.wheels:
        time, speed = IMPACTS[wheel.slope_angle_deg]
        assert wheel.impact_time == pytest.approx(time, rel=1e-7)
        assert wheel.wheel_speed == pytest.approx(speed, rel=1e-7)
        assert wheel.stress_position == pytest.approx(0.3956, abs=1e-4)
        if (wheel.tooth_count, wheel.slope_angle_deg) in STRESSES:
            stress = STRESSES[wheel.tooth_count, wheel.slope_angle_deg]
            assert wheel.stress_max == pytest.approx(stress, rel=1e-7)
    assert [check.passed for check in study.checks] == [True, True, True]


def test_validate_finds_nothing(fmu: Fmu) -> None:
    verdicts = list(validate(fmu))
    assert len(verdicts) == 7
    assert [v for v in verdicts if not v.passed] == []


def test_run_writes_everything_and_says_so(ratchet_fmu: Path, tmp_path: Path) -> None:
    settings = ["--set", "tooth_slope_angle=95deg", "--set", "tooth_count=20", "--stop-time", "1.5", "--step", "1e-3"]
    code, text = invoke("run", ratchet_fmu, *settings, "-o", tmp_path)
    assert code == 0
    assert "0.927714437" in text
    assert "results.csv, impacts.csv, events.csv, summary.json, report.html" in text
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert summary["parameters"]["tooth_slope_angle"] == pytest.approx(math.radians(95), rel=1e-15)
    assert summary["final_time"] == 1.5
    assert len(pd.read_csv(tmp_path / "results.csv")) == 1501
    assert pd.read_csv(tmp_path / "impacts.csv")["stress_max"][0] == pytest.approx(STRESSES[20, 95], rel=1e-7)


def test_the_report_works_offline(ratchet_fmu: Path, tmp_path: Path) -> None:
    assert invoke("run", ratchet_fmu, "--stop-time", "1.2", "-o", tmp_path)[0] == 0
    html = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "plotly" not in html
    assert "<script src=" not in html
    assert "<link" not in html
    for heading in (
        "Verdicts",
        "Mechanism",
        "Motion",
        "Bending stress in the tooth",
        "Impacts",
        "Modes and transitions",
        "Events",
    ):
        assert f"<h2>{heading}</h2>" in html


def test_modes_are_printed_and_drawn(ratchet_fmu: Path, tmp_path: Path) -> None:
    code, text = invoke("modes", ratchet_fmu, "-o", tmp_path / "guided.svg")
    assert code == 0
    assert "face.touches and face.approaches" in text
    assert "slope is closed throughout." in text
    code, text = invoke("modes", ratchet_fmu, "--set", "guided=false", "-o", tmp_path / "free.svg")
    assert code == 0
    assert "holding_pawl.click" in text
    assert "teeth.next" in (tmp_path / "free.svg").read_text(encoding="utf-8")
    code, text = invoke("modes", ratchet_fmu, "--set", "guided=maybe")
    assert code == 2


def test_the_events_of_the_base_case(base_case: Run) -> None:
    first = base_case.events.iloc[0]
    assert first["time"] == base_case.impacts["time"].iloc[0]
    assert list(first[["guard", "old_mode", "new_mode"]]) == ["face.gap", "slope", "slope+face"]
    assert base_case.events_lost == 0
    assert len(base_case.events) == base_case.results["event_count"].iloc[-1]


def test_the_study_shows_its_base_case_in_motion(study: Study, base_case: Run) -> None:
    assert study.base_case.impacts["time"][0] == base_case.impacts["time"][0]
    assert len(study.base_case.results) == 121
    assert study.parameters["hinge_distance"] == (0.13,) * 20
    assert study.parameters["drive_torque"] == (1e-3,) * 20


def test_a_warning_is_told_once_for_all_wheels(study: Study) -> None:
    pulls, apex = study.warnings
    assert pulls.endswith(
        "(nt = 10, beta_0 = 105 deg; nt = 15, beta_0 = 105 deg; nt = 20, beta_0 = 105 deg; nt = 25, beta_0 = 105 deg)"
    )
    assert "0.00536908 m beyond the apex" in apex
    assert "(nt = 25, beta_0 = 85 deg; with other numbers also nt = 25, beta_0 = 90 deg; nt" in apex


def test_an_fmu_without_a_drawn_wheel_is_no_ratchet(fmu: Fmu, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("harness.papers.study.study.read_drawing", lambda *_: Drawing())
    with pytest.raises(UsageError, match="its drawing has no wheel"):
        ratchet_study(fmu, lambda *_: None)


def test_teeth_have_the_paper_s_shape(study: Study) -> None:
    r = 0.1
    for wheel, rim in zip(study.wheels, study.rims, strict=True):
        theta, beta = 2 * math.pi / wheel.tooth_count, wheel.tooth_slope_angle
        slope = 1.115 * 2 * r * math.sin(theta / 2)
        x, y = rim.tooth()
        assert x == pytest.approx([0, slope * math.sin(beta), r * math.sin(theta)], abs=1e-15)
        assert y == pytest.approx([0, -slope * math.cos(beta), r * math.cos(theta) - r], abs=1e-15)


def test_the_study_command_writes_table_and_figures(ratchet_fmu: Path, tmp_path: Path) -> None:
    code, text = invoke("study", "ratchet", "--fmu", ratchet_fmu, "-o", tmp_path)
    assert code == 0
    described = " ".join((DOCS / "case-studies.md").read_text(encoding="utf-8").split())
    for said in (
        text[text.index("First impact") : text.index("Warning")],
        text[text.index("✓") : text.index("Written")],
    ):
        assert said.strip() in described
    table = pd.read_csv(tmp_path / "study.csv")
    assert len(table) == 20
    assert table["impact_time [s]"][1] == pytest.approx(IMPACTS[90][0], rel=1e-7)
    assert table["wheel_speed [rad/s]"][1] == pytest.approx(IMPACTS[90][1], rel=1e-7)
    assert table["stress_max [Pa]"][1] == pytest.approx(STRESSES[10, 90], rel=1e-7)
    summary = json.loads((tmp_path / "study.json").read_text(encoding="utf-8"))
    assert summary["units"]["stress_max"] == "Pa"
    assert summary["parameters"]["tooth_count"][::5] == [10, 15, 20, 25]
    assert summary["versions"]["model"] == "Ratchet"
    assert [finding["verdict"] for finding in summary["findings"]] == [
        "holds in part",
        "taken over",
        "holds in part",
    ]
    slenderness = [1 / math.tan(wheel["tooth_apex_angle"]) for wheel in summary["wheels"]]
    assert [wheel["slenderness"] for wheel in summary["wheels"]] == pytest.approx(slenderness, rel=1e-12)
    assert list(table["slenderness"]) == pytest.approx(slenderness, rel=1e-12)
    page = (tmp_path / "study.html").read_text(encoding="utf-8")
    for heading in ("Wheel shapes", "Tooth shapes", "Stress along the tooth", "Maximum bending stress"):
        assert f"<h2>{heading}" in page
    for finding in summary["findings"]:
        assert f"{escape(finding['claim'])}</td><td>{finding['verdict']}</td>" in page
    for name in ("fig08_wheels", "fig09_teeth", "fig10_stress", "fig11_maximum"):
        assert (tmp_path / f"{name}.svg").read_bytes() == (DOCS / "case-studies" / f"{name}.svg").read_bytes()
        assert (tmp_path / f"{name}.png").read_bytes().startswith(b"\x89PNG")


def test_the_demo_is_one_command(tmp_path: Path) -> None:
    code, text = invoke("demo", "-o", tmp_path)
    assert code == 0
    assert text.count("agrees with the reference") == 4
    assert {path.name for path in tmp_path.iterdir()} - {".lock"} == {
        *("Ratchet.fmu", "results.csv", "impacts.csv", "events.csv", "summary.json", "report.html"),
    }


def test_the_full_demo_indexes_four_teeth_and_shows_them(tmp_path: Path) -> None:
    code, text = invoke("demo", "--full", "-o", tmp_path)
    assert code == 0
    for claim in ("clicks four times", "One tooth a stroke", "latched at 147 deg", "closes to 1e-8 of the work"):
        assert claim in text
    report = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "The holding pawl clicks four times" in report
    for part in ("slope", "face", "holding pawl"):  # a band and a lamp each
        assert part in report
    events = pd.read_csv(tmp_path / "events.csv")
    assert (events["guard"] == "holding_pawl.click").sum() == 4
    assert (events["guard"] == "teeth.next").sum() == 4
    results = pd.read_csv(tmp_path / "results.csv")
    assert results["latched_angle"].nunique() == 5


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--set", "tooth_cuont=20"], "Did you mean tooth_count"),
        (["--set", "drive_torque=2 mm"], "these fit: N.m"),
        (["--set", "wheel_angle=1"], "cannot be set"),
        (["--step", "0"], "at least one nanosecond"),
        (["--stop-time", "-1"], "stop time is -1 s"),
        (["--input", "nowhere.csv"], "cannot be read"),
    ],
)
def test_wrong_use_is_told_before_anything_runs(
    ratchet_fmu: Path, tmp_path: Path, arguments: list[str], message: str
) -> None:
    code, text = invoke("run", ratchet_fmu, *arguments, "-o", tmp_path / "out")
    assert code == 2
    assert message in text
    assert [path.name for path in tmp_path.glob("out/*") if path.name != ".lock"] == []


def test_a_mechanism_that_cannot_be_assembled_fails_with_the_fmu_s_advice(ratchet_fmu: Path, tmp_path: Path) -> None:
    code, text = invoke("run", ratchet_fmu, "--set", "crank_length=10 mm", "-o", tmp_path)
    assert code == 1
    assert "Ratchet failed before the first step" in text
    assert "it gave no reason" not in text
