"""The survey of designs at the limits of their parameters: what it counts, and that its designs are ones that run."""

import math

import pytest

import models
from benchmarks import limits


def test_designs_are_the_same_each_time_and_within_limits() -> None:
    model = models.load("gear_train").MODEL
    found = list(limits.designs(model, 20))
    assert found == list(limits.designs(model, 20))
    assert len(found) == 20
    for design in found:
        model.checked({p.name: p.start for p in model.parameters} | design)
        assert 1 <= len(design) <= 4


@pytest.mark.parametrize(
    ("model", "design", "is_stiff"),
    [("gear_train", {"pinion_damping": 1e6}, True), ("gear_train", {"drive_damping": 0.1}, False)],
)
def test_what_is_only_stiff_is_fast(model: str, design: dict[str, float], is_stiff: bool) -> None:
    run = limits.run_of(model, design)
    assert run is not None
    assert run.ending == "ran"
    assert (run.implicit > 0) is is_stiff
    assert run.steps < 500
    assert math.isnan(run.reasons)


def test_what_is_slow_has_turns_that_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "ALLOWED", 0.0)
    run = limits.run_of("gear_train", {"pinion_speed_start": 1000.0})
    assert run is not None
    turns = 1000.0 * limits.MOTION / (2 * math.pi)
    assert turns * 0.5 < run.reasons < turns * 1.5 + 2


def test_a_start_that_is_refused_is_no_design() -> None:
    assert limits.run_of("four_bar", {"crank_length": 1e6}) is None
