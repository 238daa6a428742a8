"""Machines as SSP: there and back, by the schema, and the same curves in fmpy and libcosim."""

import zipfile
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssd, read_ssv

from harness.errors import UsageError
from harness.fmu.description import Description
from harness.fmu.description_file import read_description
from harness.machine.connection import Connection
from harness.machine.file.machine_plan import Plan, Source
from harness.machine.formats.ssp_export import write_ssp
from harness.machine.formats.ssp_import import import_ssp
from harness.machine.formats.ssp_xml import tag
from mechanism_fmu.fmu.disk.archive import read_entries, write_archive
from tests.harness.machine.in_other_tools import in_fmpy, in_libcosim
from tests.harness.machine.machines import SIGNALS, ReadOnce, geared_cam, plan_of, run


@pytest.fixture(scope="module")
def plan(tmp_path_factory, native_gear_train_fmu, native_cam_drive_fmu) -> Plan:
    folder = tmp_path_factory.mktemp("machine")
    return plan_of(geared_cam(folder, native_gear_train_fmu, native_cam_drive_fmu))


@pytest.fixture(scope="module")
def one_way(tmp_path_factory, native_gear_train_fmu, native_cam_drive_fmu) -> Plan:
    """The same machine, but the wheel does not feel the cam: no gain, and no output that follows an input at once."""
    folder = tmp_path_factory.mktemp("one_way")
    return plan_of(geared_cam(folder, native_gear_train_fmu, native_cam_drive_fmu, "", "false"))


def files(plan: Plan) -> dict[str, tuple[Path, Description]]:
    paths = {part.name: part.source.path for part in plan.components}
    return {name: (path, read_description(path)) for name, path in paths.items() if path is not None}


def exported(plan: Plan, folder: Path) -> Path:
    return write_ssp(plan, files(plan), folder / "machine.ssp")


def bare(plan: Plan) -> Plan:
    """A plan without the places of its files."""
    return replace(plan, components=tuple(replace(part, source=Source()) for part in plan.components), inputs=None)


def changed(ssp: Path, *changes: tuple[str, str]) -> Path:
    """The same .ssp with another text in its .ssd."""
    entries = read_entries(ssp)
    text = entries["SystemStructure.ssd"].decode()
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    write_archive({**entries, "SystemStructure.ssd": text.encode()}, ssp)
    return ssp


def test_there_and_back(plan, tmp_path):
    inputs = tmp_path / "drive.csv"
    inputs.write_text("time [s],gears.drive_angle\n0,0\n1,1\n")
    parts = (replace(plan.components[0], process=True, time_limit=2.5), plan.components[1])
    turned = (replace(plan.bonds[0], reaction=True),)
    full = replace(plan, components=parts, bonds=turned, inputs=inputs, material="S355", title="Räder & <Kurve>")
    folder = tmp_path / "back"
    folder.mkdir()
    found = import_ssp(exported(full, tmp_path), folder)
    assert found.notes == ()
    assert bare(found.plan) == bare(full)
    assert bare(plan_of(found.file)) == bare(full)
    assert (folder / "inputs.csv").read_text() == inputs.read_text()
    assert exported(full, folder).read_bytes() == (tmp_path / "machine.ssp").read_bytes()


def test_fmpy_finds_it_true_to_the_schema(plan, tmp_path):
    ssp = exported(plan, tmp_path)
    system = read_ssd(ssp, validate=True)
    assert [part.name for part in system.system.elements] == ["gears", "cam"]
    assert {unit.name for unit in system.units} == {"rad", "rad/s", "N.m", "m/s"}
    values = read_ssv(ssp, "resources/cam.ssv", validate=True)
    assert {p.name: (p.type, p.value, p.unit) for p in values.parameters} == {
        "cam_speed_start": ("Real", "0.0", "rad/s"),
        "unilateral": ("Boolean", "true", None),
        "drive_stiffness": ("Real", "5.0", "N.m/rad"),
        "drive_damping": ("Real", "0.2", "N.m.s/rad"),
    }


def test_names_are_identifiers(plan, tmp_path):
    """Tools make names of files and prefixes of them; the title stands in the description."""
    ssp = exported(replace(plan, title="2 Räder & <Kurve>"), tmp_path)
    root = ElementTree.fromstring(read_entries(ssp)["SystemStructure.ssd"])
    system = root.find(tag("ssd:System"))
    assert system is not None
    for element in (root, system):
        assert (element.get("name"), element.get("description")) == ("_2_Rader_Kurve", "2 Räder & <Kurve>")
    master = system.find(f".//{tag('oms:FixedStepMaster')}")
    assert master is not None
    assert float(master.attrib["stepSize"]) == plan.policy.step
    sets = {read_ssv(ssp, f"resources/{part.name}.ssv").name for part in plan.components}
    assert sets == {"_2_Rader_Kurve"}  # ecos knows them by one name


