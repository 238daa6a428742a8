"""The example of a machine: a motor turns gears, they a cam, and that a ratchet, which indexes its wheel."""

import importlib.util
import math
from pathlib import Path
from types import ModuleType

import pandas as pd
import pytest

from harness.results import write_with_units

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
#: Where the wheel is latched after two teeth of 18 deg [rad].
INDEXED = math.radians(75 + 2 * 18)
STEPS = (8e-3, 4e-3, 2e-3)


@pytest.fixture(scope="module")
def machine() -> ModuleType:
    """The example as a module."""
    spec = importlib.util.spec_from_file_location("indexing_machine", ROOT / "docs/examples/indexing_machine.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def runs(
    machine: ModuleType, native_gear_train_fmu: Path, native_cam_drive_fmu: Path, native_ratchet_fmu: Path
) -> dict[float, tuple[pd.DataFrame, dict[str, str]]]:
    """Results and units by communication step."""
    fmus = {"gear_train": native_gear_train_fmu, "cam_drive": native_cam_drive_fmu, "ratchet": native_ratchet_fmu}
    return {step: machine.run(fmus, step) for step in STEPS}


@pytest.mark.parametrize("step", STEPS)
def test_two_turns_of_the_cam_index_two_teeth_whatever_the_step(runs, step):
    results, _ = runs[step]
    end = results.iloc[-1]
    assert end["time"] == 17.0
    assert end["ratchet.clicks"] == 2
    assert end["ratchet.latched_angle"] == pytest.approx(INDEXED, abs=1e-12)
    assert end["ratchet.wheel_angle"] == pytest.approx(INDEXED, abs=1e-9)
    clicks = results["time"][results["ratchet.clicks"].diff() > 0].to_numpy()
    assert clicks == pytest.approx([2.64, 10.68], abs=0.02)


def test_the_roller_stays_on_the_cam_and_the_gears_in_mesh(machine, runs):
    results, _ = runs[STEPS[-1]]
    assert results["cam_drive.contact_active"].all()
    assert results["cam_drive.contact_force"].min() > 0
    ratio = results["gear_train.wheel_angle"] / results["gear_train.pinion_angle"]
    assert (ratio - machine.RATIO).abs().max() < 1e-9
    # the cam follows the wheel but for the twist of its shaft
    assert (results["gear_train.wheel_angle"] - results["cam_drive.cam_angle"]).abs().max() < 0.05


def test_it_converges_with_the_communication_step(runs):
    for name in ("ratchet.crank_angle", "gear_train.pinion_angle", "cam_drive.cam_angle"):
        coarse, middle, fine = (runs[step][0][name].iloc[-1] for step in STEPS)
        assert abs(middle - fine) < 1e-4
        assert (coarse - middle) / (middle - fine) == pytest.approx(2.0, abs=0.3)


def test_the_energy_that_the_coupling_makes_vanishes_with_the_step(machine, runs):
    for bond in machine.BONDS.values():
        energies = [machine.bond_energy(runs[step][0], bond) for step in STEPS]
        assert all(energy.given > 0.02 and energy.taken > 0.02 for energy in energies)
        assert abs(energies[-1].made) < 1e-3 * energies[-1].most
        made = [energy.made for energy in energies]
        assert made[0] / made[1] == pytest.approx(2.0, abs=0.1)
        assert made[1] / made[2] == pytest.approx(2.0, abs=0.1)


def test_the_crank_is_led_by_the_follower(machine, runs):
    results, _ = runs[STEPS[-1]]
    lag = results["cam_drive.follower_angle"] + machine.FOLLOWER_TO_CRANK - results["ratchet.crank_angle"]
    torque = 2.0 * lag + 0.1 * (results["cam_drive.follower_speed"] - results["ratchet.crank_speed"])
    assert (torque - results["ratchet.drive_shaft_torque"]).abs().max() < 1e-3


def test_results_are_a_table_with_units(runs, tmp_path):
    results, units = runs[STEPS[0]]
    table = pd.read_csv(write_with_units(results, units, tmp_path / "results.csv"))
    assert next(iter(table.columns)) == "time [s]"
    assert {"gear_train.mesh_force [N]", "ratchet.wheel_angle [rad]", "ratchet.clicks"} <= set(table.columns)
    assert table["ratchet.wheel_angle [rad]"].iloc[-1] == results["ratchet.wheel_angle"].iloc[-1]
