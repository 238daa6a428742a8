"""Elastic members through built FMUs of both flavours: the numbers of the flexibility approach, over a cycle."""

from pathlib import Path
from types import SimpleNamespace

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu
from typer.testing import CliRunner

from harness.cli import main
from mechanism_fmu.elastodynamics import configurations, linkage, quasi_static
from mechanism_fmu.kinematics import analyse
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
    stop = 2 * np.pi / CHANGED["speed"]
    times = stop * np.arange(37) / 36
    found = fmpy.simulate_fmu(
        str(fmu), stop_time=stop, output_interval=stop / 36, start_values=CHANGED, output=names, use_event_mode=False
    )
    np.testing.assert_allclose(found["time"], times, rtol=1e-12, atol=1e-12)
    mechanism = path_generator.mechanism(SimpleNamespace(**SI | CHANGED))
    expected = quasi_static(configurations(linkage(mechanism), analyse(mechanism, times)))
    for place in PLACES:
        deflection = expected.deflection(place)
        for k, quantity in enumerate(DEFLECTIONS):
            scale = np.abs(deflection[:, k]).max()
            mine = found[f"{place.replace('.', '_')}_{quantity}"]
            np.testing.assert_allclose(mine, deflection[:, k], rtol=1e-10, atol=1e-10 * scale + 1e-18)
    for number, element in enumerate(expected.configurations.linkage.elements):
        np.testing.assert_allclose(found[f"{element.member.name}_stress"], expected.stress[:, number], rtol=1e-9)
