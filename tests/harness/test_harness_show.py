import os
import signal
import threading

import numpy as np
import pytest
from fake_slave import FakeSlave, fake_description
from hypothesis import given, strategies as st

from harness.app.cli_group import terminable
from harness.app.execution import interruption
from harness.app.terminal import RunDisplay, console
from harness.fmu.values import engineering, shown
from harness.report.plot import thin


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (15547.4, "Pa", "15.55 kPa"),
        (4.916054e-4, "m/s", "491.6 µm/s"),
        (0.0, "J", "0 J"),
        (1.0, "s", "1.000 s"),
        (-0.25, "N", "-250.0 mN"),
        (999.96, "Pa", "1.000 kPa"),
        (3e13, "Pa", "30000 GPa"),
        (float("nan"), "Pa", "nan Pa"),
    ],
)
def test_engineering_notation(value: float, unit: str, text: str) -> None:
    assert engineering(value, unit) == text


@pytest.mark.parametrize(
    ("value", "name", "text"),
    [
        (np.pi / 2, "wheel_angle", "1.57079633 rad (90 deg)"),
        (0.001, "drive_torque", "0.001 N.m"),
        (0.5, "restitution", "0.5"),
        (10, "tooth_count", "10"),
        (True, "guided", "true"),
    ],
)
def test_values_are_shown_with_unit_and_display_unit(value: float, name: str, text: str) -> None:
    assert shown(value, name, fake_description()) == text


@given(st.integers(1, 3000), st.integers(4, 200), st.integers(0, 2**32))
def test_a_thinned_curve_keeps_its_ends_and_its_extremes(length: int, limit: int, seed: int) -> None:
    values = np.random.default_rng(seed).normal(size=length)
    time, thinned = thin(np.arange(float(length)), values, limit)
    assert len(time) <= max(limit + 2, 1)
    assert (time[0], time[-1]) == (0.0, length - 1.0)
    assert (thinned.min(), thinned.max()) == (values.min(), values.max())
    assert np.array_equal(values[time.astype(int)], thinned)
    assert np.all(np.diff(time) > 0)


def test_the_bar_appears_only_when_the_run_takes_long() -> None:
    now = 0.0
    slave = FakeSlave()
    with console.capture(), RunDisplay(10.0, "Loading", now=lambda: now) as display:
        display.started(slave, 0.0)
        display.stepped(slave, 1.0)
        assert not display.bar_shown
        now = 4.0
        display.stepped(slave, 2.0)
        assert display.bar_shown
        assert display._bar.tasks[0].description == "0.5 x real time"
        now = 4.05
        display.stepped(slave, 3.0)
        assert display._bar.tasks[0].completed == 2.0
        now = 6.0
        display.stepped(slave, 9.0)
        assert (display._bar.tasks[0].completed, display._bar.tasks[0].description) == (9.0, "1.5 x real time")


@pytest.mark.parametrize("first", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("second", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_is_a_request_the_first_time_and_an_exception_the_second(
    first: signal.Signals, second: signal.Signals
) -> None:
    asked: list[str] = []
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background process ignores it
    with terminable():
        with interruption(lambda: asked.append("noticed")) as stop_requested:
            assert not stop_requested()
            os.kill(os.getpid(), first)
            assert stop_requested()
            assert asked == ["noticed"]
            with pytest.raises(KeyboardInterrupt):
                os.kill(os.getpid(), second)
        with pytest.raises(KeyboardInterrupt):
            os.kill(os.getpid(), signal.SIGTERM)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL


def test_who_has_sigterm_ignored_keeps_it_so() -> None:
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    try:
        with terminable():
            os.kill(os.getpid(), signal.SIGTERM)
        assert signal.getsignal(signal.SIGTERM) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)


def test_outside_the_main_thread_nobody_asks() -> None:
    answers: list[bool] = []

    def work() -> None:
        with interruption(lambda: None) as stop_requested:
            answers.append(stop_requested())

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert answers == [False]
