"""The examples of sweeps and optima are right for the FMU that they name."""

from pathlib import Path

import pytest

from harness.designs.optimum_file import read_optimum
from harness.designs.sweep import read_sweep
from harness.designs.variation import Source, source
from harness.fmu.description_file import read_description
from harness.toml_file import TomlFile

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
