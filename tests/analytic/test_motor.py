"""The motor against matrix exponentials (benchmarks/motor.py, independent of the library)."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from benchmarks.motor import Drive, motion
from mechanism_fmu.model import MechanismError
from mechanism_fmu.simulation import Simulation
from models.motor.model import MODEL

EXACT = {"relative_tolerance": 1e-11}


def simulation_of(drive, **more):
    return Simulation(
        MODEL.build(
            MODEL.values(
                motor_constant=drive.K,
                resistance=drive.R,
                inductance=drive.L,
                rotor_inertia=drive.J,
                rotor_damping=drive.b,
                voltage_limit=drive.U,
                speed_gain=drive.kp,
                integral_gain=drive.ki,
                anti_windup=drive.g,
                **EXACT,
                **more,
            )
        ),
        inputs=(drive.wanted, drive.T),
    )


@settings(deadline=None, max_examples=10)
@given(
    wanted=st.floats(-90, 90),
    limit=st.floats(2, 40),
    gains=st.tuples(st.floats(0.0, 2.0), st.floats(0.0, 30.0), st.floats(0.0, 50.0)),
    load=st.floats(-0.5, 0.5),
)
def test_at_its_limit_and_off_it_it_is_the_exact_solution(wanted, limit, gains, load):
    drive = Drive(wanted=wanted, U=limit, kp=gains[0], ki=gains[1], g=gains[2], T=load)
    simulation = simulation_of(drive)
    times = [0.0, 0.01, 0.04, 0.1, 0.3]
    for time, (angle, speed, current, voltage, _) in zip(times, motion(drive, times), strict=True):
        simulation.advance(time)
        found = simulation.read()
        assert found["rotor_angle"] == pytest.approx(angle, rel=1e-8, abs=1e-8)
        assert found["rotor_speed"] == pytest.approx(speed, rel=1e-8, abs=1e-7)
        assert found["current"] == pytest.approx(current, rel=1e-8, abs=1e-7)
        assert found["voltage"] == pytest.approx(voltage, rel=1e-8, abs=1e-7)
        assert found["motor_torque"] == pytest.approx(drive.K * current, rel=1e-8, abs=1e-7)


def test_it_keeps_its_speed_under_load():
    simulation = simulation_of(Drive())
    simulation.advance(1.0)
    simulation.set_input("load_torque", -0.4)
    simulation.advance(3.0)
    found = simulation.read()
    assert found["rotor_speed"] == pytest.approx(50.0, abs=1e-6)
    assert found["current"] == pytest.approx((0.4 + 1e-4 * 50) / 0.25, abs=1e-6)


def test_beyond_its_voltage_it_is_as_slow_as_its_resistance_makes_it():
    simulation = simulation_of(Drive(), rotor_angle_start=1.0)
    simulation.set_input("load_torque", -2.0)
    simulation.advance(3.0)
    found = simulation.read()
    assert found["voltage"] == 24.0
    assert found["rotor_speed"] == pytest.approx((0.25 * 24 / 2 - 2.0) / (0.25**2 / 2 + 1e-4), rel=1e-8)
    assert MODEL.build(MODEL.values()).calculated[2].value == pytest.approx(3.0)  # stall_torque


@pytest.mark.parametrize("anti_windup", [0.0, 50.0])
def test_anti_windup_keeps_the_speed_from_overshooting(anti_windup):
    """Blocked for half a second, then free: without it the integral has grown, and the motor races."""
    simulation = simulation_of(Drive(g=anti_windup, ki=2.0, kp=0.25))
    simulation.set_input("load_torque", -2.5)
    simulation.advance(0.5)
    simulation.set_input("load_torque", 0.0)
    fastest = 0.0
    for time in np.linspace(0.5, 2.0, 151):
        simulation.advance(time)
        fastest = max(fastest, simulation.read()["rotor_speed"])
    assert fastest > 90.0 if anti_windup == 0.0 else fastest < 58.0


def test_energy_is_kept_from_the_supply_to_the_rotor():
    simulation = simulation_of(Drive())
    for time in (0.01, 0.1, 1.0):
        simulation.set_input("load_torque", -time)
        simulation.advance(time)
        found = simulation.read()
        stored = found["kinetic_energy"] + found["spring_energy"]
        assert stored == pytest.approx(found["work_done"] - found["energy_lost"], rel=1e-9)
        assert found["spring_energy"] == pytest.approx(4e-3 * found["current"] ** 2 / 2, rel=1e-12)


def test_rates_of_its_states():
    simulation = simulation_of(Drive())
    simulation.advance(0.05)
    found, rates = simulation.read(), simulation.read_rates()
    slope = (found["voltage"] - 2.0 * found["current"] - 0.25 * found["rotor_speed"]) / 4e-3
    assert rates["current"] == pytest.approx(slope, rel=1e-12)
    assert rates["motor_torque"] == pytest.approx(0.25 * slope, rel=1e-12)
    assert rates["spring_energy"] == pytest.approx(4e-3 * found["current"] * slope, rel=1e-12)
    assert math.isnan(rates["voltage"])


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"inductance": 1e-7}, "inductance / resistance = 5e-08 s is shorter than 1e-06 s"),
        ({"anti_windup": 1e6}, r"anti_windup \* integral_gain = 1e\+07 1/s is more than 1e\+06 1/s"),
    ],
    ids=str,
)
def test_what_would_take_no_end_of_steps_is_refused(values, text):
    with pytest.raises(MechanismError, match=text):
        MODEL.build(MODEL.values(**values))
