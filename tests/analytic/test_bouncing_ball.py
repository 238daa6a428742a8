"""A ball on a floor: every bounce has a closed form."""

import math

import pytest
from hypothesis import example, given, settings, strategies as st

from mechanism_fmu import codes
from mechanism_fmu.engine.dynamics.scaling import LENGTH, RATE
from mechanism_fmu.model import GROUND, Body, Force, Mechanism, Output, PointLineContact, Settings
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tolerances import STICK_SPEED

GRAVITY = 9.81


def speed_scale(speed):
    """Scale of the speeds of a ball with a radius of gyration of 1 m that falls, and strikes with a speed [m/s]."""
    return max(math.sqrt(GRAVITY), speed) / (LENGTH * RATE)


def ball(restitution, *, height=1.0, mass=1.0, tolerance=1e-12, contacts=1):
    floor = [
        PointLineContact(f"floor{k}", "ball", (0, 0), GROUND, (0, 0), (0.0, 1.0), restitution=restitution)
        for k in range(contacts)
    ]
    return Mechanism(
        bodies=(Body("ball", mass, mass, (0.0, height, 0.0)),),
        forces=(Force("weight", "ball", (0.0, -mass * GRAVITY)),),
        contacts=tuple(floor),
        outputs=(
            Output("height", "ball.y", "", "m"),
            Output("kinetic", "energy.kinetic", "", "J"),
            Output("work", "energy.work", "", "J"),
            Output("lost", "energy.lost", "", "J"),
            Output("force", "floor0.force", "", "N"),
        ),
        settings=Settings(relative_tolerance=tolerance),
    )


def bounces(height, restitution):
    """Times of all impacts until the ball leaves more slowly than the stick speed, and the closing speed of each."""
    speed = math.sqrt(2 * GRAVITY * height)
    time = speed / GRAVITY
    found = [(time, speed)]
    while restitution * speed >= speed_scale(speed) * STICK_SPEED:
        speed *= restitution
        time += 2 * speed / GRAVITY
        found.append((time, speed))
    return found


@pytest.mark.parametrize("restitution", [0.0, 0.3, 0.7])
def test_impact_times_up_to_the_stick_speed_and_then_rest(restitution):
    expected = bounces(1.0, restitution)
    simulation = Simulation(ball(restitution))
    found = []
    for time, _ in expected:
        simulation.advance(time * (1 + 1e-13))
        found += [(hit.time, hit.closing_speed) for hit in simulation.impacts_in_step()]
    simulation.advance(10.0)
    found += [(hit.time, hit.closing_speed) for hit in simulation.impacts_in_step()]
    assert len(found) == len(expected)
    for (time, speed), (expected_time, expected_speed) in zip(found, expected, strict=True):
        assert time == pytest.approx(expected_time, abs=1e-10)
        assert speed == pytest.approx(expected_speed, abs=1e-10)
    assert simulation.mode() == ("floor0",)
    at_rest = simulation.read()
    assert at_rest["height"] == pytest.approx(0.0, abs=1e-12)
    assert at_rest["kinetic"] == 0.0
    assert at_rest["force"] == pytest.approx(GRAVITY, rel=1e-12)
    assert at_rest["lost"] == pytest.approx(GRAVITY, rel=1e-12)


@settings(deadline=None, max_examples=30)
@given(st.floats(0.0, 0.95), st.floats(1e-3, 1e3), st.floats(1e-6, 1e6))
@example(restitution=1e-6, height=1.0, mass=1.0)  # what rebounds is slow beside what has struck
@example(restitution=0.875, height=0.001, mass=0.001)  # a step ends within a hop that is 2e-12 m high
def test_any_ball_comes_to_rest_when_the_series_says(restitution, height, mass):
    """A geometric series: t = t_1 (1 + e) / (1 - e), less what is below the stick speed; all energy is lost."""
    simulation = Simulation(ball(restitution, height=height, mass=mass))
    first = math.sqrt(2 * height / GRAVITY)
    end = first * (1 + restitution) / (1 - restitution)
    simulation.advance(end + 1e-3)
    assert simulation.mode() == ("floor0",)
    assert simulation.counters[codes.COUNT_IMPACTS] == len(bounces(height, restitution))
    found = simulation.read()
    assert found["lost"] == pytest.approx(mass * GRAVITY * height, rel=1e-9)
    assert found["kinetic"] <= 1e-15 * found["lost"]


def test_a_ball_on_the_same_floor_three_times_bounces_like_one():
    """Rows that depend on each other: three equal contacts strike at once."""
    once, thrice = Simulation(ball(0.5)), Simulation(ball(0.5, contacts=3))
    for simulation in (once, thrice):
        simulation.advance(1.0)
    assert thrice.read()["height"] == pytest.approx(once.read()["height"], abs=1e-12)
    assert thrice.counters[codes.COUNT_IMPACTS] == 3 * once.counters[codes.COUNT_IMPACTS]
    thrice.advance(5.0)
    assert thrice.read()["height"] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("height", [1e-14, 1e-12, 1e-9, 1e-6])
@pytest.mark.parametrize("restitution", [0.0, 0.9])
def test_drops_from_almost_nothing_end_at_rest(height, restitution):
    simulation = Simulation(ball(restitution, height=height))
    simulation.advance(1.0)
    assert simulation.mode() == ("floor0",)
    assert abs(simulation.read()["height"]) <= 1e-9
