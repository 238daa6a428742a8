"""Who takes part in an impact and as what: a ball on walls, in closed form."""

import math

import numpy as np
import pytest

from mechanism_fmu import codes
from mechanism_fmu.engine.dynamics.scaling import LENGTH, RATE
from mechanism_fmu.model import (
    GROUND,
    Body,
    LogicalFunction,
    Mechanism,
    Output,
    PointLineContact,
    TranslationalDriver,
    polynomial_motion,
)
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tolerances import RESTS_BELOW, STICK_SPEED, TOUCHES_WITHIN

MASS = 0.7
#: What has scale 1 (`dynamics.scaling`), and the ball's radius of gyration and its speed of 1 m/s over that.
SIZE, SPEED = math.sqrt(0.1 / MASS) / LENGTH, 1.0 / (LENGTH * RATE)
TOUCHES, RESTS, STICKS = SIZE * TOUCHES_WITHIN, SPEED * RESTS_BELOW, SPEED * STICK_SPEED
ENERGIES = tuple(Output(name, f"energy.{name}", "") for name in ("kinetic", "work", "lost"))


def floor(**options):
    return wall("floor", (0.0, 0.0), (0.0, 1.0), **options)


def wall(name, place, normal, **options):
    return PointLineContact(name, "ball", (0.0, 0.0), GROUND, place, normal, **options)


def ball(contacts, start, rate):
    body = Body("ball", MASS, 0.1, (*start, 0.0), (*rate, 0.0))
    outputs = (*ENERGIES, Output("y", "ball.y", ""))
    return Simulation(Mechanism(bodies=(body,), contacts=tuple(contacts), outputs=outputs))


def impulses(simulation):
    """Of every contact, in the first impact of the step."""
    first = codes.RECORD_CONTACT_IMPULSES
    return simulation.field("impacts")[0, first : first + simulation.field("contact_mode").size]


def rates(simulation):
    return simulation.field("y_end")[3:5]


def rising(angle):
    """The normal of a wall that a ball meets on its way along x, turned up by `angle`."""
    return (-math.cos(angle), math.sin(angle))


