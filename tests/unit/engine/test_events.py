"""When an open gap closes: roots against closed forms, and no root that is not there."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from rotor import ARM, INERTIA, Stop, rotor

from mechanism_fmu import codes
from mechanism_fmu.simulation import Simulation

EPSILON = np.finfo(float).eps


def impacts(mechanism, until):
    simulation = Simulation(mechanism)
    simulation.advance(until)
    return simulation.impacts_in_step()


def positive(least, most):
    """Numbers over orders of magnitude."""
    return st.floats(math.log(least), math.log(most)).map(math.exp)


@settings(deadline=None, max_examples=50)
@given(positive(1e-3, 1.5), positive(1e-2, 1e3), st.sampled_from([1, -1]))
def test_time_of_an_impact_under_constant_torque(distance, acceleration, sign):
    expected = math.sqrt(2 * distance / acceleration)
    stop = Stop(sign * distance, sign)
    (found,) = impacts(rotor([stop], acceleration=sign * acceleration), 1.1 * expected)
    assert found.time == pytest.approx(expected, abs=1e-12)
    assert found.closing_speed == pytest.approx(ARM * acceleration * expected, rel=1e-12)
    assert found.impulse == pytest.approx(INERTIA * acceleration * expected / ARM, rel=1e-12)


@settings(deadline=None, max_examples=30)
@given(st.floats(-0.9, 0.9), positive(0.1, 10.0))
def test_time_of_an_impact_on_a_spring(share, frequency):
    """From rest at 0.5 rad the spring swings the arm to `share` of that."""
    expected = math.acos(share) / frequency
    (found,) = impacts(rotor([Stop(0.5 * share, -1)], angle=0.5, frequency=frequency, tolerance=1e-13), 1.2 * expected)
    assert found.time == pytest.approx(expected, rel=1e-11)


@settings(deadline=None, max_examples=20)
@given(st.floats(-0.9, 0.9), positive(0.1, 10.0), st.sampled_from([1e-3, 1e-5, 1e-9]))
def test_an_impact_happens_on_the_line_however_coarse_the_steps(share, frequency, tolerance):
    """The root is one of the step itself, not of its interpolant, which is less accurate."""
    mechanism = rotor([Stop(0.5 * share, -1, 0.5)], angle=0.5, frequency=frequency, tolerance=tolerance)
    (hit,) = impacts(mechanism, 1.2 * math.acos(share) / frequency)
    simulation = Simulation(mechanism)
    simulation.advance(hit.time)
    assert simulation.field("y_end")[2] == pytest.approx(0.5 * share, abs=1e-15 + 1e-12 * frequency)


@settings(deadline=None, max_examples=50)
@given(positive(1e-10, 0.3), positive(0.1, 10.0), st.floats(0.4, 3.0))
def test_a_short_visit_behind_the_line_is_not_stepped_over(overshoot, deceleration, highest):
    """An arm thrown past the line comes back on its own: two roots, most often inside one step."""
    turn = math.sqrt(2 * highest / deceleration)
    expected = turn - math.sqrt(2 * overshoot / deceleration)
    thrown = rotor([Stop(highest - overshoot)], speed=deceleration * turn, acceleration=-deceleration)
    (found,) = impacts(thrown, 1.9 * turn)
    closing = math.sqrt(2 * overshoot * deceleration)
    assert found.time == pytest.approx(expected, abs=1e-12 + 16 * EPSILON * highest / closing)
    assert found.closing_speed == pytest.approx(ARM * closing, rel=1e-9 + 8 * EPSILON * highest / overshoot)


def test_the_engine_would_step_over_that_visit():
    """Without the stop, a single step reaches from before the first root to behind the second."""
    simulation = Simulation(rotor(speed=1.0, acceleration=-1.0))
    simulation.advance(1.0)
    start, end = simulation.field("clock")[[codes.STEP_START, codes.STEP_END]]
    assert start < 0.8 < 1.2 < end


@pytest.mark.parametrize("miss", [1e-13, 1e-10, 1e-7, 1e-4])
def test_grazing_without_crossing_is_no_impact_and_just_crossing_is(miss):
    for distance, count in ((0.5 + miss, 0), (0.5 - miss, 1)):
        thrown = rotor([Stop(distance)], speed=1.0, acceleration=-1.0)
        assert len(impacts(thrown, 1.5)) == count


@pytest.mark.parametrize("frequency", [0.5, 3.0])
def test_a_swing_that_just_misses_and_one_that_just_reaches(frequency):
    """The spring turns the arm at -0.5 rad; steps are not exact here, so the margin is the tolerance's."""
    for stop, count in ((-0.5 - 1e-9, 0), (-0.5 + 1e-9, 1)):
        swing = rotor([Stop(stop, -1)], angle=0.5, frequency=frequency, tolerance=1e-12)
        assert len(impacts(swing, 1.5 * math.pi / frequency)) == count


