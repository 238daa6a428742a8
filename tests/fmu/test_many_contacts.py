"""FMUs of both flavours with 60 and 200 contacts: the motion, what they log of it, and saved states."""

import importlib
from pathlib import Path

import pytest

from mechanism_fmu.advice import MOST_NAMED
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.fmu.package import build_fmu
from mechanism_fmu.simulation import Simulation
from tests.falling_blocks import GRAVITY, LANDS, MASS
from tests.fmu.conformance.host import Fmu, Instance


@pytest.fixture(scope="module", params=["falling_blocks", "hundred_falling_blocks"], ids=["60", "200"])
def module(request: pytest.FixtureRequest) -> object:
    return importlib.import_module(f"tests.{request.param}")


@pytest.fixture(scope="module", params=[build_fmu, build_native_fmu], ids=["pythonfmu", "native"])
def fmu(request: pytest.FixtureRequest, module: object, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    built: Path = request.param(module, tmp_path_factory.mktemp("blocks"))
    return Fmu.unzip(built, tmp_path_factory.mktemp("unzipped"))


def test_the_motion_and_what_is_logged_of_it(fmu: Fmu, module) -> None:
    simulation = Simulation(module.MODEL.build(module.MODEL.values()))
    count = len(simulation.field("contact_mode")) // 2
    with Instance(fmu) as one:
        one.begin()
        one.slave.setDebugLogging(True, ["logEvents"])
        for k in range(count):
            one.step(LANDS * (k + 1.5) - simulation.time)
            simulation.advance(LANDS * (k + 1.5))
        assert one.outputs() == simulation.read()
        assert one["last_force"] == pytest.approx(MASS * GRAVITY / 2)
        events = [message.text for message in one.log if message.text.startswith("Event")]
    assert len(events) == count
    assert events[0].startswith("Event left0.gap at t = 0.01 s: all open -> left0+right0, total impulse 0.2 N.s")
    shown = [f"{side}{k}" for k in range(MOST_NAMED // 2) for side in ("left", "right")]
    modes = (f"{'+'.join(shown)}+{2 * n - MOST_NAMED} more" for n in (count - 1, count))
    assert f": {' -> '.join(modes)}, total impulse" in events[-1]


def test_a_saved_state(fmu: Fmu) -> None:
    with Instance(fmu) as one, Instance(fmu, "two") as two:
        one.begin()
        two.begin()
        one.step(27.5 * LANDS)
        two.restore_bytes(one.save_bytes(), 27.5 * LANDS)
        assert two["impacts"] == 2 * 27
        one.step(2 * LANDS)
        two.step(2 * LANDS)
        assert two.outputs() == one.outputs()
        assert two.save_bytes() == one.save_bytes()
