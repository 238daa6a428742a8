"""Elastic members through built FMUs of both flavours: the numbers of the flexibility approach, over a cycle."""

from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu
from typer.testing import CliRunner

from harness.app.cli import main
from tests import path_generator
from tests.path_generator import DEFLECTIONS, MEMBERS, SI

FLAVOURS = {"pythonfmu": (), "native": ("--flavour", "native")}
#: Other values than the defaults, so that they must pass from the FMU's parameters to the tables.
CHANGED = {"crank_length": 0.09, "depth": 0.011, "speed": 40.0, "pound": 0.6}
PLACES = [f"{member}.{end}" for member in MEMBERS for end in ("start", "end")]


@pytest.fixture(scope="module", params=FLAVOURS)
def fmu(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp(request.param)
    result = CliRunner().invoke(main, ["build", path_generator.__file__, "-o", str(folder), *FLAVOURS[request.param]])
    assert result.exit_code == 0, result.output
    return next(folder.glob("*.fmu"))


def test_it_is_valid(fmu: Path) -> None:
    assert validate_fmu(str(fmu)) == []


def test_a_cycle_is_that_of_the_flexibility_approach(fmu: Path) -> None:
    names = [f"{place.replace('.', '_')}_{q}" for place in PLACES for q in DEFLECTIONS]
    names += [f"{member}_stress" for member in MEMBERS]
    values = SI | CHANGED
    table, expected = path_generator.cycle(values, 36)
    interval = 2 * np.pi / values["speed"] / 36
    found = fmpy.simulate_fmu(
        str(fmu), stop_time=35 * interval, output_interval=interval, start_values=CHANGED, output=names
    )
    np.testing.assert_allclose(found["time"], np.arange(36) * interval, rtol=1e-12)
    for name in names:
        scale = np.abs(table[name]).max()
        np.testing.assert_allclose(found[name], table[name], rtol=1e-10, atol=1e-10 * scale + 1e-16, err_msg=name)
    for place in PLACES:
        deflection = expected.deflection(place)
        for k, quantity in enumerate(DEFLECTIONS):
            scale = np.abs(deflection[:, k]).max()
            mine = found[f"{place.replace('.', '_')}_{quantity}"]
            np.testing.assert_allclose(mine, deflection[:, k], rtol=1e-10, atol=1e-10 * scale + 1e-16)
    for number, element in enumerate(expected.configurations.linkage.elements):
        np.testing.assert_allclose(found[f"{element.member.name}_stress"], expected.stress[:, number], rtol=1e-10)
