import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner

from harness.app.cli import main


def invoke(*arguments: str | Path) -> tuple[int, str]:
    result = CliRunner().invoke(main, [str(a) for a in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit)
    return result.exit_code, " ".join(result.output.split())


@pytest.fixture
def not_an_fmu(tmp_path: Path) -> Path:
    path = tmp_path / "photo.fmu"
    path.write_text("not a zip")
    return path


@pytest.fixture
def fmi1_fmu(tmp_path: Path) -> Path:
    path = tmp_path / "old.fmu"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr(
            "modelDescription.xml",
            '<fmiModelDescription fmiVersion="1.0" modelName="Old" modelIdentifier="Old" guid="0" '
            'numberOfContinuousStates="0" numberOfEventIndicators="0"><ModelVariables/></fmiModelDescription>',
        )
    return path


COMMANDS = [
    [],
    ["build"],
    ["cycle"],
    ["demo"],
    ["gradient"],
    ["identify"],
    ["identify", "impacts"],
    ["ked"],
    ["machine"],
    ["machine", "check"],
    ["machine", "container"],
    ["machine", "export"],
    ["machine", "import"],
    ["machine", "run"],
    ["modes"],
    ["new"],
    ["optimise"],
    ["page"],
    ["run"],
    ["study"],
    ["study", "ratchet"],
    ["sweep"],
    ["validate"],
]


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_every_command_explains_itself(command: list[str]) -> None:
    code, text = invoke(*command, "--help")
    assert code == 0
    assert "Usage:" in text


def test_help_of_run_teaches_by_example() -> None:
    _, text = invoke("run", "--help")
    assert "--set tooth_slope_angle=95deg" in text
    assert "Exit code: 0" in text


def test_version() -> None:
    from mechanism_fmu import __version__

    assert invoke("--version") == (0, f"mechanism-fmu {__version__}")


@pytest.mark.parametrize("command", ["run", "validate"])
def test_a_missing_fmu_is_wrong_use(command: str, tmp_path: Path) -> None:
    code, text = invoke(command, tmp_path / "nowhere.fmu")
    assert code == 2
    assert "There is no FMU file" in text
    assert "mechanism-fmu build ratchet" in text


@pytest.mark.parametrize("command", ["run", "validate"])
@pytest.mark.parametrize("name", ["../../outside.txt", "resources/../../../outside.txt", "/tmp/outside.txt"])
def test_an_fmu_that_would_write_outside_its_folder_is_wrong_use(
    command: str, name: str, slider_crank_fmu: Path, tmp_path: Path
) -> None:
    path = tmp_path / "leaving.fmu"
    shutil.copyfile(slider_crank_fmu, path)
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr(name, "anything")
    code, text = invoke(command, path)
    assert code == 2
    assert f"its entry '{name}'" in text
    assert "leads out of its folder" in text or "has an absolute path" in text


@pytest.mark.parametrize("command", ["run", "validate"])
def test_a_file_that_is_no_fmu_is_wrong_use(command: str, not_an_fmu: Path) -> None:
    code, text = invoke(command, not_an_fmu)
    assert code == 2
    assert "cannot be read as an FMU" in text


def test_another_version_of_fmi_is_wrong_use(fmi1_fmu: Path) -> None:
    code, text = invoke("run", fmi1_fmu)
    assert code == 2
    assert "is not an FMU for Model Exchange of FMI 2.0 or 3.0: it has Model Exchange only, of FMI 1.0" in text


@pytest.mark.parametrize("arguments", [["fly"], ["run"], ["run", "a.fmu", "--step", "fast"], ["study", "gearbox"]])
def test_wrong_arguments_are_wrong_use(arguments: list[str]) -> None:
    assert invoke(*arguments)[0] == 2


def test_build_knows_its_models(tmp_path: Path) -> None:
    code, text = invoke("build", "gearbox", "-o", tmp_path)
    assert code == 2
    known = (
        "cam_drive, four_bar, four_bar_path_generator, gear_train, geneva, geneva_clearance, graham, lever_escapement, "
        "motor, pin_pallet, ratchet, ratchet_free, recoil_anchor, rotary_table, slider_crank, verge"
    )
    assert f"There is no model 'gearbox'; there are: {known}" in text
    code, text = invoke("build", "--list")
    assert code == 0
    assert text.startswith("cam_drive Cam with a roller follower")
    assert " geneva External Geneva drive" in text
    assert " ratchet Ratchet of Pennestrì" in text


def test_help_of_run_says_what_its_tables_hold() -> None:
    """Their headings are those of the files: guard, and the modes as closed contacts."""
    _, text = invoke("run", "--help")
    said = " ".join(text.split())
    assert "impacts.csv has a row for each impact: time, contact, closing speed, impulse" in said
    assert "events.csv has a row for each event: time, guard (what happened), closed contacts before and after" in said


def test_help_does_not_wait_for_the_libraries() -> None:
    """Of all commands: it comes at once when nothing is imported for it but what parses and prints."""
    heavy = {
        "fmpy",
        "llvmlite",
        "mechanism_fmu",
        "models",
        "numba",
        "numpy",
        "pandas",
        "plotly",
        "pyarrow",
        "pydantic",
        "pythonfmu",
        "scipy",
    }
    script = f"""
import sys
from typer.testing import CliRunner
from harness.app.cli import main
for command in {COMMANDS}:
    assert CliRunner().invoke(main, [*command, "--help"]).exit_code == 0
print(sorted({heavy} & set(sys.modules)))
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("[]\n", "")


@pytest.mark.parametrize(
    ("command", "purpose"),
    [
        (["demo"], "run its base case for 6 s"),
        (["demo", "--full"], "run it through four strokes in 34 s"),
        (["study", "ratchet"], "run the paper's study with it"),
    ],
    ids=["demo", "full", "study"],
)
def test_what_is_being_done_is_said_first(command: list[str], purpose: str, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr("build_fmu.build", lambda *_: typer.echo("The engine is not inside"))
    code, text = invoke(*command, "-o", tmp_path)
    assert code == 2  # there is no FMU to go on with
    path = tmp_path / "Ratchet.fmu"
    assert text.startswith(f"Building the paper's ratchet, {path}, to {purpose}. The engine is not inside")


def test_a_build_says_what_it_made_before_what_it_lacks(ratchet_fmu: Path, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr("mechanism_fmu.fmu.package.build_fmu", lambda *_, **__: ratchet_fmu)
    monkeypatch.setattr("mechanism_fmu.fmu.native.objects.has_libraries", lambda: False)
    code, text = invoke("build", "ratchet", "-o", tmp_path)
    assert code == 0
    assert text.startswith(str(ratchet_fmu))
    assert text.index("GUID") < text.index("python -m pip install ziglang")
