"""The examples of sweeps and optima are right for the FMU that they name; programs without an FMU are right."""

import importlib.util
import math
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pandas as pd
import pytest

from harness.designs.optimum_file import read_optimum
from harness.designs.sweep import read_sweep
from harness.designs.variation import Source, source
from harness.fmu.description_file import read_description
from harness.toml_file import TomlFile
from mechanism_fmu.stress import material_card

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
DESIGNS = {"teeth": 64, "paper_wheels": 20}


@pytest.mark.parametrize("name", DESIGNS)
def test_an_example_of_a_sweep(name: str, ratchet_fmu: Path) -> None:
    file = TomlFile.read(EXAMPLES / f"{name}.toml")
    assert source(file) == Source(model="ratchet")
    assert len(read_sweep(file, read_description(ratchet_fmu)).designs) == DESIGNS[name]


@pytest.mark.parametrize(("name", "total"), [("best_tooth", 160 + 64 * 4), ("indexing", 60)])
def test_an_example_of_an_optimum(name: str, total: int, ratchet_fmu: Path) -> None:
    file = TomlFile.read(EXAMPLES / f"{name}.toml")
    assert source(file) == Source(model="ratchet")
    assert read_optimum(file, read_description(ratchet_fmu)).total == total


def program(name: str, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """An example as a module."""
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, name, module)  # where its records are looked up
    spec.loader.exec_module(module)
    return module


def test_the_report_on_a_cam(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture) -> None:
    monkeypatch.chdir(tmp_path)
    cam = program("cam_report", monkeypatch)
    report = cam.main("cam_drive", "contact", "cam", "base_radius=0.03")
    assert report.profile.least_rho == pytest.approx(0.03)
    printed = capsys.readouterr().out
    assert "1 degree of freedom" in printed
    assert printed.endswith("- nothing to object\n")
    table = pd.read_csv("cam_report.csv")
    assert len(table) == 361
    # derivatives are by the cam's angle: central differences of second order in a degree
    angle, rate = table["follower angle [rad]"], table["follower angle' [rad]"]
    np.testing.assert_allclose(np.gradient(angle, math.radians(1))[1:-1], rate[1:-1], atol=1e-3 * np.abs(rate).max())
    smaller = cam.main("cam_drive", "contact", "cam", "base_radius=0.02")
    assert smaller.pressure_angle.max() > report.pressure_angle.max()
    assert "- The pressure angle reaches" in capsys.readouterr().out


def test_the_blow_on_a_lever(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture) -> None:
    lever = program("blow_on_a_lever", monkeypatch)
    card = material_card("42CrMo4")
    found, by_table = (lever.blow(beam, card) for beam in (lever.lever(), lever.lever_by_table()))
    for name in ("bending", "shear", "across", "blows"):
        assert getattr(by_table, name) == pytest.approx(getattr(found, name), rel=2e-2)
    # half a sine of 0.04 N s in 150 us at 30 deg; F / A of 6 by 10 mm; p0 = sqrt(F E* / (pi b R)) of two equal steels
    force = math.pi / 2 * 0.04 * math.sqrt(3) / 2 / 150e-6
    assert found.force == pytest.approx(force)
    assert found.axial == pytest.approx(force / 60e-6)
    effective = card.material.youngs_modulus / (2 * (1 - 0.3**2))
    assert found.contact.pressure == pytest.approx(math.sqrt(force * effective / (math.pi * 0.01 * 2e-3)))
    # a rectangle's largest shear is 3/2 of its mean
    assert found.shear == pytest.approx(1.5 * found.across / (0.01 * 0.016))
    lever.main()
    printed = capsys.readouterr().out
    assert f"bending {found.bending / 1e6:.1f} MPa" in printed
    assert printed.count("blows") == 2
