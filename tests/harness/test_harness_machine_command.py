"""The commands `machine run`, `check` and `new`: what they write and say, and how they end."""

import json
import os
import signal
from pathlib import Path

import pandas as pd
import pytest

import build_fmu
from harness.app.commands import machine_ready, machine_run
from harness.app.execution import alone_in
from harness.app.terminal import RunDisplay
from harness.errors import UsageError
from harness.fmu.interface import Observable
from harness.machine.observers import growing_table, record
from tests.harness.machine.machines import geared_cam, invoke


@pytest.fixture
def machine(tmp_path, native_gear_train_fmu, native_cam_drive_fmu) -> Path:
    return geared_cam(tmp_path, native_gear_train_fmu, native_cam_drive_fmu)


def test_run_writes_results_impacts_and_a_summary(machine, tmp_path):
    code, text = invoke("run", machine, "-o", tmp_path / "result")
    assert code == 0
    assert "200 steps in" in text
    assert "Energy over bonds" in text
    assert "gears, cam follow each other: a cycle." in text
    results = pd.read_parquet(tmp_path / "result/results.parquet")
    assert next(iter(results)) == "time"
    assert {"gears.wheel_angle", "cam.cam_angle", "cam.cam_speed"} <= set(results)
    assert len(results) == 101  # every second communication point
    assert results["time"].iloc[-1] == 1.0
    assert (tmp_path / "result/impacts.csv").is_file()
    report = (tmp_path / "result/report.html").read_text(encoding="utf-8")
    assert report.count("<svg role") == 2  # gears and cam
    assert "<h2>Signals of cam</h2>" in report
    assert "<h2>Energy over bonds</h2>" in report
    summary = json.loads((tmp_path / "result/summary.json").read_text())
    assert (summary["title"], summary["ending"], summary["steps"]) == ("Geared cam", "completed", 200)
    assert summary["units"]["results"]["cam.cam_angle"] == "rad"
    assert summary["components"]["cam"]["statistics"]["steps"] == 200
    assert summary["components"]["gears"]["start_values"]["drive_torque"] == 0.0
    assert summary["bonds"].keys() == {"shaft"}
    assert summary["run"]["algorithm"] == "jacobi"


def test_two_runs_do_not_mix_in_one_folder(machine, tmp_path):
    folder = tmp_path / "same"
    with alone_in(folder):  # as another run has it
        code, text = invoke("run", machine, "-o", folder)
        assert code == 2
        assert f"Another command is at work in '{folder}'" in text
        assert "Choose another folder with -o" in text
        assert [path.name for path in folder.iterdir()] == [".lock"]
    assert invoke("run", machine, "-o", folder)[0] == 0


