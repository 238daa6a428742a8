"""Descriptions of FMUs and systems (SSP): whatever their elements and attributes say, they are read or refused."""

import re
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import pytest
from hypothesis import given, strategies as st

from harness.analysis.impacts import ImpactCollector
from harness.errors import UsageError
from harness.fmu.description import Description
from harness.fmu.description_file import read_description
from harness.fmu.values import shown
from harness.machine.connection import Connection
from harness.machine.file.machine_plan import ComponentPlan, Plan, Policy, Source
from harness.machine.formats.ssp_export import write_ssp
from harness.machine.formats.ssp_import import import_ssp
from harness.run.experiment import default_times, start_values
from harness.run.logic import EventCollector, default_parameters
from harness.run.master import TimeGrid, recorded_variables
from harness.run.validate import conformance_grid
from mechanism_fmu.fmu.disk.archive import read_entries, write_archive
from tests.fuzz.input_bytes import damaged, fuzzed, nasty, read_or_refused
from tests.harness.damaged import LIBRARIES, sound

FMI2 = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Wheel" guid="{1}" description="A wheel" generationTool="hand">
  <CoSimulation modelIdentifier="Wheel" canHandleVariableCommunicationStepSize="true" canInterpolateInputs="true"
    maxOutputDerivativeOrder="1" canGetAndSetFMUstate="true" canSerializeFMUstate="true"
    canBeInstantiatedOnlyOncePerProcess="false"/>
  <UnitDefinitions>
    <Unit name="rad"><BaseUnit rad="1"/><DisplayUnit name="deg" factor="57.29577951308232"/></Unit>
    <Unit name="N.m"><BaseUnit kg="1" m="2" s="-2" factor="1" offset="0"/></Unit>
    <Unit name="K"><BaseUnit K="1"/><DisplayUnit name="degC" factor="1" offset="-273.15"/></Unit>
  </UnitDefinitions>
  <TypeDefinitions><SimpleType name="Angle"><Real unit="rad" displayUnit="deg" min="-9" max="9"
    nominal="2"/></SimpleType></TypeDefinitions>
  <LogCategories><Category name="logEvents" description="events"/></LogCategories>
  <DefaultExperiment startTime="0" stopTime="1" stepSize="0.1" tolerance="1e-4"/>
  <ModelVariables>
    <ScalarVariable name="torque" valueReference="0" causality="input"><Real unit="N.m" start="0.5"/></ScalarVariable>
    <ScalarVariable name="teeth" valueReference="1" causality="parameter" variability="fixed">
      <Integer start="12" min="3" max="99"/></ScalarVariable>
    <ScalarVariable name="guided" valueReference="2" causality="parameter" variability="fixed"><Boolean start="true"/>
    </ScalarVariable>
    <ScalarVariable name="angle" valueReference="3" causality="output"><Real declaredType="Angle"/></ScalarVariable>
    <ScalarVariable name="impacts_in_step" valueReference="4" causality="output" variability="discrete"><Integer/>
    </ScalarVariable>
    <ScalarVariable name="impacts[1].time" valueReference="5" causality="output"><Real unit="N.m"/></ScalarVariable>
    <ScalarVariable name="note" valueReference="6" causality="parameter" variability="fixed"><String start="x"/>
    </ScalarVariable>
  </ModelVariables>
  <ModelStructure><Outputs><Unknown index="4" dependencies="1" dependenciesKind="dependent"/><Unknown index="5"/>
    <Unknown index="6" dependencies=""/></Outputs></ModelStructure>
</fmiModelDescription>
"""
FMI3 = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="Wheel" instantiationToken="{1}">
  <CoSimulation modelIdentifier="Wheel" hasEventMode="true" mightReturnEarlyFromDoStep="true"
    canGetAndSetFMUState="true"/>
  <UnitDefinitions><Unit name="rad"><BaseUnit rad="1"/><DisplayUnit name="deg" factor="57.3" inverse="false"/></Unit>
  </UnitDefinitions>
  <TypeDefinitions><Float64Type name="Angle" unit="rad" min="-9" max="9"/></TypeDefinitions>
  <DefaultExperiment startTime="0" stopTime="2" stepSize="0.1"/>
  <ModelVariables>
    <Float64 name="time" valueReference="9" causality="independent" variability="continuous"/>
    <Float64 name="torque" valueReference="0" causality="input" start="0.5"/>
    <UInt64 name="size" valueReference="1" causality="structuralParameter" variability="tunable" start="3"/>
    <Float64 name="field.x" valueReference="2" causality="parameter" variability="fixed" start="1 2 3">
      <Dimension valueReference="1"/></Float64>
    <Float32 name="pair" valueReference="3" causality="output" declaredType="Angle"><Dimension start="2"/></Float32>
    <Int8 name="gear" valueReference="4" causality="input" start="1"/>
    <String name="note" valueReference="5" causality="parameter" variability="fixed"><Start value="x"/></String>
    <Boolean name="brake" valueReference="6" causality="input" start="false"/>
  </ModelVariables>
  <ModelStructure><Output valueReference="3" dependencies="0 4"/><InitialUnknown valueReference="3"/></ModelStructure>
</fmiModelDescription>
"""
_VALUE = re.compile(r'(?<==)"([^"]*)"')


