"""A mechanism in a file of the user's own, from `mechanism-fmu new` to numbers: what the page in docs/ promises."""

import math
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pandas as pd
import pytest
from fmpy.validation import validate_fmu
from typer.testing import CliRunner

import mechanism_fmu.model
from harness.app.cli import main
from mechanism_fmu.fmu.own.find import write_new

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "tutorials" / "your-first-mechanism.md").read_text(encoding="utf-8")
#: The pages that name every part and every builder of ports.
_PAGES = ("tutorials/your-first-mechanism", "reference/parts", "reference/ports", "reference/units-and-start")
_PAGES_OF_TASKS = ("how-to/law-of-force", "how-to/stress-in-a-part")
LISTS = "".join((ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8") for name in (*_PAGES, *_PAGES_OF_TASKS))

FLAVOURS = {"pythonfmu": (), "native": ("--flavour", "native"), "native3": ("--flavour", "native", "--fmi", "3")}

#: The lever is a rod of this length [m] on a hinge, which falls through this angle [rad].
LENGTH, ANGLE, GRAVITY, BOUNCE = 0.2, math.radians(30), 9.81, 0.2


def build(path: Path | str, output: Path, *arguments: str) -> tuple[Path, str]:
    """Build by the command; the FMU, and the GUID that was shown."""
    result = CliRunner().invoke(main, ["build", str(path), "-o", str(output), *arguments])
    assert result.exit_code == 0, result.output
    guid = re.search(r"GUID (\S+)", result.stdout)
    assert guid is not None
    return next(output.glob("*.fmu")), guid[1]


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_new("lever", tmp_path_factory.mktemp("own"))


@pytest.fixture(scope="module")
def fmus(source: Path) -> dict[str, Path]:
    return {name: build(source, source.parent / name, *flavour)[0] for name, flavour in FLAVOURS.items()}


@pytest.mark.parametrize("name", FLAVOURS)
def test_the_template_becomes_an_fmu_without_a_remark(name: str, fmus: dict[str, Path]) -> None:
    assert fmus[name].name == "lever.fmu"
    assert validate_fmu(str(fmus[name])) == []


@pytest.fixture(scope="module")
def runs(fmus: dict[str, Path]) -> dict[str, np.ndarray]:
    outputs = ["angle", "speed", "stop_torque", "impact_count", "impacts[1].time", "impacts[1].closing_speed"]
    return {
        name: fmpy.simulate_fmu(str(fmus[name]), stop_time=1.0, output_interval=2e-3, output=outputs)
        for name in ("pythonfmu", "native")
    }


def test_both_flavours_give_the_same_numbers(runs: dict[str, np.ndarray]) -> None:
    assert runs["pythonfmu"].dtype.names == runs["native"].dtype.names
    for name in runs["native"].dtype.names:
        np.testing.assert_allclose(runs["pythonfmu"][name], runs["native"][name], rtol=0, atol=1e-14)


def test_the_lever_strikes_with_the_energy_of_its_fall(runs: dict[str, np.ndarray]) -> None:
    """Half of J omega^2 is the weight times the fall of the centre of mass; J = m l^2 / 3 about the hinge."""
    result = runs["native"]
    speed = math.sqrt(3 * GRAVITY * math.sin(ANGLE) / LENGTH)
    first = int(np.argmax(result["impact_count"] > 0))
    assert result["impacts[1].closing_speed"][first] == pytest.approx(speed, rel=1e-8)
    flight = result["time"][first] - result["impacts[1].time"][first]
    falling = 3 * GRAVITY / (2 * LENGTH)  # angular deceleration close to the stop
    assert result["speed"][first] == pytest.approx(BOUNCE * speed - falling * flight, rel=1e-3)


def test_the_lever_comes_to_rest_on_the_stop(runs: dict[str, np.ndarray]) -> None:
    result = runs["native"]
    assert abs(result["angle"][-1]) < 1e-9
    mass = 0.1
    assert result["stop_torque"][-1] == pytest.approx(mass * GRAVITY * LENGTH / 2, rel=1e-9)


def test_the_printed_commands_build_and_run_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    said = CliRunner().invoke(main, ["new", "arm"]).stdout
    commands = [line.split()[1:] for line in said.splitlines() if line.startswith("mechanism-fmu")]
    assert [words[0] for words in commands] == ["build", "run"]
    for words in commands:
        result = CliRunner().invoke(main, words)
        assert result.exit_code == 0, result.output
    assert "10 collected, 10 counted by the FMU" in result.output
    assert "[rad/s]" in result.output  # an angle stop closes with an angular speed
    assert (tmp_path / "result" / "report.html").is_file()


# --- where the file is, and what it is called ------------------------------------------------------------------------


@pytest.mark.parametrize("flavour", ["pythonfmu", "native"])
def test_the_same_sources_give_the_same_bytes_wherever_they_are(
    flavour: str, source: Path, fmus: dict[str, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also when an editor has left a mark in front and the line ends of Windows, and beside files of other things."""
    copy = tmp_path / "lever.py"
    copy.write_bytes(b"\xef\xbb\xbf" + source.read_bytes().replace(b"\n", b"\r\n"))
    (tmp_path / "__init__.py").write_text("raise RuntimeError\n")
    (tmp_path / "README.md").write_text("# Other\n\n![missing](missing.png)\n")
    (tmp_path / "model.png").write_bytes(b"not mine")
    monkeypatch.chdir(tmp_path)
    for number, path in enumerate((copy, Path("..") / tmp_path.name / "lever.py")):
        again, _ = build(path, tmp_path / str(number), *FLAVOURS[flavour])
        assert again.read_bytes() == fmus[flavour].read_bytes()
    assert not (tmp_path / "__pycache__").exists()


@pytest.mark.parametrize("name", ["my-lever.py", "2nd lever.py", "mechanism_fmu.py"])
def test_the_name_of_the_file_may_be_no_identifier(name: str, source: Path, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_bytes(source.read_bytes())
    fmu, _ = build(path, tmp_path / "out")
    assert fmpy.simulate_fmu(str(fmu), stop_time=0.2, output=["impact_count"])["impact_count"][-1] > 0


@pytest.mark.parametrize(("name", "flavour"), [("numpy.py", "pythonfmu"), ("random.py", "native")])
def test_a_file_named_like_a_module_hides_nothing(name: str, flavour: str, source: Path, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(source.read_bytes())
    command = [sys.executable, str(ROOT / "build_fmu.py"), name, "-o", "out", *FLAVOURS[flavour]]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / "lever.fmu").is_file()


def test_a_file_may_import_its_neighbours_and_is_read_anew_each_time(source: Path, tmp_path: Path) -> None:
    path = tmp_path / "lever.py"
    text = source.read_text().replace("START = deg(30)", "from .numbers import START")
    path.write_text(text)
    guids = []
    for angle in (0.1, 0.2):  # of the same length, within the same second
        (tmp_path / "numbers.py").write_text(f"START = {angle}\n")
        fmu, guid = build(path, tmp_path / "out")
        guids.append(guid)
        result = fmpy.simulate_fmu(str(fmu), stop_time=0.01, output=["angle"])
        assert result["angle"][0] == pytest.approx(angle)
    assert len(set(guids)) == 2
    with zipfile.ZipFile(fmu) as archive:
        names = [name for name in archive.namelist() if "/models/" in name and "/__pycache__/" not in name]
        own = {name.rpartition("/")[2] for name in names}
    assert own == {"lever.py", "numbers.py"}


# --- the documentation -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", FLAVOURS)
def test_the_page_in_the_fmu_is_the_docstring(name: str, fmus: dict[str, Path]) -> None:
    with zipfile.ZipFile(fmus[name]) as archive:
        html = archive.read("documentation/index.html").decode()
    assert "<h1>lever</h1>" in html
    assert "A lever that falls on a stop" in html
    assert "A lever on a hinge falls on a stop and bounces; a motor's torque can lift it." in html
    assert "<code>stop_torque</code>" in html


def test_the_page_in_docs_shows_the_template(source: Path) -> None:
    assert f"```python\n{source.read_text()}```\n" in PAGE


def test_the_page_in_docs_names_every_public_part() -> None:
    public = {name: getattr(mechanism_fmu.model, name) for name in mechanism_fmu.model.__all__}
    tables = ("MechanismTables", "compile_mechanism")  # for programs, not for a mechanism's file
    parts = [name for name, part in public.items() if callable(part) and name not in tables]
    assert [name for name in parts if f"`{name}" not in LISTS] == []


# --- more impacts in a step than the FMU holds -----------------------------------------------------------------------


@pytest.mark.parametrize("name", FLAVOURS)
def test_a_lever_that_bounces_to_rest_is_no_failure(name: str, fmus: dict[str, Path], tmp_path: Path) -> None:
    """Each impact is slower than the one before by the restitution; in two steps there are more than the FMU holds."""
    asked = ["run", str(fmus[name]), "--set", "bounce=0.9", "--stop-time", "6", "-o", str(tmp_path)]
    result = CliRunner().invoke(main, asked)
    assert result.exit_code == 0, result.output
    assert "lost to the outside" not in result.output
    impacts = pd.read_csv(tmp_path / "impacts.csv")
    assert f"{len(impacts)} collected, {len(impacts)} counted by the FMU, 0 lost" in result.output
    assert impacts["instant"].tolist() == list(range(1, len(impacts) + 1))
    assert len(impacts) > 100
    speed = impacts["closing_speed"].to_numpy()
    first = math.sqrt(3 * GRAVITY * math.sin(ANGLE) / LENGTH)
    np.testing.assert_allclose(speed, first * 0.9 ** np.arange(len(speed)), rtol=1e-3)  # gravity acts in the angle
    steps = pd.read_csv(tmp_path / "results.csv")
    assert steps["impacts_in_step"].max() <= 8
    assert steps["impacts_in_step"].sum() == len(impacts)
    assert len(steps) > 3001