@settings(deadline=None, max_examples=20)
@given(positive(1e-3, 1.0), positive(1e-2, 10.0))
def test_an_impact_at_a_communication_point_belongs_to_the_step_that_ends_there(distance, acceleration):
    mechanism = rotor([Stop(distance, restitution=0.5)], acceleration=acceleration)
    whole = Simulation(mechanism)
    time = math.sqrt(2 * distance / acceleration)
    whole.advance(1.5 * time)
    (hit,) = whole.impacts_in_step()

    before, at = Simulation(mechanism), Simulation(mechanism)
    at.advance(hit.time)
    assert at.impacts_in_step() == [hit]
    assert at.field("y_end")[5] == pytest.approx(-acceleration * time / 2)  # already x+
    before.advance(math.nextafter(hit.time, 0.0))
    assert before.impacts_in_step() == []
    before.advance(hit.time)
    assert before.impacts_in_step() == [hit]
    for simulation in (before, at):
        simulation.advance(1.5 * time)
        assert simulation.impacts_in_step() == []
        assert simulation.counters[codes.COUNT_IMPACTS] == 1
        np.testing.assert_array_equal(after_clearing(simulation), after_clearing(whole))


def after_clearing(simulation):
    simulation.advance(simulation.time)
    # But for what is noted of the communication step itself.
    simulation.counters[codes.STEPS_IN_STEP] = 0
    simulation.field("clock")[codes.STEP_BEGUN] = 0.0
    return simulation.state


def test_the_nearest_of_several_stops_is_struck_first():
    stops = [Stop(0.4), Stop(0.1), Stop(0.2), Stop(-1.0, -1)]
    (found,) = impacts(rotor(stops, acceleration=1.0), 10.0)
    assert found.contact == "stop1"
    assert found.time == pytest.approx(math.sqrt(0.2), abs=1e-12)


def test_two_stops_struck_at_the_same_instant_both_hold():
    simulation = Simulation(rotor([Stop(0.3), Stop(0.3)], acceleration=1.0))
    simulation.advance(2.0)
    assert simulation.field("y_end")[2] == pytest.approx(0.3, abs=1e-12)
    assert abs(simulation.field("y_end")[5]) < 1e-11


@settings(deadline=None, max_examples=30)
@given(positive(1e-2, 10.0), st.sampled_from([1, -1]), st.floats(0.0, 1.0))
def test_an_arm_that_starts_on_the_line_and_leaves_it_is_free(speed, sign, restitution):
    simulation = Simulation(rotor([Stop(0.0, -sign, restitution)], speed=sign * speed))
    simulation.advance(0.1 / speed)
    assert simulation.impacts_in_step() == []
    assert simulation.field("y_end")[5] == pytest.approx(sign * speed, rel=1e-12)


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_an_arm_that_starts_on_the_line_and_moves_into_it_strikes_at_once(restitution):
    simulation = Simulation(rotor([Stop(0.0, restitution=restitution)], speed=2.0), start_time=3.0)
    simulation.advance(3.5)
    (found,) = simulation.impacts_in_step()
    assert found.time == 3.0
    assert found.closing_speed == pytest.approx(2.0 * ARM)
    assert simulation.field("y_end")[5] == pytest.approx(-2.0 * restitution, abs=1e-12)


def test_an_arm_that_starts_on_the_line_at_rest_is_held():
    simulation = Simulation(rotor([Stop(0.25)], angle=0.25, acceleration=1.0))
    simulation.advance(1.0)
    assert simulation.impacts_in_step() == []
    assert simulation.field("contact_mode")[0] == codes.CLOSED
    assert simulation.field("y_end")[2] == pytest.approx(0.25, abs=1e-12)
