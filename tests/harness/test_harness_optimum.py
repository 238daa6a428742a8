"""Optima of problems whose answer is known, found the same way each time, also after an interruption."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from cheap_designs import VALLEY, Place, axis
from fake_slave import FakeFmu, FakeSlave

from harness.designs.optimum_file import CONTINUOUS, MIXED, Around, Constraint, Goal, Optimum
from harness.designs.search import Best, History, InterruptedSearchError, search
from harness.designs.sensitivity import NoIndicesError, sensitivity
from harness.designs.store import Store, identity
from harness.designs.task import Design, Quantity, Result, Task, When
from harness.designs.variation import Axis
from harness.designs.workers import Backend, Work, here
from harness.errors import UsageError
from harness.report.optimum_report import Found, optimum_report
from harness.run.master import TimeGrid, never

FAR, SUM = Quantity(When.END, "far", "Real", "m2"), Quantity(When.END, "sum", "Real", "")
TASK = Task(TimeGrid.of(1.0, 0.1), {}, None, (FAR, SUM))
X, Y, N = axis(), axis("drive_torque", -1.0, 1.0, "N.m"), axis("tooth_count", 10, 25)


def optimum_of(
    *axes: Axis, count: int = 400, largest: bool = False, sums: tuple[float | None, float | None] = (None, None)
) -> Optimum:
    constraints = () if sums == (None, None) else (Constraint(SUM, *sums),)
    method = MIXED if N in axes else CONTINUOUS
    return Optimum("Valley", TASK, axes, Goal(FAR, largest, constraints), method, count, 1, False, (), None)


def store_of(optimum: Optimum, folder: Path) -> Store:
    known = identity({"model": "Fake"}, optimum.task, optimum.axes, optimum.how)
    return Store(folder, known, optimum.axes, optimum.task.quantities)


def history_of(
    optimum: Optimum, folder: Path, stop_requested: Callable[[], bool] = never, way: Backend = VALLEY
) -> History:
    executor = partial(here, Work(Place(folder), optimum.task, way))  # type: ignore[arg-type]
    return History(store_of(optimum, folder), executor, optimum.count, stop_requested, lambda history: None)


def found(optimum: Optimum, folder: Path) -> Best:
    return search(optimum, history_of(optimum, folder))


@pytest.mark.parametrize("values", [(math.nan, 0.5), (0.5, math.nan), (None, 0.5)])
def test_what_is_no_number_is_worse_than_any_design(values: tuple[float | None, float]) -> None:
    goal = Goal(FAR, False, (Constraint(SUM, None, 1.0),))
    for other in ((1e20, 0.5), (1.0, 1e20)):
        assert goal.merit(Result(1, "cheap", values), TASK) > goal.merit(Result(2, "cheap", other), TASK)


@pytest.mark.parametrize("largest", [False, True])
def test_however_large_values_are_the_better_one_wins(largest: bool) -> None:
    """A number of runs to failure is 1e44 to 1e73 on the paper's wheel, and a safety factor may be infinite."""
    goal = Goal(FAR, largest, (Constraint(SUM, None, 1.0),))
    values = [-math.inf, -1e300, -1e73, -1e60, -2.0, 0.0, 1e-12, 2.0, 1e59, 1e60, 1.0001e60, 1e308, math.inf]
    merits = [goal.merit(Result(1, "cheap", (value, 0.5)), TASK) for value in values]
    assert merits == sorted(set(merits), reverse=largest)
    missed = [goal.merit(Result(1, "cheap", (0.0, limited)), TASK) for limited in (1.001, 2.0, 1e60, math.inf)]
    failed = goal.merit(Result.failed(Design(1, {}), "cheap", TASK, "no"), TASK)
    assert [*sorted(merits), *missed, failed] == sorted([*merits, *missed, failed])
    assert not any(map(math.isnan, missed))


def test_a_space_that_is_known_whole_still_has_a_sensitivity(tmp_path: Path) -> None:
    optimum = replace(optimum_of(axis("tooth_count", 15, 19), axis("gear", 1, 2), count=300), around=Around(4, 0.1))
    history = history_of(optimum, tmp_path)
    best = search(optimum, history)
    assert len(history.designs) == 10
    assert sensitivity(optimum, best, history) is not None
    assert best.design.values["tooth_count"] == 17


