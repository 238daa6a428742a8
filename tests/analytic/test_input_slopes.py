"""Inputs that change linearly during a communication step, against closed forms."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import example, given, settings, strategies as st

from mechanism_fmu import codes
from mechanism_fmu.model import (
    GROUND,
    Body,
    Force,
    Input,
    Mechanism,
    Output,
    PointLineContact,
    Revolute,
    Settings,
    Torque,
    Translational,
)
from mechanism_fmu.simulation import Simulation

INERTIA = 0.5
MASS = 2.0
TURN = (Output("angle", "rotor.angle", ""), Output("speed", "rotor.speed", ""), Output("work", "energy.work", ""))


def turning(torque=0.0):
    """A body on a revolute with a torque for an input: phi'' = torque / INERTIA."""
    return Simulation(
        Mechanism(
            bodies=(Body("rotor", 1.0, INERTIA),),
            joints=(Revolute("hinge", "rotor", (0.0, 0.0), GROUND, (0.0, 0.0)),),
            forces=(Torque("drive", "rotor"),),
            inputs=(Input("torque", "drive.torque", torque, "", "N.m"),),
            outputs=TURN,
        )
    )


def pressed(force, *, sliding=False, tolerance=1e-9, speed=0.0):
    """A body, free or on a guide along y, pressed on the ground at y = 0 by a force downwards that is an input."""
    guide = Translational("guide", GROUND, (0.0, 0.0), (0.0, 1.0), "body", (0.0, 0.0), (0.0, 1.0))
    return Simulation(
        Mechanism(
            bodies=(Body("body", MASS, 0.3, start_rate=(0.0, speed, 0.0)),),
            joints=(guide,) if sliding else (),
            forces=(Force("press", "body"),),
            contacts=(PointLineContact("floor", "body", (0.0, 0.0), GROUND, (0.0, 0.0), (0.0, 1.0)),),
            inputs=(Input("press", "press.y", -force, "", "N"),),
            outputs=(
                Output("force", "floor.force", "", "N"),
                Output("y", "body.y", ""),
                Output("y_rate", "body.y_rate", ""),
            ),
            settings=Settings(relative_tolerance=tolerance),
        )
    )


@settings(deadline=None, max_examples=40)
@given(
    st.lists(
        st.tuples(st.floats(1e-4, 2.0), st.floats(-3.0, 3.0), st.floats(-3.0, 3.0), st.booleans()),
        min_size=1,
        max_size=6,
    )
)
@example([(1.0, 0.0, 1.0, False), (1.0, 0.0, 0.0, True), (1.0, 0.0, 0.0, True)])
def test_a_torque_that_ramps_turns_a_body_along_a_cubic(pieces):
    """Pieces: duration, acceleration at the start, its slope, and whether to start from the value reached instead."""
    simulation = turning()
    time, angle, speed, work, value = 0.0, 0.0, 0.0, 0.0, 0.0
    for duration, start, slope, goes_on in pieces:
        if not goes_on:
            value = start
            simulation.set_input("torque", INERTIA * value)
        simulation.set_slope("torque", INERTIA * slope)
        before = speed
        angle += speed * duration + value * duration**2 / 2 + slope * duration**3 / 6
        speed += value * duration + slope * duration**2 / 2
        value += slope * duration
        work += INERTIA * (speed**2 - before**2) / 2
        time += duration
        simulation.advance(time)
        expected = {"angle": angle, "speed": speed, "work": work}
        assert simulation.read() == pytest.approx(expected, rel=1e-12, abs=1e-12 * (1 + time**3))
        assert simulation.inputs[0] == pytest.approx(INERTIA * value, rel=1e-12, abs=1e-12)
        assert simulation.field("input_slopes")[0] == 0.0


def test_an_exact_cubic_in_one_step():
    simulation = turning(INERTIA * 0.5)
    simulation.set_slope("torque", INERTIA * 3.0)
    simulation.advance(1.0)
    assert simulation.read()["angle"] == pytest.approx(0.25 + 0.5, abs=1e-12)
    assert simulation.read()["speed"] == pytest.approx(0.5 + 1.5, abs=1e-12)
    simulation.advance(2.0)  # the torque holds what it has reached
    assert simulation.read()["angle"] == pytest.approx(0.75 + 2.0 + 3.5 / 2, abs=1e-12)
    assert simulation.read()["speed"] == pytest.approx(2.0 + 3.5, abs=1e-12)


def test_no_step_goes_beyond_the_end_of_a_slope():
    simulation = turning(1.0)
    for k in range(1, 30):
        simulation.set_slope("torque", 0.1)
        simulation.advance(0.1 * k)
        assert simulation.field("clock")[codes.STEP_END] == 0.1 * k
    assert simulation.counters[codes.COUNT_STEPS] < 60


def test_a_sine_in_linear_pieces_converges_with_order_two():
    """phi'' = sin(t) from rest: phi = t - sin(t)."""
    errors = []
    for count in (8, 16, 32, 64):
        simulation, ends = turning(), np.linspace(0.0, 3.0, count + 1)
        for start, end in itertools.pairwise(ends):
            simulation.set_input("torque", INERTIA * math.sin(start))
            simulation.set_slope("torque", INERTIA * (math.sin(end) - math.sin(start)) / (end - start))
            simulation.advance(end)
        errors.append(abs(simulation.read()["angle"] - (3.0 - math.sin(3.0))))
    np.testing.assert_allclose(np.log2(np.divide(errors[:-1], errors[1:])), 2.0, atol=0.02)


@settings(deadline=None, max_examples=30)
@given(st.floats(0.5, 50.0), st.floats(0.1, 0.95), st.booleans())
def test_a_contact_opens_when_the_force_that_presses_it_ramps_through_zero(slope, share, sliding):
    """It may lack 2e-9 N, within which a force still pushes: that is the only delay."""
    opens = share
    simulation = pressed(slope * opens, sliding=sliding)
    simulation.set_slope("press", slope)
    simulation.advance(1.0)
    (event,) = simulation.events_in_step()
    assert (event.guard, event.new_mode) == ("floor.force", ())
    assert event.time == pytest.approx(opens, abs=1e-9 + 2.1e-9 / slope)
    free = 1.0 - opens
    assert simulation.read()["y_rate"] == pytest.approx(slope * free**2 / 2 / MASS, abs=1e-8)
    assert simulation.read()["y"] == pytest.approx(slope * free**3 / 6 / MASS, abs=1e-8)


def test_the_time_at_which_a_contact_opens():
    simulation = pressed(30.0)
    simulation.set_slope("press", 100.0)
    simulation.advance(1.0)
    (event,) = simulation.events_in_step()
    assert event.time == pytest.approx(0.3, abs=1e-9)


def test_the_force_of_a_contact_follows_the_ramp():
    simulation = pressed(3.0)
    for k in range(1, 11):
        simulation.set_slope("press", -2.0)
        simulation.advance(0.1 * k)
        assert simulation.read()["force"] == pytest.approx(3.0 + 0.2 * k)


@settings(deadline=None, max_examples=30)
@given(st.floats(0.1, 5.0), st.floats(0.5, 10.0))
def test_the_time_of_an_impact_under_a_ramp(speed, slope):
    """Thrown up, without weight, against a force that grows from zero: y = v t - s t^3 / 6 m."""
    lands = math.sqrt(6 * MASS * speed / slope)
    simulation = pressed(0.0, speed=speed)
    simulation.set_slope("press", -slope)
    simulation.begin_step()
    simulation.go_on(1.5 * lands, codes.STOP_AT_IMPACT)
    (impact,) = simulation.impacts_in_step()
    assert impact.time == simulation.time == pytest.approx(lands, rel=1e-12)
    assert impact.closing_speed == pytest.approx(2 * speed, rel=1e-11)
    assert simulation.inputs[0] == pytest.approx(-slope * lands)
    simulation.go_on(1.5 * lands, codes.STOP_AT_TARGET)
    assert simulation.read()["force"] == pytest.approx(1.5 * slope * lands)
    assert simulation.inputs[0] == pytest.approx(-1.5 * slope * lands)


def test_a_step_that_was_ahead_is_dropped_when_a_slope_is_set():
    simulation = turning(INERTIA)
    simulation.advance(1.0)
    simulation.advance(1.25)
    assert simulation.field("clock")[codes.STEP_END] > 1.25
    simulation.set_slope("torque", -INERTIA)
    simulation.advance(2.25)
    assert simulation.read()["speed"] == pytest.approx(2.25 - 0.5, abs=1e-12)


@pytest.mark.parametrize("saved_after", [0, 3, 7])
def test_a_saved_state_brings_its_slopes(saved_after):
    """Saved with slopes set, before the step in which they act."""

    def play(simulation, first, last):
        for k in range(first, last):
            simulation.advance(0.3 * (k + 1))
            simulation.set_input("torque", INERTIA * math.cos(k))
            simulation.set_slope("torque", INERTIA * math.sin(k))

    one, two = turning(), turning(3.0)
    one.set_slope("torque", 0.7)
    play(one, 0, saved_after)
    saved = one.state.copy()
    play(one, saved_after, 12)
    two.advance(0.5)
    two.state[:] = saved
    play(two, saved_after, 12)
    np.testing.assert_array_equal(two.state, one.state)
