"""Optima refined along gradients: known ones, in fewer designs than by comparing, and where there are no gradients."""

import json
import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from cheap_designs import Place, axis
from scipy.optimize import brentq
from typer.testing import CliRunner

import models
from harness.app.cli import main
from harness.designs.optimum_file import CONTINUOUS, MIXED, Constraint, Goal, Optimum
from harness.designs.search import Best, History, InterruptedSearchError, search
from harness.designs.store import Store, identity
from harness.designs.task import Design, Quantity, Result, Task, When
from harness.designs.workers import Backend, Work, here
from harness.run.master import TimeGrid, never
from models.ratchet.start import tooth

FAR, SUM = Quantity(When.END, "far", "Real", "m2"), Quantity(When.END, "sum", "Real", "")
COUNT = Quantity(When.END, "count", "Integer", "")
TASK = Task(TimeGrid.of(1.0, 0.1), {}, None, (FAR, SUM, COUNT))
X, Y, N = axis(), axis("drive_torque", -1.0, 1.0, "N.m"), axis("tooth_count", 10, 25)
#: From values of a design to those of the three quantities.
Values = Callable[[float, float, int], tuple[float | None, float, int]]


def valley(x: float, y: float, n: int) -> tuple[float, float, int]:
    """A bent one, along y = 4 x^2 - 0.5, with its floor at 0.3, -0.14 and 17: comparing goes round the bend slowly."""
    return (x - 0.3) ** 2 + 100.0 * (y - 4.0 * x * x + 0.5) ** 2 + 0.01 * (n - 17) ** 2, x + y, 1


def optimum_of(*limits: Constraint, count: int = 120, gradient: bool = True, whole: bool = False) -> Optimum:
    axes = (X, Y, N) if whole else (X, Y)
    goal = Goal(FAR, False, limits)
    return Optimum("Valley", TASK, axes, goal, MIXED if whole else CONTINUOUS, count, 1, gradient, (COUNT,), None)


def way_of(values: Values) -> Backend:
    def run(place: Place, task: Task, designs: list[Design]) -> list[Result]:
        return [
            Result(
                design.number,
                "cheap",
                values(
                    float(design.values["restitution"]),
                    float(design.values["drive_torque"]),
                    int(design.values.get("tooth_count", 17)),
                ),
            )
            for design in designs
        ]

    return Backend("cheap", run)  # type: ignore[arg-type]


def store_of(optimum: Optimum, folder: Path) -> Store:
    known = identity({"model": "Fake"}, optimum.task, optimum.axes, optimum.how)
    return Store(folder, known, optimum.axes, optimum.task.quantities)


def history_of(
    optimum: Optimum, folder: Path, values: Values = valley, stop_requested: Callable[[], bool] = never
) -> History:
    executor = partial(here, Work(Place(folder), optimum.task, way_of(values)))  # type: ignore[arg-type]
    return History(store_of(optimum, folder), executor, optimum.count, stop_requested, lambda history: None)


def found(optimum: Optimum, folder: Path, values: Values = valley) -> tuple[Best, int]:
    """The best design, and how many were run."""
    history = history_of(optimum, folder, values)
    best = search(optimum, history)
    return best, len(history.designs)


def misses(best: Best) -> float:
    """How far it is from the floor of the valley."""
    return math.hypot(best.design.values["restitution"] - 0.3, best.design.values["drive_torque"] + 0.14)


def bowl(x: float, y: float, n: int) -> tuple[float, float, int]:
    """Its floor is at 0.3 and -0.2."""
    return (x - 0.3) ** 2 + 4.0 * (y + 0.2) ** 2, x + y, 1


def test_the_floor_of_a_bent_valley_in_fewer_designs(tmp_path: Path) -> None:
    steep, run = found(optimum_of(count=400), tmp_path / "gradient")
    compared, more = found(optimum_of(count=400, gradient=False), tmp_path / "compared")
    assert misses(steep) < misses(compared) < 1e-6
    assert run < 0.85 * more


