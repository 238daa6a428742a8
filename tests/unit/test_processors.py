"""How many processors a process uses: those it may use, and no more than its container gets."""

import os
from pathlib import Path

import pytest

from mechanism_fmu import processors as module
from mechanism_fmu.processors import processors


@pytest.mark.parametrize(
    ("quota", "expected"),
    [
        ("max 100000", 8),
        ("200000 100000", 2),
        ("150000 100000", 2),
        ("10000 100000", 1),
        ("1600000 100000", 8),
        ("nonsense", 8),
        ("5 0", 8),
    ],
)
def test_a_container_gets_no_more_than_its_quota(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, quota: str, expected: int
) -> None:
    monkeypatch.setattr(os, "sched_getaffinity", lambda _process: set(range(8)), raising=False)
    file = tmp_path / "cpu.max"
    file.write_text(quota, encoding="ascii")
    assert module.processors(file) == expected


def test_without_a_quota_it_is_all_it_may_use(tmp_path: Path) -> None:
    assert processors(tmp_path / "none") >= 1
