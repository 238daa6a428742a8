"""Stress, damage and compliance of a mechanism of the user's own: what its model declares is analysed, by any names."""

import json
import re
import shutil
from pathlib import Path

import pandas as pd
import pytest
from typer.testing import CliRunner

import models
from harness.app.cli import main
from mechanism_fmu.fmu.own.find import write_new
from mechanism_fmu.stress import STEEL, STEEL_CARD, RectangularTooth, TableBeam, maximum_stress, sequence_damage

FLAVOURS = {"pythonfmu": (), "native": ("--flavour", "native"), "native3": ("--flavour", "native", "--fmi", "3")}

#: What a beam takes in the file of `mechanism-fmu new`: its length, v_I of each impact, and the declaration.
CHANGES = {
    "mass=values.mass)": "mass=values.mass, tooth_length=values.length)",
    "[IMPACT]": "[IMPACT, JUMP]",
    "\n\ndef mechanism": 'JUMP = Output("velocity", "velocity", "Jump of the tip, {impact}", "m/s")\n\n\ndef mechanism',
    "    stop_time=1.0,": '    analysis=(ImpactStress("stop", RectangularTooth("length", 0.01), "lever", "levers"),),\n'
    "    stop_time=1.0,",
    "from mechanism_fmu.model import Bar,": "from mechanism_fmu.model import ImpactStress, RectangularTooth\n"
    "from mechanism_fmu.model import Bar,",
}


def test_the_page_in_docs_shows_these_changes() -> None:
    page = (Path(__file__).parents[2] / "docs" / "how-to" / "stress-in-a-part.md").read_text(encoding="utf-8")
    added = [new.removesuffix(old).strip() for old, new in CHANGES.items()]
    assert [line for line in added if line.removesuffix("\n\n\ndef mechanism") not in page] == []


def command(*arguments: str) -> str:
    result = CliRunner().invoke(main, list(arguments))
    assert result.exit_code == 0, result.output
    return result.output


