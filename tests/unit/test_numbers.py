"""The page of numbers, and the file of their history."""

from pathlib import Path

import pytest

from benchmarks.numbers import HISTORY, PAGE, Entry, Number, add_to_history, kind_of, page_of, read_history


def entry(date: str, value: float, machine: str = "here", name: str = "ratchet") -> Entry:
    return Entry(date, "abc", machine, Number("size", name, "kB", value))


def test_history_is_added_to_and_read_back(tmp_path: Path) -> None:
    path = tmp_path / "numbers.csv"
    assert read_history(path) == []
    first, second = entry("2026-11-27", 795.25, name="a, b"), entry("2026-11-28", 12.0)
    add_to_history(path, [first])
    add_to_history(path, [second])
    assert read_history(path) == [first, second]


def test_the_page_has_the_last_run_and_the_one_before_on_the_same_machine() -> None:
    runs = [entry("2026-11-25", 1.5), entry("2026-11-26", 2.5, "elsewhere"), entry("2026-11-27", 3.0)]
    assert "| ratchet | kB | 3 | 1.5 |" in page_of(runs)
    assert "| ratchet | kB | 2.5 |\n" in page_of(runs[:2])


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
