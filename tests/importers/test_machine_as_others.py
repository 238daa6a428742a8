"""Exported machines in other tools: their curves are those of `machine run --as-others`.

Tools that are not there are skipped, with what to install. Compared are outputs that others follow and that follow no
input at once: of those that do, a tool shows what they were before, or behind the exchange at the end of a step.
"""

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import build_fmu
from harness.app.commands.machine_exchange import baked_machine
from harness.errors import UsageError
from harness.fmu import Fmu, open_fmu
from harness.fmu.description_file import read_description
from harness.machine.connection import Connection
from harness.machine.file.machine_plan import ComponentPlan, Plan, Policy, Source
from harness.machine.file.read_file import components, read_plan
from harness.machine.formats.baking import GAINS, baking
from harness.machine.formats.ssp_export import identifier, write_ssp
from harness.machine.formats.ssp_import import import_ssp
from harness.machine.machine import Machine
from harness.machine.part import Extrapolation
from harness.machine.running import Prepared, run_machine
from harness.machine.stepping import Jacobi
from harness.machine.structure import structure_of
from harness.run.master import Ending, Recorder, TimeGrid
from harness.toml_file import TomlFile
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.fmu.package import build_fmu as build_python_fmu
from tests.harness.machine.foreign import build
from tests.harness.machine.machines import GEARED_CAM
from tests.importers.machine_hosts import curves, tools
from tests.once import once

_TOLERANCE = 1e-9
#: Start-up and the first stroke of the indexing table.
_STEPS = 2000


def same(found: np.ndarray, expected: np.ndarray) -> bool:
    """To 1e-9 of each curve's largest value."""
    assert found.shape == expected.shape
    assert np.all(np.ptp(expected, axis=0) > 1e-3)
    return bool(np.all(np.abs(found - expected).max(axis=0) < _TOLERANCE * np.abs(expected).max(axis=0)))


def prepared(
    file: Path, by: Callable[..., Path], built: Callable[..., Path], stack: ExitStack, fmi: int = 2
) -> Prepared:
    """A machine of ready-made models whose FMUs are built already."""
    version = {"fmi": fmi} if fmi == 3 else {}
    text = TomlFile.read(file)
    flavour = "native" if by is build_native_fmu else "pythonfmu"
    parts = [
        replace(p, source=replace(p.source, flavour=flavour, fmi=fmi))
        for p in components(text, build_fmu.model_names())
    ]
    fmus = {part.name: stack.enter_context(open_fmu(built(part.source.model, by, **version))) for part in parts}
    descriptions = {name: fmu.description for name, fmu in fmus.items()}
    plan = replace(read_plan(text, parts, descriptions), inputs=None)
    return Prepared(plan, fmus, structure_of(descriptions, plan.connections).description, None)


def as_others(machine: Prepared, steps: int, signals: list[str]) -> np.ndarray:
    """Curves of the machine, stepped as others do, shape (steps, signals)."""
    plan = machine.plan
    with ExitStack() as stack:
        parts = {name: stack.enter_context(fmu.instantiate(name)) for name, fmu in machine.fmus.items()}
        whole = Machine(parts, plan.connections, Extrapolation.CONSTANT, reads_once=True)
        recorder = Recorder([whole.description.variables[name] for name in signals])
        grid = TimeGrid.of(steps * plan.policy.step, plan.policy.step)
        outcome = run_machine(whole, Jacobi(), grid, plan.start_values, [recorder])
    assert outcome.ending is Ending.COMPLETED, outcome.error
    return recorder.table()[signals].to_numpy()[1:]


def compared(machine: Prepared) -> list[str]:
    """Connected outputs that follow no input at once."""
    sources = dict.fromkeys(connection.source for connection in machine.plan.connections)
    found = [s for s in sources if machine.description.variables[s].depends_on == frozenset()]
    assert len(found) >= 2
    return found


@pytest.fixture(scope="module")
def indexing(built: Callable[..., Path]) -> Iterator[Prepared]:
    with ExitStack() as stack:
        yield prepared(build_fmu.machines()["indexing_table"], build_native_fmu, built, stack)


@pytest.fixture(scope="module")
def expected(indexing: Prepared) -> np.ndarray:
    return as_others(indexing, _STEPS, compared(indexing))


