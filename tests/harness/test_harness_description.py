"""What is read of a description: each ability by itself, each number, each type."""

from pathlib import Path

import pytest
from damaged import DESCRIPTION, sound

from harness.errors import UsageError
from harness.fmu.description import Description
from harness.fmu.description_file import read_description
from harness.run.validate import conformance_grid

#: By name, the attribute of CoSimulation that says so in FMI 2.0, with what it says.
ABILITIES = {
    "saves_state": 'canGetAndSetFMUstate="true"',
    "serializes_state": 'canSerializeFMUstate="true"',
    "takes_slopes": 'canInterpolateInputs="true"',
    "gives_slopes": 'maxOutputDerivativeOrder="1"',
    "once_per_process": 'canBeInstantiatedOnlyOncePerProcess="true"',
}


def read(folder: Path, text: str) -> Description:
    return read_description(sound(folder / "Sound.fmu", text))


def abilities(description: Description) -> set[str]:
    return {name for name in ABILITIES if getattr(description, name)}


def test_who_says_nothing_has_no_abilities(tmp_path: Path) -> None:
    assert abilities(read(tmp_path, DESCRIPTION)) == set()


@pytest.mark.parametrize("name", ABILITIES)
def test_each_ability_is_read_by_itself(tmp_path: Path, name: str) -> None:
    text = DESCRIPTION.replace("<CoSimulation ", f"<CoSimulation {ABILITIES[name]} ")
    assert abilities(read(tmp_path, text)) == {name}


def test_derivatives_of_order_zero_are_none(tmp_path: Path) -> None:
    text = DESCRIPTION.replace("<CoSimulation ", '<CoSimulation maxOutputDerivativeOrder="0" ')
    assert not read(tmp_path, text).gives_slopes


def test_steps_of_different_sizes_are_an_ability(tmp_path: Path) -> None:
    assert read(tmp_path, DESCRIPTION).varies_step
    text = DESCRIPTION.replace('canHandleVariableCommunicationStepSize="true"', "")
    assert not read(tmp_path, text).varies_step


def test_numbers_of_a_variable(tmp_path: Path) -> None:
    description = read(tmp_path, DESCRIPTION)
    one, other = description.variable("p"), description.variable("y")
    assert (one.start, one.minimum, one.maximum, one.nominal) == ("2", 0.0, 9.0, 3.0)
    assert (other.start, other.minimum, other.maximum, other.nominal) == (None, None, None, 1.0)
    assert (one.reference, one.causality, one.continuous) == (1, "parameter", False)
    assert (other.reference, other.causality, other.continuous) == (0, "output", True)
    assert (one.elements, one.element, one.unit, other.unit) == (1, 0, "", "K")
    assert (description.stop_time, description.step, description.fmi) == (1.0, 0.1, 2)
    assert description.units.displayed["K"] == {"degC": (1.0, -273.15)}


@pytest.mark.parametrize("value", ["0", "-1"])
def test_a_default_experiment_that_does_not_go_on_is_none(tmp_path: Path, value: str) -> None:
    """A step of 0 s once ended `validate` with a division by zero."""
    text = DESCRIPTION.replace('stepSize="0.1"', f'stepSize="{value}"').replace('stopTime="1"', f'stopTime="{value}"')
    description = read(tmp_path, text)
    assert (description.stop_time, description.step) == (None, None)
    assert len(conformance_grid(description)) == 100


def test_an_fmu_for_model_exchange_is_known_as_one(tmp_path: Path) -> None:
    assert not read(tmp_path, DESCRIPTION).exchange
    assert read(tmp_path, DESCRIPTION.replace("CoSimulation", "ModelExchange")).exchange


def test_an_fmu_for_scheduled_execution_is_refused(tmp_path: Path) -> None:
    text = DESCRIPTION.replace("CoSimulation", "ScheduledExecution")
    with pytest.raises(UsageError, match=r"only, of FMI 2\.0\. The harness runs no other kind; export it again\."):
        read(tmp_path, text)


@pytest.mark.parametrize(("size", "elements"), [(0, []), (1, ["y[1]"]), (2, ["y[1]", "y[2]"])])
def test_an_array_has_as_many_elements_as_it_says(tmp_path: Path, size: int, elements: list[str]) -> None:
    """FMI 3.0; none at all is allowed."""
    text = (
        '<fmiModelDescription fmiVersion="3.0" modelName="Small" instantiationToken="1">'
        '<CoSimulation modelIdentifier="Small"/><ModelVariables>'
        f'<Float64 name="y" valueReference="1" causality="output"><Dimension start="{size}"/></Float64>'
        "</ModelVariables><ModelStructure/></fmiModelDescription>"
    )
    assert list(read(tmp_path, text).variables) == elements