def changed(text: str, data: st.DataObject) -> str:
    """A text of XML with some values of attributes, or some elements, others than they were."""
    for _ in range(data.draw(st.integers(1, 3))):
        places = list(_VALUE.finditer(text))
        assert places
        place = data.draw(st.sampled_from(places))
        others = st.sampled_from([other[1] for other in places])
        value = data.draw(nasty | others | st.integers().map(str) | st.floats().map(repr))
        quoted = "".join(f"&#{ord(c)};" if c in '<>&"' else c for c in value)
        text = f'{text[: place.start()]}"{quoted}"{text[place.end() :]}'
    return text


def with_other_elements(text: str, data: st.DataObject) -> bytes:
    """With elements that go, come twice, or stand in others."""
    root = ElementTree.fromstring(text)
    for _ in range(data.draw(st.integers(1, 3))):
        parents = [element for element in root.iter() if len(element)]
        if not parents:
            break
        parent = data.draw(st.sampled_from(parents))
        child = data.draw(st.sampled_from(list(parent)))
        how = data.draw(st.sampled_from(["remove", "twice", "rename", "bare"]))
        if how == "remove":
            parent.remove(child)
        elif how == "twice":
            parent.append(child)
        elif how == "rename":
            child.tag = data.draw(st.sampled_from(["Real", "Integer", "Unknown", "Item", "Float64", "Clock", "Binary"]))
        else:
            child.attrib.clear()
    return bytes(ElementTree.tostring(root))


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("xml") / "Wheel.fmu"


def used(description: Description) -> None:
    """What the commands do with a description before and after a run."""
    times = default_times(description, None, None) if description.stop_time and description.step else (1.0, 0.1)
    TimeGrid.of(*times)
    conformance_grid(description)
    default_parameters(description, {})
    for variable in recorded_variables(description):
        assert variable.name in description.variables
        description.units.fitting(variable.unit)
        shown(0.25, variable.name, description)
    ImpactCollector(description)
    EventCollector(description)
    start_values(
        [f"{v.name}={v.start}" for v in description.of("parameter") if v.start and "=" not in v.name], description
    )


def read(path: Path, text: str | bytes) -> Description | None:
    write_archive({"modelDescription.xml": text.encode() if isinstance(text, str) else text}, path)
    description = read_or_refused(lambda: read_description(path), path)
    if description is not None:
        read_or_refused(lambda: used(description), path, " ")
    return description


@pytest.mark.parametrize("text", [FMI2, FMI3], ids=["FMI 2", "FMI 3"])
def test_what_is_damaged_was_sound(path: Path, text: str) -> None:
    description = read(path, text)
    assert description is not None
    assert len(description.variables) in (7, 11)
    used(description)


@pytest.mark.parametrize("text", [FMI2, FMI3], ids=["FMI 2", "FMI 3"])
@fuzzed
@given(data=st.data())
def test_any_value_of_an_attribute_is_read_or_refused(path: Path, text: str, data: st.DataObject) -> None:
    read(path, changed(text, data))


@pytest.mark.parametrize("text", [FMI2, FMI3], ids=["FMI 2", "FMI 3"])
@fuzzed
@given(data=st.data())
def test_any_elements_are_read_or_refused(path: Path, text: str, data: st.DataObject) -> None:
    read(path, with_other_elements(text, data))


@pytest.mark.parametrize("text", [FMI2, FMI3], ids=["FMI 2", "FMI 3"])
@fuzzed
@given(data=st.data())
def test_any_bytes_are_read_or_refused(path: Path, text: str, data: st.DataObject) -> None:
    read(path, data.draw(damaged(text.encode())))


def test_entities_do_not_grow(path: Path) -> None:
    """A billion laughs, ten times each in nine rounds: refused, or never unfolded."""
    rounds = "".join(f'<!ENTITY a{k + 1} "{f"&a{k};" * 10}">' for k in range(9))
    text = FMI2.replace("<fmiModel", f'<!DOCTYPE x [<!ENTITY a0 "ha">{rounds}]><fmiModel', 1).replace("A wheel", "&a9;")
    description = read(path, text)
    assert description is None or len(description.text) < 10_000