def exported(machine: Prepared, folder: Path, *, baked: bool) -> Path:
    path = folder / ("baked.ssp" if baked else "plain.ssp")
    if not baked:
        files = {name: (fmu.path, fmu.description) for name, fmu in machine.fmus.items()}
        return write_ssp(machine.plan, files, path)
    found, files = baked_machine(machine, folder)
    assert found.notes == ()
    assert found.plan.start_values == {}
    assert all((c.gain, c.offset) == (1.0, 0.0) for c in found.plan.connections)
    return write_ssp(found.plan, files, path, by_name=True)


@pytest.fixture(scope="module")
def baked(indexing: Prepared, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return exported(indexing, tmp_path_factory.mktemp("baked"), baked=True)


@pytest.mark.parametrize("tool", tools("libcosim", "ecos", "container"))
def test_the_indexing_table_baked(tool: str, baked: Path, indexing: Prepared, expected: np.ndarray) -> None:
    """No parameters, no gains, no offsets are left for the tool to do."""
    found = curves(tool, baked, indexing.plan.policy.step, _STEPS, compared(indexing))
    assert same(found, expected)


def test_the_baked_file_here(baked: Path, indexing: Prepared, expected: np.ndarray, tmp_path: Path) -> None:
    """Imported again, it is the same machine, with nothing to set and nothing to transform."""
    plan = import_ssp(baked, tmp_path).plan
    assert plan.start_values == {}
    assert {(c.gain, c.offset) for c in plan.connections} == {(1.0, 0.0)}
    with ExitStack() as stack:
        paths = {part.name: part.source.path for part in plan.components}
        fmus = {name: stack.enter_context(open_fmu(path)) for name, path in paths.items() if path is not None}
        found = as_others(Prepared(plan, fmus, indexing.description, None), _STEPS, compared(indexing))
    assert same(found, expected)


@pytest.mark.parametrize("tool", tools("libcosim", "ecos"))
def test_the_indexing_table_plain(tool: str, indexing: Prepared, expected: np.ndarray, tmp_path: Path) -> None:
    """In tools that apply parameters and transformations; ecos must be told the name of the parameters."""
    ssp = exported(indexing, tmp_path, baked=False)
    name = identifier(indexing.plan.title)
    found = curves(tool, ssp, indexing.plan.policy.step, _STEPS, compared(indexing), name)
    assert same(found, expected)


def geared_cam(folder: Path) -> Path:
    """Gears and a cam that start at 0, at rest: then fmpy's first step, with 0 at all inputs, is as it should be."""
    file = folder / "geared_cam.toml"
    text = GEARED_CAM.replace('file = "{gear_train}"', 'model = "gear_train"')
    text = text.replace('file = "{cam_drive}"', 'model = "cam_drive"').replace("{unilateral}", "true")
    back = '[[connect]]\nfrom = "cam.drive_shaft_torque"\nto = "gears.load_torque"\ngain = -1.0\n'
    file.write_text(text.replace("{back}", back), encoding="utf-8")
    return file


@pytest.fixture(scope="module", params=[build_native_fmu, build_python_fmu], ids=["native", "pythonfmu"])
def from_rest(
    request: pytest.FixtureRequest, built: Callable[..., Path], tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Prepared]:
    with ExitStack() as stack:
        yield prepared(geared_cam(tmp_path_factory.mktemp("rest")), request.param, built, stack)


@pytest.fixture(scope="module")
def from_rest_baked(from_rest: Prepared, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return exported(from_rest, tmp_path_factory.mktemp("from_rest"), baked=True)


@pytest.mark.parametrize("tool", tools("fmpy", "libcosim", "ecos", "container"))
def test_a_machine_from_rest_baked(tool: str, from_rest: Prepared, from_rest_baked: Path) -> None:
    signals = compared(from_rest)
    found = curves(tool, from_rest_baked, from_rest.plan.policy.step, 200, signals)
    assert same(found, as_others(from_rest, 200, signals))


@pytest.mark.parametrize("tool", tools("container", "ecos"))
def test_a_machine_of_fmi_3_baked(tool: str, built: Callable[..., Path], tmp_path: Path) -> None:
    """In a tool that runs FMI 3.0."""
    with ExitStack() as stack:
        machine = prepared(geared_cam(tmp_path), build_native_fmu, built, stack, fmi=3)
        found = curves(tool, exported(machine, tmp_path, baked=True), machine.plan.policy.step, 200, compared(machine))
        assert same(found, as_others(machine, 200, compared(machine)))


@pytest.fixture(scope="module")
def mass(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An FMU that is not this project's."""
    folder = once(tmp_path_factory, "foreign_mass", lambda folder: build.by_pythonfmu("mass.py", folder))
    return folder / "Mass.fmu"


@pytest.mark.parametrize("tool", tools("libcosim"))
def test_the_input_of_a_foreign_fmu_has_a_gain_before_it_that_delays(
    tool: str, mass: Path, built: Callable[..., Path], tmp_path: Path
) -> None:
    """What is said of it: the curves are those of a machine with the component of gains, one step behind."""
    with ExitStack() as stack:
        files = {"rotor": built("motor", build_native_fmu), "mass": mass}
        fmus = {name: stack.enter_context(open_fmu(path)) for name, path in files.items()}
        parts = (
            ComponentPlan("rotor", Source(None, "motor"), values={"speed_reference": 30.0, "speed_gain": 0.5}),
            ComponentPlan("mass", Source(mass), values={"mass": 2.0}),
        )
        connections = (Connection("rotor.rotor_speed", "mass.force", gain=-3.0, offset=0.5),)
        plan = Plan("Foreign", parts, connections, (), Policy(0.2, 1e-3))
        machine = Prepared(plan, fmus, structure_of(_described(fmus)).description, None)
        found, made = baked_machine(machine, tmp_path)
        assert found.gains[0].factor == -3.0
        assert found.notes == (
            "mass.force gets -3 times rotor.rotor_speed + 0.5 from the component gains_of_connections, because the FMU "
            "of mass is not of this project: this delays the signal by one step.",
            "The FMU of mass is not of this project, so its parameters stay in a file beside it: mass. Tools that "
            "apply none need them to be set by hand.",
        )
        for name, (path, _) in made.items():
            fmus[name] = stack.enter_context(open_fmu(path))
        assert set(fmus) == {"rotor", "mass", GAINS}
        delayed = Prepared(found.plan, fmus, structure_of(_described(fmus)).description, None)
        signals = ["rotor.rotor_speed", "mass.x"]
        ours = as_others(delayed, 200, signals)
        at_once = as_others(replace(machine, fmus={name: fmus[name] for name in files}), 200, signals)
        assert ours[2:, 1] != pytest.approx(at_once[2:, 1], rel=1e-6)
        ssp = write_ssp(found.plan, made, tmp_path / "foreign.ssp", by_name=True)
    assert same(curves(tool, ssp, 1e-3, 200, signals), ours)


def _described(fmus: dict[str, Fmu]) -> dict[str, object]:
    return {name: fmu.description for name, fmu in fmus.items()}


def test_a_file_of_this_version_is_known_again(built: Callable[..., Path], tmp_path: Path) -> None:
    """An FMU file counts as its model if a build of now has its GUID; one that was changed is somebody else's."""
    path = built("gear_train", build_native_fmu)
    description = read_description(path)
    flavour = build_fmu.Flavour.NATIVE
    assert build_fmu.model_with_guid(description.model, description.guid, flavour, 2) == "gear_train"
    assert build_fmu.model_with_guid(description.model, "{other}", flavour, 2) is None
    assert build_fmu.model_with_guid("Other", description.guid, flavour, 2) is None


def test_units_of_what_is_given(indexing: Prepared) -> None:
    """A baked input has the unit of its source, so that no tool converts twice."""
    descriptions = dict(indexing.descriptions)
    motor = descriptions["motor"]
    angle = replace(motor.variables["rotor_angle"], unit="deg")
    descriptions["motor"] = replace(motor, variables={**motor.variables, "rotor_angle": angle})
    found = baking(indexing.plan, descriptions, list(descriptions)).numbers["gears"].inputs["drive_angle"]
    assert found == (pytest.approx(np.pi / 180), pytest.approx(np.radians(-2400)), "deg")
    wrong = replace(angle, unit="m")
    descriptions["motor"] = replace(motor, variables={**motor.variables, "rotor_angle": wrong})
    with pytest.raises(UsageError, match="does not measure the same"):
        baking(indexing.plan, descriptions, list(descriptions))
