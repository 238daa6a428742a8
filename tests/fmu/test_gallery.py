"""Every mechanism of the gallery is short, builds in both flavours without a word, and gives the same bits in both."""

from pathlib import Path

import fmpy
import numpy as np
import pytest
from typer.testing import CliRunner

from harness.app.cli import main

GALLERY = Path(__file__).parents[2] / "docs" / "examples" / "gallery"
EXAMPLES = sorted(path.stem for path in GALLERY.glob("*.py"))

#: Lines from `def mechanism` to the end of the file, at most; 40 of those that are not named.
LINES = {"whitworth": 25, "watt": 25, "scotch_yoke": 25, "rocking_block": 20}

#: Those that are built in every run of the tests.
QUICK = ("whitworth", "rocking_block", "two_pawls")


#: What the first line of a build says: degrees of freedom, coordinates, rows.
FREEDOMS = {
    "andrews": (1, 21, 20),
    "backspin": (2, 3, 1),
    "braked_shaft": (2, 6, 4),
    "chebyshev": (0, 9, 9),
    "door_closer": (1, 3, 2),
    "engine": (1, 9, 8),
    "freewheel": (3, 9, 6),
    "governor": (1, 9, 8),
    "pantograph": (0, 12, 12),
    "peaucellier": (0, 21, 21),
    "roberts": (0, 9, 9),
    "rocking_block": (1, 3, 2),
    "scissors": (0, 300, 300),
    "scotch_yoke": (1, 6, 5),
    "slider_crank_clearance": (3, 9, 6),
    "stephenson": (0, 15, 15),
    "stick_slip": (1, 6, 5),
    "toggle_press": (0, 15, 15),
    "two_pawls": (3, 9, 6),
    "watt": (0, 15, 15),
    "wedge": (1, 6, 5),
    "whitworth": (0, 12, 12),
    "woodpecker": (2, 6, 4),
}


@pytest.mark.parametrize("name", EXAMPLES)
def test_it_is_short(name: str) -> None:
    text = (GALLERY / f"{name}.py").read_text(encoding="utf-8")
    assert text[text.index("def mechanism") :].count("\n") <= LINES.get(name, 40)


@pytest.mark.parametrize(
    "name", [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in EXAMPLES]
)
def test_both_flavours_agree_to_the_bit(name: str, tmp_path: Path) -> None:
    """A fifth of the default experiment, with all outputs."""
    found = []
    for flavour in ("pythonfmu", "native"):
        command = ["build", str(GALLERY / f"{name}.py"), "-o", str(tmp_path / flavour), "--flavour", flavour]
        said = CliRunner().invoke(main, command)
        assert said.exit_code == 0, said.output
        assert said.stderr == ""
        fmu = next((tmp_path / flavour).glob("*.fmu"))
        free, coordinates, rows = FREEDOMS[name]
        degrees = "1 degree" if free == 1 else f"{free} degrees"
        told = f"{fmu.stem}: {degrees} of freedom ({coordinates} coordinates, {rows} rows, 0 redundant)"
        assert said.stdout.splitlines()[0] == told
        until = fmpy.read_model_description(fmu).defaultExperiment.stopTime
        found.append(fmpy.simulate_fmu(str(fmu), stop_time=float(until) / 5, output_interval=float(until) / 200))
    first, second = found
    assert first.dtype == second.dtype
    assert any(np.ptp(first[name]) > 0.0 for name in first.dtype.names if name != "time")
    np.testing.assert_array_equal(first, second)
