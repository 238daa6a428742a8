"""What never moves: the commands, imports and names that users have relied on from the first day on.

`.ci/run` has cloned and installed (`pip install -e .`) before. If this fails, the change is wrong and not the test.
"""

import subprocess
import sys
from pathlib import Path

import pytest
from fmpy import read_model_description, simulate_fmu

import models
from harness.fmu import open_fmu
from harness.run.experiment import Experiment, perform
from mechanism_fmu.stress import STEEL, WedgeTooth, maximum_stress

ROOT = Path(__file__).parents[1]
#: The base case of the paper with another torque and preload: time of the first impact, and the wheel's speed before
#: and after it, by the plain implementation of the same equations in `benchmarks.reference`.
INPUTS = {"drive_torque": 2e-3, "spring_preload": 1e-3}
TIME, BEFORE, AFTER = 0.6579058142133577, -2.05641553e-2, 1.29663422e-2
#: The base case: jump of the tooth's tip [m/s], and the stress that it leaves [Pa], as README.md has them.
VELOCITY, STRESS = 5.084569462e-4, 16080.32337


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory, ratchet_fmu: Path) -> Path:
    """By `python build_fmu.py ratchet`; `ratchet_fmu` only lets the engine be compiled once."""
    folder = tmp_path_factory.mktemp("card")
    subprocess.run([sys.executable, ROOT / "build_fmu.py", "ratchet"], cwd=folder, check=True, timeout=300)
    path = folder / "build" / "Ratchet.fmu"
    assert path.read_bytes() == ratchet_fmu.read_bytes()
    return path


def test_the_packages_are_importable_from_anywhere_and_are_those_of_the_clone(tmp_path: Path) -> None:
    program = "import harness, models, mechanism_fmu; print(harness.__file__, models.__file__, mechanism_fmu.__file__)"
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=True, capture_output=True, text=True)
    assert done.stdout.split() == [str(ROOT / name / "__init__.py") for name in ("harness", "models", "mechanism_fmu")]


@pytest.mark.parametrize("name", ["harness", "models", "build_fmu"])
def test_in_a_clone_no_module_has_a_second_name(name: str, tmp_path: Path) -> None:
    program = f"import {name}\nfrom importlib.util import find_spec\nprint(find_spec('mechanism_fmu.{name}'))"
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=True, capture_output=True, text=True)
    assert done.stdout.strip() == "None"


@pytest.mark.parametrize("how", [["-m", "mechanism_fmu"], ["-c", "from harness.app.cli import main; main()"]])
def test_the_command_is_there_as_a_module_too(how: list[str], tmp_path: Path) -> None:
    done = subprocess.run([sys.executable, *how, "--version"], cwd=tmp_path, check=True, capture_output=True, text=True)
    assert done.stdout.split()[0] == "mechanism-fmu"


def test_the_models_are_listed_with_their_folders() -> None:
    assert models.available()["ratchet"] == ROOT / "models" / "ratchet"
    assert models.load("ratchet").MODEL.name == "Ratchet"


def test_fmpy_runs_the_fmu_with_torque_and_preload_and_reads_angle_speed_and_impacts(fmu: Path) -> None:
    assert read_model_description(fmu).coSimulation is not None
    outputs = ["wheel_angle", "wheel_speed", "impact_count", "impact_time", "impact_velocity"]
    run = simulate_fmu(
        fmu, stop_time=1.0, output_interval=1e-3, start_values=INPUTS, output=outputs, fmi_type="CoSimulation"
    )
    after = run[run["impact_count"] > 0]
    assert after["time"][0] == pytest.approx(TIME, abs=1e-3)
    assert after["impact_time"][0] == pytest.approx(TIME, abs=1e-9)
    before = run[run["time"] < TIME]
    assert before["wheel_speed"][-1] == pytest.approx(BEFORE, rel=0.01)
    assert after["wheel_speed"][0] == pytest.approx(AFTER, rel=0.01)
    # The angle is the integral of the speed: by the trapezoidal rule, before the impact.
    turned = sum((before["wheel_speed"][1:] + before["wheel_speed"][:-1]) / 2 * 1e-3)
    assert before["wheel_angle"][-1] - before["wheel_angle"][0] == pytest.approx(turned, rel=1e-4)


def test_the_harness_feeds_the_blow_to_the_stress_module(fmu: Path) -> None:
    with open_fmu(fmu) as opened:
        base = perform(opened, Experiment(stop_time=1.0, step=1e-2))
        other = perform(opened, Experiment(stop_time=1.0, step=1e-2, start_values=INPUTS))
    blow, harder = base.impacts.iloc[0], other.impacts.iloc[0]
    assert blow["velocity"] == pytest.approx(VELOCITY, rel=1e-9)
    assert blow["stress_max"] == pytest.approx(STRESS, rel=1e-7)
    assert harder["time"] == pytest.approx(TIME, abs=1e-9)
    assert isinstance(other.beam, WedgeTooth)
    assert harder["velocity"] == pytest.approx(other.beam.length * (AFTER - BEFORE), rel=1e-8)
    assert harder["stress_max"] == maximum_stress(other.beam, STEEL, harder["velocity"]).stress
    assert harder["stress_max"] == pytest.approx(STRESS * harder["velocity"] / VELOCITY, rel=1e-7)