def test_the_folder_has_the_name_of_the_file(machine, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert invoke("run", machine)[0] == 0
    assert (tmp_path / "geared_cam/summary.json").is_file()


def test_another_table_of_inputs(machine, tmp_path):
    table = tmp_path / "load.csv"
    table.write_text("time [s],cam.load_torque [N.mm]\n0,0\n1,100\n")
    assert invoke("run", machine, "--input", table, "-o", tmp_path / "loaded")[0] == 0
    assert invoke("run", machine, "-o", tmp_path / "free")[0] == 0
    loaded, free = (pd.read_parquet(tmp_path / name / "results.parquet") for name in ("loaded", "free"))
    assert abs(loaded["cam.cam_angle"].iloc[-1] - free["cam.cam_angle"].iloc[-1]) > 1e-3
    table.write_text("time [s],gears.drive_speed [rpm]\n0,0\n1,100\n")
    code, said = invoke("run", machine, "--input", table)
    assert code == 2
    assert "'gears.drive_speed' is in" in said


def test_check_shows_what_is_in_it_and_runs_nothing(machine, tmp_path):
    before = set(tmp_path.iterdir())
    code, text = invoke("check", machine)
    assert code == 0
    assert "cam.drive_shaft_torque" in text
    assert "* -1 + 0.001 N.m" in text
    assert "The file has no mistakes." in text
    assert set(tmp_path.iterdir()) == before


def test_mistakes_are_told_all_at_once_before_anything_is_built(machine, tmp_path, monkeypatch):
    text = machine.read_text().replace("gears.wheel_speed", "gears.wheel_sped", 2)
    machine.write_text(text + '[component.other]\nmodel = "geneav"\n')
    monkeypatch.setattr(build_fmu, "built", lambda *_: pytest.fail("a model was built"))
    code, said = invoke("run", machine, "-o", tmp_path / "result")
    assert code == 2
    assert "geared_cam.toml has 3 mistakes; nothing was run." in said
    assert said.count("Did you mean wheel_speed") == 2
    assert "there is no model 'geneav'. Did you mean geneva" in said
    assert not (tmp_path / "result").exists()


def test_a_machine_that_is_not_there(tmp_path, monkeypatch):
    ready = {"indexing_table": tmp_path / "indexing_table.toml"}
    monkeypatch.setattr(machine_ready.build_fmu, "machines", lambda: ready)
    code, text = invoke("run", "indexing_tabel")
    assert code == 2
    assert "There is no machine 'indexing_tabel'. Did you mean indexing_table?" in text
    assert invoke("check", tmp_path / "nowhere.toml")[0] == 2


def test_a_ready_machine_by_its_name(machine, tmp_path, monkeypatch):
    monkeypatch.setattr(machine_ready.build_fmu, "machines", lambda: {"ready": machine})
    code, text = invoke("run", "ready", "-o", tmp_path / "result")
    assert code == 0
    assert "Geared cam: gears, cam" in text


def test_ready_machines_have_no_mistakes_that_can_be_found_without_building():
    for path in build_fmu.machines().values():
        file = machine_ready.TomlFile.read(path)
        machine_ready.components(file, build_fmu.model_names())
        file.check()


def test_a_component_that_fails_ends_the_run_with_its_name_and_keeps_what_was_recorded(machine, tmp_path):
    """A step of the input that no integrator can follow."""
    table = tmp_path / "drive.csv"
    table.write_text("time [s],gears.drive_angle\n0,0\n0.5,0\n0.501,1e300\n1,1e300\n")
    text = machine.read_text().replace('step = "5 ms"', 'step = "5 ms"\ninput = "drive.csv"')
    machine.write_text(text.replace("drive_torque = 0.0", "drive_torque = 0.0\ndrive_stiffness = 1.0"))
    code, said = invoke("run", machine, "-o", tmp_path / "result")
    assert code == 1
    assert "gears failed at t = 0.5" in said
    assert "The files hold what was recorded up to 0.5" in said
    results = pd.read_parquet(tmp_path / "result/results.parquet")
    assert results["time"].iloc[-1] == pytest.approx(0.5, abs=0.011)
    assert json.loads((tmp_path / "result/summary.json").read_text())["ending"] == "failed"


def test_a_component_that_cannot_begin_leaves_an_earlier_run_alone(machine, tmp_path):
    assert invoke("run", machine, "-o", tmp_path / "result")[0] == 0
    before = {file: file.read_bytes() for file in (tmp_path / "result").iterdir()}
    machine.write_text(
        machine.read_text().replace("[component.cam.set]", '[component.cam.set]\nfollower_length = "9 m"')
    )
    code, said = invoke("run", machine, "-o", tmp_path / "result")
    assert code == 1
    assert "cam failed before the first step" in said
    assert "Nothing was written" in said
    assert {file: file.read_bytes() for file in (tmp_path / "result").iterdir()} == before


def test_a_full_disk_ends_the_run_and_leaves_what_can_be_written(machine, tmp_path, monkeypatch):
    """Files of an earlier run are named, so that nobody takes them for this one's."""
    folder = tmp_path / "result"
    assert invoke("run", machine, "-o", folder)[0] == 0
    usual, written = growing_table.write_binary, []

    def until_full(path, write):
        written.append(path)
        if len(written) > 2:
            raise UsageError(f"'{path}' cannot be written: no space left.")
        return usual(path, write)

    monkeypatch.setattr(growing_table, "write_binary", until_full)
    monkeypatch.setattr(record, "_PATIENCE", 0.0)
    code, said = invoke("run", machine, "-o", folder)
    assert code == 1
    assert "no space left. What was recorded before is whole: 2 file(s)" in said
    assert "results.parts, impacts.csv, summary.json" in said
    assert f"Of an earlier run in {folder}: results.parquet, report.html" in said
    summary = json.loads((folder / "summary.json").read_text())
    assert (summary["ending"], summary["results"]) == ("failed", "results.parts")
    assert summary["final_time"] < 0.1
    assert len(pd.read_parquet(folder / "results.parts")) == 2
    monkeypatch.undo()

    def refuse(path, data):
        raise UsageError(f"'{path}' cannot be written: no space left.")

    monkeypatch.setattr(machine_run, "write_json", refuse)
    machine.write_text(machine.read_text().replace("every = 2", 'every = 2\nformat = "csv"'))
    code, said = invoke("run", machine, "-o", folder)
    assert code == 1
    assert f"'{folder / 'summary.json'}' cannot be written: no space left." in said
    assert f"Of an earlier run in {folder}: summary.json" in said
    assert not (folder / "results.parquet").exists()  # results.csv takes its place
    assert not (folder / "results.parts").exists()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_control_c_and_sigterm_keep_what_was_recorded(machine, tmp_path, monkeypatch, number):
    usual = RunDisplay.stepped

    def stepped(self: RunDisplay, unit: Observable, time: float) -> None:
        usual(self, unit, time)
        if time == 0.5:
            os.kill(os.getpid(), number)

    monkeypatch.setattr(RunDisplay, "stepped", stepped)
    code, said = invoke("run", machine, "-o", tmp_path / "result")
    assert code == 130
    assert "Interrupted: the files hold what was recorded up to 0.5 s of 1 s" in said
    results = pd.read_parquet(tmp_path / "result/results.parquet")
    assert results["time"].iloc[-1] == 0.5
    assert (tmp_path / "result/report.html").is_file()


def test_a_component_in_a_process_of_its_own(machine, tmp_path):
    invoke("run", machine, "-o", tmp_path / "one")
    machine.write_text(machine.read_text().replace("[component.cam.set]", "process = true\n[component.cam.set]"))
    code, _ = invoke("run", machine, "-o", tmp_path / "two")
    assert code == 0
    one, two = (pd.read_parquet(tmp_path / name / "results.parquet") for name in ("one", "two"))
    pd.testing.assert_frame_equal(one, two, check_exact=True)


def test_a_run_with_another_step_other_values_and_as_others_do(machine, tmp_path):
    """What is changed for one run is in its record, and so is how it stepped."""
    code, text = invoke(
        *("run", machine, "-o", tmp_path / "out", "--step", "10 ms", "--as-others"),
        *("--set", "cam.drive_stiffness=4", "--set", "gears.drive_damping=0.4 N.m.s/rad"),
    )
    assert code == 0
    assert "100 steps in" in text
    assert "Stepped as the masters of other tools do" in text
    summary = json.loads((tmp_path / "out/summary.json").read_text())
    run = summary["run"]
    assert (run["step"], run["algorithm"]) == (0.01, "jacobi")
    assert (run["extrapolation"], run["reads_once"]) == ("constant", True)
    assert summary["components"]["cam"]["start_values"]["drive_stiffness"] == 4.0
    assert summary["components"]["gears"]["start_values"]["drive_damping"] == 0.4


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--step", "0"), "step"),
        (("--step", "5 m"), "does not measure the same quantity"),
        (("--set", "cam.drive_angle=1"), "'cam.drive_angle' follows gears.wheel_angle, by a connection"),
        (("--set", "cam.stiffness=1"), "has no variable 'cam.stiffness'. Did you mean cam."),
        (("--set", "cam.drive_stiffness"), "is not a setting"),
        (("--set", "cam.drive_stiffness=-1"), "is below its limit"),
    ],
)
def test_changes_that_cannot_be(machine, tmp_path, arguments, said):
    code, text = invoke("run", machine, "-o", tmp_path / "out", *arguments)
    assert (code, said in text) == (2, True), text
    assert not (tmp_path / "out/summary.json").exists()
