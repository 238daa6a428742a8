"""The ratchet over seconds: the swing after the impact, constraints, energy, communication steps, pulling contacts."""

import math
from itertools import pairwise

import numpy as np
import pytest

from benchmarks.ratchet import Parameters, build
from benchmarks.reference import FACE, SLOPE, constraints
from mechanism_fmu.simulation import Simulation
from models.ratchet.model import MODEL


def simulation_of(**values):
    return Simulation(MODEL.mechanism(MODEL.values(**values)))


def test_after_the_impact_the_four_bar_swings():
    simulation = simulation_of()
    times = np.arange(1.0, 12.0, 1e-3)
    angles, speeds = [], []
    for time in times:
        simulation.advance(time)
        found = simulation.read()
        angles.append(found["wheel_angle"])
        speeds.append(found["wheel_speed"])
    before = next(k for k, (a, b) in enumerate(pairwise(speeds)) if a > 0 >= b)
    stop = np.interp(0.0, [-speeds[before], -speeds[before + 1]], times[before : before + 2])
    assert stop == pytest.approx(4.9066, abs=5e-5)
    assert math.degrees(max(angles)) == pytest.approx(82.1675, abs=5e-5)
    assert math.degrees(min(angles)) == pytest.approx(74.4235, abs=5e-5)
    assert simulation.read()["impact_count"] == 1


@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_constraints_do_not_drift(restitution):
    plain = build(Parameters())
    simulation = simulation_of(restitution=restitution)
    for time in np.arange(0.0, 6.0, 1e-2):
        simulation.advance(time)
        q, qd = np.split(simulation.field("y_end")[:-2], 2)
        closed = (SLOPE, FACE) if simulation.field("contact_mode")[1] else (SLOPE,)
        phi, jacobian, _ = constraints(plain, q, qd, closed)
        assert np.abs(phi).max() < 1e-10
        assert np.abs(jacobian @ qd).max() < 1e-9


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_energy_ledger(restitution):
    """Work goes into motion, the spring and impacts; inputs that change do not upset the balance."""
    simulation = simulation_of(restitution=restitution)
    for time in np.arange(0.0, 6.0, 1e-2):
        if time > 2.0:
            simulation.set_input("drive_torque", 2e-3 * math.sin(5 * time))
            simulation.set_input("load_torque", 1e-3 * math.cos(3 * time))
            simulation.set_input("spring_preload", 1e-3 * (time - 2.0))
        simulation.advance(time)
        found = simulation.read()
        stored = found["kinetic_energy"] + found["spring_energy"] + found["energy_lost"]
        assert stored == pytest.approx(found["work_done"], abs=1e-12)
        assert found["energy_lost"] >= -1e-14  # what the rates' drift of 1e-12 makes of nothing lost


COMMON = np.arange(1, 121) * 0.05


def course(between):
    """Motion and force at the common times, with `between(k)` other communication points before each."""
    simulation = simulation_of(restitution=0.3)
    names = ("wheel_angle", "crank_angle", "pawl_angle", "wheel_speed", "crank_speed", "pawl_speed")
    names += ("contact_force", "face_gap", "impact_count", "impact_time", "impact_impulse", "energy_lost", "work_done")
    found, last = [], 0.0
    for k, time in enumerate(COMMON):
        for point in [*np.linspace(last, time, between(k) + 2)[1:-1], time]:
            simulation.advance(point)
        outputs = simulation.read()
        found.append([outputs[name] for name in names])
        last = time
    return np.array(found)


@pytest.mark.parametrize("between", [499, 49, lambda k: k * k % 17], ids=["0.1 ms", "1 ms", "uneven"])
def test_the_communication_step_does_not_change_the_motion(between):
    count = between if callable(between) else lambda _k: between
    np.testing.assert_array_equal(course(count), course(lambda _k: 0))


def test_the_slope_first_pulls_at_the_published_time():
    simulation = simulation_of(tooth_slope_angle=math.radians(95))
    simulation.advance(3.7)
    assert simulation.pulling_contacts() == {}
    simulation.advance(6.0)
    assert simulation.pulling_contacts()["slope"] == pytest.approx(3.769, abs=5e-4)


def test_a_steep_slope_pulls_before_the_impact():
    simulation = simulation_of(tooth_slope_angle=math.radians(105))
    simulation.advance(0.9)
    assert simulation.read()["impact_count"] == 0
    assert "slope" in simulation.pulling_contacts()


def test_the_base_case_never_pulls_at_the_first_tooth():
    simulation = simulation_of()
    simulation.advance(0.9)
    assert simulation.pulling_contacts() == {}