def test_the_bottom_of_a_valley(tmp_path: Path) -> None:
    best = found(optimum_of(X, Y), tmp_path)
    assert best.feasible
    assert best.design.values == pytest.approx({"restitution": 0.3, "drive_torque": -0.2}, abs=1e-5)


def test_the_lowest_place_on_a_fence(tmp_path: Path) -> None:
    """x + y >= 1: by Lagrange, x - 0.3 = 4 (y + 0.2) = 0.72."""
    best = found(optimum_of(X, Y, sums=(1.0, None)), tmp_path)
    assert best.feasible
    assert best.result.values[1] >= 1.0
    assert best.result.values[0] == pytest.approx(0.648, rel=1e-2)


def test_the_highest_corner(tmp_path: Path) -> None:
    best = found(optimum_of(X, Y, largest=True), tmp_path)
    assert best.design.values == pytest.approx({"restitution": 1.0, "drive_torque": 1.0}, abs=1e-5)


def test_whole_numbers_and_a_list(tmp_path: Path) -> None:
    listed = replace(X, values=(0.0, 0.25, 0.75))
    best = found(optimum_of(N, Y, listed, count=300), tmp_path)
    assert best.design.values["tooth_count"] == 17
    assert best.design.values["restitution"] == 0.25
    assert best.design.values["drive_torque"] == pytest.approx(-0.2, abs=1e-4)


def test_a_goal_that_cannot_be_reached_gives_the_nearest(tmp_path: Path) -> None:
    best = found(optimum_of(X, Y, sums=(3.0, None)), tmp_path)
    assert not best.feasible
    assert best.result.values[1] == pytest.approx(2.0, abs=1e-4)


@pytest.mark.parametrize("axes", [(X, Y), (X, N)], ids=["continuous", "mixed"])
def test_a_search_that_was_interrupted_finds_what_an_undisturbed_one_finds(
    axes: tuple[Axis, ...], tmp_path: Path
) -> None:
    optimum = optimum_of(*axes, count=90, sums=(None, 1.2))
    for patience in (1, 17, 40):
        asked = iter([False] * patience + [True] * 1000)
        with pytest.raises(InterruptedSearchError):
            search(optimum, history_of(optimum, tmp_path / "interrupted", lambda asked=asked: next(asked)))
    for name in ("interrupted", "undisturbed"):
        found(optimum, tmp_path / name)
        store_of(optimum, tmp_path / name).finish()
    results = [tmp_path / name / "results.parquet" for name in ("interrupted", "undisturbed")]
    assert results[0].read_bytes() == results[1].read_bytes()
    assert len(pd.read_parquet(results[0])) <= 90


def test_a_history_of_another_search_is_refused(tmp_path: Path) -> None:
    optimum = optimum_of(X, Y, count=20)
    store_of(optimum, tmp_path).append(
        [(Design(1, {"restitution": 0.1, "drive_torque": 0.1}), Result(1, "cheap", (1.0, 0.2)))]
    )
    with pytest.raises(UsageError, match="other versions of scipy or optuna"):
        found(optimum, tmp_path)


def test_designs_that_fail_come_last() -> None:
    goal = Goal(FAR, False, (Constraint(SUM, None, 1.0),))
    good, far, missed, missed_by_more = (
        Result(1, "cheap", v) for v in ((1.0, 1.0), (9e9, 1.0), (0.0, 1.1), (0.0, 1e9))
    )
    failed = Result.failed(Design(1, {}), "cheap", TASK, "why")
    merits = [goal.merit(result, TASK) for result in (good, far, missed, missed_by_more, failed)]
    assert merits == sorted(merits)
    assert len(set(merits)) == 5


