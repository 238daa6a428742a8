"""The file of a sweep, and what it means."""

import math
from pathlib import Path

import pytest
from fake_slave import fake_description
from sweep_files import GOOD, mistakes, read

from harness.designs.task import Quantity, When
from harness.designs.variation import Source, source
from harness.fmu.description import Description, Variable
from harness.toml_file import TomlFile
from tests.declared import TEETH


def description_of_a_tooth() -> Description:
    description = fake_description()
    described = {
        name: Variable(name, 40 + k, "Real", "calculatedParameter", unit=("m", "rad")[k])
        for k, name in enumerate(["tooth_length", "tooth_apex_angle"])
    }
    return Description(
        "Fake", "Fake", "{guid}", {**description.variables, **described}, units=description.units, analysis=TEETH
    )


def test_a_good_file(tmp_path: Path) -> None:
    sweep = read(tmp_path, GOOD)
    assert sweep.title == "Teeth"
    assert list(sweep.task.grid)[-1] == (400_000_000, 500_000_000)
    assert sweep.task.fixed == {"drive_torque": 2.0, "guided": False}
    assert [design.number for design in sweep.designs] == list(range(1, 9))
    for design in sweep.designs:
        assert list(design.values) == ["tooth_count", "tooth_slope_angle", "gear"]
        assert design.values["tooth_count"] in range(10, 26)
        assert math.radians(85) <= design.values["tooth_slope_angle"] <= math.radians(105)
        assert design.values["gear"] in (1, 3)
    assert sweep.task.quantities == (
        Quantity(When.END, "wheel_angle", "Real", "rad", "deg"),
        Quantity(When.MAX, "wheel_angle", "Real", "rad", "deg"),
        Quantity(When.MAX, "impact_count", "Integer", ""),
        Quantity(When.FIRST_IMPACT, "time", "Real", "s"),
        Quantity(When.PARAMETER, "tooth_pitch", "Real", "rad"),
    )


def test_the_fmu_of_a_file_stands_beside_it_or_is_a_model(tmp_path: Path) -> None:
    path = tmp_path / "teeth.toml"
    path.write_text('[fmu]\nfile = "build/Ratchet.fmu"\n')
    assert source(TomlFile.read(path)) == Source(path=tmp_path / "build" / "Ratchet.fmu")
    path.write_text('[fmu]\nmodel = "ratchet"\n')
    assert source(TomlFile.read(path)) == Source(model="ratchet")


def test_times_are_the_default_experiments_unless_given(tmp_path: Path) -> None:
    sweep = read(tmp_path, GOOD.replace('[run]\nstop_time = "500 ms"\nstep = 0.1\n', ""))
    assert (sweep.task.grid.stop, sweep.task.grid.step) == (10**9, 10**6)


def test_stresses_can_be_recorded_where_the_fmu_describes_a_tooth(tmp_path: Path) -> None:
    text = GOOD.replace('first_impact = ["time"]', 'largest_impact = ["stress_max"]')
    sweep = read(tmp_path, text, description_of_a_tooth())
    assert Quantity(When.LARGEST_IMPACT, "stress_max", "Real", "Pa") in sweep.task.quantities


def test_a_grid_says_how_many_values_there_are(tmp_path: Path) -> None:
    grid = GOOD.replace('method = "latin_hypercube"\ncount = 8\nseed = 1', 'method = "grid"')
    assert mistakes(tmp_path, grid)[1:] == [
        "21: vary.tooth_slope_angle.steps: is missing; a grid needs to know how many values to take, both ends "
        "among them"
    ]
    sweep = read(tmp_path, grid.replace("to = 105", "to = 105\nsteps = 5"))
    assert len(sweep.designs) == 16 * 5 * 2
    assert sweep.designs[1].values == {"tooth_count": 10, "tooth_slope_angle": math.radians(85), "gear": 3}
    angles = {design.values["tooth_slope_angle"] for design in sweep.designs}
    assert sorted(angles) == [pytest.approx(math.radians(angle), rel=1e-15) for angle in (85, 90, 95, 100, 105)]
