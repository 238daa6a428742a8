import time as clock
from dataclasses import replace

import numpy as np
import pytest
from fake_slave import FakeFmu, FakeSlave
from hypothesis import given, strategies as st

from harness.fmu.description import Variable
from harness.report.motion import contacts, intervals, joined, lanes_plot, motion_plots
from harness.report.packed import packed_figures
from harness.report.plot import interactive
from harness.run.experiment import Experiment, Run, perform

TIME = np.arange(6.0)


def run_with(**signals: list[bool] | np.ndarray) -> Run:
    """A run of 1 s with recorded Boolean outputs."""
    samples = len(next(iter(signals.values()), [0] * 11))
    run = perform(FakeFmu(FakeSlave(impacts=[0.25])), Experiment(1.0, 1.0 / (samples - 1)))  # type: ignore[arg-type]
    more = {name: Variable(name, 900 + i, "Boolean", "output") for i, name in enumerate(signals)}
    description = replace(run.description, variables={**run.description.variables, **more})
    return replace(run, description=description, results=run.results.assign(**signals))


@pytest.mark.parametrize(
    ("active", "expected"),
    [
        ("000000", []),
        ("111111", [[0, 5]]),
        ("011001", [[1, 3], [5, 5]]),
        ("100000", [[0, 1]]),
        ("101010", [[0, 1], [2, 3], [4, 5]]),
    ],
)
def test_intervals_of_known_signals(active: str, expected: list[list[float]]) -> None:
    assert intervals(TIME, np.array([flag == "1" for flag in active])).tolist() == expected


def test_no_samples_have_no_intervals() -> None:
    assert intervals(np.empty(0), np.empty(0, dtype=bool)).shape == (0, 2)


@given(flags=st.lists(st.booleans(), min_size=1, max_size=60))
def test_a_sample_is_active_exactly_when_it_lies_in_an_interval(flags: list[bool]) -> None:
    time = np.linspace(0, 1, len(flags))
    spans = intervals(time, np.array(flags))
    held = [bool(((spans[:, 0] <= t) & (t < spans[:, 1])).any()) for t in time[:-1]]
    assert held == flags[:-1]
    assert (np.diff(spans.ravel()) >= 0).all()


def test_short_gaps_are_closed_and_long_ones_stay() -> None:
    spans = np.array([[0.0, 1.0], [1.1, 2.0], [2.1, 3.0], [5.0, 6.0]])
    assert joined(spans, 0.5).tolist() == [[0, 3], [5, 6]]
    assert joined(spans, 0.05).tolist() == spans.tolist()
    assert joined(spans, 9.0).tolist() == [[0, 6]]
    assert joined(np.empty((0, 2)), 1.0).shape == (0, 2)


@given(flags=st.lists(st.booleans(), min_size=1, max_size=60), gap=st.floats(0, 2))
def test_joining_keeps_the_ends_and_covers_what_was_covered(flags: list[bool], gap: float) -> None:
    spans = intervals(np.linspace(0, 1, len(flags)), np.array(flags))
    fewer = joined(spans, gap)
    assert len(fewer) <= len(spans)
    assert set(fewer.ravel()) <= set(spans.ravel())
    assert all(((fewer[:, 0] <= begin) & (end <= fewer[:, 1])).any() for begin, end in spans)
    assert (fewer[1:, 0] - fewer[:-1, 1] >= gap).all()


def test_contacts_are_the_boolean_outputs_with_the_ending() -> None:
    run = run_with(slope_active=[True] * 11, holding_pawl_active=[False] * 11, active_slope=[True] * 11)
    assert [(c.name, c.variable) for c in contacts(run)] == [
        ("slope", "slope_active"),
        ("holding pawl", "holding_pawl_active"),
    ]
    assert len({c.colour for c in contacts(run)}) == 2


def test_without_contacts_there_is_no_lane() -> None:
    run = run_with()
    assert lanes_plot(run) is None
    assert [plot.title for plot in motion_plots(run)] == ["Angle change [deg]"]


def test_a_lane_for_each_contact_shares_the_time_axis() -> None:
    face = [False] * 3 + [True] * 4 + [False] * 4
    plots = motion_plots(run_with(slope_active=[True] * 11, face_active=face, stop_active=[False] * 11))
    figure = interactive(plots[-1])
    assert [(lane["name"], lane["about"], lane["spans"]) for lane in figure["lanes"]] == [
        ("slope", "slope_active", [[0.0, 1.0]]),
        ("face", "face_active", [[pytest.approx(0.3), pytest.approx(0.7)]]),
        ("stop", "stop_active", []),
    ]
    assert {(plot.x_label, plot.range) for plot in plots} == {("time [s]", (0.0, 1.0))}


def test_long_runs_with_chatter_stay_quick_and_small() -> None:
    samples = 100_001
    chatter = np.arange(samples) % 3 == 0
    run = run_with(slope_active=[True] * 11)
    times = np.linspace(0, 1, samples)
    long = replace(run, results=run.results.iloc[[0] * samples].assign(time=times, slope_active=chatter))
    began = clock.perf_counter()
    html = packed_figures([interactive(plot) for plot in motion_plots(long)])
    assert clock.perf_counter() - began < 5.0
    assert len(html) < 500_000
