"""What `mechanism-fmu new --like` writes: each builds, runs, and does what it says; and what `check` says of files."""

import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from fmpy import read_model_description
from typer.testing import CliRunner

from harness.app.cli import main
from harness.app.commands.one_run import _LIKE
from harness.app.file_cli import New
from mechanism_fmu.fmu.own.find import Like, write_new
from mechanism_fmu.fmu.own.prepare import load
from mechanism_fmu.model import Model
from mechanism_fmu.simulation import simulate


def model(like: str, folder: Path) -> Model:
    found: Model = load(write_new(like, folder, Like(like))).MODEL
    return found


def check(path: Path | str, *options: str, code: int = 0) -> str:
    result = CliRunner().invoke(main, ["check", str(path), *options])
    assert result.exit_code == code, result.output
    return result.output


def test_the_command_offers_what_there_is() -> None:
    assert [new.value for new in New] == [like.value for like in Like] == list(_LIKE)


@pytest.mark.parametrize("like", list(Like))
def test_each_has_no_mistake_and_runs_in_red_nowhere(
    like: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    said = CliRunner().invoke(main, ["new", "mine", "--like", like]).stdout
    commands = [line.split()[1:] for line in said.splitlines() if line.startswith("mechanism-fmu")]
    text = Path("mine.py").read_text(encoding="utf-8")
    assert max(map(len, text.splitlines())) <= 123  # the lever's comment
    assert "NAME" not in text
    assert "Warning" not in check("mine.py")
    for words in commands:
        result = CliRunner().invoke(main, words)
        assert result.exit_code == 0, result.output
        assert "Warning" not in result.output


def test_the_four_bar_closes_at_the_angle_that_is_held(tmp_path: Path) -> None:
    """Freudenstein's equation for the rocker's angle at a crank angle of 60 degrees."""
    data = json.loads(check(write_new("four_bar", tmp_path, Like.FOUR_BAR), "--json"))
    assert data["degrees_of_freedom"] == 1
    poses = {body["name"]: body["pose"] for body in data["bodies"]}
    a, b, c, d, theta = 0.05, 0.18, 0.12, 0.2, math.radians(60)
    assert poses["crank"][2] == pytest.approx(theta, abs=1e-12)
    psi = poses["rocker"][2]
    freudenstein = d / a * math.cos(psi) - d / c * math.cos(theta) + (a * a - b * b + c * c + d * d) / (2 * a * c)
    assert freudenstein == pytest.approx(math.cos(theta - psi), abs=1e-9)


def test_the_cams_follower_follows_and_jumps_when_it_turns_too_fast(tmp_path: Path) -> None:
    cam = model("cam", tmp_path)
    slow = simulate(cam.build(cam.values(cam_speed=20.0)), 0.6)
    assert slow.impacts == ()
    assert slow["follower_y"].max() == pytest.approx(0.06, abs=1e-9)  # base radius and lift
    assert slow["follower_y"][0] == pytest.approx(0.04, abs=1e-12)
    fast = simulate(cam.build(cam.values(cam_speed=47.0)), 0.6)
    assert len(fast.impacts) > 1


def test_the_ratchet_advances_by_whole_teeth_a_stroke(tmp_path: Path) -> None:
    """Of a swing of 50 degrees two thirds of a tooth of 15 are lost: 40 are two teeth, and the load brings it back."""
    ratchet = model("ratchet", tmp_path)
    result = simulate(ratchet.build(ratchet.values()), 4.0)
    angles = [result.at(time)["wheel_angle"] for time in (1.0, 2.0, 3.0, 4.0)]
    pitch = math.radians(15)
    np.testing.assert_allclose(np.diff(angles), 2 * pitch, atol=1e-6)


# --- check -----------------------------------------------------------------------------------------------------------


def test_a_mistake_is_said_with_its_line(tmp_path: Path) -> None:
    path = write_new("lever", tmp_path)
    path.write_text(path.read_text(encoding="utf-8").replace('Revolute("hinge"', 'Revolut("hinge"'), encoding="utf-8")
    line = next(n for n, text in enumerate(path.read_text(encoding="utf-8").splitlines(), 1) if "Revolut(" in text)
    said = " ".join(check(path, code=1).split())
    assert f"line {line}" in said
    assert "did you mean 'Revolute'" in said
    data = json.loads(CliRunner().invoke(main, ["check", str(path), "--json"]).stdout)
    assert data["exit_code"] == 1
    assert len(data["mistakes"]) == 1


def test_what_cannot_be_assembled_is_a_mistake(tmp_path: Path) -> None:
    path = write_new("bars", tmp_path, Like.FOUR_BAR)
    text = path.read_text(encoding="utf-8").replace('"ground_length", 0.2', '"ground_length", 0.9')
    path.write_text(text, encoding="utf-8")
    said = " ".join(check(path, code=1).split())
    assert "do not reach each other" in said
    assert "bars.py" in said


def test_redundant_rows_are_named(tmp_path: Path) -> None:
    """Three equal cranks that carry one bar: the third says nothing new."""
    path = tmp_path / "parallel.py"
    path.write_text(_PARALLEL, encoding="utf-8")
    data = json.loads(check(path, "--json"))
    assert data["degrees_of_freedom"] == 1
    assert len(data["redundant"]) == 1
    assert not data["own_outputs"]
    assert {"bar_x", "kinetic_energy"} <= {output["name"] for output in data["outputs"]}


_PARALLEL = """
from mechanism_fmu.model import GROUND, Body, Distance, Mechanism, Model


def mechanism(values):
    rods = [
        Distance(name=f"rod{k}", body_i=GROUND, point_i=(k, 0.0), body_j="bar", point_j=(k - 1.0, 0.0), distance=1.0)
        for k in range(3)
    ]
    bar = Body(name="bar", mass=1.0, inertia=1.0, start=(1.6, 0.8, 0.0))
    return Mechanism(bodies=(bar,), joints=tuple(rods))


MODEL = Model(name="parallel", description="Three rods", parameters=(), mechanism=mechanism)
"""


def test_no_such_file_is_wrong_use(tmp_path: Path) -> None:
    check(tmp_path / "nothing.py", code=2)


# --- the options of all commands -------------------------------------------------------------------------------------


def test_json_is_one_object_wherever_the_option_stands(tmp_path: Path) -> None:
    path = write_new("lever", tmp_path)
    for words in (["--json", "check", str(path)], ["check", "--json", str(path)], ["check", str(path), "--json"]):
        data: dict[str, Any] = json.loads(CliRunner().invoke(main, words).stdout)
        assert (data["exit_code"], data["name"]) == (0, "lever")


def test_quiet_leaves_stdout_empty_and_errors_on_stderr(tmp_path: Path) -> None:
    path = write_new("lever", tmp_path)
    result = CliRunner().invoke(main, ["check", str(path), "--quiet"])
    assert (result.exit_code, result.stdout) == (0, "")
    result = CliRunner().invoke(main, ["check", str(tmp_path / "nothing.py"), "--quiet"])
    assert (result.exit_code, result.stdout) == (2, "")
    assert "There is no file" in result.stderr


def test_a_run_as_json_has_its_summary_and_times_have_units(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    write_new("fall", tmp_path, Like.BLANK)
    built = json.loads(CliRunner().invoke(main, ["build", "fall.py", "--json"]).stdout)
    assert built["exit_code"] == 0
    words = ["run", "build/fall.fmu", "--stop-time", "500ms", "--step", "10 ms", "--units-row", "--json"]
    data = json.loads(CliRunner().invoke(main, words).stdout)
    assert (data["final_time"], data["steps"]) == (0.5, 50)
    assert data["final_values"]["body_y"] == pytest.approx(-9.81 * 0.5**2 / 2, rel=1e-9)
    assert (tmp_path / "result" / "impacts.csv").read_text() == "time\ns\n"  # a body that falls strikes nothing
    table = pd.read_csv(tmp_path / "result" / "results.csv", header=[0, 1])
    assert dict(table.columns)["body_y"] == "m"
    assert "No stress" not in str(data)
    refused = CliRunner().invoke(main, ["run", "build/fall.fmu", "--stop-time", "5 m"])
    assert refused.exit_code == 2
    assert "--stop-time" in refused.stderr


def test_numbers_of_the_default_drawing_are_in_the_fmu_and_in_no_table(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    write_new("bars", tmp_path, Like.FOUR_BAR)
    assert CliRunner().invoke(main, ["build", "bars.py"]).exit_code == 0
    result = CliRunner().invoke(main, ["run", "build/bars.fmu", "--stop-time", "100ms", "--json"])
    drawn = [v for v in read_model_description("build/bars.fmu").modelVariables if v.name.startswith("drawing_")]
    assert {v.causality for v in drawn} == {"calculatedParameter"}
    summary = json.loads(Path("result/summary.json").read_text(encoding="utf-8"))
    assert set(summary["parameters"]) == set(summary["units"]["parameters"]) > {"ground_length", "crank_mass"}
    report = Path("result/report.html").read_text(encoding="utf-8")
    for text in (*summary["parameters"], *summary["units"]["parameters"], result.stdout, _without_scripts(report)):
        assert "drawing_" not in text
    assert "The mechanism at the time shown below" in report  # it is drawn, none the less


def _without_scripts(page: str) -> str:
    return re.sub(r"<script.*?</script>", "", page, flags=re.DOTALL)
