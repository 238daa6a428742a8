from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import fmpy
import pytest
from fmpy.model_description import ModelDescription
from fmpy.validation import validate_fmu
from pendulum import MODEL

import models
from mechanism_fmu.fmu.native.description3 import model_description3, outputs_again, reports_impacts, variables3
from mechanism_fmu.fmu.parts.model_description import to_bytes
from mechanism_fmu.fmu.parts.variables import variables_of
from mechanism_fmu.model import Mechanism, MechanismError, Model, Output, Parameter

TOKEN = "{01234567-89ab-cdef-0123-456789abcdef}"
RATCHET = models.load("ratchet").MODEL
BARE = replace(MODEL, mechanism=lambda _: Mechanism(()), parameters=(Parameter("n", 1, "n", type="Integer"),))


def with_outputs(*outputs: Output) -> Model:
    def mechanism(values: SimpleNamespace) -> Mechanism:
        return replace(MODEL.mechanism(values), outputs=outputs)

    return replace(MODEL, mechanism=mechanism)


FLAG = Output("struck", "impact.any", "Whether there was an impact", "1", type="Boolean")


def angle(name: str, unit: str = "rad") -> Output:
    return Output(name, "arm.angle", "An angle", unit)


def written(model: Model, folder: Path, clocks: bool = False) -> Path:
    (folder / "modelDescription.xml").write_bytes(to_bytes(model_description3(model, TOKEN, clocks)))
    return folder


@pytest.fixture(scope="module")
def ratchet(tmp_path_factory: pytest.TempPathFactory) -> ModelDescription:
    return fmpy.read_model_description(str(written(RATCHET, tmp_path_factory.mktemp("ratchet"))))


@pytest.fixture(scope="module")
def clocked(tmp_path_factory: pytest.TempPathFactory) -> ModelDescription:
    return fmpy.read_model_description(str(written(RATCHET, tmp_path_factory.mktemp("clocked"), clocks=True)))


@pytest.mark.parametrize(
    "model",
    [MODEL, BARE, *(models.load(name).MODEL for name in models.available())],
    ids=("pendulum", "bare", *models.available()),
)
def test_fmpy_finds_no_problem(model: Model, tmp_path: Path) -> None:
    assert validate_fmu(str(written(model, tmp_path))) == []


def test_the_same_model_gives_the_same_bytes() -> None:
    assert to_bytes(model_description3(MODEL, TOKEN)) == to_bytes(model_description3(MODEL, TOKEN))


def test_head_and_abilities(ratchet: ModelDescription) -> None:
    able = ratchet.coSimulation

    assert (ratchet.fmiVersion, ratchet.modelName, ratchet.instantiationToken) == ("3.0", "Ratchet", TOKEN)
    assert not able.needsExecutionTool
    assert able.canGetAndSetFMUstate
    assert able.canSerializeFMUstate
    assert able.canHandleVariableCommunicationStepSize
    assert able.hasEventMode
    assert able.providesIntermediateUpdate
    assert able.mightReturnEarlyFromDoStep
    assert able.canReturnEarlyAfterIntermediateUpdate
    assert able.maxOutputDerivativeOrder == 1


@pytest.mark.parametrize("form", ["ratchet", "clocked"])
def test_variables_are_those_of_fmi_2_under_the_same_value_references(
    form: str, request: pytest.FixtureRequest
) -> None:
    description: ModelDescription = request.getfixturevalue(form)
    found = {v.valueReference: v for v in description.modelVariables}
    types = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean"}
    for variable in variables_of(RATCHET):
        same = found[variable.value_reference]
        assert (same.name, same.description) == (variable.name, variable.description)
        assert (same.type, same.causality, same.variability) == (
            types[variable.type],
            variable.causality,
            variable.variability,
        )
        assert (same.unit, same.displayUnit) == (variable.unit, variable.display_unit)
        if variable.type == "Real" and variable.start is not None:
            assert float(same.start) == variable.start


@pytest.mark.parametrize("name", models.available())
def test_every_importer_can_read_the_plain_form(name: str) -> None:
    """What OMSimulator 3.0 does not take: value reference 0, arrays, clocks."""
    root = model_description3(models.load(name).MODEL, TOKEN)
    variables = root.findall("ModelVariables/*")

    references = [int(v.attrib["valueReference"]) for v in variables]
    assert references == list(range(1, len(variables) + 1))
    assert {v.tag for v in variables} <= {"Float64", "Int32", "Boolean"}
    assert not root.findall(".//Dimension")
    assert not [v for v in variables if "clocks" in v.attrib]
    assert not [v for v in variables if " " in v.attrib["name"]]
    unknowns = root.findall("ModelStructure/*")
    named = [int(r) for u in unknowns for r in (u.attrib["valueReference"], *u.get("dependencies", "").split())]
    assert set(named) <= set(references)
    assert root.attrib["modelName"].isidentifier()
    assert root.find("CoSimulation").attrib["modelIdentifier"].isidentifier()  # type: ignore[union-attr]


def test_time_stands_behind_all_but_what_is_of_model_exchange(ratchet: ModelDescription) -> None:
    time, *behind = ratchet.modelVariables[len(variables_of(RATCHET)) :]
    states, indicators = len(ratchet.derivatives), len(ratchet.eventIndicators)
    assert [v.causality for v in behind] == ["local"] * (2 * states + indicators)
    assert (states, indicators) == (20, 21)

    assert (time.name, time.type, time.valueReference) == ("time", "Float64", len(variables_of(RATCHET)) + 1)
    assert (time.causality, time.variability, time.unit) == ("independent", "continuous", "s")


