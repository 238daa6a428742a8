import itertools
import math

import pytest
from hypothesis import given, strategies as st

from harness.errors import UsageError
from harness.run.master import SECOND, TimeGrid, begin_and_size, seconds


@given(st.integers(1, 10**12), st.integers(1, 10**9), st.integers(0, 10**12))
def test_steps_join_without_gap_and_end_at_stop(length: int, step: int, start: int) -> None:
    grid = TimeGrid(start, start + min(length, 1000 * step), step)
    steps = list(grid)
    assert len(steps) == len(grid)
    assert steps[0][0] == grid.start
    assert steps[-1][1] == grid.stop
    assert all(before[1] == after[0] for before, after in itertools.pairwise(steps))
    assert all(end - begin == step for begin, end in steps[:-1])
    assert 0 < steps[-1][1] - steps[-1][0] <= step


def test_time_never_drifts_over_a_million_steps() -> None:
    added = 0.0
    for number, (begin, _) in enumerate(TimeGrid.of(stop_time=1e4, step=0.01)):
        assert seconds(begin) == number / 100
        added += 0.01
    assert added != 1e4  # what the clock is there to avoid


@given(st.integers(1, 2**53), st.integers(1, 2**53))
def test_begin_and_size_add_up_to_the_end_to_the_last_bit(length: int, step: int) -> None:
    for begin, end in itertools.islice(TimeGrid(0, length, step), 1000):
        assert sum(begin_and_size(begin, end)) == seconds(end)


def test_last_step_is_shortened() -> None:
    steps = list(TimeGrid.of(stop_time=1.0, step=0.3))
    assert [end - begin for begin, end in steps] == [3 * SECOND // 10] * 3 + [SECOND // 10]


def test_a_step_longer_than_the_run_becomes_the_run() -> None:
    assert list(TimeGrid.of(stop_time=0.5, step=2.0)) == [(0, SECOND // 2)]


@pytest.mark.parametrize(
    ("stop_time", "step", "message"),
    [
        (1.0, 0.0, "at least one nanosecond"),
        (1.0, 1e-10, "at least one nanosecond"),
        (1.0, -1e-3, "step is -0.001 s"),
        (0.0, 1e-3, "must be later than the start"),
        (-1.0, 1e-3, "stop time is -1 s"),
        (math.nan, 1e-3, "stop time is nan s"),
        (1.0, math.inf, "step is inf s"),
        (1e9, 1e-3, "counts nanoseconds up to 9007199 s"),
    ],
)
def test_impossible_times_are_refused(stop_time: float, step: float, message: str) -> None:
    with pytest.raises(UsageError, match=message):
        TimeGrid.of(stop_time, step)


def test_steps_of_one_size():
    assert TimeGrid.of(1.0, 0.1).even
    assert TimeGrid.of(0.05, 0.1).even  # one step, though a shorter one
    assert not TimeGrid.of(1.05, 0.1).even


def test_steps_are_even_where_none_is_shortened() -> None:
    assert TimeGrid.of(1.0, 0.25).even
    assert TimeGrid.of(1.0, 2.0).even  # one step of its own size
    assert not TimeGrid.of(1.0, 0.75).even
    assert not TimeGrid.of(1.0, 0.3).even
    assert TimeGrid.of(1.5, 0.5, 0.5).even
    assert not TimeGrid.of(1.5, 0.75, 0.5).even