@pytest.fixture(scope="module")
def lever(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The file of a lever whose impacts are to be analysed."""
    path = write_new("lever", tmp_path_factory.mktemp("own"))
    text = path.read_text(encoding="utf-8")
    for old, new in CHANGES.items():
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_a_lever_with_a_beam_on_its_contact_has_stress_and_damage(lever: Path, flavour: str) -> None:
    folder = lever.parent / flavour
    command("build", str(lever), "-o", str(folder), *FLAVOURS[flavour])
    command("run", str(folder / "lever.fmu"), "--stop-time", "0.5", "-o", str(folder / "result"))
    impacts = pd.read_csv(folder / "result" / "impacts.csv")
    assert len(impacts) >= 2
    # the stop throws it back with a fifth of its speed, v_I = l (1 + e) omega, but at last it stays
    jump = 0.2 * impacts["closing_speed"] * [*[1.2] * (len(impacts) - 1), 1.0]
    assert list(impacts["velocity"]) == pytest.approx(list(jump), rel=1e-10)
    beam = RectangularTooth(0.2, 0.01)
    expected = [maximum_stress(beam, STEEL, velocity).stress for velocity in impacts["velocity"]]
    assert list(impacts["stress_max"]) == pytest.approx(expected, rel=1e-12)
    summary = json.loads((folder / "result" / "summary.json").read_text(encoding="utf-8"))
    assert (summary["tooth"]["length"], summary["tooth"]["height"]) == (0.2, 0.01)
    assert summary["units"]["impacts"]["stress_max"] == "Pa"
    damage = sequence_damage(beam, STEEL, STEEL_CARD.strength, impacts["time"], impacts["velocity"])
    assert summary["fatigue"]["stress"] == pytest.approx(damage.stress, rel=1e-12)
    report = (folder / "result" / "report.html").read_text(encoding="utf-8")
    assert "<h2>Bending stress in the lever</h2>" in report
    assert "uniform bar of length 200 mm and height 10 mm" in report
    assert "tooth" not in re.sub(r"<script.*?</script>|tooth_length|Versions.*", "", report, flags=re.DOTALL)


#: The lever, 20 mm wide, its height falling from root to tip.
PLACES, HEIGHTS = (0.0, 0.06, 0.12, 0.2), (0.012, 0.009, 0.007, 0.006)
SECTIONS = (
    tuple(0.02 * h for h in HEIGHTS),
    tuple(0.02 * h**3 / 12 for h in HEIGHTS),
    tuple(h / 2 for h in HEIGHTS),
)


def test_a_lever_of_any_section_has_stress_by_its_table(lever: Path) -> None:
    folder = lever.parent / "tapered"
    folder.mkdir()
    given = f"TableBeam({(*PLACES[:-1], 'length')!r}, *{SECTIONS!r}, thickness=0.02)"
    text = lever.read_text(encoding="utf-8").replace('RectangularTooth("length", 0.01)', given)
    (folder / "lever.py").write_text(text.replace("RectangularTooth", "TableBeam"), encoding="utf-8")
    command("build", str(folder / "lever.py"), "-o", str(folder))
    command("run", str(folder / "lever.fmu"), "--stop-time", "0.5", "-o", str(folder / "result"))
    impacts = pd.read_csv(folder / "result" / "impacts.csv")
    beam = TableBeam(PLACES, *SECTIONS)
    expected = [maximum_stress(beam, STEEL, velocity).stress for velocity in impacts["velocity"]]
    assert len(impacts) >= 2
    assert list(impacts["stress_max"]) == pytest.approx(expected, rel=1e-12)
    summary = json.loads((folder / "result" / "summary.json").read_text(encoding="utf-8"))
    assert summary["tooth"]["places"] == list(PLACES)
    damage = sequence_damage(beam, STEEL, STEEL_CARD.strength, impacts["time"], impacts["velocity"])
    assert summary["fatigue"]["stress"] == pytest.approx(damage.stress, rel=1e-12)
    assert "beam of length 200 mm" in (folder / "result" / "report.html").read_text(encoding="utf-8")


def test_of_a_lever_without_teeth_no_stress_is_missed_unless_it_is_asked_for(tmp_path: Path) -> None:
    path = write_new("plain", tmp_path)
    command("build", str(path), "-o", str(tmp_path))
    words = ["run", str(tmp_path / "plain.fmu"), "--stop-time", "0.5", "-o", str(tmp_path / "result")]
    said = command(*words)
    assert "Impacts: " in said
    assert "stress" not in said.lower()
    assert "Nothing is to be analysed" not in (tmp_path / "result" / "report.html").read_text(encoding="utf-8")
    assert "No stress: the FMU declares no beam that impacts strike." in flat(command(*words, "--material", "steel"))
    assert "Nothing is to be analysed" in (tmp_path / "result" / "report.html").read_text(encoding="utf-8")


def flat(text: str) -> str:
    return " ".join(text.split())


def test_of_teeth_without_a_beam_the_report_says_how_to_have_one(lever: Path, tmp_path: Path) -> None:
    """So do FMUs from before there was an analysis.json."""
    text = re.sub(r"    analysis=.*\n", "", lever.read_text(encoding="utf-8"))
    path = tmp_path / "plain.py"
    path.write_text(text, encoding="utf-8")
    command("build", str(path), "-o", str(tmp_path))
    said = command("run", str(tmp_path / "lever.fmu"), "--stop-time", "0.5", "-o", str(tmp_path / "result"))
    assert "No stress: the FMU declares no beam that impacts strike." in flat(said)
    report = (tmp_path / "result" / "report.html").read_text(encoding="utf-8")
    assert "Nothing is to be analysed: the FMU declares no beam that impacts strike." in report
    assert "Model(analysis=(ImpactStress(...),))" in report
    summary = json.loads((tmp_path / "result" / "summary.json").read_text(encoding="utf-8"))
    assert (summary["tooth"], summary["fatigue"], summary["compliance"]) == (None, None, [])


#: Other names for all that the ratchet calls its own; those of the library stay.
NAMES = {r"crank": "swing", r"pawl": "finger", r"wheel": "rotor", r"(?<=\"|\.)tooth_": "cog_"}


def renamed(text: str) -> str:
    for old, new in NAMES.items():
        text = re.sub(old, new, text)
    return text


@pytest.fixture(scope="module")
def two_ratchets(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Results of the ratchet, and of a copy of it in which everything has another name."""
    folder = tmp_path_factory.mktemp("renamed")
    home = Path(str(models.load("ratchet").__file__)).parent
    shutil.copytree(home, folder / "copy", ignore=shutil.ignore_patterns("__pycache__", "drawing.*", "README.md"))
    for path in (folder / "copy").glob("*.py"):
        path.write_text(renamed(path.read_text(encoding="utf-8")).replace('"Ratchet"', '"Copy"'), encoding="utf-8")
    command("build", "ratchet", "-o", str(folder))
    command("build", str(folder / "copy" / "model.py"), "-o", str(folder))
    values = {"tooth_count": "12", "drive_torque": "2e-3"}
    for fmu, name in (("Ratchet", str), ("Copy", lambda text: renamed(f'"{text}')[1:])):
        given = [part for key, value in values.items() for part in ("--set", f"{name(key)}={value}")]
        command("run", str(folder / f"{fmu}.fmu"), *given, "--stop-time", "1.2", "-o", str(folder / f"of_{fmu}"))
    return folder / "of_Ratchet", folder / "of_Copy"


def test_a_copy_of_the_ratchet_by_other_names_has_the_same_stress(two_ratchets: tuple[Path, Path]) -> None:
    one, other = (pd.read_csv(folder / "impacts.csv") for folder in two_ratchets)
    assert len(one) >= 1
    assert one["stress_max"].notna().any()
    pd.testing.assert_series_equal(one["stress_max"], other["stress_max"], check_exact=True)


def test_and_the_same_compliance(two_ratchets: tuple[Path, Path]) -> None:
    one, other = (json.loads((f / "summary.json").read_text(encoding="utf-8")) for f in two_ratchets)
    assert [found["case"] for found in one["compliance"]] == ["contact force", "impact"]
    for found, same in zip(one["compliance"], other["compliance"], strict=True):
        assert {renamed(name): value for name, value in found.items()} == same
        assert found["lost_motion"] > 0.0
        assert found["pawl_stress"] > 0.0
    assert one["fatigue"] == other["fatigue"]
