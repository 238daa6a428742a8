"""The gear train against its closed form (benchmarks/gear_train.py, independent of the library)."""

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings, strategies as st

from benchmarks.gear_train import Pair, motion
from mechanism_fmu import codes
from mechanism_fmu.simulation import Simulation
from models.gear_train.model import MODEL

ACCELERATIONS = (45.8259325044, -19.0941385435)
EXACT = {"relative_tolerance": 1e-12}


def simulation_of(**values):
    return Simulation(MODEL.build(MODEL.values(**values)))


def values_of(pair):
    return {
        "pinion_inertia": pair.J1,
        "wheel_inertia": pair.J2,
        "pinion_radius": pair.R1,
        "wheel_radius": pair.R2,
        "pinion_damping": pair.d1,
        "wheel_damping": pair.d2,
    }


def assert_moves_as(found, exact, within=1e-9):
    assert found["pinion_angle"] == pytest.approx(exact.angles[0], rel=within, abs=within)
    assert found["wheel_angle"] == pytest.approx(exact.angles[1], rel=within, abs=within)
    assert found["pinion_speed"] == pytest.approx(exact.speeds[0], rel=within, abs=within)
    assert found["wheel_speed"] == pytest.approx(exact.speeds[1], rel=within, abs=within)
    assert found["mesh_force"] == pytest.approx(exact.force, rel=1e-8, abs=1e-8)


def test_the_slides_pair_is_the_default():
    """ME451: J1 = .02, J2 = .11, R1 = .05, R2 = .12, T1 = 1.5, T2 = -.7."""
    simulation = simulation_of()
    rates = simulation.read_rates()
    for name, acceleration in zip(("pinion_speed", "wheel_speed"), ACCELERATIONS, strict=True):
        assert rates[name] == pytest.approx(acceleration, abs=1e-10)
    simulation.advance(0.1)
    found = simulation.read()
    for name, acceleration in zip(("pinion_speed", "wheel_speed"), ACCELERATIONS, strict=True):
        assert found[name] / 0.1 == pytest.approx(acceleration, abs=1e-9)
    assert motion(Pair(), 0.0).accelerations == pytest.approx(ACCELERATIONS, abs=1e-10)


def test_speeds_grow_in_proportion_to_time():
    simulation = simulation_of(**EXACT)
    for time in (0.25, 0.5, 1.0, 2.0):
        simulation.advance(time)
        assert_moves_as(simulation.read(), motion(Pair(), time))


def test_mesh_force_in_closed_form():
    R1, R2, J1, J2, T1, T2 = 0.05, 0.12, 0.02, 0.11, 1.5, -0.7
    force = -(R1 * T1 / J1 + R2 * T2 / J2) / (R1**2 / J1 + R2**2 / J2)
    found = simulation_of().read()
    assert found["mesh_force"] == pytest.approx(force, rel=1e-13)
    # torques without the other gear's: the mesh transmits what holds both at rest
    still = simulation_of()
    still.set_input("load_torque", 1.5 * R2 / R1)
    still.advance(1.0)
    found = still.read()
    assert found["mesh_force"] == pytest.approx(-1.5 / R1, rel=1e-12)
    assert found["pinion_speed"] == pytest.approx(0.0, abs=1e-11)


@settings(deadline=None, max_examples=40)
@given(
    sizes=st.tuples(*[st.floats(0.02, 0.5)] * 4),
    torques=st.tuples(*[st.floats(-3, 3)] * 2),
    dampings=st.tuples(*[st.just(0.0) | st.floats(0.01, 0.3)] * 2),
    angle=st.floats(-50, 50),
    speed=st.floats(-20, 20),
)
def test_any_pair_moves_in_closed_form_from_any_start(sizes, torques, dampings, angle, speed):
    J1, J2, R1, R2 = sizes
    pair = Pair(J1, J2, R1, R2, *torques, *dampings)
    simulation = simulation_of(**values_of(pair), pinion_angle_start=angle, pinion_speed_start=speed, **EXACT)
    simulation.set_input("drive_torque", pair.T1)
    simulation.set_input("load_torque", pair.T2)
    for time in (0.0, 0.2, 0.7):
        simulation.advance(time)
        assert_moves_as(simulation.read(), motion(pair, time, angle, speed))


@pytest.mark.parametrize("angle", [0.0, 1.0, -7.0, 700.3, -1000.0])
def test_it_starts_at_any_angle_just_there(angle):
    found = simulation_of(pinion_angle_start=angle, pinion_speed_start=3.0).read()
    assert found["pinion_angle"] == angle
    assert found["wheel_angle"] == pytest.approx(found["ratio"] * angle, rel=1e-15)
    assert found["wheel_speed"] == pytest.approx(found["ratio"] * 3.0, rel=1e-15)
    assert found["ratio"] == pytest.approx(-5 / 12, rel=1e-15)


@pytest.mark.parametrize(("method", "within"), [(codes.EXPLICIT, 1e-9), (codes.AUTOMATIC, 1e-8)])
def test_gears_stay_in_mesh_over_a_thousand_turns(method, within):
    """Over a way of 315 m; implicit steps become 27 s long there, and are right by the tolerance of 1e-9 of the way."""
    simulation = simulation_of(drive_damping=1.0, integration_method=method)
    simulation.set_input("drive_speed", 100.0)
    simulation.advance(63.0)
    found = simulation.read()
    assert found["pinion_angle"] > 1000 * 2 * math.pi * 0.99
    assert 0.05 * found["pinion_angle"] + 0.12 * found["wheel_angle"] == pytest.approx(0.0, abs=within)


def test_a_shaft_takes_the_gears_to_its_angle():
    simulation = simulation_of(drive_stiffness=20.0, drive_damping=1.0)
    simulation.set_input("drive_torque", 0.0)
    simulation.set_input("drive_angle", 2.0)
    simulation.advance(10.0)
    found = simulation.read()
    # the load on the wheel, seen at the pinion, winds up the shaft
    lag = -0.7 * found["ratio"] / 20.0
    assert found["pinion_angle"] == pytest.approx(2.0 + lag, abs=1e-8)
    assert found["drive_shaft_torque"] == pytest.approx(-20.0 * lag, abs=1e-7)


def test_energy_is_accounted_for():
    simulation = simulation_of(
        pinion_damping=2e-3, wheel_damping=1e-2, joint_friction_radius=1e-4, drive_stiffness=5.0, pinion_speed_start=2.0
    )
    start, turned = simulation.read()["kinetic_energy"], 0.0
    for time in np.arange(1, 401) * 0.005:
        simulation.set_input("drive_torque", 2 * math.cos(7 * time))
        before = simulation.read()["work_done"]
        simulation.advance(time)
        found = simulation.read()
        turned += abs(found["work_done"] - before)
        assert abs(found["kinetic_energy"] + found["energy_lost"] - start - found["work_done"]) < 1e-8 * max(
            turned, start
        )
    assert found["energy_lost"] > 0.01


def test_the_reference_curve_is_met():
    curve = pd.read_csv(Path(__file__).parents[2] / "models" / "gear_train" / "reference.csv")
    simulation = simulation_of(**EXACT)
    assert len(curve) > 2
    assert len(curve.columns) > 2
    for row in curve.to_dict("records"):
        simulation.advance(row.pop("time"))
        found = simulation.read()
        for name, expected in row.items():
            assert found[name] == pytest.approx(expected, rel=1e-9, abs=1e-9), (name, simulation.time)
