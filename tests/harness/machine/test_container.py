"""A machine as one FMU: what it says about itself, and the same curves."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from fmpy.validation import validate_fmu

from harness.errors import UsageError
from harness.fmu import open_fmu
from harness.fmu.description import Description
from harness.fmu.description_file import read_description
from harness.machine.connection import Link
from harness.machine.file.machine_plan import Plan
from harness.machine.formats import gains
from harness.machine.formats.container import Part, left_out, write_container
from harness.machine.structure import in_order
from harness.run.master import Ending, Recorder, TimeGrid, run_fixed_step
from mechanism_fmu.fmu.disk.archive import read_entries
from mechanism_fmu.fmu.native.package import build_native_fmu
from tests.harness.machine.machines import SIGNALS, geared_cam, plan_of, run
from tests.harness.machine.test_machine_file import real


@pytest.fixture(scope="module")
def plan(tmp_path_factory, native_gear_train_fmu, native_cam_drive_fmu) -> Plan:
    folder = tmp_path_factory.mktemp("machine")
    return plan_of(geared_cam(folder, native_gear_train_fmu, native_cam_drive_fmu))


def parts(plan: Plan) -> dict[str, Part]:
    paths = {part.name: part.source.path for part in plan.components}
    return {name: Part(path, read_description(path)) for name, path in paths.items() if path is not None}


@pytest.fixture(scope="module")
def container(plan, tmp_path_factory) -> Path:
    return write_container(plan, parts(plan), tmp_path_factory.mktemp("container") / "GearedCam.fmu")


def test_it_is_a_valid_fmu(container):
    assert validate_fmu(str(container)) == []
    with open_fmu(container) as fmu:
        description = fmu.description
    assert (description.model, description.text) == ("GearedCam", "Geared cam")
    assert (description.stop_time, description.step) == (1.0, 0.005)
    assert not description.varies_step  # multiples of 5 ms, which cannot be said
    variable = description.variable("cam.drive_stiffness")
    assert (variable.start, variable.unit, variable.causality) == ("5.0", "N.m/rad", "parameter")
    assert description.variable("cam.unilateral").start == "true"
    assert description.variable("gears.drive_angle").causality == "input"
    assert "gears.load_torque" not in description.variables
    assert description.variable("gears.load_torque.factor").start == "-1.0"
    assert float(str(description.variable("gears.load_torque.offset").start)) == pytest.approx(1e-3)
    assert description.units.convert(1.0, "rpm", "rad/s") == pytest.approx(np.pi / 30)


def test_all_platforms_are_inside(container):
    names = read_entries(container).keys()
    platforms = {name.split("/")[1] for name in names if name.startswith("binaries/")}
    assert platforms == {"linux64", "win64", "darwin64"}
    for nested in ("gears", "cam", gains.NAME):
        inside = {name.split("/")[3] for name in names if name.startswith(f"resources/{nested}/binaries/")}
        assert inside >= platforms


def test_it_moves_as_the_machine_does(container, plan):
    """Connections go one after the other in such an order that nothing is a step late, gains included."""
    with open_fmu(container) as fmu, fmu.instantiate("machine") as machine:
        recorder = Recorder([fmu.description.variables[name] for name in SIGNALS])
        outcome = run_fixed_step(machine, TimeGrid.of(1.0, 5e-3), {}, [recorder])
    assert outcome.ending is Ending.COMPLETED
    found, ours = recorder.table(), run(plan)
    for name in SIGNALS:
        assert np.ptp(ours[name]) > 0.01
        assert found[name].to_numpy() == pytest.approx(ours[name].to_numpy(), rel=1e-9, abs=1e-11)


def test_its_parameters_are_those_of_the_components(container, plan):
    gears, cam = plan.components
    softer = replace(plan, components=(gears, replace(cam, values={**cam.values, "drive_stiffness": 2.0})))
    with open_fmu(container) as fmu, fmu.instantiate("machine") as machine:
        values = {"cam.drive_stiffness": 2.0}
        assert run_fixed_step(machine, TimeGrid.of(1.0, 5e-3), values).ending is Ending.COMPLETED
        found = machine.get(SIGNALS)
    assert found == pytest.approx(run(softer)[list(SIGNALS)].iloc[-1].tolist(), rel=1e-9)


def test_components_of_fmi_3(built, tmp_path, native_cam_drive_fmu, plan):
    """As of FMI 2.0, but for what a step loses by early returns."""
    gears = built("gear_train", build_native_fmu, fmi=3)
    folder = tmp_path / "fmi3"
    folder.mkdir()
    mixed = plan_of(geared_cam(folder, gears, native_cam_drive_fmu))
    path = write_container(mixed, parts(mixed), tmp_path / "Mixed.fmu")
    with open_fmu(path) as fmu, fmu.instantiate("machine") as machine:
        assert run_fixed_step(machine, TimeGrid.of(1.0, 5e-3), {}).ending is Ending.COMPLETED
        found = machine.get(SIGNALS)
    assert found == pytest.approx(run(plan)[list(SIGNALS)].iloc[-1].tolist(), rel=1e-9)


def foreign(plan: Plan, name: str, **as_it_is: object) -> dict[str, Part]:
    """The components, one variable of the gears being of another type of FMI 3.0."""
    known = parts(plan)
    description = known["gears"].description
    types = {
        n: replace(v, fmi_type={"Real": "Float64", "Integer": "Int32"}.get(v.type, v.type))
        for n, v in description.variables.items()
    }
    types[name] = replace(types[name], **as_it_is)  # type: ignore[arg-type]
    changed = replace(description, fmi=3, variables=types)
    return known | {"gears": replace(known["gears"], description=changed)}


@pytest.mark.parametrize("as_it_is", [{"fmi_type": "Float32"}, {"fmi_type": "Enumeration"}, {"elements": 3}])
def test_types_that_it_would_misread_are_left_out(plan, tmp_path, as_it_is):
    strange = foreign(plan, "drive_stiffness", **as_it_is)
    assert left_out(plan, strange) == ["gears.drive_stiffness"]
    assert left_out(plan, parts(plan)) == []
    path = write_container(plan, strange, tmp_path / "Strange.fmu")
    names = read_description(path).variables.keys()
    assert "gears.drive_stiffness" not in names
    assert "gears.drive_damping" in names


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("drive_damping", "would not have the start values of gears.drive_damping"),
        ("wheel_angle", "gears.wheel_angle is of type Float32, which fmpy's container cannot connect"),
    ],
)
def test_types_without_which_it_would_be_another_machine_are_refused(plan, tmp_path, name, said):
    with pytest.raises(UsageError, match=said):
        write_container(plan, foreign(plan, name, fmi_type="Float32"), tmp_path / "Strange.fmu")


def test_the_same_machine_gives_the_same_bytes(container, plan, tmp_path):
    again = write_container(plan, parts(plan), tmp_path / "GearedCam.fmu")
    assert again.read_bytes() == container.read_bytes()


def test_without_gains_there_is_no_fmu_of_gains(plan, tmp_path):
    plain = replace(plan, connections=plan.connections[:2], bonds=())
    entries = read_entries(write_container(plain, parts(plan), tmp_path / "Plain.fmu"))
    assert not any(name.startswith(f"resources/{gains.NAME}/") for name in entries)
    assert len(json.loads(entries["resources/container.json"])["components"]) == 2


def test_gains_need_a_linker(plan, tmp_path, monkeypatch):
    monkeypatch.setattr(gains, "has_linker", lambda: False)
    with pytest.raises(UsageError, match="ziglang"):
        write_container(plan, parts(plan), tmp_path / "GearedCam.fmu")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("name", ["geared cam.fmu", "1.fmu"])
def test_names(plan, tmp_path, name):
    with pytest.raises(UsageError, match="no name for an FMU"):
        write_container(plan, parts(plan), tmp_path / name)


def test_connections_behind_those_that_they_follow_at_once():
    """c follows b's input, b follows a's: a chain, given the other way round; and a loop stays as it is."""
    variables = {
        v.name: v
        for v in (
            real("a.state", "output", "m", depends_on=frozenset()),
            real("b.in", "input", "m"),
            real("b.out", "output", "m", depends_on=frozenset({"in"})),
            real("c.in", "input", "m"),
            real("c.out", "output", "m"),  # nobody says
            real("a.in", "input", "m"),
        )
    }
    machine = Description("Machine", "", "", variables)
    third, second, first = Link("c.out", "a.in", 1, 0), Link("b.out", "c.in", 1, 0), Link("a.state", "b.in", 1, 0)
    assert in_order([third, second, first], machine) == [first, second, third]
