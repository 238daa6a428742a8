import zipfile
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from xml.etree.ElementTree import Element

import fmpy
import pytest
from fmpy.validation import validate_fmu
from pendulum import MODEL

from mechanism_fmu.fmu.parts.model_description import model_description, to_bytes
from mechanism_fmu.fmu.parts.variables import variables_of
from mechanism_fmu.model import Mechanism, MechanismError, Parameter

GUID = "{01234567-89ab-cdef-0123-456789abcdef}"


@pytest.fixture
def root() -> Element:
    return model_description(MODEL, GUID)


def only(root: Element, path: str) -> Element:
    (element,) = root.findall(path)
    return element


def test_fmpy_finds_no_problem(tmp_path: Path) -> None:
    (tmp_path / "modelDescription.xml").write_bytes(to_bytes(model_description(MODEL, GUID)))
    assert validate_fmu(str(tmp_path)) == []


def test_a_model_without_ports_is_valid_too(tmp_path: Path) -> None:
    bare = replace(MODEL, mechanism=lambda _: Mechanism(()), parameters=(Parameter("n", 1, "n", type="Integer"),))
    (tmp_path / "modelDescription.xml").write_bytes(to_bytes(model_description(bare, GUID)))
    assert validate_fmu(str(tmp_path)) == []


def test_the_same_model_gives_the_same_bytes() -> None:
    assert to_bytes(model_description(MODEL, GUID)) == to_bytes(model_description(MODEL, GUID))


def test_head(root: Element) -> None:
    assert root.attrib["guid"] == GUID
    assert root.attrib["modelName"] == "Pendulum"
    assert root.attrib["generationTool"].endswith("(pythonfmu 0.7.0)")
    assert "generationDateAndTime" not in root.attrib


def test_capabilities(root: Element) -> None:
    assert only(root, "CoSimulation").attrib == {
        "modelIdentifier": "Pendulum",
        "needsExecutionTool": "true",
        "canHandleVariableCommunicationStepSize": "true",
        "canNotUseMemoryManagementFunctions": "true",
        "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true",
    }


def test_default_experiment_is_the_models(root: Element) -> None:
    expected = {"startTime": "0.0", "stopTime": "2.0", "tolerance": "1e-08", "stepSize": "0.01"}
    assert only(root, "DefaultExperiment").attrib == expected


def test_every_variable_reads_back_as_it_was(root: Element) -> None:
    read = fmpy.read_model_description(BytesIO(_zipped(root)), validate=False).modelVariables
    for variable, found in zip(variables_of(MODEL), read, strict=True):
        assert (found.name, found.valueReference) == (variable.name, variable.value_reference)
        assert (found.type, found.causality, found.variability) == (
            variable.type,
            variable.causality,
            variable.variability,
        )
        assert (found.unit, found.displayUnit) == (variable.unit, variable.display_unit)
        assert found.description == variable.description
        assert _number(found.start) == variable.start
        if variable.type == "Real":
            assert (_number(found.min), _number(found.max)) == (variable.minimum, variable.maximum)
            assert _number(found.nominal) == variable.nominal


def test_numbers_keep_all_their_digits(root: Element) -> None:
    assert only(root, ".//ScalarVariable[@name='mass']/Real").attrib["start"] == "0.30000000000000004"


def test_limits_of_an_integer_are_written_as_integers(root: Element) -> None:
    expected = {"start": "3", "min": "3", "max": "100"}
    assert only(root, ".//ScalarVariable[@name='teeth']/Integer").attrib == expected


def test_a_type_has_the_display_unit_that_all_its_variables_share(root: Element) -> None:
    angle = only(root, "TypeDefinitions/SimpleType[@name='Angle']/Real")
    assert angle.attrib == {"quantity": "Angle", "unit": "rad", "displayUnit": "deg"}
    # 'bias' is shown in N.m and 'torque' in mN.m
    assert "displayUnit" not in only(root, "TypeDefinitions/SimpleType[@name='Torque']/Real").attrib
    assert only(root, ".//ScalarVariable[@name='torque']/Real").attrib["displayUnit"] == "mN.m"


def test_units_are_defined_once_with_what_is_shown_and_what_is_offered(root: Element) -> None:
    torque = only(root, "UnitDefinitions/Unit[@name='N.m']")
    assert only(torque, "BaseUnit").attrib == {"kg": "1", "m": "2", "s": "-2"}
    assert {d.attrib["name"]: float(d.attrib["factor"]) for d in torque.findall("DisplayUnit")} == {
        "N.mm": 1e3,
        "mN.m": 1e3,
    }


def test_structure_lists_outputs_and_initial_unknowns_by_index_from_one(root: Element) -> None:
    outputs = {u.attrib["index"]: u.attrib["dependencies"] for u in root.findall("ModelStructure/Outputs/Unknown")}
    assert outputs == {"3": "", "4": "1 2", "5": "", "6": "", "7": ""}
    unknowns = {
        u.attrib["index"]: u.attrib["dependencies"] for u in root.findall("ModelStructure/InitialUnknowns/Unknown")
    }
    assert unknowns == {
        "3": "8 9 10 11",
        "4": "1 2 8 9 10 11",
        "5": "",
        "6": "",
        "7": "",
        "12": "8 9 10 11",
    }


def test_a_unit_that_cannot_be_is_refused_by_the_name_of_its_variable() -> None:
    wrong = (Parameter("size", 1.0, "Size", "m", display_unit="deg"),)
    model = replace(MODEL, parameters=wrong, mechanism=lambda _: Mechanism(()))
    with pytest.raises(MechanismError, match="size: display unit 'deg'"):
        model_description(model, GUID)


def test_descriptions_with_special_letters_survive() -> None:
    model = replace(MODEL, description='Pennestrì & "others" <1>')
    read = fmpy.read_model_description(BytesIO(_zipped(model_description(model, GUID))))
    assert read.description == 'Pennestrì & "others" <1>'


def _number(text: str | None) -> float | bool | None:
    if text is None or text in ("true", "false"):
        return None if text is None else text == "true"
    return float(text)


def _zipped(root: Element) -> bytes:
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr("modelDescription.xml", to_bytes(root))
    return buffer.getvalue()
