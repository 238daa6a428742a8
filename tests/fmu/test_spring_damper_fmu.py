"""A spring-damper in an FMU: the same numbers in all forms, and those of its closed form."""

import math

import fmpy
import numpy as np
import pytest
from typer.testing import CliRunner

from harness.app.cli import main

FORMS = {"pythonfmu": (), "fmi2": ("--flavour", "native"), "fmi3": ("--flavour", "native", "--fmi", "3")}
SOURCE = '''"""A mass on a spring-damper, with an actuator."""
from mechanism_fmu.model import GROUND, Body, Input, Mechanism, Model, Output, Parameter, SpringDamper

PARAMETERS = (Parameter("stiffness", 20.0, "Of the spring", "N/m", minimum=0.0),)
INPUTS = (Input("pull", "strut.preload", 0.5, "Force of the actuator", "N"),)
OUTPUTS = (
    Output("length", "strut.length", "Distance of the points", "m"),
    Output("speed", "strut.speed", "Rate of the distance", "m/s"),
    Output("force", "strut.force", "Force that pulls the points together", "N", feedthrough=("pull",)),
    Output("stored", "energy.spring", "Energy of the spring", "J"),
)


def mechanism(values):
    strut = SpringDamper("strut", "mass", (0.0, 0.0), GROUND, (0.0, 0.0), values.stiffness, 2.0, 0.6)
    return Mechanism((Body("mass", 0.7, 1.0, (2.1, 0.0, 0.0)),), forces=(strut,), inputs=INPUTS, outputs=OUTPUTS)


MODEL = Model("Strut", "A mass on a strut", PARAMETERS, mechanism, stop_time=1.0, step_size=0.01)
'''


@pytest.fixture(scope="module")
def rows(tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    """What FMPy records of each form."""
    place = tmp_path_factory.mktemp("strut")
    (place / "strut.py").write_text(SOURCE, encoding="utf-8")
    found = {}
    for form, options in FORMS.items():
        result = CliRunner().invoke(main, ["build", str(place / "strut.py"), "-o", str(place / form), *options])
        assert result.exit_code == 0, result.output
        (fmu,) = (place / form).glob("*.fmu")
        found[form] = fmpy.simulate_fmu(str(fmu), stop_time=1.0, output_interval=0.05)
    return found


@pytest.mark.parametrize("form", ["fmi2", "fmi3"])
def test_all_forms_give_the_same_bits(rows: dict[str, np.ndarray], form: str) -> None:
    for name in ("length", "speed", "force", "stored"):
        assert rows[form][name].tobytes() == rows["pythonfmu"][name].tobytes()


def test_it_swings_as_the_closed_form_says(rows: dict[str, np.ndarray]) -> None:
    mass, stiffness, damping, pull = 0.7, 20.0, 0.6, 0.5
    found, decay = rows["fmi2"], damping / (2 * mass)
    root, rest = math.sqrt(stiffness / mass - decay**2), 2.0 - pull / stiffness
    time, start = found["time"], 2.1 - rest
    length = rest + np.exp(-decay * time) * start * (np.cos(root * time) + decay / root * np.sin(root * time))
    np.testing.assert_allclose(found["length"], length, rtol=1e-8)
    np.testing.assert_allclose(found["stored"], 0.5 * stiffness * (length - 2.0) ** 2, atol=1e-8)
