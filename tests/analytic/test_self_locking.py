"""A pawl on a slope: it slides down to the root, or locks itself, when it stands within the cone of friction."""

import math

import pytest
from cycle import PERIOD, strokes

from mechanism_fmu.simulation import Simulation
from models.ratchet.model import MODEL

#: Links without mass push along themselves only, as in statics; the wheel alone is heavy.
LIGHT = {"pawl_mass": 1e-6, "pawl_inertia": 1e-10, "crank_mass": 1e-6, "crank_inertia": 1e-10}


def locking(**values):
    (found,) = (
        c.value for c in MODEL.mechanism(MODEL.values(**values)).calculated if c.name == "self_locking_friction"
    )
    return found


def test_the_paper_s_pawl_locks_at_the_tangent_of_its_angle_to_the_normal():
    """By hand: psi = 75 deg, beta_0 = 90 deg, so that the normal stands at 75 deg; the pawl at gamma = 190.835 deg."""
    gamma = Simulation(MODEL.build(MODEL.values())).read()["pawl_angle"]
    assert locking() == pytest.approx(math.tan(math.radians(75) - gamma), rel=1e-9)
    assert locking() == pytest.approx(2.0653, abs=1e-4)


@pytest.mark.parametrize("slope", [80, 90, 100])
@pytest.mark.parametrize("guided", [True, False])
@pytest.mark.parametrize("share", [0.9, 0.999, 0.99999, 1.00001, 1.001, 1.1])
def test_just_below_it_slides_and_just_above_it_locks(slope, guided, share):
    """The free pawl comes to rest on tooth 0, where the guided one stands."""
    values = {"tooth_slope_angle": math.radians(slope), **LIGHT}
    locks = locking(**values)
    simulation = Simulation(MODEL.build(MODEL.values(friction=share * locks, guided=guided, **values)))
    assert simulation.read()["slope_active"]
    simulation.advance(1e-3)
    found = simulation.read()
    assert bool(found["slope_sticks"]) == (share > 1)
    assert (found["slope_slip_speed"] < 0) == (share < 1)
    assert found["wheel_speed"] > 0  # either way


def test_an_indexing_ratchet_with_friction_comes_home_in_every_stroke():
    """With 0.5 its tip is at the root, on the tooth face, at the end of every stroke forwards."""
    clicks, at_face = _indexed(0.5)
    assert clicks == 3
    assert at_face == [1, 1, 1]


def test_with_twice_the_friction_that_locks_it_drives_without_the_face():
    """The tip goes on along the slope where it gripped it, and friction takes the wheel along, click by click."""
    clicks, at_face = _indexed(2.5)
    assert clicks == 3
    assert at_face == [0, 0, 0]


def _indexed(friction):
    """Clicks after three strokes, and whether the face carried at the end of each."""
    at_face = []
    steps = round(PERIOD / 0.01)
    for k, simulation in enumerate(strokes(until=3 * PERIOD, hold=0.01, friction=friction), 1):
        if k % steps == steps // 2:
            at_face.append(simulation.read()["face_active"])
    return simulation.read()["clicks"], at_face


def test_friction_that_locks_is_warned_of():
    assert MODEL.warned(MODEL.values(friction=2.06)) == []
    (message,) = MODEL.warned(MODEL.values(friction=2.07))
    assert "friction = 2.07 locks the pawl on the slope, at the start from 2.0653 on" in message
    free = {"guided": False, "tooth_count": 20, "tooth_slope_angle": math.radians(95)}
    (message,) = MODEL.warned(MODEL.values(friction=1.1 * locking(**free), **free))
    assert "locks the pawl" in message
