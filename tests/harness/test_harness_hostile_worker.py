"""What a process that runs designs writes is data: a forged result fails its design alone, and nothing of it runs."""

import json
import os
import pickle
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from cheap_designs import FORGED, begin_processes_with_what_they_need, cheap_sweep, forging, work_of
from hypothesis import given, strategies as st

from harness.designs.task import Design, Quantity, Task, When
from harness.designs.workers import Processes, read_results
from harness.fmu.processes import BrokenFrameError


@dataclass(frozen=True)
class Command:
    """Runs a command where it is unpickled."""

    text: str

    def __reduce__(self) -> tuple[Any, ...]:
        return os.system, (self.text,)


def frame(data: Any, tail: bytes = b"") -> bytes:
    text = data if isinstance(data, bytes) else json.dumps(data).encode()
    return struct.pack("<II", len(text), len(tail)) + text + tail


@pytest.fixture(scope="module", autouse=True)
def _processes_begin_with_what_they_need() -> None:
    begin_processes_with_what_they_need()


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\x00" * 3,
        struct.pack("<II", 2**32 - 1, 2**32 - 1),
        frame(b"[" * 50_000),
        frame({}),
        frame([]),
        frame([[FORGED + 1, [1.0], None, None, None]]),
        frame([[True, [1.0], None, None, None]]),
        frame([[FORGED, [1.0, 2.0], None, None, None]]),
        frame([[FORGED, ["much"], None, None, None]]),
        frame([[FORGED, [True], None, None, None]]),
        frame([[FORGED, [None], {"a": 1}, None, None]]),
        frame([[FORGED, [None], None, None]]),
        frame([[FORGED, [None], None, None, ["impact", 1]]]),
        "pickle",
    ],
    ids=range(15),
)
def test_a_forged_result_fails_its_design_alone(data: Any, tmp_path: Path) -> None:
    witness = tmp_path / "was_here"
    forged = pickle.dumps(Command(f"touch {witness}")) if data == "pickle" else data
    sweep = cheap_sweep(12)
    with Processes(work_of(sweep, tmp_path, forging(forged)), 2) as processes:
        results = {design.number: result for pairs in processes.run(sweep.designs) for design, result in pairs}
    assert sorted(results) == list(range(1, 13))
    assert [number for number, result in results.items() if result.failure] == [FORGED]
    assert "ended without a word, twice" in str(results[FORGED].failure)
    assert not witness.exists()


plain = st.recursive(
    st.none() | st.booleans() | st.integers(-3, 3) | st.floats() | st.text(max_size=3),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=3), inner, max_size=2),
    max_leaves=10,
)


@given(plain | st.tuples(st.just(1), st.lists(plain, max_size=3), plain, plain).map(lambda one: [list(one)]))
def test_any_plain_data_is_results_or_refused(data: Any) -> None:
    task = Task(None, {}, None, tuple(Quantity(When.END, kind, kind, "") for kind in ("Real", "Integer")))  # type: ignore[arg-type]
    try:
        (result,) = read_results(data, [Design(1, {})], task, "fmu")
    except BrokenFrameError:
        return
    real, whole = result.values
    assert type(real) in (float, int, type(None))
    assert type(whole) in (int, type(None))
    assert {type(result.failure), type(result.warnings)} <= {str, type(None)}