def test_a_description_reads_no_other_file(path: Path) -> None:
    secret = path.with_name("secret.txt")
    secret.write_text("secret")
    text = FMI2.replace("<fmiModel", f'<!DOCTYPE x [<!ENTITY a SYSTEM "{secret.as_uri()}">]><fmiModel', 1)
    description = read(path, text.replace('start="x"', 'start="x&a;"'))
    assert description is None or "secret" not in str(description)


@pytest.fixture(scope="module")
def system(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The entries of a sound SSP file with two components, values, a connection, and this project's annotations."""
    folder = tmp_path_factory.mktemp("ssp")
    fmu = sound(folder / "Wheel.fmu", FMI2)
    description = read_description(fmu)
    parts = tuple(
        ComponentPlan(name, Source(fmu), process, 2.5 if process else None, {"teeth": 15, "guided": False, "note": "a"})
        for name, process in (("one", False), ("two", True))
    )
    connection = Connection("one.impacts[1].time", "two.torque", 0.5, 0.25)
    plan = Plan("Two", parts, (connection,), (), Policy(1.0, 0.1))
    write_ssp(plan, {part.name: (fmu, description) for part in parts}, folder / "two.ssp")
    return read_entries(folder / "two.ssp")


def imported(path: Path, entries: dict[str, bytes], folder: Path) -> bool:
    """Whether a system is imported; nothing is written but into its folder."""
    write_archive(entries, path)
    around = set(folder.parent.iterdir())
    found = read_or_refused(lambda: import_ssp(path, folder), path, "'")
    assert set(folder.parent.iterdir()) == around
    assert all(one.is_file() and one.parent == folder for one in folder.iterdir())
    for one in folder.iterdir():
        one.unlink()
    return found is not None


@pytest.fixture(scope="module")
def ssp(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The file, and the folder it is imported to."""
    place = tmp_path_factory.mktemp("imported")
    (place / "here").mkdir()
    return place / "two.ssp", place / "here"


def test_the_system_that_is_damaged_was_sound(ssp: tuple[Path, Path], system: dict[str, bytes]) -> None:
    assert LIBRARIES
    assert imported(ssp[0], system, ssp[1])


def _with_values(text: str, data: st.DataObject) -> bytes:
    return changed(text, data).encode()


@pytest.mark.parametrize("how", [_with_values, with_other_elements])
@fuzzed
@given(data=st.data())
def test_any_system_is_imported_or_refused(
    ssp: tuple[Path, Path],
    system: dict[str, bytes],
    how: Callable[[str, st.DataObject], bytes],
    data: st.DataObject,
) -> None:
    text = system["SystemStructure.ssd"].decode()
    imported(ssp[0], system | {"SystemStructure.ssd": how(text, data)}, ssp[1])


@fuzzed
@given(data=st.data())
def test_any_bytes_of_a_system_are_imported_or_refused(
    ssp: tuple[Path, Path], system: dict[str, bytes], data: st.DataObject
) -> None:
    name = data.draw(st.sampled_from(sorted(system)))
    imported(ssp[0], system | {name: data.draw(damaged(system[name]))}, ssp[1])


@pytest.mark.parametrize("encoding", ["TF-8", "hex", "shift_jis", "idna", "utf-16", "\u00fc"])
@pytest.mark.parametrize("name", ["SystemStructure.ssd", "resources/one.ssv"])
def test_an_encoding_that_nobody_knows_is_refused(
    ssp: tuple[Path, Path], system: dict[str, bytes], name: str, encoding: str
) -> None:
    assert b"'UTF-8'" in system[name]
    assert not imported(ssp[0], system | {name: system[name].replace(b"UTF-8", encoding.encode(), 1)}, ssp[1])
    found = read(ssp[0], FMI2.replace("UTF-8", encoding, 1))
    assert found is None or encoding == "shift_jis"  # which the reader of descriptions knows


@pytest.mark.parametrize("name", ["../out.fmu", "/tmp/out.fmu", "resources/..\\out.fmu"])
def test_a_component_s_file_cannot_lie_outside(ssp: tuple[Path, Path], system: dict[str, bytes], name: str) -> None:
    fmu = next(entry for entry in system if entry.endswith(".fmu"))
    text = system["SystemStructure.ssd"].decode().replace(fmu, name).encode()
    entries = {key: value for key, value in system.items() if key != fmu} | {name: system[fmu]}
    write_archive(entries | {"SystemStructure.ssd": text}, ssp[0])
    with pytest.raises(UsageError, match="cannot be read as an SSP file: its entry"):
        import_ssp(*ssp)