def test_the_floor_of_a_bowl_with_better_digits_in_as_many_designs(tmp_path: Path) -> None:
    steep, run = found(optimum_of(count=60), tmp_path / "gradient", bowl)
    compared, _ = found(optimum_of(count=60, gradient=False), tmp_path / "compared", bowl)
    assert run <= 60
    assert steep.result.values[0] < 1e-3 * compared.result.values[0]


@pytest.mark.parametrize("least", [0.6, 1.0])
def test_the_lowest_place_on_a_fence(least: float, tmp_path: Path) -> None:
    """x + y >= s: by Lagrange, x - 0.3 = 4 (y + 0.2) = 0.8 (s - 0.1) up to x = 1."""
    x = min(0.3 + 0.8 * (least - 0.1), 1.0)
    best, run = found(optimum_of(Constraint(SUM, least, None)), tmp_path, bowl)
    assert best.feasible
    assert best.design.values == pytest.approx({"restitution": x, "drive_torque": least - x}, abs=1e-4)
    assert best.result.values[0] == pytest.approx(bowl(x, least - x, 0)[0], rel=1e-7)
    assert run < 120


def test_the_most_within_limits(tmp_path: Path) -> None:
    """Of x + y within (x - 0.3)^2 + 4 (y + 0.2)^2 <= 0.05: 0.1 + sqrt(0.05 * 5 / 4), unless at most 0.2 is allowed."""
    limits = Constraint(FAR, None, 0.05)
    optimum = replace(optimum_of(limits, count=240), goal=Goal(SUM, True, (limits,)))
    best, _ = found(optimum, tmp_path / "circle", bowl)
    assert best.feasible
    assert best.result.values[1] == pytest.approx(0.1 + math.sqrt(0.05 * 1.25), rel=1e-7)
    fenced = replace(optimum, goal=Goal(SUM, True, (limits, Constraint(SUM, 0.0, 0.2))))
    best, _ = found(fenced, tmp_path / "fenced", bowl)
    assert best.feasible
    assert best.result.values[1] == pytest.approx(0.2, rel=1e-7)


def test_whole_numbers_stay_as_they_were_found(tmp_path: Path) -> None:
    best, _ = found(optimum_of(count=400, whole=True), tmp_path)
    number = best.design.values["tooth_count"]
    assert isinstance(number, int)
    assert abs(number - 17) <= 2
    assert best.result.values[0] == pytest.approx(0.01 * (number - 17) ** 2, abs=1e-6)


def test_where_events_change_at_every_step_merits_are_compared(tmp_path: Path) -> None:
    """No two designs have the same: nothing is asked along gradients but the first row of differences."""
    counts: dict[tuple[float, float], int] = {}

    def changing(x: float, y: float, n: int) -> tuple[float, float, int]:
        return *bowl(x, y, n)[:2], counts.setdefault((x, y), len(counts))

    best, _ = found(optimum_of(count=400), tmp_path, changing)
    assert best.design.values == pytest.approx({"restitution": 0.3, "drive_torque": -0.2}, abs=1e-5)


def test_where_half_of_the_plane_has_other_events_the_optimum_is_found_all_the_same(tmp_path: Path) -> None:
    """The floor lies just on the border, with a jump of the objective by 1 and a count by 1 beyond it."""

    def broken(x: float, y: float, n: int) -> tuple[float, float, int]:
        beyond = int(x > 0.3)
        return bowl(x, y, n)[0] + beyond, x + y, beyond

    best, _ = found(optimum_of(count=400), tmp_path, broken)
    assert best.design.values == pytest.approx({"restitution": 0.3, "drive_torque": -0.2}, abs=1e-3)
    assert best.result.values[2] == 0


def test_a_count_that_is_asked_for_is_kept(tmp_path: Path) -> None:
    """As of clicks: it is 4 from 0.4 on only, and the bowl's floor is at 0.3."""

    def counted(x: float, y: float, n: int) -> tuple[float, float, int]:
        return *bowl(x, y, n)[:2], int(10.0 * x)

    best, _ = found(optimum_of(Constraint(COUNT, 4, None), count=400), tmp_path, counted)
    assert best.feasible
    assert best.result.values[2] == 4
    assert best.design.values == pytest.approx({"restitution": 0.4, "drive_torque": -0.2}, abs=1e-3)


