"""The commands `machine export`, `import` and `container`: what they write and say, and how they end."""

from pathlib import Path

import pandas as pd
import pytest
from typer.testing import CliRunner

from harness.app.cli import main
from harness.app.commands import machine_exchange
from harness.fmu.description_file import read_description
from mechanism_fmu.fmu.disk.archive import read_entries, write_archive
from tests.harness.machine.machines import BACK, geared_cam, invoke


@pytest.fixture
def machine(tmp_path, native_gear_train_fmu, native_cam_drive_fmu) -> Path:
    return geared_cam(tmp_path, native_gear_train_fmu, native_cam_drive_fmu)


def test_export_and_import(machine, tmp_path):
    code, text = invoke("export", machine, "-o", tmp_path / "geared.ssp")
    assert code == 0
    assert "The file has parameters and gains, offsets or conversions of units: it is for tools that apply them" in text
    assert 'parameter_set="Geared_cam"' in text
    assert "--baked puts them into copies of the FMUs" in text
    code, text = invoke("import", tmp_path / "geared.ssp", "-o", tmp_path / "back")
    assert code == 0
    assert f"mechanism-fmu machine run {tmp_path / 'back' / 'geared.toml'}" in text
    assert invoke("run", tmp_path / "back/geared.toml", "-o", tmp_path / "result")[0] == 0
    invoke("run", machine, "-o", tmp_path / "original")
    one, two = (pd.read_parquet(tmp_path / name / "results.parquet") for name in ("result", "original"))
    pd.testing.assert_frame_equal(one, two, check_exact=True)
    assert invoke("import", machine, "-o", tmp_path / "nothing")[0] == 2


def test_an_import_overwrites_nothing_and_leaves_nothing_behind_when_it_fails(machine, tmp_path):
    ssp, folder = tmp_path / "geared.ssp", tmp_path / "back"
    assert invoke("export", machine, "-o", ssp)[0] == 0
    folder.mkdir()
    (folder / "geared.toml").write_text("# by hand")
    (folder / "notes.txt").write_text("mine")
    code, said = invoke("import", ssp, "-o", folder)
    assert code == 2
    assert "has geared.toml already, and nothing is overwritten. Choose another folder with -o" in said
    assert sorted(file.name for file in folder.iterdir()) == ["geared.toml", "notes.txt"]
    assert (folder / "geared.toml").read_text() == "# by hand"
    entries = read_entries(ssp)
    structure = entries["SystemStructure.ssd"]
    for change in ((b'step="0.005"', b'step="-5"'), (b'"wheel_speed"', b'"wheel_sped"')):
        assert change[0] in structure
        write_archive({**entries, "SystemStructure.ssd": structure.replace(*change)}, ssp)
        code, said = invoke("import", ssp, "-o", tmp_path / "new")
        assert code == 2
        assert "mechanism-fmu-" not in said  # a folder that is gone
        assert not (tmp_path / "new").exists()
    write_archive(entries, ssp)
    (folder / "geared.toml").unlink()
    assert invoke("import", ssp, "-o", folder)[0] == 0
    assert (folder / "notes.txt").read_text() == "mine"


def test_container(machine, tmp_path, monkeypatch):
    machine.write_text(machine.read_text().replace(BACK, ""))
    code, text = invoke("container", machine, "-o", tmp_path / "Geared.fmu")
    assert code == 0
    assert f"mechanism-fmu run {tmp_path / 'Geared.fmu'}" in text
    other = machine.rename(tmp_path / "2-geared cam.toml")
    monkeypatch.chdir(tmp_path)
    assert invoke("container", other)[0] == 0
    assert (tmp_path / "_2_geared_cam.fmu").is_file()
    other.rename(machine)
    with monkeypatch.context() as patch:
        patch.setattr(machine_exchange, "prepared", lambda _: pytest.fail("a model was built"))
        code, said = invoke("container", machine, "-o", "geared-cam.fmu")
    assert code == 2
    assert "'geared-cam.fmu' is no name for an FMU" in said
    result = CliRunner().invoke(main, ["run", str(tmp_path / "Geared.fmu"), "-o", str(tmp_path / "result")])
    assert result.exit_code == 0
    results = pd.read_csv(tmp_path / "result/results.csv")
    invoke("run", machine, "-o", tmp_path / "machine")
    own = pd.read_parquet(tmp_path / "machine/results.parquet")
    assert results["cam.cam_angle"].to_numpy()[::2] == pytest.approx(own["cam.cam_angle"].to_numpy(), rel=1e-9)


def test_export_of_a_machine_with_numbers_of_its_own(machine, tmp_path):
    """Files of this version's models are built anew; nothing is left for the tool to apply."""
    code, text = invoke("export", machine, "--baked", "-o", tmp_path / "baked.ssp")
    assert code == 0, text
    assert "Building gear_train (native) with the numbers of gears" in text
    assert "it is for tools that apply them" not in text
    assert "not 0 at the start" not in text  # from rest, at 0
    entries = read_entries(tmp_path / "baked.ssp")
    assert sorted(entries) == ["SystemStructure.ssd", "resources/cam.fmu", "resources/gears.fmu"]
    assert b"LinearTransformation" not in entries["SystemStructure.ssd"]
    cam = read_description(_file(tmp_path / "cam.fmu", entries["resources/cam.fmu"]))
    assert float(str(cam.variables["drive_stiffness"].start)) == 5.0
    gears = read_description(_file(tmp_path / "gears.fmu", entries["resources/gears.fmu"]))
    assert "acts as -1 * value + 0.001 N.m" in gears.variables["load_torque"].description


def _file(path: Path, contents: bytes) -> Path:
    path.write_bytes(contents)
    return path


def test_export_says_where_the_first_step_of_fmpy_is_another(machine, tmp_path):
    moved = machine.read_text().replace("drive_torque = 0.0\n", 'drive_torque = 0.0\npinion_angle_start = "90 deg"\n')
    machine.write_text(moved)
    code, text = invoke("export", machine, "-o", tmp_path / "plain.ssp")
    assert code == 0
    assert "not 0 at the start are gears.wheel_angle" in text
