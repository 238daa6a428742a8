"""Both flavours say in the same words why a driven mechanism cannot start, or cannot go on."""

from pathlib import Path

import pytest
from fmpy.fmi1 import FMICallException

import tests.driven_four_bar as driven
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.fmu.package import build_fmu
from mechanism_fmu.model import MechanismError
from mechanism_fmu.simulation import Simulation, SimulationError
from tests.driven_four_bar import MODEL
from tests.fmu.conformance.host import Fmu, Instance


@pytest.fixture(scope="module", params=[build_fmu, build_native_fmu], ids=["pythonfmu", "native"])
def fmu(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    built: Path = request.param(driven, tmp_path_factory.mktemp("driven"))
    return Fmu.unzip(built, tmp_path_factory.mktemp("unzipped"))


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"crank_speed": 5.0}, "body 'crank' (-0.189331, 0.121568, 3), not (-0.315552, 0.202613, 5), body 'coupler' ("),
        ({"blocked": True}, "No rates near them do; what is left: A by "),
        ({"blocked": True, "drive_speed": -3.0, "crank_speed": 1.0}, ", wall by "),
    ],
)
def test_why_it_cannot_start(fmu: Fmu, values: dict[str, float], words: str) -> None:
    with pytest.raises(MechanismError) as refusal:
        Simulation(MODEL.build(MODEL.values(**values)))
    assert words in str(refusal.value)
    with Instance(fmu) as one:
        with pytest.raises(FMICallException, match="ExitInitializationMode"):
            one.begin(values)
        assert one.refusal == f"one: {refusal.value}"


def test_why_it_cannot_go_on(fmu: Fmu) -> None:
    simulation = Simulation(MODEL.build(MODEL.values()))
    with pytest.raises(SimulationError, match=r"Driver 'drive' asks for 2\.0469. rad here, and goes on\.$") as failure:
        simulation.advance(1.0)
    with Instance(fmu) as one:
        one.begin()
        with pytest.raises(FMICallException, match="DoStep"):
            one.step(1.0)
        assert one.refusal == f"one: {failure.value}"
