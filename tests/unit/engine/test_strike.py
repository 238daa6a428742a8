"""One round of impacts by itself, from states that the test writes: a ball in a corner, in closed form.

The floor is y = 0; the slope drives down, by 30 degrees, what comes along x.
"""

import math

import numpy as np
import pytest

from mechanism_fmu import codes
from mechanism_fmu.engine import status
from mechanism_fmu.engine.compiler.subset import entry
from mechanism_fmu.engine.contacts.impact import MOST_ROUNDS, strike
from mechanism_fmu.model import GROUND, Body, Mechanism, PointLineContact
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tolerances import RESTS_BELOW, STICK_SPEED, TOUCHES_WITHIN

MASS = 0.7
S, C = math.sin(math.radians(30)), math.cos(math.radians(30))
FLOOR, SLOPE = 0, 1
LAST = MOST_ROUNDS - 1


@entry
def strike_in(block, struck, round_):
    return strike(block, struck, round_)


def corner(rate, *, height=0.0, restitution=0.0, up=False, **floor):
    """The ball at the slope, `height` above the floor, with both contacts open and never touched."""
    rise = S if up else -S
    contacts = (
        PointLineContact("floor", "ball", (0.0, 0.0), GROUND, (0.0, 0.0), (0.0, 1.0), restitution=restitution, **floor),
        PointLineContact("slope", "ball", (0.0, 0.0), GROUND, (1.0, 0.0), (-C, rise), restitution=restitution),
    )
    simulation = Simulation(Mechanism(bodies=(Body("ball", MASS, 0.1, (0.0, 0.3, 0.0)),), contacts=contacts))
    simulation.field("scales")[:] = 1.0
    simulation.field("body_scales")[:] = 1.0
    simulation.field("y_end")[:6] = [1.0 - height * S / C, height, 0.0, *rate, 0.0]
    return simulation


def after(simulation, struck, round_):
    """Whether anything approached, the ball's velocity, and the modes."""
    approached, outcome = strike_in(simulation._block, struck, round_)
    assert outcome == status.OK
    return approached, simulation.field("y_end")[3:5].copy(), simulation.field("contact_mode").tolist()


def test_a_struck_contact_returns_with_e_and_one_out_of_reach_takes_no_part():
    simulation = corner((1.0, 0.0), height=1e-6, restitution=0.5)
    approached, velocity, mode = after(simulation, SLOPE, 0)
    assert approached
    np.testing.assert_allclose(velocity, np.array([1.0, 0.0]) - 1.5 * C * np.array([C, S]), rtol=1e-12)
    assert mode == [codes.OPEN, codes.OPEN]


def test_the_last_rounds_are_plastic():
    """Nothing returns."""
    _, velocity, mode = after(corner((1.0, 0.0), height=1e-6, restitution=0.5), SLOPE, LAST)
    np.testing.assert_allclose(velocity, [S**2, -S * C], rtol=1e-12)
    assert mode == [codes.OPEN, codes.CLOSED]


@pytest.mark.parametrize("rise", [2 * RESTS_BELOW, 1e-3])
def test_a_touching_contact_that_separates_takes_part_in_the_last_rounds_only(rise):
    closing = C + rise * S
    early, velocity, mode = after(corner((1.0, rise)), SLOPE, 0)
    assert early
    np.testing.assert_allclose(velocity, np.array([1.0, rise]) - closing * np.array([C, S]), rtol=1e-12)
    assert mode[SLOPE] == codes.CLOSED
    _, velocity, mode = after(corner((1.0, rise)), SLOPE, LAST)
    np.testing.assert_allclose(velocity, 0.0, atol=1e-15)
    assert mode == [codes.CLOSED, codes.CLOSED]


@pytest.mark.parametrize("rise", [0.3 * RESTS_BELOW, 0.9 * RESTS_BELOW])
def test_a_contact_at_rest_that_still_separates_a_little_may_be_turned_round(rise):
    """As an elastic contact would; in the last rounds it is stopped."""
    _, velocity, mode = after(corner((1.0, rise)), SLOPE, 0)
    assert velocity[1] == pytest.approx(-rise, rel=1e-5)
    assert velocity[0] == pytest.approx(rise * S / C, rel=1e-5)
    assert mode == [codes.CLOSED, codes.CLOSED]
    _, velocity, _ = after(corner((1.0, rise)), SLOPE, LAST)
    np.testing.assert_allclose(velocity, 0.0, atol=1e-15)


