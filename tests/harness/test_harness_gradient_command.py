"""`mechanism-fmu gradient`: what it shows, gives as data and writes, and what it refuses."""

import json
import shutil
import zipfile
from pathlib import Path

import pandas as pd
import pytest
from typer.testing import CliRunner

from harness.app.cli import main
from harness.designs import by_batch

TIME, STRESS = "first_impact.time", "first_impact.stress_max"
ASKED = ["--of", TIME, "--of", STRESS, "--by", "pawl_length", "--by", "wheel_mass", "--stop-time", "1.2s"]


def invoke(*arguments: str | Path) -> tuple[int, str, str]:
    done = CliRunner().invoke(main, ["gradient", *map(str, arguments)])
    assert done.exception is None or isinstance(done.exception, SystemExit)
    return done.exit_code, done.stdout, done.stderr


def test_the_table(tmp_path: Path) -> None:
    code, out, err = invoke("ratchet", *ASKED)
    assert (code, err) == (0, "")
    assert f"{TIME} = 0.939921177 s, and how it changes with" in out
    cells = [[cell.strip() for cell in line.strip("│").split("│")] for line in out.splitlines() if line.startswith("│")]
    assert [row[:4] for row in cells] == [
        ["pawl_length", "0.1", "m", "-16.0954"],
        ["pawl_length", "0.1", "m", "-255283.6"],
    ]
    assert [row[5] for row in cells] == ["-1.7", "-1.6"]
    assert all(float(row[4]) < 1e-5 for row in cells)
    assert f"Note: {TIME} does not depend on wheel_mass." in out


def test_data_and_files(tmp_path: Path) -> None:
    table_file, data_file = tmp_path / "found.csv", tmp_path / "found.json"
    code, out, _ = invoke("ratchet", *ASKED, "--json", "-o", table_file)
    assert code == 0
    data = json.loads(out)
    assert data["exit_code"] == 0
    assert data["files"] == [str(table_file)]
    assert data["quantities"][TIME] == {"value": pytest.approx(0.939921177, rel=1e-9), "unit": "s"}
    assert data["variables"] == {"pawl_length": 0.1, "wheel_mass": pytest.approx(5.6264)}
    slope = data["derivatives"][TIME]["pawl_length"]
    assert slope == pytest.approx(-16.0954, abs=1e-4)
    assert 0.0 < data["errors"][TIME]["pawl_length"] < 1e-8
    assert data["relative"][TIME]["pawl_length"] == pytest.approx(slope * 0.1 / 0.939921177)
    assert data["derivatives"][STRESS]["wheel_mass"] == 0.0
    assert data["none"] == {}

    table = pd.read_csv(table_file)
    assert table.columns.tolist() == ["quantity", "variable", "value", "at", "derivative", "error"]
    assert table.set_index(["quantity", "variable"]).derivative[TIME, "pawl_length"] == pytest.approx(slope, rel=1e-15)
    assert len(table) == 4
    assert invoke("ratchet", *ASKED, "-o", data_file)[0] == 0
    kept = json.loads(data_file.read_text(encoding="utf-8"))
    assert {name: data[name] for name in kept} == kept


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--of", "first_impact.tim"], "--of: an impact has no 'tim'. Did you mean time?"),
        (["--of", "stress_max"], "--of: 'stress_max' is no quantity; write when and what"),
        (["--of", "end.clicks"], "--of: 'end.clicks' is Integer, which has no derivatives; a Real quantity has."),
        (["--of", TIME, "--by", "tooth_count"], "--by: 'tooth_count' is Integer; there are derivatives by Real"),
        (["--of", TIME, "--by", "guided"], "--by: 'guided' is Boolean; there are derivatives by Real"),
        (["--of", TIME, "--by", "pawl_lenght"], "Did you mean pawl_length"),
        (["--of", TIME, "--by", "wheel_angle"], "'wheel_angle' is a variable of causality output and cannot be set"),
        (["--of", TIME, "--stop-time", "0.5s"], f"The design has no {TIME}, as where there is no impact"),
        (["--of", TIME, "--set", "pawl_length=5mm"], "The design has no derivatives, because it fails: "),
        (["--of", TIME, "--stop-time", "1m"], "--stop-time = '1m': unit 'm' does not measure the same quantity"),
        (["--of", TIME, "-o", "found.txt"], "give a file that ends in .csv or .json"),
        (["--of", TIME, "-o", "nowhere/found.csv"], "There is no folder"),
        ([], "Missing option '--of'"),
    ],
)
def test_what_is_refused(options: list[str], said: str, ratchet_fmu: Path) -> None:
    code, _, err = invoke(ratchet_fmu, "--trust", *options)
    assert code == 2
    assert said in " ".join(err.split())


