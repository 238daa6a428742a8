import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from typer.testing import CliRunner

from harness.cli import main


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


@pytest.mark.parametrize("command", [[], ["run"], ["demo"], ["validate"], ["study"], ["study", "ratchet"], ["build"]])
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
def test_a_file_that_is_no_fmu_is_wrong_use(command: str, not_an_fmu: Path) -> None:
    code, text = invoke(command, not_an_fmu)
    assert code == 2
    assert "cannot be read as an FMU" in text


def test_another_version_of_fmi_is_wrong_use(fmi1_fmu: Path) -> None:
    code, text = invoke("run", fmi1_fmu)
    assert code == 2
    assert "is not an FMI 2.0 co-simulation FMU (its FMI version is 1.0)" in text


@pytest.mark.parametrize("arguments", [["fly"], ["run"], ["run", "a.fmu", "--step", "fast"], ["study", "gearbox"]])
def test_wrong_arguments_are_wrong_use(arguments: list[str]) -> None:
    assert invoke(*arguments)[0] == 2


def test_build_knows_its_models(tmp_path: Path) -> None:
    code, text = invoke("build", "gearbox", "-o", tmp_path)
    assert code == 2
    known = "cam_drive, four_bar, gear_train, geneva, ratchet, slider_crank"
    assert f"There is no model 'gearbox'; there are: {known}" in text
    code, text = invoke("build", "--list")
    assert code == 0
    assert text.startswith("cam_drive Cam with a roller follower")
    assert " geneva External Geneva drive" in text
    assert " ratchet Ratchet of Pennestrì" in text


def test_help_does_not_wait_for_the_libraries() -> None:
    heavy = "pandas", "numpy", "fmpy", "plotly", "mechanism_fmu", "models"
    script = f"import sys, harness.cli; sys.exit(bool(set({heavy!r}) & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", script], check=False).returncode == 0
