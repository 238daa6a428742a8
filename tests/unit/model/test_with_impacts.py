"""One law and one pair of numbers for the contacts of a mechanism: what it changes, and what it refuses."""

import math

import pytest

import models
from mechanism_fmu.model import (
    GROUND,
    AngleStop,
    Mechanism,
    MechanismError,
    Output,
    PointFollower,
    PointLineContact,
    Revolute,
    circle,
    rigid_body,
)
from mechanism_fmu.simulation import Simulation

BALL = rigid_body("ball", (0, 1e-9), mass=1.0, inertia=0.1, velocity=(1.0, -2.0))
FLOOR = PointLineContact("floor", BALL, GROUND.line((0, 0), (1, 0)), restitution=0.1, friction=0.3, friction_static=0.4)
STOP = AngleStop("stop", BALL, GROUND, angle=-3.0)
MECHANISM = Mechanism(bodies=(BALL,), contacts=(FLOOR, STOP), outputs=(Output("v", "ball.y_rate", ""),))


def test_contacts_that_strike_and_rub_take_the_numbers() -> None:
    changed = MECHANISM.with_impacts("stronge", restitution=0.5, friction=0.2)
    floor, stop = changed.contacts
    assert (floor.restitution, floor.friction, floor.friction_static) == (0.5, 0.2, None)
    assert stop == STOP
    assert changed.impact_law == "stronge"
    assert MECHANISM.contacts[0].restitution == 0.1


def test_the_motion_has_them() -> None:
    simulation = Simulation(MECHANISM.with_impacts("stronge", restitution=0.5, friction=0.2))
    simulation.advance(1e-6)
    assert math.isclose(simulation.read()["v"], 1.0)


def test_only_contacts_that_are_named_change() -> None:
    second = PointLineContact("wall", BALL, GROUND.line((5, 0), (0, 1)))
    both = Mechanism(bodies=(BALL,), contacts=(FLOOR, second))
    floor, wall = both.with_impacts("newton", 0.5, 0.2, contacts=["wall"]).contacts
    assert floor == FLOOR
    assert (wall.restitution, wall.friction) == (0.5, 0.2)


def test_all_places_of_an_outline_contact_change() -> None:
    model = models.load("ratchet_free").MODEL
    mechanism = model.mechanism(model.values())
    changed = mechanism.with_impacts("poisson", 0.3, 0.1, contacts=["tooth"])
    assert [c.name for c in changed.contacts] == [c.name for c in mechanism.contacts]
    tooth = [c for c in changed.contacts if c.name.startswith("tooth")]
    assert len(tooth) == 3
    assert {(c.restitution, c.friction) for c in tooth} == {(0.3, 0.1)}


@pytest.mark.parametrize("contacts", [["stop"], ["roof"]])
def test_a_contact_that_cannot_have_them_is_refused(contacts: list[str]) -> None:
    with pytest.raises(MechanismError, match=rf"Contact '{contacts[0]}' is none that can .* those that can: floor\."):
        MECHANISM.with_impacts("newton", 0.5, 0.2, contacts=contacts)


def test_a_mechanism_without_such_contacts_is_refused() -> None:
    held = PointFollower("pin", BALL, GROUND.at(0, 0), profile_j=circle(1.0))
    for parts in ({"contacts": (STOP, held)}, {"joints": (Revolute("pin", BALL, GROUND),)}):
        with pytest.raises(MechanismError, match=r"No contact of the mechanism can have .* those that can: none"):
            Mechanism(bodies=(BALL,), **parts).with_impacts("newton", 0.5, 0.2)
