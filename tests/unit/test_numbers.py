"""The numbers: what is found of results, what is left out, their history, and the page. Nothing is timed."""

import math
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest
from typer.testing import CliRunner

from benchmarks.endurance import Endured
from benchmarks.limits import Run
from benchmarks.model_exchange import BothWays
from benchmarks.numbers import __main__ as command, longer, number
from benchmarks.numbers.history import HISTORY, Entry, add_to_history, read_history
from benchmarks.numbers.number import Number, Part, find
from benchmarks.numbers.page import PAGE, page_of
from benchmarks.numbers.quick import kind_of, limits_of
from benchmarks.peers.case import OURS, Point
from benchmarks.peers.cases import CASES
from benchmarks.peers.result import Result
from benchmarks.timing import Comparison


def entry(date: str, value: float, machine: str = "here", name: str = "ratchet", group: str = "size") -> Entry:
    return Entry(date, "abc", machine, Number(group, name, "kB", value))


def by_name(found: Iterator[Number]) -> dict[str, float]:
    return {one.name: one.value for one in found}


def test_history_is_added_to_and_read_back(tmp_path: Path) -> None:
    path = tmp_path / "numbers.csv"
    assert read_history(path) == []
    first, second = entry("2026-11-27", 795.25, name="a, b"), entry("2026-11-28", 12.0)
    add_to_history(path, [first])
    add_to_history(path, [second])
    assert read_history(path) == [first, second]


def test_the_page_has_the_last_run_and_the_one_before_on_the_same_machine() -> None:
    runs = [entry("2026-11-25", 1.5), entry("2026-11-26", 2.5, "elsewhere"), entry("2026-11-27", 3.0)]
    assert "| | unit | 2026-11-27, abc | 2026-11-25, abc |\n" in page_of(runs)
    assert "| ratchet | kB | 3 | 1.5 |\n" in page_of(runs)
    assert "| ratchet | kB | 2.5 |\n" in page_of(runs[:2])


def test_a_number_that_the_last_run_did_not_look_for_stays_with_its_date() -> None:
    page = page_of(
        [
            entry("2026-11-25", 9.0, name="slow", group="speed"),
            entry("2026-11-26", 1.0, name="quick", group="speed"),
            entry("2026-11-26", 8.0, name="slow", group="speed"),
            entry("2026-11-26", 4.0, name="instances", group="endurance"),
            entry("2026-11-27", 2.0, name="quick", group="speed"),
        ]
    )
    assert "Last run: 2026-11-27, abc. " in page
    assert "| | unit | 2026-11-27, abc | before | if older |\n| --- | --- | --- | --- | --- |\n" in page
    assert "| quick | kB | 2 | 1 | |\n| slow | kB | 8 | 9 | 2026-11-26, abc |\n" in page
    assert page.endswith("## Endurance\n\n| | unit | 2026-11-26, abc |\n| --- | --- | --- |\n| instances | kB | 4 |\n")


def test_of_what_each_run_finds_as_a_whole_nothing_older_stays() -> None:
    runs = [entry("2026-11-26", 1.0, name=name, group="tests") for name in ("unit", "gone")]
    page = page_of([*runs, entry("2026-11-27", 2.0, name="unit", group="tests")])
    assert "| unit | kB | 2 | 1 |" in page
    assert "gone" not in page
    assert "gone" in page_of([*runs, entry("2026-11-27", 2.0)])  # the last run did not count tests


@pytest.mark.parametrize(
    ("file", "kind"),
    [
        ("tests/unit/engine/test_a.py", "unit/engine"),
        ("tests/unit/test_a.py", "unit"),
        ("tests/fmu/native/test_a.py", "fmu"),
        ("tests/test_house.py", "house"),
    ],
)
def test_kinds_of_tests_are_their_folders(file: str, kind: str) -> None:
    assert kind_of(file) == kind


def test_the_page_that_is_there_is_made_of_the_history_that_is_there() -> None:
    assert PAGE.read_text(encoding="utf-8") == page_of(read_history(HISTORY))


FOUND = Number("speed", "a", "s", 1.0)


def ends(error: Exception) -> Part:
    def measure(_: Path) -> Iterator[Number]:
        yield FOUND
        raise error

    return Part(f"ends with {error}", measure, lacks=(LookupError,))


def parts() -> list[Part]:
    return [
        Part("runs", lambda _: [FOUND]),
        Part("needs", lambda _: [FOUND], needs=("mujoco", "numba")),
        ends(LookupError("no compiler")),
        ends(ModuleNotFoundError("no scipy")),
        ends(RuntimeError("a leak")),
    ]


