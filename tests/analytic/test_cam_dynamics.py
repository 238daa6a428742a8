"""Cams and followers in motion: one degree of freedom, whose equation is known where the lift is."""

import math
from dataclasses import replace

import numpy as np
import pytest

from mechanism_fmu.kinematics import cam_report
from mechanism_fmu.model import Settings
from mechanism_fmu.model.curves.profiles import circle
from mechanism_fmu.simulation import Simulation
from tests.slide_cam import CAM_INERTIA, EGG, FOLLOWER_MASS, SLIDE_CAM, TORQUE, WEIGHT, cam_mechanism

BIG, E, ROLLER = 1.0, 0.3, 0.25


def eccentric_lift(phi, roller):
    """Lift and two derivatives of an eccentric circle under a roller, or under a flat face (None)."""
    s, c = E * math.sin(phi), E * math.cos(phi)
    if roller is None:
        return BIG + s, c, -s
    w = math.sqrt((BIG + roller) ** 2 - c**2)
    w1 = c * s / w
    return s + w, c + w1, -s + (c**2 - s**2 - w1**2) / w


def lagrange(lift, speed):
    """Angular acceleration of the cam, and the contact force along the guide.

    (J + m y'^2) phi'' + m y' y'' phi'^2 = T - G y', and N = m (y' phi'' + y'' phi'^2) + G.
    """
    _, first, second = lift
    turn = (TORQUE - WEIGHT * first - FOLLOWER_MASS * first * second * speed**2) / (
        CAM_INERTIA + FOLLOWER_MASS * first**2
    )
    return turn, FOLLOWER_MASS * (first * turn + second * speed**2) + WEIGHT


@pytest.mark.parametrize(("kind", "roller"), [("flat", None), ("roller", ROLLER), ("point", 0.0)])
def test_eccentric_circles_accelerate_as_lagranges_equation_says(kind, roller):
    random = np.random.default_rng(5)
    for phi, speed in zip(random.uniform(0, 6, 8), random.uniform(-5, 5, 8), strict=True):
        mechanism = cam_mechanism(kind, circle(BIG), phi, speed, 1.3, centre=(E, 0.0))
        simulation = Simulation(replace(mechanism, settings=Settings(1e-9, 0.0, 0.0)))
        lift = eccentric_lift(phi, roller)
        turn, along = lagrange(lift, speed)
        found = simulation.read()
        assert found["height"] == pytest.approx(lift[0], abs=1e-12)
        assert found["rise"] == pytest.approx(lift[1] * speed, abs=1e-11)
        assert simulation.read_rates()["speed"] == pytest.approx(turn, rel=1e-9, abs=1e-9)
        pressure = 0.0 if roller is None else math.asin(E * math.cos(phi) / (BIG + roller))
        assert found["force"] == pytest.approx(along / math.cos(pressure), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("kind", ["roller", "point"])
@pytest.mark.parametrize("profile", [SLIDE_CAM, EGG], ids=["slides", "egg"])
def test_cams_accelerate_as_lagranges_equation_says(kind, profile):
    """Lift by kinematic analysis, with the cam turning at 1 rad/s."""
    report = cam_report(cam_mechanism(kind, profile, 0.05), "pair", "cam", 9)
    lifts = np.array(report.motion.of("follower.y")).T
    for phi, lift in list(zip(report.cam_angle, lifts, strict=True))[:9]:
        simulation = Simulation(replace(cam_mechanism(kind, profile, phi, 2.5), settings=Settings(1e-9, 0.0, 0.0)))
        assert simulation.read()["height"] == pytest.approx(lift[0], abs=1e-11)
        turn, _ = lagrange(lift, 2.5)
        assert simulation.read_rates()["speed"] == pytest.approx(turn, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(
    ("kind", "profile"), [("roller", SLIDE_CAM), ("point", SLIDE_CAM), ("flat", EGG), ("roller", EGG)]
)
def test_energy_is_kept_over_several_turns(kind, profile):
    simulation = Simulation(cam_mechanism(kind, profile, 0.3, 6.0))
    start = simulation.read()
    for time in np.linspace(0.25, 4.0, 16):
        simulation.advance(time)
        found = simulation.read()
        assert found["kinetic"] - found["work"] == pytest.approx(start["kinetic"], rel=1e-8)
        work = TORQUE * (found["angle"] - start["angle"]) - WEIGHT * (found["height"] - start["height"])
        assert found["work"] == pytest.approx(work, rel=1e-8, abs=1e-8)
        assert abs(found["gap"]) < 1e-10
    assert found["angle"] > 3 * 2 * math.pi
    assert found["lost"] == 0.0
