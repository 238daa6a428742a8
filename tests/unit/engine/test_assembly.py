"""Closing a four-bar from a rough guess, and what is refused."""

import math
import re

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from rotor import Stop, rotor

from mechanism_fmu.model import GROUND, Body, Mechanism, MechanismError, PointLineContact, Revolute, Translational
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tolerances import CLOSED_WITHIN

GROUND_LENGTH, CRANK, COUPLER, ROCKER = 1.0, 0.3, 0.9, 0.7


def bar(name, length, start, rates=(0.0, 0.0, 0.0)):
    return Body(name, 1.0, length**2 / 12, start, rates)


def four_bar(starts, *, crank=CRANK, held=("crank.angle",), rates=((0.0, 0.0, 0.0),) * 3):
    """Bars along their own x axis, hinged at (0, 0) and (GROUND_LENGTH, 0)."""
    lengths = {"crank": crank, "coupler": COUPLER, "rocker": ROCKER}
    bodies = zip(lengths.items(), starts, rates, strict=True)
    return Mechanism(
        bodies=tuple(bar(name, length, start, rate) for (name, length), start, rate in bodies),
        joints=(
            Revolute("crank_hinge", "crank", (-crank / 2, 0.0), GROUND, (0.0, 0.0)),
            Revolute("crank_pin", "crank", (crank / 2, 0.0), "coupler", (-COUPLER / 2, 0.0)),
            Revolute("rocker_pin", "coupler", (COUPLER / 2, 0.0), "rocker", (ROCKER / 2, 0.0)),
            Revolute("rocker_hinge", "rocker", (-ROCKER / 2, 0.0), GROUND, (GROUND_LENGTH, 0.0)),
        ),
        held=held,
    )


def along(start, angle, length):
    """Centre of a bar that begins at `start`, and its angle."""
    return (start[0] + length / 2 * math.cos(angle), start[1] + length / 2 * math.sin(angle), angle)


def closed_four_bar(angle):
    """Exact positions of the open branch by the law of cosines."""
    pin = (CRANK * math.cos(angle), CRANK * math.sin(angle))
    to_hinge = (GROUND_LENGTH - pin[0], -pin[1])
    distance = math.hypot(*to_hinge)
    lean = math.acos((COUPLER**2 + distance**2 - ROCKER**2) / (2 * COUPLER * distance))
    coupler = math.atan2(to_hinge[1], to_hinge[0]) + lean
    tip = (pin[0] + COUPLER * math.cos(coupler), pin[1] + COUPLER * math.sin(coupler))
    rocker = math.atan2(tip[1], tip[0] - GROUND_LENGTH)
    return [
        along((0.0, 0.0), angle, CRANK),
        along(pin, coupler, COUPLER),
        along((GROUND_LENGTH, 0.0), rocker, ROCKER),
    ]


def positions(simulation):
    count = simulation.field("body_start").size
    return simulation.field("y_end")[:count]


@settings(deadline=None, max_examples=30)
@given(st.floats(-3.0, 3.0), st.lists(st.floats(-0.1, 0.1), min_size=9, max_size=9))
def test_a_four_bar_closes_from_a_rough_guess_and_the_held_crank_stays(angle, errors):
    exact = np.array(closed_four_bar(angle))
    guess = exact + np.reshape(errors, (3, 3))
    guess[0, 2] = angle
    simulation = Simulation(four_bar([tuple(row) for row in guess.tolist()]))
    np.testing.assert_allclose(positions(simulation), exact.ravel(), rtol=0, atol=1e-10)
    assert positions(simulation)[2] == angle
    assert np.abs(simulation.field("residual")[:8]).max() <= CLOSED_WITHIN


def test_what_is_closed_already_does_not_move():
    start = (0.25, -0.5, 0.125)
    joint = Translational("guide", "slider", (0.0, 0.0), (1.0, 0.0), GROUND, (0.25, -0.5), (8.0, 1.0))
    slider = Body("slider", 1.0, 1.0, (0.25, -0.5, math.atan2(1.0, 8.0)))
    simulation = Simulation(Mechanism(bodies=(slider, Body("free", 1.0, 1.0, start)), joints=(joint,)))
    np.testing.assert_array_equal(positions(simulation), [*slider.start, *start])