def test_with_a_clock_numbered_outputs_are_arrays_as_well(clocked: ModelDescription) -> None:
    names = {v.name for v in clocked.modelVariables}
    arrays = {v.name: v for v in clocked.modelVariables if v.dimensions}

    assert set(arrays) == {v.name.replace("[1].", ".") for v in clocked.modelVariables if "[1]." in v.name}
    assert {name: v.shape for name, v in arrays.items()} == {
        name: (8 if name.startswith("impacts") else 16,) for name in arrays
    }
    assert {"impacts.time", "impacts.pawl_speed_before", "events.guard"} <= set(arrays)
    assert {"impacts[1].time", "impacts[8].time", "events[16].guard"} <= names
    assert arrays["impacts.time"].description == "Time of impact k of the last communication step"
    assert "(0 gap closed, 1 force gone, 2 next tooth," in arrays["events.guard"].description


def test_the_clock_is_behind_time(clocked: ModelDescription) -> None:
    (clock,) = (v for v in clocked.modelVariables if v.type == "Clock")

    assert (clock.name, clock.valueReference) == ("impact.clock", len(variables_of(RATCHET)) + 2)
    assert (clock.causality, clock.variability, clock.intervalVariability) == ("output", "discrete", "triggered")


def test_what_the_clock_brings_is_beside_the_plain_variables(clocked: ModelDescription) -> None:
    (clock,) = (v for v in clocked.modelVariables if v.type == "Clock")
    ticked = {v.name: v for v in clocked.modelVariables if v.clocks}
    last = [v for v in variables_of(RATCHET) if v.name.startswith("impact_") and v.name != "impact_count"]

    assert set(ticked) == {v.name.replace("impact_", "impact.tick.") for v in last}
    assert all(v.clocks == [clock] for v in ticked.values())


def test_continuous_outputs_may_be_read_between_communication_points() -> None:
    root = model_description3(RATCHET, TOKEN)
    variables = root.findall("ModelVariables/*")
    marked = {v.attrib["name"] for v in variables if v.attrib.get("intermediateUpdate") == "true"}

    assert marked == {
        v.name for v in variables_of(RATCHET) if v.causality == "output" and v.variability == "continuous"
    }


def test_structure_names_dependencies_by_value_reference(ratchet: ModelDescription) -> None:
    reference = {v.name: v for v in ratchet.modelVariables}
    outputs = {u.variable.name: u for u in ratchet.outputs}
    inputs = [v for v in ratchet.modelVariables if v.causality == "input"]
    states = [v.derivative for v in ratchet.modelVariables if v.derivative is not None]

    assert outputs["contact_force"].dependencies == [*inputs, *states]
    assert outputs["wheel_angle"].dependencies == states
    assert outputs["drive_shaft_torque"].dependencies == [reference["drive_angle"], reference["drive_speed"], *states]
    assert outputs["impact"].dependencies == []
    unknown = {u.variable.name: u for u in ratchet.initialUnknowns}
    assert unknown["tooth_pitch"].dependencies == [v for v in ratchet.modelVariables if v.causality == "parameter"]


def test_what_is_clocked_is_no_initial_unknown(clocked: ModelDescription) -> None:
    unknown = {u.variable.name for u in clocked.initialUnknowns}

    assert {"impact_time", "impacts.time", "impact.clock"} <= unknown
    assert not [name for name in unknown if name.startswith("impact.tick.")]


def test_arrays_say_where_their_elements_are() -> None:
    variables = variables_of(RATCHET)
    by_reference = {v.value_reference: v.name for v in variables}
    arrays = [again for again in outputs_again(variables) if again.count]

    assert arrays
    for again in arrays:
        assert again.count is not None
        elements = [by_reference[again.first.value_reference + k * again.stride] for k in range(again.count)]
        assert elements == [again.name.replace(".", f"[{k}].") for k in range(1, again.count + 1)]


def test_an_array_may_have_one_element() -> None:
    (only,) = (again for again in outputs_again(variables_of(MODEL)) if again.count)
    assert (only.name, only.count, only.stride) == ("impacts.time", 1, 0)


@pytest.mark.parametrize(
    "outputs",
    [
        (angle("a[1].b"), angle("a[2].b", "1")),
        (angle("a[1].b"), angle("a[3].b")),
        (angle("a[2].b"), angle("a[1].b")),
        (angle("a[1].b"), angle("a[2].b"), angle("c"), angle("a[3].b")),
    ],
    ids=("of different units", "with a gap", "backwards", "unevenly spaced"),
)
def test_numbered_outputs_that_make_no_array_make_none(outputs: tuple[Output, ...], tmp_path: Path) -> None:
    model = with_outputs(*outputs, FLAG)

    assert not any(v.dimension for v in variables3(model, clocks=True))
    assert {o.name for o in outputs} <= {v.name for v in variables3(model, clocks=True)}
    assert validate_fmu(str(written(model, tmp_path, clocks=True))) == []


def test_without_impacts_there_is_no_clock() -> None:
    model = with_outputs(Output("when", "impact.time", "Time of the last impact", "s"))

    assert not reports_impacts(variables_of(model))
    with pytest.raises(MechanismError, match="no clock; build it without --clocks"):
        variables3(model, clocks=True)


@pytest.mark.parametrize(
    "outputs", [[angle("time")], [Output("a[1].b", "impacts[1].time", "", "s"), angle("a.b")]], ids=("time", "array")
)
def test_a_name_that_fmi_3_needs_is_refused(outputs: list[Output]) -> None:
    with pytest.raises(MechanismError, match="give the port another name"):
        variables3(with_outputs(*outputs, FLAG), clocks=True)
