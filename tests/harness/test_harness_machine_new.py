"""`machine new`: a file that runs as it is, with all of its tables; and names that cannot be."""

from pathlib import Path

import pandas as pd
import pytest
from typer.testing import CliRunner

from harness.app.cli import main
from harness.machine.file.read_file import TABLES


def invoke(*arguments: str) -> tuple[int, str]:
    result = CliRunner().invoke(main, ["machine", *arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit)
    return result.exit_code, " ".join(result.output.split())


def test_it_runs_as_it_is(tmp_path, monkeypatch, native_gear_train_fmu, native_cam_drive_fmu) -> None:
    monkeypatch.chdir(tmp_path)
    code, text = invoke("new", "my_machine")
    assert (code, "mechanism-fmu machine run my_machine.toml" in text) == (0, True)
    file = Path("my_machine.toml")
    written = file.read_text(encoding="utf-8")
    assert "NAME" not in written
    assert all(f"[{table}" in written or f"{table} =" in written for table in TABLES)
    for model, fmu in (("gear_train", native_gear_train_fmu), ("cam_drive", native_cam_drive_fmu)):
        written = written.replace(f'model = "{model}"', f'file = "{fmu}"')
    # The connection that is commented out can be, too.
    switched = written.partition("# [[connect]]")[2].partition("\n\n")[0]
    asked = "\n".join(line.removeprefix("# ") for line in f"# [[connect]]{switched}".splitlines())
    file.write_text(written.replace("drive_torque = 0.0\n", "").replace("[[bond]]", f"{asked}\n\n[[bond]]"))
    assert invoke("check", "my_machine.toml")[0] == 0
    file.write_text(written)
    code, text = invoke("run", "my_machine.toml")
    assert (code, "1200 steps in" in text) == (0, True), text
    assert pd.read_parquet("my_machine/results.parquet")["cam.cam_angle"].abs().max() > 1.0


@pytest.mark.parametrize(("name", "better"), [("my machine", "my_machine"), ("3d", "my_3d"), ("ä-b", "b")])
def test_a_name_that_cannot_be(tmp_path, monkeypatch, name: str, better: str) -> None:
    monkeypatch.chdir(tmp_path)
    code, text = invoke("new", name)
    assert (code, f"mechanism-fmu machine new {better}" in text) == (2, True), text
    assert list(tmp_path.iterdir()) == []


def test_nothing_is_overwritten(tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("one.toml").write_text("mine")
    code, text = invoke("new", "one.toml")
    assert (code, "is there already" in text) == (2, True)
    assert Path("one.toml").read_text() == "mine"
