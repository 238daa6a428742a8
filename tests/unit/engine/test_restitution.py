"""Bouncing under constant torque against its geometric series, the rest that ends it, and e = 1."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st
from rotor import ARM, INERTIA, Stop, rotor

from mechanism_fmu import codes
from mechanism_fmu.model import Output
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tolerances import STICK_SPEED

OUTPUTS = (
    Output("force", "stop0.force", "", "N"),
    Output("kinetic", "energy.kinetic", "", "J"),
    Output("lost", "energy.lost", "", "J"),
    Output("work", "energy.work", "", "J"),
)


def speed_at_rest(simulation):
    """The scale of speeds where nothing but the forces at the start acts any more."""
    length, _, _, rate = simulation.field("scales")
    return length * rate


def all_impacts(simulation, times):
    found = []
    for time in times:
        simulation.advance(time)
        found += simulation.impacts_in_step()
    return found


@settings(deadline=None, max_examples=12)
@given(st.floats(0.05, 0.9), st.floats(0.1, 1.0), st.floats(0.1, 100.0))
def test_bounces_follow_the_geometric_series_until_they_stick(restitution, distance, acceleration):
    first = math.sqrt(2 * distance / acceleration)
    closing = ARM * acceleration * first
    simulation = Simulation(rotor([Stop(distance, 1, restitution)], acceleration=acceleration, outputs=OUTPUTS))
    sticks_below = STICK_SPEED * speed_at_rest(simulation)
    # closing speed of impact k is e^k times the first; the last is the first that would leave too slowly
    count = 1
    while restitution**count * closing >= sticks_below:
        count += 1
    powers = restitution ** np.arange(count)
    times = first + 2 * first * (np.cumsum(powers) - 1)
    end = times[-1] + first  # long after the last

    found = all_impacts(simulation, [*(times[:-1] + times[1:]) / 2, end])
    # rounding of the angle disturbs the slowest bounces, and with them how many more there are
    assert abs(len(found) - count) <= 2
    sure = np.count_nonzero(powers * closing > 100 * sticks_below)
    rounding = np.cumsum(16 * np.finfo(float).eps * distance / (powers * acceleration * first))
    assert np.all(np.abs([hit.time for hit in found[:sure]] - times[:sure]) <= 1e-12 * first + rounding[:sure])
    np.testing.assert_allclose([hit.closing_speed for hit in found[:sure]], (powers * closing)[:sure], rtol=1e-6)

    at_rest = simulation.read()
    assert simulation.field("contact_mode")[0] == codes.CLOSED
    assert simulation.counters[codes.COUNT_LOST] == 0
    assert simulation.field("y_end")[2] == pytest.approx(distance, abs=1e-12)
    assert at_rest["force"] == pytest.approx(INERTIA * acceleration / ARM)
    assert at_rest["kinetic"] == pytest.approx(0.0, abs=1e-20)
    assert at_rest["lost"] == pytest.approx(INERTIA * acceleration * distance, rel=1e-9)
    assert at_rest["work"] == pytest.approx(at_rest["lost"], rel=1e-9)


@settings(deadline=None, max_examples=30)
@given(st.floats(0.0, 1.0), st.floats(0.1, 10.0))
def test_an_impact_returns_e_times_the_speed_and_loses_the_rest(restitution, speed):
    assume(restitution == 0.0 or restitution > 1e-4)  # below a speed of 1e-6 of what moves, it sticks
    simulation = Simulation(rotor([Stop(0.5, 1, restitution)], speed=speed, outputs=OUTPUTS))
    simulation.advance(0.75 / speed)
    (hit,) = simulation.impacts_in_step()
    returned = restitution
    assert hit.impulse == pytest.approx((1 + returned) * INERTIA * speed / ARM)
    assert simulation.field("y_end")[5] == pytest.approx(-returned * speed, rel=1e-12, abs=1e-11)
    assert simulation.read()["lost"] == pytest.approx(INERTIA / 2 * speed**2 * (1 - returned**2), abs=1e-13)


def test_between_two_elastic_stops_the_arm_keeps_its_energy_and_its_beat():
    simulation = Simulation(rotor([Stop(0.5, 1, 1.0), Stop(-0.5, -1, 1.0)], speed=1.0, outputs=OUTPUTS))
    found = all_impacts(simulation, np.arange(500) + 0.75)
    np.testing.assert_allclose([hit.time for hit in found], np.arange(500) + 0.5, rtol=0, atol=1e-10)
    assert [hit.contact for hit in found[:4]] == ["stop0", "stop1", "stop0", "stop1"]
    assert simulation.read()["kinetic"] == pytest.approx(INERTIA / 2, rel=1e-12)
    assert simulation.read()["lost"] == pytest.approx(0.0, abs=1e-13)


def test_elastic_bounces_under_torque_keep_their_height():
    simulation = Simulation(rotor([Stop(0.5, 1, 1.0)], acceleration=1.0, outputs=OUTPUTS))
    found = all_impacts(simulation, np.arange(201.0) + 0.5)
    np.testing.assert_allclose([hit.time for hit in found], 1 + 2 * np.arange(len(found)), rtol=0, atol=1e-9)
    assert len(found) == 100
    assert simulation.read()["kinetic"] == pytest.approx(simulation.read()["work"], rel=1e-9)


def test_a_long_step_keeps_the_newest_impacts_and_counts_those_it_lost():
    simulation = Simulation(rotor([Stop(0.5, 1, 1.0), Stop(-0.5, -1, 1.0)], speed=1.0))
    simulation.advance(12.0)
    kept = [hit.time for hit in simulation.impacts_in_step()]
    np.testing.assert_allclose(kept, np.arange(4, 12) + 0.5)
    assert len(kept) == codes.IMPACT_BUFFER_LENGTH
    assert simulation.counters[codes.COUNT_IMPACTS] == 12
    assert simulation.counters[codes.COUNT_LOST] == 4
    simulation.advance(13.0)
    assert [hit.time for hit in simulation.impacts_in_step()] == pytest.approx([12.5])
    assert simulation.counters[codes.COUNT_LOST] == 4


@settings(deadline=None, max_examples=25)
@given(st.integers(1, 14), st.floats(0.05, 0.95), st.floats(-1e-3, 1e-3))
def test_an_input_that_changes_in_mid_flight_makes_no_impact_of_its_own(bounce, share, change):
    """The arm falls from 0.5 rad in 1 s and then bounces with e = 1/2: flight k lasts 2^(1-k) s."""
    simulation = Simulation(rotor([Stop(0.5, 1, 0.5)], acceleration=1.0))
    flight = 2.0 ** (1 - bounce)
    simulation.advance(3 - 2 * flight + share * flight)
    assert simulation.counters[codes.COUNT_IMPACTS] == bounce
    simulation.set_input("torque", INERTIA * (1 + change))
    simulation.advance(3 - 2 * flight + (share + 0.04) * flight)
    assert simulation.impacts_in_step() == []
    simulation.advance(3 - flight + 0.01 * flight)
    assert len(simulation.impacts_in_step()) == 1
