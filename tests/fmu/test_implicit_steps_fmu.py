"""Where the motion is stiff: both flavours take the engine's own implicit steps, and go on from states saved there."""

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

import models
from mechanism_fmu import codes
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.fmu.package import build_fmu
from mechanism_fmu.simulation import Simulation
from tests.fmu.conformance.host import Fmu, Instance

#: A pinion in oil so thick that explicit steps would be some 1e-9 s long.
IN_OIL = {"pinion_damping": 1e6}
SIZE, STEPS, SAVED = 0.005, 10, 4


def torque(step: int) -> float:
    """Of the drive [N.m], another one in each communication step."""
    return 2.0 + 0.3 * step


@pytest.fixture(scope="module", params=[build_fmu, build_native_fmu], ids=["pythonfmu", "native"])
def fmu(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    build: Callable[[ModuleType, Path], Path] = request.param
    folder = tmp_path_factory.mktemp("fmu")
    return Fmu.unzip(build(models.load("gear_train"), folder), folder / "unzipped")


@pytest.fixture(scope="module")
def engine() -> dict[str, float]:
    """Its outputs at the end."""
    model = models.load("gear_train").MODEL
    simulation = Simulation(model.build(model.values(**IN_OIL)))
    steps, implicit = [], []
    for step in range(STEPS):
        simulation.set_input("drive_torque", torque(step))
        simulation.advance((step + 1) * SIZE)
        steps.append(simulation.counters.item(codes.COUNT_STEPS))
        implicit.append(simulation.counters.item(codes.COUNT_IMPLICIT))
    assert implicit[SAVED] > implicit[SAVED - 1] > 0
    assert implicit[-1] - implicit[SAVED] == steps[-1] - steps[SAVED] > 0  # all of them, and none is explicit again
    return simulation.read()


def run(one: Instance, steps: range) -> None:
    for step in steps:
        one.set({"drive_torque": torque(step)})
        one.step((step + 1) * SIZE - one.time)


def require_same(found: dict[str, float], engine: dict[str, float]) -> None:
    common = found.keys() & engine.keys()
    assert {"pinion_angle", "wheel_speed", "mesh_force"} <= common
    assert {name: found[name] for name in common} == {name: engine[name] for name in common}


def test_the_motion_is_the_engines_own(fmu: Fmu, engine: dict[str, float]) -> None:
    with Instance(fmu) as one:
        one.begin(IN_OIL)
        run(one, range(STEPS))
        require_same(one.outputs(), engine)


def test_a_saved_state_goes_on_to_the_same_bits(fmu: Fmu, engine: dict[str, float]) -> None:
    with Instance(fmu) as one, Instance(fmu, "other") as other:
        one.begin(IN_OIL)
        run(one, range(SAVED))
        saved, time = one.save_bytes(), one.time
        run(one, range(SAVED, STEPS))
        other.begin()  # without the oil: parameters are part of the state
        other.restore_bytes(saved, time)
        run(other, range(SAVED, STEPS))
        assert other.outputs() == one.outputs()
        require_same(other.outputs(), engine)
