"""The slider-crank against its closed form (benchmarks/slider_crank.py, independent of the library)."""

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
from scipy.optimize import minimize_scalar

from benchmarks.slider_crank import SliderCrank
from models.slider_crank.model import MODEL

slider_crank = partial(simulation_of, MODEL)
FORMS = {
    "central": ({}, {}),
    "offset": ({"offset": 0.06, "crank_centre": -0.01}, {"offset": 0.06, "crank_centre": -0.01}),
    "offset below": ({"offset": -0.1, "rod_length": 0.16}, {"offset": -0.1, "rod": 0.16}),
    "long crank": ({"crank_length": 0.19, "crank_angle_start": 1.0}, {"crank": 0.19}),
}


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("form", FORMS)
def test_rod_and_slider_follow_the_crank_as_the_closed_form_says(form, sense):
    values, lengths = FORMS[form]
    known = SliderCrank(**lengths)

    def exact(theta):
        return {
            ("rod_angle", "rod_speed"): known.rod_angle(theta),
            ("slider_position", "slider_velocity"): known.slider(theta),
        }

    assert_follows(slider_crank(crank_speed_start=sense * 8.0, **FREE, **values), exact, sense)


@pytest.mark.parametrize("form", FORMS)
def test_the_crank_moves_as_eksergians_equation_says(form):
    values, lengths = FORMS[form]
    known = SliderCrank(**lengths)
    start = values.get("crank_angle_start", 0.0)
    simulation = slider_crank(**values, **DRIVEN)
    assert_crank_moves(
        simulation, known.links, start, lambda theta: 0.3 * known.slider(theta).rate, {"load_force": 0.3}
    )


def test_energy_is_accounted_for():
    def set_inputs(simulation, time):
        simulation.set_input("load_force", 3.0 * math.sin(7 * time))

    simulation = slider_crank(
        joint_friction_radius=1e-4,
        slider_friction=0.1,
        crank_damping=1e-3,
        gravity=9.81,
        offset=0.03,
    )
    worst, exchanged = worst_imbalance(simulation, np.arange(1, 401) * 0.005, set_inputs)
    assert worst < 1e-8 * exchanged
    assert simulation.read()["energy_lost"] > 0.01


def test_a_slider_that_rubs_loses_its_coefficient_times_weight_times_way():
    """A light rod and a heavy slider: the guide carries the weight and, turned by the crank, little else."""
    simulation = slider_crank(
        slider_friction=1e-3,
        slider_mass=10.0,
        gravity=1e3,
        crank_inertia=1e6,
        rod_mass=1e-9,
        rod_inertia=1e-9,
        crank_speed_start=0.1,
        drive_damping=0.0,
        relative_tolerance=1e-10,
    )
    simulation.advance(20 * math.pi)
    found = simulation.read()
    assert found["energy_lost"] == pytest.approx(1e-3 * 10.0 * 1e3 * 2 * found["stroke"], rel=1e-2)


@pytest.mark.parametrize("offset", [0.0, 0.06, -0.1])
def test_the_stated_dead_positions_are_where_the_slider_turns_back(offset):
    known = SliderCrank(offset=offset)
    stated = {c.name: c.value for c in MODEL.mechanism(MODEL.values(offset=offset)).calculated}
    outer = -minimize_scalar(lambda theta: -known.slider(theta).value, bounds=(-2, 2), method="bounded").fun
    inner = minimize_scalar(lambda theta: known.slider(theta).value, bounds=(2, 5), method="bounded").fun
    assert stated["outer_dead_position"] == pytest.approx(outer, abs=1e-9)
    assert stated["inner_dead_position"] == pytest.approx(inner, abs=1e-9)
    assert stated["stroke"] == pytest.approx(outer - inner, abs=1e-9)


def test_a_rod_that_is_too_short_for_full_turns_lets_the_crank_swing_and_the_slider_pass():
    """Where the rod stands at a right angle to the slider's line the crank turns back; no energy is lost there."""
    values = {"rod_length": 0.04, "crank_inertia": 1e-3, "rod_inertia": 1e-4, "rod_centre": 0.02}
    simulation = slider_crank(crank_speed_start=5.0, **FREE, **values)
    energy = simulation.read()["kinetic_energy"]
    courses = []
    for time in np.arange(1, 301) * 0.005:
        simulation.advance(time)
        found = simulation.read()
        courses.append((found["crank_angle"], found["slider_position"]))
        theta, phi = found["crank_angle"], found["rod_angle"]
        assert 0.05 * math.sin(theta) + 0.04 * math.sin(phi) == pytest.approx(0.0, abs=1e-12)
        assert found["slider_position"] == pytest.approx(0.05 * math.cos(theta) + 0.04 * math.cos(phi), abs=1e-12)
        assert found["kinetic_energy"] == pytest.approx(energy, rel=1e-9)
    angles, positions = np.transpose(courses)
    assert np.abs(angles).max() == pytest.approx(math.asin(0.8), abs=1e-3)
    assert positions.min() == pytest.approx(0.01, abs=1e-4)


def test_the_reference_curve_is_met():
    assert_meets_reference(slider_crank(relative_tolerance=1e-12), "slider_crank", 1e-9)
    assert_meets_reference(slider_crank(), "slider_crank", 1e-7)