def test_a_converting_connection_goes_there_and_back(plan, tmp_path):
    switched = Connection("cam.impact", "gears.drive_torque", 0.5, convert=True)
    found = import_ssp(exported(replace(plan, connections=(*plan.connections, switched)), tmp_path), tmp_path)
    assert found.plan.connections[-1] == switched
    assert plan_of(found.file).connections[-1] == switched


def test_two_components_of_one_fmu_share_its_file(plan, tmp_path):
    cam = plan.components[1]
    twins = replace(plan, components=(*plan.components, replace(cam, name="other", values={})))
    path = write_ssp(twins, {**files(plan), "other": files(plan)["cam"]}, tmp_path / "twins.ssp")
    with zipfile.ZipFile(path) as archive:
        names = archive.namelist()
    assert [name for name in names if name.endswith(".fmu")] == ["resources/CamDrive.fmu", "resources/GearTrain.fmu"]


def test_what_another_tool_has_changed_counts(plan, tmp_path):
    ssp = changed(
        exported(plan, tmp_path),
        ('factor="-1.0"', 'factor="-2.0"'),
        ('stopTime="1.0"', 'stopTime="3.0"'),
        ('startConnector="wheel_speed"', 'startConnector="pinion_speed"'),
    )
    found = import_ssp(ssp, tmp_path).plan
    assert found.policy.stop_time == 3.0
    assert [c.source for c in found.connections][1] == "gears.pinion_speed"
    assert found.connections[2].gain == -2.0


def test_a_file_of_another_tool(plan, tmp_path):
    """No annotations of ours, and another name with a blank; what is left out is told."""
    ssp = exported(plan, tmp_path)
    entries = read_entries(ssp)
    text = entries["SystemStructure.ssd"].decode().replace('type="mechanism_fmu"', 'type="com.example"')
    text = text.replace('name="cam"', 'name="the cam"').replace('Element="cam"', 'Element="the cam"')
    outside = '<ssd:Connection startConnector="in" endElement="gears" endConnector="drive_speed" />'
    text = text.replace("<ssd:Connections>", f"<ssd:Connections>{outside}")
    write_archive({**entries, "SystemStructure.ssd": text.encode()}, ssp)
    found = import_ssp(ssp, tmp_path)
    assert found.plan.policy.step == 0.005  # of the annotation of the Open Simulation Platform
    assert found.plan.bonds == ()
    assert [part.name for part in found.plan.components] == ["gears", "the_cam"]
    assert "The component 'the cam' is called the_cam here." in found.notes
    assert "The connection from '.in' to 'gears.drive_speed' leaves the system and was left out." in found.notes
    assert plan_of(found.file).start_values.keys() == found.plan.start_values.keys()


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('source="resources/GearTrain.fmu"', 'source="resources/other.fmu"', "is not in the file"),
        ("ssd:Component", "ssd:System", "only flat ones"),
        ("<ssc:LinearTransformation", "<ssc:BooleanMappingTransformation", "maps values one by one"),
        ("ssd:System", "ssd:Sistem", "no SSP 1.0 file"),
        ('factor="-1.0"', 'factor="one"', "damaged"),
        ('algorithm="jacobi"', 'algorithm="none"', "damaged"),
        ("own:Record", "own:Recorded", "damaged"),
        ("</ssd:Elements>", "", "cannot be read"),
    ],
)
def test_what_cannot_be_imported(plan, tmp_path, old, new, said):
    ssp = changed(exported(plan, tmp_path), (old, new))
    with pytest.raises(UsageError, match=said):
        import_ssp(ssp, tmp_path)


def test_parameters_that_cannot_be_read(plan, tmp_path):
    ssp = exported(plan, tmp_path)
    write_archive({**read_entries(ssp), "resources/cam.ssv": b"<a"}, ssp)
    with pytest.raises(UsageError, match=r"damaged one: its parameters 'resources/cam.ssv' cannot be read: "):
        import_ssp(ssp, tmp_path)


def test_a_start_value_of_a_connected_input_is_left_out(plan, tmp_path):
    """Other tools may give one, for the first moment."""
    ssp = exported(plan, tmp_path)
    entries = read_entries(ssp)
    given = b'<ssv:Parameters><ssv:Parameter name="drive_speed"><ssv:Real value="1.0"/></ssv:Parameter>'
    values = entries["resources/cam.ssv"].replace(b"<ssv:Parameters>", given)
    assert given in values
    write_archive({**entries, "resources/cam.ssv": values}, ssp)
    found = import_ssp(ssp, tmp_path)
    assert found.notes == ("cam: the start value of 'drive_speed' was left out, for it follows gears.wheel_speed.",)
    assert bare(plan_of(found.file)) == bare(plan)


