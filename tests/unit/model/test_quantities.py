"""What the classes of parts say of their outputs is what the outputs of all models say."""

import pytest

import models
from mechanism_fmu.model import Mechanism, Output
from mechanism_fmu.model.forces import ForceElement
from mechanism_fmu.model.joints.base import Effort

MECHANISMS = {name: models.load(name).MODEL for name in models.available()}


def read_by(mechanism: Mechanism) -> list[tuple[Output, ForceElement, str]]:
    """The outputs that read force elements."""
    forces = {force.name: force for force in mechanism.forces}
    parts = [(output, *output.source.partition(".")[::2]) for output in mechanism.outputs]
    return [(output, forces[part], quantity) for output, part, quantity in parts if part in forces]


@pytest.mark.parametrize("name", MECHANISMS)
def test_outputs_of_force_elements_have_their_units_and_depend_on_what_they_follow(name: str) -> None:
    model = MECHANISMS[name]
    mechanism = model.build(model.values())
    for output, force, quantity in read_by(mechanism):
        fact = force.quantities[quantity]
        assert output.unit == fact.unit, output.name
        targets = {f"{force.name}.{entry}" for entry in fact.feedthrough}
        needed = {port.name for port in mechanism.inputs if port.target in targets}
        assert needed <= set(output.feedthrough), output.name


@pytest.mark.parametrize("name", MECHANISMS)
def test_outputs_of_joints_have_the_units_of_their_efforts(name: str) -> None:
    model = MECHANISMS[name]
    mechanism = model.build(model.values())
    joints = {joint.name: joint for joint in mechanism.joints}
    for output in mechanism.outputs:
        part, _, quantity = output.source.partition(".")
        if part in joints:
            effort: Effort = joints[part].efforts[quantity]
            assert output.unit == effort.unit, output.name


def test_some_model_reads_force_elements() -> None:
    assert sum(len(read_by(model.build(model.values()))) for model in MECHANISMS.values()) >= 8