def test_a_part_that_misses_something_is_left_out_and_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(number, "is_here", lambda package: package == "numba")
    said: list[str] = []
    found = find(parts(), tmp_path, said.append)
    assert said == [part.name for part in parts()]
    assert found.numbers == [FOUND]
    assert found.left_out == {
        "needs": "mujoco is not installed: python -m pip install -e '.[bench]'",
        "ends with no compiler": "no compiler",
        "ends with no scipy": "no scipy",
    }
    assert found.failed == {"ends with a leak": "RuntimeError: a leak"}


def test_the_command_keeps_what_it_finds_and_names_the_rest(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(number, "is_here", lambda package: False)
    monkeypatch.setattr(command.quick, "parts", lambda: parts()[:2])
    monkeypatch.setattr(command.longer, "parts", lambda: parts()[2:])
    monkeypatch.setattr(command, "_commit", lambda: "abc")
    monkeypatch.setattr(command, "HISTORY", tmp_path / "numbers.csv")
    monkeypatch.setattr(command, "PAGE", tmp_path / "numbers.md")
    app = command.typer.Typer()
    app.command()(command.run)

    done = CliRunner().invoke(app, [])
    assert done.exit_code == 0
    assert "Left out: needs: mujoco is not installed" in done.output
    assert "a leak" not in done.output
    assert "| a | s | 1 |" in (tmp_path / "numbers.md").read_text()

    done = CliRunner().invoke(app, ["--all", "--no-pages"])
    assert done.exit_code == 1
    assert "Failed: ends with a leak: RuntimeError: a leak" in done.output
    assert len(read_history(tmp_path / "numbers.csv")) == 1
    assert CliRunner().invoke(app, ["--part", "no such"]).exit_code == 2


def test_each_part_has_its_own_name_and_needs_what_comes_with_an_extra() -> None:
    every = command.quick.parts() + longer.parts()
    assert len({part.name for part in every}) == len(every)
    assert {package for part in every for package in part.needs} <= set(number._EXTRAS)


def test_a_comparison_is_what_its_requirement_is_about() -> None:
    slow, fast = (6.0, 5.0, 90.0), (2.0, 1.0, 2.0)
    (ratio,) = longer.judged([Comparison("one step", "calm", slow, fast, least_ratio=2.0)])
    assert ratio == Number("speed", "one step: calm, times as fast", "1", 3.0)
    (time,) = longer.judged([Comparison("one step", "calm", slow, (2.5e-3,), longest=0.02)])
    assert time == Number("speed", "one step: calm", "ms", 2.5)
    (time,) = longer.judged([Comparison("one step", "calm", slow, fast, longest=10.0)])
    assert time == Number("speed", "one step: calm", "s", 2.0)


def test_designs_at_the_limits_are_counted() -> None:
    runs = [
        Run("a", {}, 0.001, 50, 3, math.nan, "ran"),
        Run("a", {}, 0.2, 900, 0, 30.0, "ran"),
        Run("a", {}, 0.3, 900, 5, 3.0, "ran"),
        Run("a", {}, 0.4, 46, 0, 0.0, "no end"),
    ]
    assert [one.value for one in limits_of(runs, 10)] == [4, 3, 2, 1, 250.0]
    assert by_name(limits_of(runs, 10))["10 a model: designs tried"] == 4


def test_memory_is_that_of_each_where_the_system_tells() -> None:
    found = by_name(
        longer.endured(
            [
                Endured("", "step", 1000, 10_000, 14_000, 0.5, None),
                Endured("", "impact", 100, 0, 0, 0.5, 1e-6),
            ]
        )
    )
    assert found == {
        "memory grown by each step of 1,000": 4.0,
        "time of each step of 1,000": 500.0,
        "time of each impact of 100": 5000.0,
        "drift of the energy in 100 impacts, relative": 1e-6,
    }


def test_designs_of_both_ways_are_added_up() -> None:
    one = BothWays("ratchet", 5, 2, (1e-9, 3e-9), (4, 7), 2, 12.0, Counter())
    none = BothWays("geneva", 5, 5, (), (), 0, math.nan, Counter())
    assert list(by_name(longer.exchanged([one, none])).values()) == [10, 3, 2, 3e-9, 7, 2, 12.0]
    assert list(by_name(longer.exchanged([none])).values()) == [5, 0, 0]


def test_of_a_peer_its_time_over_ours_is_kept() -> None:
    case = CASES["ratchet"]
    points = (Point(OURS, "its own", "", 0.5, 1e-9), Point("pymunk", "pivots", "", 2.0, 1e-6))
    assert by_name(longer.verdicts([Result(case, points)])) == {f"{case.title}: pymunk, pivots, time over ours": 4.0}
