"""The ready machines give the same curves in other tools: as SSP in libcosim and fmpy, and as one container FMU."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import build_fmu
from harness.fmu import open_fmu
from harness.fmu.description_file import read_description
from harness.machine.file.machine_plan import Plan, Source
from harness.machine.file.read_file import components, read_plan
from harness.machine.formats.container import Part, write_container
from harness.machine.formats.ssp_export import write_ssp
from harness.run.master import Ending, Recorder, TimeGrid, run_fixed_step
from harness.toml_file import TomlFile
from mechanism_fmu.fmu.native.package import build_native_fmu
from tests.harness.machine.in_other_tools import in_fmpy, in_libcosim
from tests.harness.machine.machines import ReadOnce, run

pytestmark = pytest.mark.slow

#: Long enough for a start and the first strokes, in steps.
_STEPS = 1000
#: Of each curve, relative to its largest value.
_TOLERANCE = 1e-9


@pytest.fixture(scope="module", params=build_fmu.machines())
def plan(request: pytest.FixtureRequest, built: Callable[..., Path]) -> Plan:
    """A ready machine with native FMUs."""
    file = TomlFile.read(build_fmu.machines()[request.param])
    parts = components(file, build_fmu.model_names())
    sources = {part.name: Source(built(part.source.model, build_native_fmu)) for part in parts}
    descriptions = {name: read_description(path) for name, source in sources.items() if (path := source.path)}
    found = read_plan(file, parts, descriptions)
    policy = replace(found.policy, stop_time=_STEPS * found.policy.step)
    placed = tuple(replace(part, source=sources[part.name]) for part in found.components)
    return replace(found, components=placed, policy=policy, inputs=None)


@pytest.fixture(scope="module")
def parts(plan: Plan) -> dict[str, Part]:
    return {p.name: Part(path, read_description(path)) for p in plan.components if (path := p.source.path)}


@pytest.fixture(scope="module")
def signals(plan: Plan, parts: dict[str, Part]) -> list[str]:
    """Outputs that others follow and that follow no input at once, so that they are read alike everywhere."""
    found = []
    for source in dict.fromkeys(connection.source for connection in plan.connections):
        part, _, name = source.partition(".")
        if parts[part].description.variables[name].depends_on == frozenset():
            found.append(source)
    assert len(found) > 2
    return found


@pytest.fixture(scope="module")
def ssp(plan: Plan, parts: dict[str, Part], tmp_path_factory: pytest.TempPathFactory) -> Path:
    files = {name: (part.path, part.description) for name, part in parts.items()}
    return write_ssp(plan, files, tmp_path_factory.mktemp("ssp") / "machine.ssp")


@pytest.fixture(scope="module")
def read_once(plan: Plan, signals: list[str]) -> np.ndarray:
    """Curves of a machine that reads each output once at a communication point, shape (steps, signals)."""
    return run(plan, signals, ReadOnce)[signals].to_numpy()[1:]


def same(found: np.ndarray, expected: np.ndarray) -> bool:
    assert np.all(np.ptp(expected, axis=0) > 1e-3)
    return bool(np.all(np.abs(found - expected).max(axis=0) < _TOLERANCE * np.abs(expected).max(axis=0)))


def test_in_libcosim(ssp: Path, plan: Plan, signals: list[str], read_once: np.ndarray) -> None:
    assert same(in_libcosim(ssp, plan, _STEPS, signals), read_once)


def test_in_fmpy(ssp: Path, plan: Plan, signals: list[str], read_once: np.ndarray) -> None:
    found = in_fmpy().simulate(ssp, plan.policy.stop_time, plan.policy.step)
    assert same(np.column_stack([found[name] for name in signals])[:_STEPS], read_once)


def test_as_one_fmu(plan: Plan, parts: dict[str, Part], signals: list[str], tmp_path: Path) -> None:
    path = write_container(plan, parts, tmp_path / "Machine.fmu")
    with open_fmu(path) as fmu, fmu.instantiate("machine") as machine:
        recorder = Recorder([fmu.description.variables[name] for name in signals])
        grid = TimeGrid.of(plan.policy.stop_time, plan.policy.step)
        assert run_fixed_step(machine, grid, {}, [recorder]).ending is Ending.COMPLETED
    assert same(recorder.table()[signals].to_numpy()[1:], run(plan, signals)[signals].to_numpy()[1:])
