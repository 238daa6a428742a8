"""Pairs with hollow profiles that are open: their gap is that of the nearest place, wherever it is."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial import cKDTree

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    CamFollower,
    Force,
    Mechanism,
    MechanismError,
    Output,
    PointFollower,
    PointLineContact,
    Revolute,
    Translational,
    circle,
    harmonic_profile,
    polynomial_motion,
)
from mechanism_fmu.simulation import Simulation

RADIUS = 0.05
OUTPUTS = (
    Output("height", "follower.y", "", "m"),
    Output("gap", "pair.gap", "", "m"),
    Output("impact_count", "impact.count", "", type="Integer"),
)


def star(lobes, share):
    return harmonic_profile(RADIUS, (*[0.0] * (lobes - 1), share * RADIUS))


def radius(lobes, share, alpha):
    return RADIUS * (1 + share * np.cos(lobes * alpha))


@pytest.mark.parametrize(
    ("lobes", "share", "low"), [(4, 0.5, 0.5), (5, 0.5, 0.5), (6, 0.5, 0.5), (8, 0.3, 0.5), (8, 0.5, 0.3)]
)
def test_a_point_on_a_stop_is_struck_by_every_lobe_and_never_gets_inside(lobes, share, low):
    start = math.pi / lobes + math.pi / 2
    rest = RADIUS * (1 - share) + low * 2 * share * RADIUS
    mechanism = Mechanism(
        bodies=(
            Body("cam", 1.0, 1.0, (0.0, 0.0, start), (0.0, 0.0, -1.0)),
            Body("follower", 0.1, 1e-3, (0.0, rest, 0.0)),
        ),
        joints=(
            Revolute("shaft", "cam", (0.0, 0.0), GROUND, (0.0, 0.0)),
            Translational("guide", "follower", (0.0, 0.0), (0.0, 1.0), GROUND, (0.0, 0.0), (0.0, 1.0)),
            AngleDriver("motor", "cam", polynomial_motion(start, -1.0)),
        ),
        forces=(Force("weight", "follower", (0.0, -5.0)),),
        contacts=(
            PointFollower("pair", "follower", (0.0, 0.0), "cam", star(lobes, share), unilateral=True, closed=False),
            PointLineContact("stop", "follower", (0.0, 0.0), GROUND, (0.0, rest), (0.0, 1.0)),
        ),
        outputs=OUTPUTS,
    )
    simulation = Simulation(mechanism)
    highest = 0.0
    for k in range(1, 700):
        simulation.advance(0.01 * k)
        height = simulation.read()["height"]
        highest = max(highest, height)
        assert height - radius(lobes, share, math.pi / 2 - start + 0.01 * k) > -1e-9
    assert highest == pytest.approx(RADIUS * (1 + share), abs=2e-6)
    strokes = (lobes * 6.99 + math.pi) // (2 * math.pi)  # a lobe comes every turn / lobes, the first after half of that
    assert simulation.read()["impact_count"] >= strokes


@pytest.mark.parametrize("start", [1, 2, *(pytest.param(k, marks=pytest.mark.slow) for k in (3, 4))])
def test_free_bodies_with_lobes_strike_each_other_and_never_overlap(start):
    """The distance of both outlines, by brute force, is the gap; energy only falls by what an impact takes."""
    profile = star(3, 0.16)
    pair = CamFollower("pair", "one", profile, "follower", profile, unilateral=True, closed=False)
    generator = np.random.default_rng([5, start])
    alphas = np.linspace(0.0, 2 * math.pi, 1500)
    turns = generator.uniform(-20, 20, 2)
    mechanism = Mechanism(
        bodies=(
            Body("one", 1.0, 1e-3, (0.0, 0.0, generator.uniform(0, 6)), (0.0, 0.0, turns[0])),
            Body("follower", 1.0, 1e-3, (0.5, 0.01, generator.uniform(0, 6)), (-1.0, 0.0, turns[1])),
        ),
        contacts=(replace(pair, restitution=0.5),),
        outputs=(*OUTPUTS, Output("kinetic", "energy.kinetic", "", "J"), Output("lost", "energy.lost", "", "J")),
    )
    simulation = Simulation(mechanism)
    energy = simulation.read()["kinetic"]
    for k in range(1, 81):
        simulation.advance(0.01 * k)
        found = simulation.read()
        q = simulation.field("y_at")  # where the outputs were read
        outlines = []
        for x, y, phi in (q[0:3], q[3:6]):
            rho = radius(3, 0.16, alphas)
            outlines.append(np.column_stack([x + rho * np.cos(alphas + phi), y + rho * np.sin(alphas + phi)]))
        distance = cKDTree(outlines[0]).query(outlines[1][::5])[0].min()
        if found["gap"] > 1e-3:
            assert found["gap"] == pytest.approx(distance, abs=2e-4)
        assert found["kinetic"] + found["lost"] == pytest.approx(energy, rel=1e-7)
    assert found["impact_count"] >= 1


def test_a_disabled_pair_changes_nothing():
    """It stands where its contact point is not determined: in the centre of a circle."""
    bodies = (Body("follower", 1.0, 1.0, (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)),)
    joints = (Revolute("hinge", "follower", (0.0, 0.0), GROUND, (0.0, 0.0)),)
    pair = PointFollower("pair", "follower", (0.0, 0.0), GROUND, circle(0.1), unilateral=True, enabled=0)
    turned = []
    for contacts in ((), (pair,)):
        outputs = (Output("angle", "follower.angle", "", "rad"),)
        simulation = Simulation(Mechanism(bodies=bodies, joints=joints, contacts=contacts, outputs=outputs))
        simulation.advance(1.0)
        turned.append(simulation.read()["angle"])
    assert turned[0] == pytest.approx(turned[1], abs=1e-12)


@pytest.mark.parametrize("profile", [circle(0.0), circle(-0.01), harmonic_profile(0.05, (0.08,))])
def test_a_profile_that_reaches_its_centre_is_refused_by_name(profile):
    mechanism = Mechanism(
        bodies=(Body("follower", 1.0, 1.0, (0.0, 0.2, 0.0)),),
        contacts=(PointFollower("pair", "follower", (0.0, 0.0), GROUND, profile),),
    )
    with pytest.raises(MechanismError, match=r"reaches its own centre.*Contact 'pair'"):
        Simulation(mechanism)