@pytest.mark.parametrize("model", ["cuckoo", "cuckoo.fmu"])
def test_a_model_that_is_not_there_is_refused(model: str) -> None:
    code, _, err = invoke(model, "--of", TIME)
    assert code == 2
    assert "There is no " in err


def test_a_kink_is_an_error_where_it_was_asked_for() -> None:
    """Without friction nothing sticks on the slope, with however little it does."""
    code, out, err = invoke("ratchet", "--of", TIME, "--by", "friction", "--by", "pawl_mass", "--stop-time", "1.2s")
    assert code == 1
    assert (
        "Error: No derivatives by friction: within 4.0e-03 of 0 the events change: end.slope_sticks is False, but "
        "beside it True. Choose a value beside it; or, if what is asked comes first, an earlier --stop-time."
    ) in err
    assert "pawl_mass" in out


def test_a_kink_is_a_note_otherwise_and_beside_it_there_is_a_derivative(tmp_path: Path) -> None:
    path = tmp_path / "found.csv"
    code, out, err = invoke("ratchet", "--of", TIME, "--stop-time", "1.2s", "-o", path)
    assert (code, err) == (0, "")
    assert "Note: No derivatives by friction: within 4.0e-03 of 0 the events change" in out
    table = pd.read_csv(path).set_index("variable")
    assert table.derivative.isna().sum() == 2  # restitution, too: with a little of it there are more impacts
    assert table.derivative["restitution":"restitution"].isna().all()
    code, out, _ = invoke("ratchet", "--of", TIME, "--by", "friction", "--set", "friction=0.1", "--json")
    assert code == 0
    assert json.loads(out)["derivatives"][TIME]["friction"] == pytest.approx(0.08733, abs=1e-5)


@pytest.fixture(scope="module")
def unknown_fmu(ratchet_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One that no build here has made."""
    path = tmp_path_factory.mktemp("unknown") / "Ratchet.fmu"
    shutil.copyfile(ratchet_fmu, path)
    with zipfile.ZipFile(path, "a") as archive:
        archive.comment = b"from somewhere"
    return path


@pytest.mark.parametrize("trust", [False, True])
def test_an_fmu_runs_in_this_process_only_if_it_is_trusted(
    trust: bool, unknown_fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    called = []
    real = by_batch._batch
    monkeypatch.setattr(by_batch, "_batch", lambda path: called.append(path) or real(path))
    code, out, err = invoke(unknown_fmu, *ASKED, "--json", *(["--trust"] if trust else []))
    assert (code, err) == (0, "")
    assert bool(called) is trust
    found = json.loads(out)
    assert found["derivatives"][TIME]["pawl_length"] == pytest.approx(-16.0954, abs=1e-4)
    assert found["derivatives"][TIME]["wheel_mass"] == 0.0


def test_an_fmu_without_the_sources_of_its_model_runs_through_its_calls(native_slider_crank_fmu: Path) -> None:
    by = ["--by", "crank_length", "--by", "offset"]
    code, out, err = invoke(native_slider_crank_fmu, "--of", "parameter.crank_length", *by, "--json", "--trust")
    assert (code, err) == (0, "")
    found = json.loads(out)["derivatives"]["parameter.crank_length"]
    assert found == {"crank_length": pytest.approx(1.0, rel=1e-9), "offset": 0.0}


def test_its_help_teaches_by_example() -> None:
    code, out, _ = invoke("--help")
    assert code == 0
    assert "gradient ratchet --of first_impact.time" in out
    assert "Exit code: 0 all well" in out
    assert "--fast" not in out
