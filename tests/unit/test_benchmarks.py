import io
import json
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

import models
from benchmarks import acceleration, bending, cams, elastodynamics, fmu_step, fmus, reference, step
from benchmarks.c_limit import compare as c_limit
from benchmarks.c_limit.library import Limit, NoCompilerError, build, export
from benchmarks.native_surface import compare as native_surface
from benchmarks.table import as_json, table, this_machine
from benchmarks.timing import Comparison, DisagreementError, in_turns, require_agreement
from mechanism_fmu import codes
from mechanism_fmu.model import MechanismError
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.tables.layout import field_of, pack


@pytest.mark.parametrize(
    ("least_ratio", "longest", "met"),
    [(None, None, None), (3.0, None, True), (3.1, None, False), (None, 2.1, True), (None, 2.0, False)],
)
def test_the_ratio_of_the_medians_is_what_is_judged(
    least_ratio: float | None, longest: float | None, met: bool | None
) -> None:
    comparison = Comparison("a", "b", (6.0, 5.0, 90.0), (2.0, 1.0, 2.0), least_ratio, longest)
    assert comparison.ratio == 3.0
    assert comparison.met is met


def test_rounds_take_turns_and_the_first_does_not_count() -> None:
    counter = iter(range(6))
    assert in_turns(lambda: next(counter), lambda: next(counter), 2) == ((2, 4), (3, 5))


@pytest.mark.parametrize("other", [1.1, np.nan])
def test_what_does_not_agree_is_refused(other: float) -> None:
    require_agreement("x", [1.0, 2.0], [1.05, 2.0], 0.06)
    with pytest.raises(DisagreementError, match="differ by"):
        require_agreement("x", [1.0, 2.0], [other, 2.0], 0.06)


@pytest.mark.slow
def test_the_periodic_motion_of_a_linkage_agrees_with_its_direct_integration() -> None:
    assert [c.case for c in bending.compare(1)] == ["direct integration of 12 turns"]


def test_engine_and_plain_program_agree_and_are_timed() -> None:
    found = acceleration.compare(1) + step.compare(1)
    assert [c.case for c in found] == [
        "before impact",
        "after impact",
        "new input each step, before impact",
        "new input each step, after impact",
        "constant input, before impact",
        "constant input, after impact",
    ]
    assert all(len(times) == 1 and times[0] > 0 for c in found for times in (c.slow, c.fast))


def test_ten_bodies_with_cams_accelerate_as_the_textbook_says() -> None:
    assert [c.case for c in cams.compare(1)] == ["ten bodies, four cams"]


def test_an_elastic_cycle_is_that_of_a_frame_at_each_angle() -> None:
    (found,) = elastodynamics.compare(1)
    assert found.longest == 0.02


@pytest.mark.parametrize("compare", [acceleration.compare, step.compare])
def test_a_wrong_acceleration_is_not_timed(
    compare: Callable[[int], list[Comparison]], monkeypatch: pytest.MonkeyPatch
) -> None:
    right = reference.acceleration
    monkeypatch.setattr(reference, "acceleration", lambda *of: right(*of) + 1e-4)
    with pytest.raises(DisagreementError):
        compare(1)


def test_the_fmus_agree_through_the_impact(ratchet_fmu: Path, tmp_path: Path) -> None:
    found = fmu_step.compare(fmus.build_plain(tmp_path), ratchet_fmu, tmp_path / "unzipped", 1)
    assert [c.case for c in found].count("new input each step, after impact") == 2


needs_compiler = pytest.mark.skipif(shutil.which("cc") is None, reason="There is no C compiler here.")


@pytest.fixture(scope="module")
def engine() -> c_limit.Engine:
    return c_limit.Engine()


@needs_compiler
@pytest.mark.parametrize("drive", c_limit.DRIVES)
def test_the_hand_written_c_takes_the_same_steps(drive: str, engine: c_limit.Engine, tmp_path: Path) -> None:
    start = engine.save()
    limit = Limit(build(tmp_path), engine.block)
    c_limit.require_same_motion(drive, engine, limit)
    assert engine.steps == limit.steps > 300
    assert limit.impact_time == pytest.approx(0.9399, abs=1e-4)
    engine.restore(start)


@needs_compiler
def test_engine_and_hand_written_c_are_timed(tmp_path: Path) -> None:
    found = c_limit.compare(tmp_path, 1)
    assert [c.case for c in found] == ["constant input", "new input each step", "before impact", "after impact"]
    assert all(times > 0 for c in found for times in (*c.slow, *c.fast))


