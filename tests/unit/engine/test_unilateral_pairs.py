"""Pairs of profiles that only push: lifting off, free flight, landing, resting; and where a contact point gets lost.

The cam is an eccentric circle of radius R with eccentricity e, driven at a constant speed w; under a flat face the
lift is y = R + e sin(phi), so that the face lifts off where m y'' = -m w^2 e sin(phi) falls below -G, at
sin(phi) = G / (m e w^2).
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from mechanism_fmu.model import AngleDriver, MechanismError
from mechanism_fmu.model.curves import constant, cosine
from mechanism_fmu.model.curves.motions import polynomial_motion
from mechanism_fmu.model.curves.profiles import circle, piecewise_profile
from mechanism_fmu.simulation import Simulation, SimulationError
from tests.slide_cam import FOLLOWER_MASS, SLIDE_CAM, WEIGHT, cam_mechanism

BIG, E, SPEED, ROLLER = 1.0, 0.3, 8.0, 0.25
GRAVITY = WEIGHT / FOLLOWER_MASS
RESTITUTION = 0.4


def driven(kind, *, profile=None, speed=SPEED, centre=(E, 0.0), **options):
    """The cam from phi = 0 on at a constant speed."""
    mechanism = cam_mechanism(kind, profile or circle(BIG), 0.0, speed, centre=centre, **{"height": 1.3, **options})
    return replace(mechanism, joints=(*mechanism.joints, AngleDriver("motor", "cam", polynomial_motion(0.0, speed))))


def lift(kind, time):
    """Height, speed and acceleration of the follower on the cam."""
    s, c = E * math.sin(SPEED * time), E * math.cos(SPEED * time)
    if kind == "flat":
        return BIG + s, SPEED * c, -(SPEED**2) * s
    w = math.sqrt((BIG + (ROLLER if kind == "roller" else 0.0)) ** 2 - c**2)
    w1 = c * s / w
    return s + w, SPEED * (c + w1), SPEED**2 * (-s + (c**2 - s**2 - w1**2) / w)


def take_off(kind):
    """When the follower would have to fall faster than free, the first time."""
    return brentq(lambda time: lift(kind, time)[2] + GRAVITY, 0.0, math.pi / 2 / SPEED, xtol=1e-15)


def landing(kind):
    start = take_off(kind)
    height, rate, _ = lift(kind, start)

    def above(time):
        t = time - start
        return height + rate * t - GRAVITY * t * t / 2 - lift(kind, time)[0]

    times = np.arange(start + 0.02, 3.0, 1e-3)
    first = next(t for t in times if above(t) < 0.0)
    time = brentq(above, first - 1e-3, first, xtol=1e-15)
    return time, rate - GRAVITY * (time - start)


@pytest.mark.parametrize("kind", ["flat", "roller", "point"])
def test_a_follower_lifts_off_flies_and_lands(kind):
    simulation = Simulation(driven(kind, unilateral=True, restitution=RESTITUTION))
    start = take_off(kind)
    simulation.advance(start + 0.01)
    (event,) = simulation.events_in_step()
    assert event.guard == "pair.force"
    assert event.time == pytest.approx(start, abs=1e-9)
    assert simulation.mode() == ()
    height, rate, _ = lift(kind, start)
    found = simulation.read()
    assert found["force"] == 0.0
    assert found["height"] == pytest.approx(height + rate * 0.01 - GRAVITY * 0.01**2 / 2, abs=1e-9)
    assert found["gap"] > 0.0
    end, falling = landing(kind)
    simulation.advance(end + 1e-6)
    impact = simulation.impacts_in_step()[0]
    assert impact.time == pytest.approx(end, abs=1e-9)
    surface, rising, _ = lift(kind, end)
    # The normal of the surface: the follower's speed along it is that of the guide times the cosine.
    c = E * math.cos(SPEED * end)
    cosine_ = 1.0 if kind == "flat" else math.sqrt(1 - (c / (BIG + (ROLLER if kind == "roller" else 0.0))) ** 2)
    closing = (rising - falling) * cosine_
    assert impact.closing_speed == pytest.approx(closing, rel=1e-8)
    assert impact.impulse == pytest.approx(FOLLOWER_MASS / cosine_**2 * (1 + RESTITUTION) * closing, rel=1e-8)
    assert simulation.read()["rise"] == pytest.approx(rising + RESTITUTION * (rising - falling), abs=1e-4)
    assert surface == pytest.approx(simulation.read()["height"], abs=1e-4)


@pytest.mark.parametrize("kind", ["flat", "roller", "point"])
def test_a_guided_follower_pulls_from_the_same_time_on(kind):
    """Where the guided contact force would turn negative, the unilateral follower lifts off."""
    simulation = Simulation(driven(kind))
    simulation.advance(take_off(kind) + 0.01)
    assert simulation.read()["force"] < 0.0
    assert simulation.pulling_contacts() == {"pair": pytest.approx(take_off(kind), abs=1e-9)}


@pytest.mark.parametrize("kind", ["flat", "roller", "point"])
def test_a_slow_follower_stays_on_its_cam(kind):
    simulation = Simulation(driven(kind, speed=1.0, unilateral=True))
    guided = Simulation(driven(kind, speed=1.0))
    for time in (1.0, 3.0, 8.0):
        simulation.advance(time)
        guided.advance(time)
        assert simulation.mode() == ("pair",)
        assert simulation.read() == pytest.approx(guided.read(), abs=1e-9)


@pytest.mark.parametrize("kind", ["flat", "roller", "point"])
def test_a_follower_that_falls_onto_a_resting_cam_bounces_and_rests(kind):
    """Each flight is e times as long as the one before; then it rests with its weight on the cam."""
    drop = 0.05
    low = {"flat": BIG, "roller": math.sqrt((BIG + ROLLER) ** 2 - E**2), "point": math.sqrt(BIG**2 - E**2)}[kind]
    mechanism = driven(kind, speed=0.0, unilateral=True, restitution=RESTITUTION, closed=False, height=low + drop)
    simulation = Simulation(mechanism)
    fall = math.sqrt(2 * drop / GRAVITY)
    end = fall * (1 + 2 * RESTITUTION / (1 - RESTITUTION))
    simulation.advance(fall * (1 + RESTITUTION))
    (impact,) = simulation.impacts_in_step()
    assert impact.time == pytest.approx(fall, abs=1e-9)
    assert simulation.read()["height"] == pytest.approx(low + drop * RESTITUTION**2, abs=1e-9)
    simulation.advance(end + 0.1)
    assert simulation.mode() == ("pair",)
    found = simulation.read()
    assert found["height"] == pytest.approx(low, abs=1e-8)
    cosine_ = low / {"flat": BIG, "roller": BIG + ROLLER, "point": BIG}[kind]
    assert found["force"] == pytest.approx(WEIGHT / cosine_, rel=1e-6)


def test_a_face_that_bridges_a_hollow_is_told():
    """On the nose of the slides' cam, a tangent is rho^2 / sqrt(rho^2 + rho'^2) from the centre: 1 m, as on its circle.

    The normal there has the angle alpha - atan(rho' / rho), and is vertical when the cam has turned by the rest to 90.
    """

    def rho(alpha):
        return 1.25 - 0.25 * math.cos(3 * alpha), 0.75 * math.sin(3 * alpha)

    def beyond(alpha):
        value, rate = rho(alpha)
        return value**2 / math.hypot(value, rate) - 1.0

    alpha = brentq(beyond, math.radians(14.96), 1.0, xtol=1e-15)
    value, rate = rho(alpha)
    simulation = Simulation(driven("flat", profile=SLIDE_CAM, speed=1.0, centre=(0.0, 0.0), height=1.5))
    with pytest.raises(SimulationError, match=r"have met at a second one.*Contacts: pair"):
        simulation.advance(3.0)
    assert simulation.time == pytest.approx(math.pi / 2 - alpha + math.atan2(rate, value), abs=0.02)


def test_an_open_pair_over_a_hollow_goes_over_to_the_nearest_side():
    """A point hovers over a turning cam: the nearest place changes sides, at the latest where the old one ends."""
    hovering = driven(
        "point", profile=SLIDE_CAM, speed=1.0, centre=(0.0, 0.0), unilateral=True, closed=False, height=3.0
    )
    simulation = Simulation(replace(hovering, forces=()))
    alphas = np.linspace(0.0, 2 * math.pi, 20001)
    radius = np.where(alphas < 2 * math.pi / 3, 1.25 - 0.25 * np.cos(3 * alphas), 1.0)
    near = 0
    for k in range(1, 64):
        simulation.advance(0.1 * k)
        place = alphas + 0.1 * k
        nearest = np.hypot(radius * np.cos(place), radius * np.sin(place) - 3.0).min()
        gap = simulation.read()["gap"]
        assert nearest - 1e-6 < gap < nearest + 0.1
        near += gap < nearest + 1e-6
    assert near >= 60


def test_a_roller_too_large_for_the_hollow_is_refused_at_the_start():
    """Its radius is 0.8 m in the hollow: smaller rollers touch at one point, and a large one in two."""
    small = cam_mechanism("roller", SLIDE_CAM, math.pi / 2, roller=0.7, height=2.0)
    assert Simulation(small).mode() == ("pair",)
    with pytest.raises(MechanismError, match=r"starts with two profiles that overlap.*'cam' reaches 0\.033\d* m into"):
        Simulation(cam_mechanism("roller", SLIDE_CAM, math.pi / 2, roller=3.0, height=4.0))


def test_a_hollow_that_is_too_narrow_for_the_roller_stops_it():
    """A dimple whose radius is about a fifth: a roller of 0.5 m touches both its sides."""
    wave = (2.0, (constant(1.1), cosine(-0.1, 6.0)))
    dimple = piecewise_profile((0.0, (constant(1.0),)), wave, (2.0 + math.pi / 3, (constant(1.0),)))
    options = {"profile": dimple, "speed": 1.0, "centre": (0.0, 0.0)}
    Simulation(driven("roller", roller=0.2, **options)).advance(6.5)
    with pytest.raises(SimulationError, match=r"have met at a second one"):
        Simulation(driven("roller", roller=0.5, **options)).advance(6.5)