def test_sobol_indices_of_a_sum_of_squares(tmp_path: Path) -> None:
    """Uniform near the floor: the variance of k u^2 with |u| <= a is k^2 a^4 4/45, of each variable by itself."""
    optimum = replace(optimum_of(X, Y, count=200), around=Around(128, 0.1))
    history = history_of(optimum, tmp_path)
    history._executor = partial(here, Work(Place(tmp_path), optimum.task, replace(VALLEY, run=_smooth)))  # type: ignore[arg-type]
    best = search(optimum, history)
    found = sensitivity(optimum, best, history)
    assert found is not None
    variances = np.array([1.0 * 0.05**4, 16.0 * 0.1**4]) * 4.0 / 45.0
    np.testing.assert_allclose(found.first, variances / variances.sum(), atol=0.04)
    np.testing.assert_allclose(found.total, variances / variances.sum(), atol=0.04)
    assert found.spread == pytest.approx(math.sqrt(variances.sum()), rel=0.05)
    assert found.limits[1] == pytest.approx((-0.3, -0.1), abs=1e-4)
    table = store_of(optimum, tmp_path).finish()
    page = optimum_report(optimum, Found(best, found, history, table, None), FakeFmu(FakeSlave()))  # type: ignore[arg-type]
    for heading in ("Search", "Sensitivity", "Constraints", "All designs", "Parameters", "Versions"):
        assert f"<h2>{heading}</h2>" in page


def _smooth(fmu: Place, task: Task, designs: list[Design]) -> list[Result]:
    """The valley without failures."""
    return [
        replace(result, number=design.number)
        for design in designs
        for result in VALLEY.run(fmu, task, [replace(design, number=1)])  # type: ignore[arg-type]
    ]


def test_near_an_optimum_that_fails_there_are_no_indices(tmp_path: Path) -> None:
    optimum = replace(optimum_of(X, Y, count=60), around=Around(64, 0.1))
    history = history_of(optimum, tmp_path)
    best = search(optimum, history)
    with pytest.raises(NoIndicesError, match=r"near the optimum, \d+ of 256 designs give no number"):
        sensitivity(optimum, best, history)


def test_an_objective_that_never_changes_has_no_indices_and_this_is_said(tmp_path: Path) -> None:
    constant = Backend("cheap", lambda fmu, task, designs: [Result(d.number, "cheap", (7.0, 1.0)) for d in designs])
    optimum = replace(optimum_of(X, Y, count=20), around=Around(4, 0.1))
    history = history_of(optimum, tmp_path, way=constant)
    best = search(optimum, history)
    with pytest.raises(NoIndicesError, match="the objective is 7 m2 everywhere: no variable matters there"):
        sensitivity(optimum, best, history)


def test_nothing_is_asked_for_twice_and_a_small_space_is_soon_exhausted(tmp_path: Path) -> None:
    optimum = optimum_of(N, count=100)
    assert found(optimum, tmp_path).design.values == {"tooth_count": 17}
    table = store_of(optimum, tmp_path).results()
    assert len(set(table["tooth_count"].to_pylist())) == len(table) <= 16


def _with_gaps(fmu: Place, task: Task, designs: Sequence[Design]) -> list[Result]:
    """The valley, but every third design has no objective, and every third no constraint: nobody knows them."""
    results = []
    for design, (far, total) in zip(designs, (result.values for result in _smooth(fmu, task, designs)), strict=True):
        gap = design.number % 3
        results.append(Result(design.number, "cheap", (None if gap == 1 else far, math.nan if gap == 2 else total)))
    return results


@pytest.mark.parametrize("largest", [False, True])
def test_whole_numbers_with_designs_of_which_something_is_not_known(tmp_path: Path, largest: bool) -> None:
    """They are asked for, fail, and the search goes on."""
    optimum = optimum_of(N, X, count=90, largest=largest, sums=(None, 0.8))
    history = history_of(optimum, tmp_path, way=replace(VALLEY, run=_with_gaps))  # type: ignore[arg-type]
    best = search(optimum, history)
    unknown = [result for result in history.results if None in result.values or math.isnan(result.values[1])]
    assert len(unknown) == pytest.approx(60, abs=2)
    assert best.feasible
    assert best.design.number % 3 == 0
    assert optimum.goal.violation(best.result, optimum.task) == 0.0
    known = [result for result in history.results if result not in unknown and result.values[1] <= 0.8]
    best_known = (max if largest else min)(result.values[0] for result in known)
    assert best.result.values[0] == best_known