@pytest.mark.parametrize("height", [0.9 * TOUCHES_WITHIN, -0.9 * TOUCHES_WITHIN])
def test_a_contact_within_reach_strikes_at_once(height):
    """Both closing speeds are taken in one round."""
    simulation = corner((1.0, -0.5), height=height)
    approached, velocity, mode = after(simulation, SLOPE, 0)
    assert approached
    np.testing.assert_allclose(velocity, 0.0, atol=1e-15)
    assert mode == [codes.CLOSED, codes.CLOSED]
    assert simulation.counters[codes.COUNT_IMPACTS] == 2


@pytest.mark.parametrize("rate", [(-1.0, 1.0), (-1.0, 0.0), (0.0, 0.0), (0.0, 0.5 * RESTS_BELOW)])
@pytest.mark.parametrize("round_", [0, LAST])
def test_nothing_happens_when_nothing_approaches(rate, round_):
    simulation = corner(rate)
    before = simulation.state.copy()
    approached, velocity, _ = after(simulation, codes.NONE, round_)
    assert not approached
    np.testing.assert_array_equal(velocity, rate)
    np.testing.assert_array_equal(simulation.state, before)


@pytest.mark.parametrize(
    ("struck", "rate", "strikes"),
    [
        (FLOOR, -0.5 * RESTS_BELOW, True),
        (codes.NONE, -0.5 * RESTS_BELOW, False),
        (SLOPE, -0.5 * RESTS_BELOW, False),
        (FLOOR, 0.0, False),
        (FLOOR, 0.5, False),
    ],
)
def test_a_guided_contact_strikes_however_slowly_where_its_own_gap_closed(struck, rate, strikes):
    simulation = corner((-1.0, rate), guided=True)
    approached, velocity, _ = after(simulation, struck, 0)
    assert approached == strikes
    assert velocity[1] == (pytest.approx(0.0, abs=1e-24) if strikes else rate)


def test_an_impact_record_is_kept_of_what_strikes_only():
    simulation = corner((1.0, 0.0))
    after(simulation, SLOPE, 0)
    assert simulation.counters[codes.COUNT_IMPACTS] == 1
    record = simulation.field("impacts")[0]
    assert record[codes.RECORD_CONTACT] == SLOPE
    assert record[codes.RECORD_CLOSING_SPEED] == pytest.approx(C, rel=1e-12)
    np.testing.assert_allclose(record[8:10], [MASS * S / C, MASS / C], rtol=1e-12)
    np.testing.assert_allclose(record[10:16], [1.0, 0.0, 0.0, 0.0, 0.0, 0.0], atol=1e-15)
    np.testing.assert_allclose(record[16:], 0.0, atol=1e-15)


def test_a_contact_that_does_not_exist_is_passed_over_and_the_next_still_counts():
    simulation = corner((1.0, -1.0), enabled=False)
    approached, velocity, mode = after(simulation, SLOPE, 0)
    assert approached
    np.testing.assert_allclose(velocity, np.array([1.0, -1.0]) - (C - S) * np.array([C, S]), rtol=1e-12)
    assert mode == [codes.OPEN, codes.CLOSED]


@pytest.mark.parametrize("rate", [(1.0, 0.0), (-1.0, -2.0)])
def test_what_comes_apart_is_open_and_was_touching(rate):
    """A floor at rest, from which the slope drives the ball up; a floor from which it bounces by itself."""
    simulation = corner(rate, restitution=0.5, up=True)
    after(simulation, codes.NONE, 0)
    assert simulation.field("contact_mode")[FLOOR] == codes.OPEN
    assert simulation.field("contact_touching")[FLOOR] == 1


def test_what_comes_apart_more_slowly_than_the_stick_speed_is_closed():
    speed = 0.9 * STICK_SPEED / S
    simulation = corner((speed / C, 0.0), up=True)
    _, velocity, mode = after(simulation, SLOPE, 0)
    assert velocity[1] == pytest.approx(speed * S, rel=1e-9)
    assert mode == [codes.CLOSED, codes.CLOSED]
