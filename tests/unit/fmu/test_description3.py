from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import fmpy
import pytest
from fmpy.model_description import ModelDescription
from fmpy.validation import validate_fmu
from pendulum import MODEL

import models
from mechanism_fmu.fmu.model_description import to_bytes
from mechanism_fmu.fmu.native.description3 import array_layout, model_description3, variables3
from mechanism_fmu.fmu.variables import variables_of
from mechanism_fmu.model import Mechanism, MechanismError, Model, Output, Parameter

TOKEN = "{01234567-89ab-cdef-0123-456789abcdef}"
RATCHET = models.load("ratchet").MODEL
BARE = replace(MODEL, mechanism=lambda _: Mechanism(()), parameters=(Parameter("n", 1, "n", type="Integer"),))


def with_outputs(*outputs: Output) -> Model:
    def mechanism(values: SimpleNamespace) -> Mechanism:
        return replace(MODEL.mechanism(values), outputs=outputs)

    return replace(MODEL, mechanism=mechanism)


def angle(name: str, unit: str = "rad") -> Output:
    return Output(name, "arm.angle", "An angle", unit)


def written(model: Model, folder: Path) -> Path:
    (folder / "modelDescription.xml").write_bytes(to_bytes(model_description3(model, TOKEN)))
    return folder


@pytest.fixture(scope="module")
def ratchet(tmp_path_factory: pytest.TempPathFactory) -> ModelDescription:
    return fmpy.read_model_description(str(written(RATCHET, tmp_path_factory.mktemp("ratchet"))))


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


def test_scalars_are_those_of_fmi_2_under_the_same_value_references(ratchet: ModelDescription) -> None:
    found = {v.valueReference: v for v in ratchet.modelVariables}
    types = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean"}
    scalars = [v for v in variables_of(RATCHET) if "[" not in v.name and v.name != "impact"]
    for variable in scalars:
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


def test_numbered_outputs_are_arrays(ratchet: ModelDescription) -> None:
    flat = {v.name: v.value_reference for v in variables_of(RATCHET)}
    arrays = {v.name: v for v in ratchet.modelVariables if v.dimensions}

    assert {name: v.shape for name, v in arrays.items()} == {
        **{f"impacts.{f}": (8,) for f in ("time", "velocity", "closing_speed", "impulse", "energy_lost")},
        **{f"impacts.{f}": (8,) for f in ("wheel_speed_before", "wheel_speed", "instant", "tooth", "contact")},
        **{f"events.{f}": (16,) for f in ("time", "guard", "subject", "old_mode", "new_mode", "impulse")},
    }
    assert all(v.valueReference == flat[name.replace(".", "[1].")] for name, v in arrays.items())
    assert arrays["impacts.time"].description == "Time of impact k of the last communication step"
    assert "(0 gap closed, 1 force gone, 2 next tooth," in arrays["events.guard"].description


def test_the_flag_of_an_impact_is_a_clock_behind_all_others_and_time_follows(ratchet: ModelDescription) -> None:
    count = len(variables_of(RATCHET))
    clock, time = ratchet.modelVariables[-2:]

    assert (clock.name, clock.type, clock.valueReference) == ("impact", "Clock", count)
    assert (clock.causality, clock.variability, clock.intervalVariability) == ("output", "discrete", "triggered")
    assert (time.name, time.type, time.valueReference, time.unit) == ("time", "Float64", count + 1, "s")
    assert (time.causality, time.variability) == ("independent", "continuous")


def test_what_describes_the_last_impact_is_clocked(ratchet: ModelDescription) -> None:
    clocked = {v.name for v in ratchet.modelVariables if v.clocks}

    assert all(v.clocks == [ratchet.modelVariables[-2]] for v in ratchet.modelVariables if v.clocks)
    assert {
        "impact_time",
        "impact_velocity",
        "impact_tooth",
        "impact_wheel_speed_before",
        "impact_energy_lost",
    } <= clocked
    assert all(name.startswith("impact_") for name in clocked)
    assert not clocked & {"impact_count", "impacts_in_step", "impacts_lost"}


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

    assert outputs["contact_force"].dependencies == inputs
    assert outputs["wheel_angle"].dependencies == []
    assert outputs["drive_shaft_torque"].dependencies == [reference["drive_angle"], reference["drive_speed"]]
    assert outputs["impact"].dependencies == []
    unknown = {u.variable.name: u for u in ratchet.initialUnknowns}
    assert "impact_time" not in unknown
    assert unknown["tooth_pitch"].dependencies == [v for v in ratchet.modelVariables if v.causality == "parameter"]


def test_layout_tells_elements_and_strides_by_flat_index() -> None:
    variables = variables_of(RATCHET)
    layout = dict(zip((v.name for v in variables), array_layout(variables), strict=True))

    assert layout["wheel_angle"] == layout["impact_time"] == (1, 0)
    assert layout["impacts[1].time"] == layout["impacts[1].contact"] == (8, 10)
    assert layout["events[1].guard"] == (16, 6)
    assert layout["impacts[2].time"] == layout["events[16].impulse"] == (0, 0)
    assert layout["impact"] == (0, 0)
    present = [v.value_reference for v, (count, _) in zip(variables, layout.values(), strict=True) if count]
    assert present == [v.value_reference for v in variables3(RATCHET)[:-2]]


def test_an_array_may_have_one_element() -> None:
    assert array_layout(variables_of(MODEL))[variables3(MODEL)[-3].value_reference] == (1, 0)
    (only,) = (v for v in variables3(MODEL) if v.dimension)
    assert (only.name, only.dimension) == ("impacts.time", 1)


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
def test_numbered_outputs_that_make_no_array_stay_what_they_are(outputs: tuple[Output, ...], tmp_path: Path) -> None:
    model = with_outputs(*outputs)

    assert not any(v.dimension for v in variables3(model))
    assert {o.name for o in outputs} <= {v.name for v in variables3(model)}
    assert validate_fmu(str(written(model, tmp_path))) == []


def test_without_the_flag_there_is_no_clock(tmp_path: Path) -> None:
    model = with_outputs(Output("when", "impact.time", "Time of the last impact", "s"))

    assert {v.type for v in variables3(model)} == {"Float64", "Int32", "Boolean"}
    assert not any(v.clock for v in variables3(model))
    assert variables3(model)[-1].value_reference == len(variables_of(model)) + 1
    assert validate_fmu(str(written(model, tmp_path))) == []


@pytest.mark.parametrize("outputs", [[angle("time")], [angle("a[1].b"), angle("a.b")]], ids=("time", "array"))
def test_a_name_that_fmi_3_needs_is_refused(outputs: list[Output]) -> None:
    with pytest.raises(MechanismError, match="give the port another name"):
        variables3(with_outputs(*outputs))