@pytest.mark.parametrize("restitution", [0.0, 0.4, 1.0])
@pytest.mark.parametrize("degrees", [-50, -10, 0, 30, 70])
def test_a_guided_floor_keeps_its_row_and_pushes_or_pulls(degrees, restitution):
    """Only x is free: v+ = -e v, and what the wall gives across is taken by the floor."""
    angle = math.radians(degrees)
    slope = wall("slope", (1.0, 0.0), rising(angle), restitution=restitution)
    simulation = ball([floor(closed=True, guided=True), slope], (0.0, 0.0), (2.0, 0.0))
    simulation.advance(0.75)
    expected = (1 + restitution) * MASS * 2.0 / math.cos(angle)
    np.testing.assert_allclose(rates(simulation), [-restitution * 2.0, 0.0], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(impulses(simulation), [-expected * math.sin(angle), expected], rtol=1e-12, atol=1e-14)
    assert [hit.contact for hit in simulation.impacts_in_step()] == ["slope"]
    assert simulation.mode() == (("floor",) if restitution else ("floor", "slope"))


@pytest.mark.parametrize("restitution", [0.0, 0.4, 1.0])
@pytest.mark.parametrize("degrees", [-50, -10, 30, 70])
def test_a_floor_that_only_pushes_holds_what_is_driven_down_and_lets_go_what_is_driven_up(degrees, restitution):
    angle = math.radians(degrees)
    slope = wall("slope", (1.0, 0.0), rising(angle), restitution=restitution)
    simulation = ball([floor(), slope], (0.0, 0.0), (2.0, 0.0))
    assert simulation.mode() == ("floor",)
    simulation.advance(0.51)
    closing = 2.0 * math.cos(angle)
    expected = (1 + restitution) * MASS * closing
    if degrees < 0:
        expected /= math.cos(angle) ** 2
        np.testing.assert_allclose(rates(simulation), [-restitution * 2.0, 0.0], rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(impulses(simulation), [-expected * math.sin(angle), expected], rtol=1e-12)
        assert "floor" in simulation.mode()
    else:
        after = np.array([2.0, 0.0]) + expected / MASS * np.array(rising(angle))
        np.testing.assert_allclose(rates(simulation), after, rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(impulses(simulation), [0.0, expected], rtol=1e-12)
        assert "floor" not in simulation.mode()
    (hit,) = simulation.impacts_in_step()
    assert (hit.contact, hit.closing_speed) == ("slope", pytest.approx(closing, rel=1e-12))


def low_flight(height, *, fall=0.0, degrees=-30, **options):
    """A ball flies along x against a wall 1 m away, where it is at `height`, sinking at the rate `fall`."""
    slope = wall("slope", (1.0, 0.0), rising(math.radians(degrees)))
    simulation = ball([floor(**options), slope], (0.0, height + fall), (1.0, -fall))
    assert simulation.mode() == ()
    simulation.begin_step()
    simulation.go_on(1.5, codes.STOP_AT_IMPACT)
    return simulation


SLOW = 0.5 * RESTS
S, C = math.sin(math.radians(30)), math.cos(math.radians(30))


def test_a_contact_within_reach_takes_part_though_it_is_open():
    """Both hold the ball at once: one impact, after which the ball rests in the corner."""
    simulation = low_flight(0.7 * TOUCHES, fall=SLOW)
    assert [hit.contact for hit in simulation.impacts_in_step()] == ["slope"]
    np.testing.assert_allclose(impulses(simulation), [MASS * S / C, MASS / C], rtol=1e-8)
    np.testing.assert_allclose(rates(simulation), 0.0, atol=1e-12)
    assert simulation.mode() == ("floor", "slope")


@pytest.mark.parametrize("height", [2 * TOUCHES, 1e-5])
def test_a_contact_out_of_reach_takes_no_part(height):
    """The ball is sent down along the wall, and strikes the floor later."""
    simulation = low_flight(height)
    assert [hit.contact for hit in simulation.impacts_in_step()] == ["slope"]
    np.testing.assert_allclose(impulses(simulation), [0.0, MASS * C], rtol=1e-8)
    np.testing.assert_allclose(rates(simulation), [S**2, -S * C], rtol=1e-8)
    assert simulation.mode() == ("slope",)


@pytest.mark.parametrize(("fall", "struck"), [(SLOW, ["slope"]), (5 * SLOW, ["floor", "slope"])])
def test_a_contact_within_reach_strikes_when_it_approaches_faster_than_at_rest(fall, struck):
    simulation = low_flight(0.7 * TOUCHES, fall=fall)
    hits = simulation.impacts_in_step()
    assert [hit.contact for hit in hits] == struck
    assert hits[0].closing_speed == pytest.approx(fall if len(hits) == 2 else C, rel=1e-6)
    assert simulation.mode() == ("floor", "slope")


def test_an_open_guided_contact_within_reach_takes_no_part_while_it_is_at_rest():
    """Driven up, the ball is free of it; driven down, it strikes the floor in the next round, at the same instant."""
    up = low_flight(0.7 * TOUCHES, fall=SLOW, degrees=30, guided=True)
    np.testing.assert_allclose(impulses(up), [0.0, MASS * C], rtol=1e-8)
    np.testing.assert_allclose(rates(up), [S**2, S * C], rtol=1e-8)
    down = low_flight(0.7 * TOUCHES, fall=SLOW, guided=True)
    np.testing.assert_allclose(impulses(down), [0.0, MASS * C], rtol=1e-8)
    first, second = down.impacts_in_step()[:2]
    assert (first.contact, second.contact) == ("slope", "floor")
    assert second.time == first.time
    assert second.closing_speed == pytest.approx(S * C, rel=1e-8)
    assert down.mode() == ("floor", "slope")


@pytest.mark.parametrize(("factor", "returned"), [(1 + 1e-6, 0.5), (1 - 1e-6, 0.0)])
def test_an_impact_that_would_return_more_slowly_than_the_stick_speed_sticks(factor, returned):
    speed = factor * STICKS / 0.5
    simulation = ball([floor(restitution=0.5)], (0.0, speed), (1.0, -speed))
    simulation.advance(1.5)
    (hit,) = simulation.impacts_in_step()
    assert hit.impulse == pytest.approx((1 + returned) * MASS * speed, rel=1e-9)
    assert rates(simulation)[1] == pytest.approx(returned * speed, rel=1e-9, abs=1e-16)
    assert simulation.mode() == (() if returned else ("floor",))


def test_what_nothing_presses_returns_however_slowly():
    speed = 1e-9
    simulation = ball([floor(restitution=0.5)], (0.0, speed), (0.0, -speed))
    simulation.advance(1.5)
    assert rates(simulation)[1] == pytest.approx(0.5 * speed, rel=1e-9)


@pytest.mark.parametrize("guided", [True, False])
def test_what_arrives_more_slowly_than_at_rest_is_caught_but_strikes_only_if_guided(guided):
    speed = 0.5 * RESTS
    simulation = ball([floor(guided=guided)], (0.0, 10 * speed), (1.0, -speed))
    simulation.advance(20.0)
    assert len(simulation.impacts_in_step()) == guided
    assert simulation.mode() == ("floor",)
    np.testing.assert_allclose(rates(simulation)[1], 0.0, atol=1e-18 if guided else RESTS)


def test_a_guided_contact_that_bounces_is_open_afterwards():
    simulation = ball([floor(guided=True, restitution=0.5)], (0.0, 1.0), (0.0, -1.0))
    simulation.advance(2.0)
    assert simulation.mode() == ()
    assert simulation.read()["y"] == pytest.approx(0.5, rel=1e-12)


def test_a_contact_that_does_not_exist_takes_no_part():
    slope = wall("slope", (1.0, 0.0), rising(-0.5))
    simulation = ball([floor(enabled=False), slope], (0.0, 0.0), (2.0, 0.0))
    simulation.advance(0.6)
    np.testing.assert_allclose(impulses(simulation), [0.0, 2 * MASS * math.cos(0.5)], rtol=1e-12)
    assert simulation.mode() == ("slope",)


@pytest.mark.parametrize("fall", [2.0, 0.5 * RESTS_BELOW])
def test_a_row_that_a_function_closes_takes_the_speed_across_it(fall):
    """If it closes in motion, that is an impact; with a wall to be struck afterwards, it holds like a joint."""
    rail = PointLineContact("rail", "ball", (0.0, 0.0), GROUND, (0.0, 0.0), (0.0, 1.0), closed_while="not before")
    slope = wall("slope", (1.0, 0.0), rising(0.5), restitution=0.5)
    body = Body("ball", MASS, 0.1, (-1.0, fall, 0.0), (1.0, -fall, 0.0))
    simulation = Simulation(
        Mechanism(
            bodies=(body,),
            contacts=(rail, slope),
            functions=(LogicalFunction("before", of="rail.along", below=0.0),),
            outputs=ENERGIES,
        )
    )
    simulation.advance(1.5)
    hits = [(hit.contact, hit.closing_speed, hit.energy_lost) for hit in simulation.impacts_in_step()]
    assert hits == ([("rail", pytest.approx(fall), pytest.approx(MASS / 2 * fall**2))] if fall > RESTS else [])
    (event,) = simulation.events_in_step()
    assert event.impulse == pytest.approx(MASS * fall if fall > RESTS else 0.0, rel=1e-9)
    np.testing.assert_allclose(rates(simulation), [1.0, 0.0], atol=1e-15)
    assert simulation.read()["lost"] == pytest.approx(MASS / 2 * fall**2, rel=1e-9, abs=1e-15)
    simulation.advance(2.5)
    (hit,) = simulation.impacts_in_step()
    assert hit.impulse == pytest.approx(1.5 * MASS / math.cos(0.5), rel=1e-9)
    np.testing.assert_allclose(rates(simulation), [-0.5, 0.0], atol=1e-12)
    assert simulation.mode() == ("rail",)


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_a_driver_does_work_in_an_impact(restitution):
    """A ram at constant speed u strikes a ball at rest: p = (1 + e) m u, and the driver gives p u at once."""
    u = 2.0
    ram = Body("ram", 3.0, 1.0, (0.0, 0.0, 0.0), (u, 0.0, 0.0))
    face = PointLineContact("face", "ball", (0.0, 0.0), "ram", (0.0, 0.0), (1.0, 0.0), restitution=restitution)
    motor = TranslationalDriver("motor", "ram", (0.0, 0.0), (1.0, 0.0), polynomial_motion(0.0, u))
    simulation = Simulation(
        Mechanism(
            bodies=(ram, Body("ball", MASS, 0.1, (1.0, 0.0, 0.0))),
            joints=(motor,),
            contacts=(face,),
            outputs=ENERGIES,
        )
    )
    simulation.advance(0.75)
    (hit,) = simulation.impacts_in_step()
    assert hit.impulse == pytest.approx((1 + restitution) * MASS * u, rel=1e-12)
    found = simulation.read()
    assert found["work"] == pytest.approx((1 + restitution) * MASS * u**2, rel=1e-9)
    assert found["lost"] == pytest.approx((1 - restitution**2) * MASS * u**2 / 2, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("height", [1e8 / 3, 1e8 / 7, 1e9 / 43])
def test_what_is_struck_takes_part_however_far_rounding_leaves_it_from_zero(height):
    """At 1e8 m/s, and so far from the origin, the gap at the impact is zero to 1e-8 m only."""
    simulation = ball([wall("lid", (0.0, height), (0.0, -1.0), restitution=0.5)], (0.0, -height), (0.0, 1e8))
    simulation.advance(3 * height / 1e8)
    (hit,) = simulation.impacts_in_step()
    assert hit.time == pytest.approx(2 * height / 1e8, rel=1e-14)
    assert rates(simulation)[1] == pytest.approx(-0.5e8, rel=1e-12)
