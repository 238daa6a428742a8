"""The four-bar linkage against its closed form (benchmarks/four_bar.py, independent of the library)."""

import math
from functools import partial

import numpy as np
import pytest
from linkage import (
    DRIVEN,
    FREE,
    assert_crank_moves,
    assert_follows,
    assert_meets_reference,
    simulation_of,
    worst_imbalance,
)

from benchmarks.four_bar import FourBar
from models.four_bar.model import MODEL

four_bar = partial(simulation_of, MODEL)
#: Lengths of ground, crank, coupler, rocker [m].
LENGTHS = {
    "crank and rocker": (0.2, 0.05, 0.18, 0.12),
    "both turn fully": (0.05, 0.15, 0.12, 0.14),
    "shallow": (0.2, 0.05, 0.18, 0.08),
}


def values_of(lengths, crossed):
    names = ("ground_length", "crank_length", "coupler_length", "rocker_length")
    return {**dict(zip(names, lengths, strict=True)), "crossed": crossed}


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("crossed", [False, True], ids=["open", "crossed"])
@pytest.mark.parametrize("form", LENGTHS)
def test_coupler_and_rocker_follow_the_crank_as_freudensteins_equation_says(form, crossed, sense):
    known = FourBar(*LENGTHS[form], crossed)

    def exact(theta):
        phi, psi = known.angles(theta)
        return {("coupler_angle", "coupler_speed"): phi, ("rocker_angle", "rocker_speed"): psi}

    assert_follows(four_bar(crank_speed_start=sense * 8.0, **FREE, **values_of(LENGTHS[form], crossed)), exact, sense)


@pytest.mark.parametrize("crossed", [False, True], ids=["open", "crossed"])
@pytest.mark.parametrize("form", LENGTHS)
def test_the_crank_moves_as_eksergians_equation_says(form, crossed):
    known = FourBar(*LENGTHS[form], crossed)
    # A rocker that turns fully has no angle without turns, which its spring would need.
    spring = 0.0 if form == "both turn fully" else 0.05

    values = {"crank_angle_start": 0.3, "spring_stiffness": spring, "spring_free_angle": 0.5}
    simulation = four_bar(**values_of(LENGTHS[form], crossed), **values, **DRIVEN)
    middle = simulation.read()["rocker_angle"]

    def load(theta):
        _, psi = known.angles(theta)
        angle = math.remainder(psi.value - middle, 2 * math.pi) + middle
        return (0.02 - spring * (angle - 0.5)) * psi.rate

    assert_crank_moves(simulation, known.links, 0.3, load, {"load_torque": 0.02})


@pytest.mark.parametrize("crossed", [False, True], ids=["open", "crossed"])
def test_the_energy_of_an_undriven_linkage_drifts_by_less_than_1e_7_in_1000_s(crossed):
    """At the default tolerance, over more than 300 turns."""
    simulation = four_bar(crank_speed_start=2.0, drive_damping=0.0, crossed=crossed)
    energy = simulation.read()["kinetic_energy"]
    for time in range(5, 1001, 5):
        simulation.advance(float(time))
        assert simulation.read()["kinetic_energy"] == pytest.approx(energy, rel=1e-7)
    assert simulation.read()["crank_angle"] > 300 * 2 * math.pi


def test_energy_is_accounted_for():
    def set_inputs(simulation, time):
        simulation.set_input("load_torque", 0.05 * math.sin(7 * time))

    simulation = four_bar(joint_friction_radius=1e-4, crank_damping=1e-3, gravity=9.81, spring_stiffness=0.1)
    worst, exchanged = worst_imbalance(simulation, np.arange(1, 401) * 0.005, set_inputs)
    assert worst < 1e-8 * exchanged
    assert simulation.read()["energy_lost"] > 0.01


@pytest.mark.parametrize("form", LENGTHS)
def test_the_stated_transmission_angles_are_the_extreme_ones(form):
    known = FourBar(*LENGTHS[form])
    stated = {c.name: c.value for c in MODEL.mechanism(MODEL.values(**values_of(LENGTHS[form], False))).calculated}

    def transmission(theta):
        phi, psi = known.angles(theta)
        return abs(math.remainder(psi.value - phi.value, 2 * math.pi))

    assert stated["folded_transmission_angle"] == pytest.approx(transmission(0.0), abs=1e-12)
    assert stated["stretched_transmission_angle"] == pytest.approx(transmission(math.pi), abs=1e-12)
    angles = [transmission(theta) for theta in np.linspace(0.0, 2 * math.pi, 1000)]
    assert min(angles) >= stated["folded_transmission_angle"] - 1e-12
    assert max(angles) <= stated["stretched_transmission_angle"] + 1e-12


@pytest.mark.parametrize(
    ("lengths", "what"),
    [((0.2, 0.05, 0.14, 0.1), "coupler and rocker stretched"), ((0.2, 0.16, 0.2, 0.12), "coupler and rocker folded")],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_a_crank_that_cannot_turn_fully_swings_without_losing_energy(lengths, what):
    d, a, b, c = lengths
    simulation = four_bar(crank_speed_start=5.0, crank_angle_start=1.0, **FREE, **values_of(lengths, False))
    energy = simulation.read()["kinetic_energy"]
    angles = []
    for time in np.arange(1, 401) * 0.005:
        simulation.advance(time)
        found = simulation.read()
        theta, phi, psi = (found[f"{link}_angle"] for link in ("crank", "coupler", "rocker"))
        assert a * math.cos(theta) + b * math.cos(phi) == pytest.approx(d + c * math.cos(psi), abs=1e-12)
        assert a * math.sin(theta) + b * math.sin(phi) == pytest.approx(c * math.sin(psi), abs=1e-12)
        assert found["kinetic_energy"] == pytest.approx(energy, rel=1e-9)
        angles.append(theta)
    reach = b + c if what.endswith("stretched") else abs(b - c)
    limit = math.acos((a * a + d * d - reach * reach) / (2 * a * d))
    extreme = max(angles) if what.endswith("stretched") else min(angles)
    assert extreme == pytest.approx(limit, abs=2e-3)


def test_the_reference_curve_is_met():
    assert_meets_reference(four_bar(relative_tolerance=1e-12), "four_bar", 1e-9)
    assert_meets_reference(four_bar(), "four_bar", 1e-7)
