"""A native FMU refuses the numbers that `compile_mechanism` refuses, in the same words."""

import pytest
from fmpy.fmi1 import FMICallException

import tests.unlimited as unlimited
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.model import MechanismError
from mechanism_fmu.model.compile import compile_mechanism
from tests.fmu.conformance.host import Fmu, Instance
from tests.unlimited import MODEL

IMPOSSIBLE = {
    "negative mass": {"mass": -1.0},
    "massless": {"mass": 0.0},
    "restitution": {"restitution": 1.5},
    "normal": {"normal": 0.5, "enabled": 0.25},
    "stiffness": {"stiffness": -2.0, "damping": -1e-3},
    "pitch": {"pitch": 0.0},
    "tolerance": {"tolerance": 1.0, "gain": -1.0},
    "row that bounces": {"row_restitution": 0.5},
    "axis": {"axis": 0.0},
    "infinite, and zero times infinity": {"scale": 1e200, "restitution": -1.0, "start": 2.0},
}


@pytest.fixture(scope="module")
def fmu(tmp_path_factory):
    built = build_native_fmu(unlimited, tmp_path_factory.mktemp("unlimited"))
    return Fmu.unzip(built, tmp_path_factory.mktemp("unzipped"))


@pytest.mark.parametrize("values", IMPOSSIBLE.values(), ids=IMPOSSIBLE)
def test_impossible_numbers_are_refused_in_the_words_of_the_check(fmu, values):
    with pytest.raises(MechanismError) as refusal:
        compile_mechanism(MODEL.build(MODEL.values(**values)))
    with Instance(fmu) as one:
        one.slave.setupExperiment(startTime=0.0)
        one.set(values)
        one.slave.enterInitializationMode()
        with pytest.raises(FMICallException, match="ExitInitializationMode"):
            one.slave.exitInitializationMode()
        # The log has room for 2000 characters of it; a host takes it for a format of printf.
        assert one.refusal.replace("%%", "%") == f"one: {refusal.value}"[: len("one: ") + 1999]
        one.reset().begin().run(0.1, 0.05)
        assert one["arm_angle"] == pytest.approx(0.0)


def test_what_the_model_objects_to_is_said_alone(fmu):
    with Instance(fmu) as one:
        with pytest.raises(FMICallException):
            one.begin({"mass": -2000.0})
        assert one.refusal == "one: mass = -2000 kg is what the model objects to."