@pytest.mark.parametrize("nothing", [None, math.nan], ids=["none", "not a number"])
@pytest.mark.parametrize("share", [1.0, 0.3], ids=["nowhere", "in part"])
def test_designs_without_an_objective(nothing: float | None, share: float, tmp_path: Path) -> None:
    """As where there is no impact: in the whole plane, or beside the floor."""

    def struck(x: float, y: float, n: int) -> tuple[float | None, float, int]:
        return nothing if x < share else bowl(x, y, n)[0], x + y, 1

    best, run = found(optimum_of(count=200), tmp_path, struck)
    assert run <= 200
    if share < 1.0:
        assert best.design.values == pytest.approx({"restitution": 0.3, "drive_torque": -0.2}, abs=1e-3)


def test_a_search_that_was_interrupted_finds_what_an_undisturbed_one_finds(tmp_path: Path) -> None:
    optimum = optimum_of(Constraint(SUM, None, 0.05))
    for patience in (1, 9, 16, 20, 24):
        asked = iter([False] * patience + [True] * 1000)
        with pytest.raises(InterruptedSearchError):
            search(optimum, history_of(optimum, tmp_path / "interrupted", bowl, lambda asked=asked: next(asked)))
    for name in ("interrupted", "undisturbed"):
        found(optimum, tmp_path / name, bowl)
        store_of(optimum, tmp_path / name).finish()
    results = [tmp_path / name / "results.parquet" for name in ("interrupted", "undisturbed")]
    assert results[0].read_bytes() == results[1].read_bytes()
    again = history_of(optimum, tmp_path / "undisturbed", bowl, lambda: True)
    search(optimum, again)
    assert len(again.designs) == again.earlier


TOOTH = """\
[fmu]
model = "ratchet"

[run]
stop_time = "1.2 s"
step = "0.1 s"

[set]
tooth_count = 22

[optimise]
minimise = "first_impact.stress_max"
count = {count}
seed = 1
gradient = {gradient}

[vary.tooth_slope_angle]
from = 85
to = 105
unit = "deg"

[constraint."parameter.tooth_length"]
at_least = 8
unit = "mm"
"""


def angle_of_8_mm() -> float:
    """The slope angle [rad] with which a tooth of 22 is 8 mm long: the longer, the more stress."""
    ratchet = models.load("ratchet").MODEL

    def too_long(angle: float) -> float:
        return float(tooth(ratchet.values(tooth_count=22, tooth_slope_angle=angle)).beam_length) - 8e-3

    return float(brentq(too_long, math.radians(85), math.radians(105), xtol=1e-14))


def optimised(folder: Path, gradient: bool, count: int) -> tuple[dict[str, Any], str]:
    """optimum.json, and what is said."""
    folder.mkdir(exist_ok=True)
    path = folder / "tooth.toml"
    path.write_text(TOOTH.format(gradient=str(gradient).lower(), count=count), encoding="utf-8")
    done = CliRunner().invoke(main, ["optimise", str(path), "-o", str(folder / "out"), "--fast"])
    assert done.exit_code == 0, done.output
    return json.loads((folder / "out" / "optimum.json").read_text(encoding="utf-8")), done.output


def test_the_best_tooth_is_found_in_20_designs(tmp_path: Path) -> None:
    """To 1e-8; comparing misses it by 2e-4 in as many, and by 1e-7 in 100."""
    angle = angle_of_8_mm()
    assert math.degrees(angle) == pytest.approx(95.7685, abs=1e-4)
    best, said = optimised(tmp_path / "gradient", True, 20)
    assert "20 designs, 0 of them there before." in said
    assert best["values"]["tooth_slope_angle"] == pytest.approx(angle, rel=1e-8)
    assert best["keeps_constraints"]
    compared, _ = optimised(tmp_path / "compared", False, 20)
    assert abs(compared["values"]["tooth_slope_angle"] - angle) > 1e-4
    again, said = optimised(tmp_path / "gradient", True, 20)
    assert "20 designs, 20 of them there before." in said
    assert again == best
