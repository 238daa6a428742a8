"""Force elements in FMUs: a law of the user's own, tables, gravity and bushings give the same bits in every form."""

from pathlib import Path

import fmpy
import numpy as np
import pytest
from typer.testing import CliRunner

from harness.app.cli import main
from mechanism_fmu.fmu.own.prepare import load
from mechanism_fmu.simulation import Simulation

FORMS = {"pythonfmu": (), "fmi2": ("--flavour", "native"), "fmi3": ("--flavour", "native", "--fmi", "3")}
SOURCE = '''"""A block on a bushing, a rope, a table and two laws."""
from mechanism_fmu.model import *
from mechanism_fmu.model.functions import exp, maximum, power, smoothstep, where

PARAMETERS = (
    Parameter("stiffness", 300.0, "Of the law", "N/m", minimum=0.0),
    Parameter("exponent", 1.3, "Of the gas", minimum=1.0, maximum=2.0),
    Parameter("gravity", 9.80665, "Downwards", "m/s2"),
)
OUTPUTS = (
    *(Output(f"block_{name}", f"block.{name}", "", unit) for name, unit in (("x", "m"), ("y", "m"), ("angle", "rad"))),
    *(Output(f"{part}_force", f"{part}.force", "", "N") for part in ("gas", "rope", "table")),
    *(Output(f"corner_{name}", f"corner.{name}", "", unit) for name, unit in (("x", "m"), ("y_rate", "m/s"))),
    Output("twist", "stop.torque", "", "N.m"),
    Output("stored", "energy.spring", "", "J"),
    Output("work", "energy.work", "", "J"),
)


def mechanism(values):
    def gas(length, speed):
        compression = 0.2 / maximum(length, 1e-3)
        return where(speed < 0.0, 0.9, 1.0) * values.stiffness * 0.01 * (1.0 - power(compression, values.exponent))

    def stop(angle, speed):
        return values.stiffness * smoothstep(abs(angle), 0.1, 0.4) * angle + exp(-angle) * speed * 0.01

    return Mechanism(
        (Body("block", 0.7, 0.05, (0.2, 0.0, 0.1), (1.0, 0.5, 3.0)),),
        forces=(
            NonlinearSpring("gas", "block", (0.05, 0.0), GROUND, (0.0, 0.0), law=gas),
            NonlinearSpring(
                "table", "block", (0.0, 0.1), GROUND, (0.5, 0.0),
                law=characteristic([(0.0, -values.stiffness / 10), (0.3, 0.0), (0.5, values.stiffness / 30)]),
            ),
            SpringDamper("rope", "block", (0.0, 0.0), GROUND, (0.0, 0.5), 50.0, 0.5, 0.3, one_sided="stretched"),
            NonlinearTorsionSpring("stop", "block", law=stop),
            Bushing("bushing", "block", (0.0, 0.0), GROUND, (0.2, 0.0), 20.0, 30.0, 0.1, 0.1, 0.2, 0.01),
            PointForce("push", "block", (0.1, 0.0), (0.0, 1.0), frame="body"),
        ),
        markers=(Marker("corner", "block", (values.stiffness / 3000, 0.1)),),
        gravity=(0.0, -values.gravity),
        outputs=OUTPUTS,
    )


MODEL = Model("Block", "A block on many springs", PARAMETERS, mechanism, stop_time=1.0, step_size=0.01)
'''


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("block")
    (folder / "block.py").write_text(SOURCE, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def rows(place: Path) -> dict[str, np.ndarray]:
    """What FMPy records of each form, with a stiffness that is not the default."""
    found = {}
    for form, options in FORMS.items():
        result = CliRunner().invoke(main, ["build", str(place / "block.py"), "-o", str(place / form), *options])
        assert result.exit_code == 0, result.output
        (fmu,) = (place / form).glob("*.fmu")
        found[form] = fmpy.simulate_fmu(str(fmu), stop_time=1.0, output_interval=0.05, start_values={"stiffness": 350})
    return found


@pytest.mark.parametrize("form", ["fmi2", "fmi3"])
def test_all_forms_give_the_same_bits(rows: dict[str, np.ndarray], form: str) -> None:
    for name in rows["pythonfmu"].dtype.names:
        assert rows[form][name].tobytes() == rows["pythonfmu"][name].tobytes(), name
    assert np.ptp(rows[form]["gas_force"]) > 0.5, "the law does something"


def test_python_gives_the_same_bits(place: Path, rows: dict[str, np.ndarray]) -> None:
    model = load(place / "block.py").MODEL
    simulation = Simulation(model.build(model.values(stiffness=350.0)))
    for row in rows["fmi2"]:
        simulation.advance(float(row["time"]))
        found = simulation.read()
        for name in ("block_x", "block_angle", "gas_force", "table_force", "twist", "stored", "work"):
            assert found[name] == row[name], (name, row["time"])
