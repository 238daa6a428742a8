"""Friction in FMUs: a rod that falls, strikes, slides and rests, a pin, a brake; the same bits everywhere."""

import math
from pathlib import Path

import fmpy
import numpy as np
import pytest
from typer.testing import CliRunner

from harness.app.cli import main
from mechanism_fmu.fmu.own.prepare import load
from mechanism_fmu.simulation import Simulation

FORMS = {"pythonfmu": (), "fmi2": ("--flavour", "native"), "fmi3": ("--flavour", "native", "--fmi", "3")}
SOURCE = '''"""A rod thrown on a floor, a pendulum in a tight pin, a disc that a brake stops."""
import math
from mechanism_fmu.model import *

PARAMETERS = (
    Parameter("friction", 0.4, "Of the floor", "1", minimum=0.0),
    Parameter("radius", 0.08, "Friction radius of the pin", "m", minimum=0.0),
    Parameter("torque", 0.3, "Of the brake", "N.m", minimum=0.0),
)
OUTPUTS = (
    *(Output(f"rod_{name}", f"rod.{name}", "", unit) for name, unit in (("x", "m"), ("y", "m"), ("angle", "rad"))),
    Output("slip", "floor.slip_speed", "", "m/s"),
    Output("rub", "floor.friction_force", "", "N"),
    Output("holds", "pin.sticks", "", "1", type="Boolean"),
    Output("swing", "pendulum.angle", "", "rad"),
    Output("turn", "disc.angle", "", "rad"),
    Output("brake_torque", "brake.friction_force", "", "N.m"),
    Output("lost", "energy.lost", "", "J"),
    Output("events", "event.count", "", "1", type="Integer"),
    Output("impacts", "impact.count", "", "1", type="Integer"),
)


def mechanism(values):
    rod = rigid_body("rod", (0.0, 0.6), mass=1.0, inertia=0.083, angle=0.5, velocity=(2.0, 0.0), speed=-1.0)
    pendulum = rigid_body("pendulum", (3.2, 1.0), mass=1.0, inertia=0.01)
    disc = rigid_body("disc", (5.0, 1.0), mass=1.0, inertia=0.05, speed=8.0)
    ground = GROUND.line((0, 0), (1, 0))
    ends = (PointLineContact(name, rod.at(x, 0), ground, friction=values.friction, restitution=0.3)
            for name, x in (("floor", -0.5), ("other", 0.5)))
    return Mechanism(
        (rod, pendulum, disc),
        (
            Revolute("pin", pendulum.at(-0.2, 0), GROUND.at(3, 1), friction_radius=values.radius),
            Revolute("shaft", disc, GROUND.at(5, 1)),
        ),
        contacts=tuple(ends),
        forces=(Brake("brake", disc, limit=values.torque),),
        inputs=(Input("limit", "brake.limit", 0.3, "", "N.m"),),
        gravity=(0.0, -9.81),
        outputs=OUTPUTS,
        impact_law="LAW",
    )


MODEL = Model("Rubbing", "Friction", PARAMETERS, mechanism, stop_time=3.0, step_size=0.01)
'''


@pytest.fixture(scope="module", params=["newton", "poisson", "stronge"])
def place(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp(request.param)
    (folder / "rubbing.py").write_text(SOURCE.replace("LAW", request.param), encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def rows(place: Path) -> dict[str, np.ndarray]:
    """What FMPy records of each form, with a friction that is not the default."""
    found = {}
    for form, options in FORMS.items():
        result = CliRunner().invoke(main, ["build", str(place / "rubbing.py"), "-o", str(place / form), *options])
        assert result.exit_code == 0, result.output
        (fmu,) = (place / form).glob("*.fmu")
        found[form] = fmpy.simulate_fmu(str(fmu), stop_time=3.0, output_interval=0.05, start_values={"friction": 0.35})
    return found


def test_all_forms_give_the_same_bits(rows: dict[str, np.ndarray]) -> None:
    for form, table in rows.items():
        assert table.dtype.names == rows["pythonfmu"].dtype.names
        for name in table.dtype.names:
            assert table[name].tobytes() == rows["pythonfmu"][name].tobytes(), (form, name)


def test_it_is_the_motion_of_the_library(place: Path, rows: dict[str, np.ndarray]) -> None:
    model = load(place / "rubbing.py").MODEL
    simulation = Simulation(model.build(model.values(friction=0.35)))
    table = rows["fmi2"]
    simulation.advance(0.0)
    for row in table:
        simulation.advance(float(row["time"]))
        read = simulation.read()
        assert read["rod_x"] == row["rod_x"]
        assert read["swing"] == row["swing"]
        assert read["lost"] == row["lost"]


def test_at_last_all_rests_and_not_before(rows: dict[str, np.ndarray]) -> None:
    table = rows["fmi3"]
    assert table["impacts"][-1] >= 2
    assert abs(math.sin(table["rod_angle"][-1])) < 1e-9
    assert table["turn"][-1] == table["turn"][-2] == pytest.approx(8.0**2 * 0.05 / (2 * 0.3), rel=1e-8)
    assert table["rod_x"][-1] == table["rod_x"][-2]  # it does not creep
    assert table["holds"][-1]
    assert (np.diff(table["lost"]) >= -1e-12).all()