def test_another_coordinate_can_be_held_instead():
    guess = [tuple(row + np.array([0.01, -0.02, 0.0])) for row in np.array(closed_four_bar(1.0))]
    simulation = Simulation(four_bar(guess, held=("rocker.angle",)))
    assert positions(simulation)[8] == guess[2][2]
    np.testing.assert_allclose(positions(simulation), np.ravel(closed_four_bar(1.0)), rtol=0, atol=1e-10)


def test_closed_contacts_are_assembled_with_the_joints():
    simulation = Simulation(rotor([Stop(0.3, closed=True)], angle=0.1))
    assert positions(simulation)[2] == pytest.approx(0.3, abs=1e-12)
    assert simulation.field("contact_mode")[0] == 1


def test_a_four_bar_that_cannot_close_is_refused_with_what_is_left_of_each_joint():
    with pytest.raises(MechanismError) as refusal:
        Simulation(four_bar(closed_four_bar(1.0), crank=3.0, held=()))
    message = str(refusal.value)
    assert "cannot be closed" in message
    left = dict(re.findall(r"(\w+) by ([\d.e-]+)", message))
    assert list(left) == ["crank_hinge", "crank_pin", "rocker_pin", "rocker_hinge"]
    # the crank is longer than the other bars together by 3 - (1 + 0.9 + 0.7) m, which the four joints share
    assert sum(map(float, left.values())) == pytest.approx(0.4, rel=0.3)


def test_held_coordinates_that_contradict_each_other_are_refused():
    starts = closed_four_bar(1.0)
    starts[2] = (*starts[2][:2], starts[2][2] + 0.2)
    with pytest.raises(MechanismError, match="rocker_hinge by"):
        Simulation(four_bar(starts, held=("crank.angle", "rocker.angle", "coupler.angle")))


def test_a_closed_contact_that_cannot_be_reached_is_named():
    contact = PointLineContact("seat", "plate", (0.0, 0.0), GROUND, (0.0, 2.0), (0.0, 1.0), closed=True)
    hinge = Revolute("hinge", "plate", (0.0, 0.0), GROUND, (0.0, 0.0))
    with pytest.raises(MechanismError, match=r"hinge by 1, seat by 1 \(m, or rad"):
        Simulation(Mechanism(bodies=(Body("plate", 1.0, 1.0),), joints=(hinge,), contacts=(contact,)))


def test_a_start_inside_the_other_body_is_refused_with_the_depth():
    with pytest.raises(MechanismError, match=r"starts with a contact point inside.*'stop0'.*'rotor' is 0.115208 m"):
        Simulation(rotor([Stop(0.1)], angle=0.1 + math.asin(0.115208 / 0.4)))


def test_rates_that_disagree_with_the_joints_are_refused():
    rates = ((0.0, 0.0, 1.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    with pytest.raises(MechanismError, match="rates do not agree with the joints"):
        Simulation(four_bar(closed_four_bar(1.0), rates=rates, held=()))


def test_rates_follow_that_of_a_held_coordinate():
    rates = ((0.0, 0.0, 1.3), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    simulation = Simulation(four_bar(closed_four_bar(1.0), rates=rates))
    ahead, behind = (closed_four_bar(1.0 + step) for step in (1e-5, -1e-5))
    expected = 1.3 * (np.ravel(ahead) - np.ravel(behind)) / 2e-5
    np.testing.assert_allclose(simulation.field("y_end")[9:18], expected, rtol=0, atol=1e-9)
    assert simulation.field("y_end")[11] == 1.3


def test_rates_that_disagree_with_a_closed_contact_are_refused():
    with pytest.raises(MechanismError, match="rates do not agree"):
        Simulation(rotor([Stop(0.0, closed=True)], speed=0.1))


def test_rates_that_agree_are_kept():
    simulation = Simulation(rotor(speed=2.5))
    np.testing.assert_array_equal(simulation.field("y_end"), [0, 0, 0, 0, 0, 2.5, 0, 0])
