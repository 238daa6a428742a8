"""What the classes of parts say of their outputs is what the outputs of all models say."""

import pytest

import models
from mechanism_fmu.model import Mechanism, Output
from mechanism_fmu.model.forces import ForceElement
from mechanism_fmu.model.joints.base import Effort
from mechanism_fmu.model.mechanism import OF_FRICTION, turns

MECHANISMS = {name: models.load(name).MODEL for name in models.available()}


def read_by(mechanism: Mechanism) -> list[tuple[Output, ForceElement, str]]:
    """The outputs that read force elements."""
    forces = {force.name: force for force in mechanism.forces}
    parts = [(output, *output.source.partition(".")[::2]) for output in mechanism.outputs]
    found = [(output, forces[part], quantity) for output, part, quantity in parts if part in forces]
    return [one for one in found if one[2] not in OF_FRICTION]


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
        if part in joints and quantity not in OF_FRICTION:
            effort: Effort = joints[part].efforts[quantity]
            assert output.unit == effort.unit, output.name


@pytest.mark.parametrize("name", MECHANISMS)
def test_outputs_of_friction_have_its_units_and_depend_on_all_inputs(name: str) -> None:
    model = MECHANISMS[name]
    mechanism = model.build(model.values())
    parts = {part.name: part for part in (*mechanism.contacts, *mechanism.joints, *mechanism.elements)}
    for output in mechanism.outputs:
        part, _, quantity = output.source.partition(".")
        if quantity in OF_FRICTION:
            units = {"slip_speed": ("m/s", "rad/s"), "friction_force": ("N", "N.m"), "sticks": ("1", "1")}
            assert output.unit == units[quantity][turns(parts[part])], output.name
            needed = {port.name for port in mechanism.inputs} if quantity == "friction_force" else set()
            assert set(output.feedthrough) == needed, output.name


def test_models_read_the_friction_of_all_that_may_rub_but_for_pins() -> None:
    found = {
        name: {output.source for output in model.build(model.values()).outputs if output.source.endswith(".sticks")}
        for name, model in MECHANISMS.items()
    }
    assert {name: sources for name, sources in found.items() if sources} == {
        "cam_drive": {"contact.sticks"},
        "geneva": {"slot.sticks"},
        "geneva_clearance": {"slot.sticks", "locking_disc.sticks"},
        "ratchet": {"slope.sticks", "face.sticks"},
        "ratchet_free": {"tooth.sticks"},
        "rotary_table": {"brake.sticks"},
        "slider_crank": {"guide.sticks"},
    }


def test_some_model_reads_force_elements() -> None:
    assert sum(len(read_by(model.build(model.values()))) for model in MECHANISMS.values()) >= 8