@pytest.mark.parametrize("contents", [b"no zip", None])
def test_what_is_no_ssp_file(tmp_path, contents):
    path = tmp_path / "machine.ssp"
    if contents is None:
        write_archive({"readme.txt": b""}, path)
    else:
        path.write_bytes(contents)
    with pytest.raises(UsageError, match=r"SSP file"):
        import_ssp(path, tmp_path)


def test_units_are_converted_once(plan, tmp_path):
    """In other units than those of the target, the transformation converts, and the importer is told so."""
    gears, cam = files(plan)["gears"], files(plan)["cam"]
    angle = replace(gears[1].variables["wheel_angle"], unit="deg")
    degrees = replace(gears[1], variables={**gears[1].variables, "wheel_angle": angle})
    turned = replace(plan, connections=(Connection("gears.wheel_angle", "cam.drive_angle", 0.7, 0.3),), bonds=())
    path = write_ssp(turned, {"gears": (gears[0], degrees), "cam": cam}, tmp_path / "degrees.ssp")
    text = read_entries(path)["SystemStructure.ssd"].decode()
    assert 'suppressUnitConversion="true"' in text
    factor = float(text.partition('factor="')[2].partition('"')[0])
    assert factor == pytest.approx(0.7 * np.pi / 180, rel=1e-14)
    # this GearTrain.fmu gives radians, so that the gain takes over the conversion
    found = import_ssp(path, tmp_path).plan.connections[0]
    assert (found.gain, found.offset) == (pytest.approx(factor, rel=1e-14), 0.3)


def test_fmpy_runs_it_with_the_same_curves(one_way, tmp_path):
    """simulate_ssp takes no parameters from the file, and begins with inputs of 0, as they are here.

    It writes what a step has come to at the time when the step began.
    """
    ssp = exported(one_way, tmp_path)
    found = simulate_ssp(str(ssp), stop_time=0.2, step_size=5e-3, parameter_set=in_fmpy().parameters(ssp))
    ours = run(one_way)
    assert len(found) >= 40
    for name in ("gears.wheel_angle", "cam.cam_angle", "cam.follower_angle"):
        curve = ours[name].to_numpy()[1 : len(found) + 1]
        assert np.ptp(curve) > 1e-3
        assert found[name] == pytest.approx(curve, rel=1e-9)


def test_fmpy_runs_a_cycle_with_the_same_curves_when_it_is_given_what_it_leaves_out(plan, tmp_path):
    """It reads each output once, as libcosim does."""
    cam = replace(plan.components[1], values={**plan.components[1].values, "cam_speed_start": 1.0})
    moving = replace(plan, components=(plan.components[0], cam))
    ssp = exported(moving, tmp_path)
    found = in_fmpy().simulate(ssp, 0.5, 5e-3)["cam.cam_angle"]
    curve = run(moving, kind=ReadOnce)["cam.cam_angle"].to_numpy()[1 : len(found) + 1]
    assert found == pytest.approx(curve, rel=1e-9)
    alone = simulate_ssp(str(ssp), stop_time=0.5, step_size=5e-3, parameter_set=in_fmpy().parameters(ssp))
    assert np.abs(alone["cam.cam_angle"] - curve).max() > 1e-3


def test_libcosim_runs_it_with_the_same_curves(plan, one_way, tmp_path):
    """Bit for bit, if outputs that follow an input at once are read before it is set, as libcosim does."""
    for machine in (one_way, plan):
        found = in_libcosim(exported(machine, tmp_path), machine, 200)
        assert found[:, 2].max() - found[:, 2].min() > 0.05
        same = run(machine, kind=ReadOnce)[list(SIGNALS)].to_numpy()[1:]
        assert np.abs(found - same).max() < 1e-12
    # This project reads them again after it is set: one step earlier, so that the difference is of first order.
    differences = []
    for step in (4e-3, 2e-3, 1e-3):
        finer = replace(plan, policy=replace(plan.policy, step=step))
        found = in_libcosim(exported(finer, tmp_path), finer, round(1 / step))
        differences.append(np.abs(found - run(finer)[list(SIGNALS)].to_numpy()[1:]).max(axis=0))
    assert differences[0].max() < 0.02
    assert np.all(differences[1] < 0.7 * differences[0])
    assert np.all(differences[2] < 0.7 * differences[1])
