"""Mechanisms of the gallery: short files that are built in both flavours, and right."""

import math
from pathlib import Path

import fmpy
import numpy as np
import pytest
from typer.testing import CliRunner

from harness.app.cli import main

GALLERY = Path(__file__).parents[2] / "docs" / "examples" / "gallery"


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    """The quick return over two turns of its crank, as FMUs of both flavours."""
    folder = tmp_path_factory.mktemp("gallery")
    found = {}
    for flavour in ("pythonfmu", "native"):
        command = ["build", str(GALLERY / "whitworth.py"), "-o", str(folder / flavour), "--flavour", flavour]
        said = CliRunner().invoke(main, command)
        assert said.exit_code == 0, said.output
        assert said.stdout.startswith("Whitworth: 0 degrees of freedom (12 coordinates, 12 rows, 0 redundant)\n")
        assert said.stderr == ""
        fmu = str(folder / flavour / "Whitworth.fmu")
        found[flavour] = fmpy.simulate_fmu(fmu, stop_time=2.0, output_interval=0.01, output=["ram", "lever"])
    return found


def test_both_flavours_of_a_file_in_the_new_form_agree_to_the_bit(runs: dict[str, np.ndarray]) -> None:
    np.testing.assert_array_equal(runs["pythonfmu"], runs["native"])


def test_the_quick_return_has_its_closed_form(runs: dict[str, np.ndarray]) -> None:
    """The lever points at the pin of the crank; the ram is the rod's length away from the lever's far end."""
    crank, offset, arm, rod = 0.1, 0.05, 0.08, 0.4
    theta = 2 * math.pi * runs["native"]["time"]
    lever = np.unwrap(np.arctan2(offset + crank * np.sin(theta), crank * np.cos(theta)))
    ram = -arm * np.cos(lever) + np.sqrt(rod**2 - (arm * np.sin(lever)) ** 2)
    np.testing.assert_allclose(runs["native"]["lever"], lever, rtol=0, atol=2e-9)
    np.testing.assert_allclose(runs["native"]["ram"], ram, rtol=0, atol=2e-10)


def test_it_is_short() -> None:
    text = (GALLERY / "whitworth.py").read_text(encoding="utf-8")
    assert text[text.index("def mechanism") :].count("\n") <= 25
