"""modelDescription.xml agrees with itself and with what the instances do."""

import math
from xml.etree import ElementTree

import pytest
from fmpy.fmi1 import FMICallException


@pytest.fixture(scope="module")
def root(subject):
    return ElementTree.parse(f"{subject.fmu.folder}/modelDescription.xml").getroot()


def variables(root):
    found = {element.get("name"): (element, element[0]) for element in root.iter("ScalarVariable")}
    assert len(found) > 10
    assert "Real" in {value.tag for _, value in found.values()}
    return found


def step_beyond(kind, limit, direction):
    return int(limit) + direction if kind == "Integer" else math.nextafter(limit, direction * math.inf)


def test_start_values_lie_within_the_limits(root):
    for name, (_, value) in variables(root).items():
        if value.tag != "Boolean" and "start" in value.attrib:
            low, high = float(value.get("min", "-inf")), float(value.get("max", "inf"))
            assert low <= float(value.get("start")) <= high, name


def test_every_number_says_its_unit_and_every_unit_is_defined(root):
    units = {unit.get("name"): {d.get("name") for d in unit.iter("DisplayUnit")} for unit in root.iter("Unit")}
    for name, (_, value) in variables(root).items():
        if value.tag == "Real":
            assert value.get("unit") in units, name
            assert value.get("displayUnit") is None or value.get("displayUnit") in units[value.get("unit")], name
    assert "deg" in units["rad"]
    assert "rpm" in units["rad/s"]


def test_display_units_convert_as_their_names_say(root):
    factors = {d.get("name"): float(d.get("factor")) for d in root.iter("DisplayUnit")}
    assert factors["deg"] == pytest.approx(180 / math.pi, rel=1e-15)
    assert factors["rpm"] == pytest.approx(30 / math.pi, rel=1e-15)


def test_declared_types_have_the_unit_of_their_variables(root):
    types = {t.get("name"): t[0].get("unit") for t in root.iter("SimpleType")}
    declared = [value for _, value in variables(root).values() if "declaredType" in value.attrib]
    assert declared
    assert all(types[value.get("declaredType")] == value.get("unit") for value in declared)


def test_only_real_outputs_are_continuous(root):
    for name, (element, value) in variables(root).items():
        if element.get("causality") == "output" and value.tag != "Real":
            assert element.get("variability") == "discrete", name
        assert element.get("variability") != "fixed" or "arameter" in element.get("causality"), name


def test_initial_belongs_to_the_causality(root):
    expected = {"input": None, "output": "calculated", "parameter": "exact", "calculatedParameter": "calculated"}
    expected["local"] = "calculated"  # states and their derivatives
    for name, (element, value) in variables(root).items():
        assert element.get("initial") == expected[element.get("causality")], name
        assert ("start" in value.attrib) == (element.get("causality") in ("input", "parameter")), name


def test_the_structure_lists_every_unknown_once(root):
    names = list(variables(root))
    listed = {
        part: [names[int(unknown.get("index")) - 1] for unknown in root.find(f"ModelStructure/{part}")]
        for part in ("Outputs", "InitialUnknowns")
    }
    outputs = [n for n, (e, _) in variables(root).items() if e.get("causality") == "output"]
    calculated = [n for n, (e, _) in variables(root).items() if e.get("initial") == "calculated"]
    assert listed == {"Outputs": outputs, "InitialUnknowns": calculated}


def test_dependencies_are_what_can_be_known(root):
    causality = [element.get("causality") for element, _ in variables(root).values()]
    known = {"Outputs": {"input", "local"}, "InitialUnknowns": {"input", "parameter"}}  # local: states
    for part, allowed in known.items():
        unknowns = root.find(f"ModelStructure/{part}")
        assert len(unknowns) > 0
        for unknown in unknowns:
            if causality[int(unknown.get("index")) - 1] == "local":
                assert unknown.get("dependencies") is None  # states: they may depend on all
                continue
            indices = [int(text) for text in unknown.get("dependencies").split()]
            assert {causality[index - 1] for index in indices} <= allowed
            assert len(unknown.get("dependenciesKind").split()) == len(indices)


def test_value_references_are_unique_and_everything_is_described(root):
    elements = [element for element, _ in variables(root).values()]
    assert len({element.get("valueReference") for element in elements}) == len(elements)
    assert all(len(element.get("description")) > 5 for element in elements)


def test_default_experiment_is_complete(root):
    numbers = {k: float(v) for k, v in root.find("DefaultExperiment").attrib.items()}
    assert set(numbers) == {"startTime", "stopTime", "tolerance", "stepSize"}
    assert 0 < numbers["stepSize"] < numbers["stopTime"] - numbers["startTime"]


def test_the_limits_are_those_that_are_enforced(root, instance):
    one = instance()
    tried = 0
    for name, (_, value) in variables(root).items():
        for key, direction in (("min", -1), ("max", 1)):
            if key in value.attrib:
                limit = {"Real": float, "Integer": int}[value.tag](value.get(key))
                one.reset()
                one.set({name: limit})
                with pytest.raises(FMICallException):
                    one.set({name: step_beyond(value.tag, limit, direction)})
                assert f": {name} = " in one.refusal
                assert "limit; give at " in one.refusal
                tried += 1
    assert tried > 10
