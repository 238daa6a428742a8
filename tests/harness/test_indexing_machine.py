"""The example of a machine: a motor turns gears, they a cam, and that a ratchet, which indexes its wheel."""

import importlib.util
import math
from pathlib import Path
from types import ModuleType

import pandas as pd
import pytest

from harness.machine.observers.bonds import BondEnergy

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
#: Where the wheel is latched after two teeth of 18 deg [rad].
INDEXED = math.radians(75 + 2 * 18)
STEPS = (6e-3, 4e-3, 2e-3)


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
    machine: ModuleType,
    native_gear_train_fmu: Path,
    native_cam_drive_fmu: Path,
    native_ratchet_fmu: Path,
    tmp_path_factory: pytest.TempPathFactory,
) -> dict[float, tuple[pd.DataFrame, dict[str, BondEnergy]]]:
    """Results, and energies over the bonds, by communication step."""
    fmus = {"gear_train": native_gear_train_fmu, "cam_drive": native_cam_drive_fmu, "ratchet": native_ratchet_fmu}
    found = {}
    for step in STEPS:
        file = tmp_path_factory.mktemp("machine") / "results.parquet"
        energies = machine.run(fmus, step, file)
        found[step] = pd.read_parquet(file), energies
    return found


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


def test_the_step_hardly_matters(runs):
    """Impacts end a step, and in between inputs go on as outputs do."""
    for name in ("ratchet.crank_angle", "gear_train.pinion_angle", "cam_drive.cam_angle"):
        coarse, middle, fine = (runs[step][0][name].iloc[-1] for step in STEPS)
        assert abs(coarse - fine) < 1e-5
        assert abs(middle - fine) < 3e-6


def test_the_coupling_makes_hardly_any_energy(machine, runs):
    for bond in machine.BONDS:
        for step in STEPS:
            energy = runs[step][1][bond]
            assert energy.given > 0.02
            assert energy.taken > 0.02
            assert abs(energy.made) < 2e-4 * energy.most


def test_the_crank_is_led_by_the_follower(machine, runs):
    results, _ = runs[STEPS[-1]]
    lag = results["cam_drive.follower_angle"] + machine.FOLLOWER_TO_CRANK - results["ratchet.crank_angle"]
    torque = 2.0 * lag + 0.1 * (results["cam_drive.follower_speed"] - results["ratchet.crank_speed"])
    assert (torque - results["ratchet.drive_shaft_torque"]).abs().max() < 1e-3
