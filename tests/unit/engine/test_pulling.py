"""When a guided contact first pulls, against the closed form of its force."""

import math

import numpy as np
import pytest
from carried import FREQUENCY, LARGEST, carried, seat_force
from hypothesis import given, settings, strategies as st
from scipy.optimize import brentq

from mechanism_fmu import codes
from mechanism_fmu.simulation import Simulation


def first_pull(press):
    return math.acos(-press) / FREQUENCY


@pytest.mark.parametrize("press", [0.0, -0.3, 1.5])
def test_force_of_a_closed_contact(press):
    simulation = Simulation(carried(press))
    for time in np.linspace(0, 5, 21):
        simulation.advance(time)
        found = simulation.read()
        assert found["force"] == pytest.approx(seat_force(time, press), abs=1e-7)
        assert found["gap"] == 0.0


@settings(deadline=None, max_examples=30)
@given(st.floats(-0.99, 0.97), st.floats(1e-2, 3.0))
def test_time_of_the_first_pull_whatever_the_communication_step(press, step):
    simulation = Simulation(carried(press, tolerance=1e-12))
    expected = first_pull(press)
    for time in [*np.arange(0, expected - 1e-6, step), expected - 1e-6]:
        simulation.advance(time)
        assert simulation.pulling_contacts() == {}
    for time in (expected + 1e-6, expected + 1.0, expected + 4.0):
        simulation.advance(time)
        assert simulation.pulling_contacts() == {"seat": pytest.approx(expected, abs=2e-8)}
    assert simulation.counters[codes.COUNT_PULLS] == 1


def test_a_contact_that_pulls_from_the_start():
    assert Simulation(carried(-1.1), start_time=2.0).pulling_contacts() == {"seat": 2.0}


def test_a_contact_that_always_pushes_never_pulls():
    simulation = Simulation(carried(1.01))
    simulation.advance(10.0)
    assert simulation.pulling_contacts() == {}
    assert simulation.counters[codes.COUNT_PULLS] == 0


@pytest.mark.parametrize("press", [0.0, 0.5])
def test_a_pull_ahead_of_the_communication_point_is_forgotten_when_an_input_prevents_it(press):
    simulation = Simulation(carried(press))
    just_before = first_pull(press) - 1e-4
    simulation.advance(just_before)
    assert simulation.field("pull_time")[0] > just_before  # the engine knows already
    assert simulation.counters[codes.COUNT_PULLS] == 1
    assert simulation.pulling_contacts() == {}
    simulation.set_input("torque", -2.0 * LARGEST)
    simulation.advance(just_before + 5.0)
    assert simulation.pulling_contacts() == {}
    assert simulation.counters[codes.COUNT_PULLS] == 0


def test_an_input_that_makes_a_contact_pull_does_so_at_once():
    simulation = Simulation(carried(2.0))
    simulation.advance(1.0)
    simulation.set_input("torque", 2.0 * LARGEST)
    simulation.advance(1.5)
    assert simulation.pulling_contacts() == {"seat": 1.0}


def test_the_first_pull_is_kept_when_an_input_changes_later():
    simulation = Simulation(carried(0.0))
    for time, press in ((1.0, 2.0), (1.5, -2.0), (2.0, 2.0), (2.5, -2.0)):
        simulation.advance(time)
        simulation.set_input("torque", -press * LARGEST)
    assert simulation.pulling_contacts() == {"seat": pytest.approx(first_pull(0.0), abs=1e-6)}
    assert simulation.counters[codes.COUNT_PULLS] == 1


@settings(deadline=None, max_examples=20)
@given(st.floats(0.0, 0.9), st.floats(-0.5, -0.1))
def test_the_first_pull_under_a_torque_that_ramps(press, slope):
    """Located inside a step, where the force is that of the torque at that time."""
    expected = brentq(lambda t: press + slope * t + math.cos(FREQUENCY * t), 0.0, math.pi / FREQUENCY, xtol=1e-14)
    simulation = Simulation(carried(press, tolerance=1e-12))
    simulation.set_slope("torque", -slope * LARGEST)
    simulation.advance(3.0)
    assert simulation.pulling_contacts() == {"seat": pytest.approx(expected, abs=2e-8)}