@pytest.mark.slow
@needs_compiler
def test_the_engine_of_fmus_takes_the_same_steps_as_c(tmp_path: Path) -> None:
    library = build(tmp_path)
    try:
        shipped = c_limit.EngineOfFmus(tmp_path, library)
    except (NoCompilerError, MechanismError) as error:
        pytest.skip(str(error))
    limit = Limit(library, shipped.block)
    c_limit.require_same_motion("new input each step", shipped, limit)
    assert shipped.steps == limit.steps > 6000
    again = tmp_path / "again"  # what is loaded must not be written anew
    again.mkdir()
    found = c_limit.compare_with_fmus(again, 1)
    assert [c.case for c in found] == list(c_limit.DRIVES)


@needs_compiler
def test_c_of_another_mechanism_is_not_timed(engine: c_limit.Engine, tmp_path: Path) -> None:
    start, settings = engine.save(), field_of(engine.block, "settings")
    limit = Limit(build(tmp_path), engine.block)
    settings[codes.BAUMGARTE_ALPHA] += 1.0
    with pytest.raises(DisagreementError, match="constant input"):
        c_limit.require_same_motion("constant input", engine, limit)
    settings[codes.BAUMGARTE_ALPHA] -= 1.0
    engine.restore(start)


def surface(folder: Path) -> list[Comparison]:
    try:
        return native_surface.compare(folder, 1)
    except (NoCompilerError, MechanismError) as error:
        pytest.skip(str(error))


@pytest.mark.slow
def test_native_fmu_and_bare_engine_are_timed(tmp_path: Path) -> None:
    assert [c.case for c in surface(tmp_path)] == [
        "1 ms step, constant input",
        "1 ms step, new input each step",
        "what the surface adds to a step",
        "instantiate .. exitInitializationMode",
        "state saved and restored",
    ]


@pytest.mark.slow
def test_two_that_do_not_get_the_same_input_are_not_timed(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    right = native_surface._word
    others = {"drive_torque": "spring_preload", "wheel_speed": "wheel_speed"}
    monkeypatch.setattr(native_surface, "_word", lambda *of: right(*of[:-1], others[of[-1]]))
    with pytest.raises(DisagreementError, match="bare engine"):
        surface(tmp_path)


@pytest.mark.parametrize(
    ("parameters", "what"),
    [({"guided": 0.0}, "free contacts"), ({"friction": 0.1}, "friction"), ({"joint_friction_radius": 0.1}, "friction")],
)
def test_the_c_program_refuses_what_it_does_not_know(parameters: dict[str, float], what: str) -> None:
    model = models.load("ratchet").MODEL
    block = pack(compile_mechanism(model.build(model.values(**parameters))))
    with pytest.raises(ValueError, match=what):
        export(block)


def test_without_a_compiler_there_is_no_c_program(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("CC", "no_such_compiler")
    with pytest.raises(NoCompilerError, match="CC"):
        build(tmp_path)


@needs_compiler
def test_what_the_compiler_says_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("CC", "cc --no-such-option")
    with pytest.raises(RuntimeError, match="no-such-option"):
        build(tmp_path)


def test_the_table_shows_median_range_ratio_and_verdict() -> None:
    found = [
        Comparison("one step", "calm", (2.6e-3, 2e-3, 3e-3), (4e-5, 5e-5, 6e-5), least_ratio=50.0),
        Comparison("start", "cold", (30.0,), (1.6, 1.7), longest=1.5),
        Comparison("limit", "C", (2e-6,), (2.2e-6,), least_ratio=1 / 1.15),
    ]
    text = io.StringIO()
    Console(width=120, file=text).print(table(found))
    lines = [line.split() for line in text.getvalue().splitlines()]
    assert lines[2] == ["calm", "2.6", "ms", "[2-3]", "50", "us", "[40-60]", "52", ">=", "50", "met"]
    assert lines[4] == ["cold", "30", "s", "1.65", "s", "[1.6-1.7]", "18", "<", "1.5", "s", "missed"]
    assert lines[6] == ["C", "2", "us", "2.2", "us", "0.91", ">=", "0.87", "met"]
    assert json.loads(json.dumps(as_json(this_machine(), found)))["comparisons"][0]["slow"] == [2.6e-3, 2e-3, 3e-3]
