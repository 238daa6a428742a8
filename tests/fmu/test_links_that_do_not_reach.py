"""Links that do not reach each other are refused by every flavour of FMU, and by a batch, in the words of the model."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

import tests.reaching as reaching
from mechanism_fmu.batch.numbers import Numbers
from mechanism_fmu.batch.prepared import impossible, prepared
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.fmu.package import build_fmu
from mechanism_fmu.model import MechanismError
from tests.fmu.conformance.host import Fmu, Instance
from tests.reaching import MODEL, REFUSED


@pytest.fixture(scope="module", params=[build_fmu, build_native_fmu], ids=["pythonfmu", "native"])
def fmu(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Fmu:
    built: Path = request.param(reaching, tmp_path_factory.mktemp("reaching"))
    return Fmu.unzip(built, tmp_path_factory.mktemp("unzipped"))


def words(values: Mapping[str, float]) -> str:
    with pytest.raises(MechanismError) as refusal:
        MODEL.build(MODEL.values(**values))
    return str(refusal.value)


def test_both_flavours_refuse_in_the_words_of_the_model_and_run_what_reaches(fmu: Fmu) -> None:
    for values in REFUSED.values():
        with Instance(fmu) as one:
            with pytest.raises(FMICallException, match="ExitInitializationMode"):
                one.begin(values)
            assert one.refusal == f"one: {words(values)}"
            one.reset().begin({"coupler": 0.19}).run(0.1, 0.05)
            assert one["crank_angle"] == pytest.approx(1.0)  # at rest, without gravity


def test_a_batch_refuses_them_too() -> None:
    ready = prepared(MODEL)
    names = {name for values in REFUSED.values() for name in values}
    designs = [{p.name: p.start for p in MODEL.parameters} | values for values in (*REFUSED.values(), {})]
    columns = {name: np.array([design[name] for design in designs]) for name in names}
    numbers = Numbers(ready.traced, {p.name: columns.get(p.name, p.start) for p in MODEL.parameters}, {})
    refused = impossible(ready.traced, numbers, ready.entries, len(designs))
    assert refused == {design: words(values) for design, values in enumerate(REFUSED.values())}
