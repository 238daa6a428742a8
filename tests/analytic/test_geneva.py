"""The Geneva drive against its closed form (benchmarks/geneva.py, independent of the library)."""

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from benchmarks.geneva import Masses, in_slot, motion, peak, wheel
from mechanism_fmu.simulation import Simulation
from models.geneva.model import MODEL

SLOTS = (3, 4, 5, 6, 8)
W = 2 * math.pi
#: A driver so heavy against the wheel that its speed changes by less than 1e-11 of itself.
STEADY = {"driver_inertia": 1e6, "wheel_inertia": 1e-6, "drive_damping": 0.0, "relative_tolerance": 1e-12}
LIGHT = {"driver_inertia": 2e-3, "drive_damping": 0.0}
WHEEL_RATE = 11


def simulation_of(**values):
    return Simulation(MODEL.build(MODEL.values(**values)))


def accelerations(simulation):
    """Accelerations [rad/s2] of driver and wheel now; also reads the outputs."""
    found = simulation.read()
    rates = simulation.field("dy_at")
    return found, rates[8], rates[WHEEL_RATE]


def events_until(simulation, stop, step=0.05):
    events = []
    for k in range(1, round((stop - simulation.time) / step) + 1):
        simulation.advance(k * step)
        events += simulation.events_in_step()
    return events


@pytest.mark.parametrize("slots", range(3, 25))
def test_ratios_that_the_fmu_states_are_those_of_the_closed_form(slots):
    stated = {c.name: c.value for c in MODEL.mechanism(MODEL.values(slot_count=slots)).calculated}
    top = peak(slots)
    middle = in_slot(0.0, slots)
    assert stated["peak_acceleration_ratio"] == pytest.approx(top.curvature, rel=1e-13)
    assert stated["peak_acceleration_angle"] == pytest.approx(top.angle, abs=1e-13)
    assert stated["peak_speed_ratio"] == pytest.approx(middle.rate, rel=1e-13)
    assert stated["entry_acceleration_ratio"] == pytest.approx(math.tan(math.pi / slots), rel=1e-14)
    entry = in_slot(-stated["engagement_angle"], slots)
    assert entry.angle == pytest.approx(-stated["indexing_angle"] / 2, rel=1e-14)
    assert entry.rate == pytest.approx(0.0, abs=1e-15)
    assert entry.curvature == pytest.approx(stated["entry_acceleration_ratio"], rel=1e-13)
    rest = 2 * math.pi - 2 * stated["engagement_angle"]
    assert stated["motion_to_rest_ratio"] == pytest.approx(2 * stated["engagement_angle"] / rest, rel=1e-14)
    curvatures = [abs(in_slot(phi, slots).curvature) for phi in np.linspace(0, stated["engagement_angle"], 2001)]
    assert max(curvatures) <= top.curvature * (1 + 1e-14)


@pytest.mark.parametrize(("slots", "ratio", "degrees"), [(4, 5.407, 11.46), (6, 1.350, 22.90)])
def test_the_peaks_are_those_that_textbooks_print(slots, ratio, degrees):
    assert peak(slots).curvature == pytest.approx(ratio, abs=6e-4)
    assert math.degrees(peak(slots).angle) == pytest.approx(degrees, abs=6e-3)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("slots", SLOTS)
def test_a_steady_driver_moves_the_wheel_as_the_closed_form_says(slots, sense):
    simulation = simulation_of(slot_count=slots, driver_speed_start=sense * W, driver_angle_start=0.3, **STEADY)
    for time in np.arange(1, 401) * 0.0077:
        simulation.advance(time)
        found, _, acceleration = accelerations(simulation)
        exact = wheel(0.3 + sense * W * time, slots)
        assert found["wheel_angle"] == pytest.approx(exact.angle, abs=1e-9)
        assert found["wheel_speed"] == pytest.approx(sense * W * exact.rate, abs=1e-8)
        assert acceleration == pytest.approx(W * W * exact.curvature, abs=1e-6)


@pytest.mark.parametrize("slots", SLOTS)
def test_one_turn_indexes_by_one_station_and_moves_for_its_share_of_the_time(slots):
    simulation = simulation_of(slot_count=slots, driver_angle_start=0.3, **STEADY)
    events = [event.time for event in events_until(simulation, 1.9) if event.guard == "pin_in_slot"]
    entry, leaving, again = events[:3]
    assert again - entry == pytest.approx(1.0, abs=1e-9)
    assert leaving - entry == pytest.approx(0.5 - 1 / slots, abs=1e-9)
    assert (leaving - entry) / (again - leaving) == pytest.approx((slots - 2) / (slots + 2), rel=2e-9)
    start = simulation_of(slot_count=slots, driver_angle_start=0.3, **STEADY).read()["wheel_angle"]
    simulation.advance(2.0)
    assert simulation.read()["wheel_angle"] - start == pytest.approx(-2 * 2 * math.pi / slots, abs=1e-13)


@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("slots", [4, 6])
def test_the_peak_acceleration_is_where_and_what_it_should_be(slots, side):
    top = peak(slots)
    simulation = simulation_of(slot_count=slots, **STEADY)
    at = (math.pi + side * top.angle) / W
    found = {}
    for shift in (-1e-3, 0.0, 1e-3):
        simulation.advance(at + shift)
        found[shift] = accelerations(simulation)[2] / W**2
    assert found[0.0] == pytest.approx(side * top.curvature, rel=1e-9)
    assert abs(found[0.0]) > max(abs(found[-1e-3]), abs(found[1e-3]))


@pytest.mark.parametrize("slots", SLOTS)
def test_entry_is_without_a_jump_of_speed_and_with_the_known_acceleration(slots):
    for values in (STEADY, LIGHT):
        simulation = simulation_of(slot_count=slots, **values)
        entry = (math.pi / 2 + math.pi / slots) / W
        simulation.advance(entry - 1e-7)
        before = simulation.read()
        assert not before["slot_active"]
        simulation.advance(entry + 1e-7)
        found, _, acceleration = accelerations(simulation)
        (event,) = simulation.events_in_step()
        assert event.time == pytest.approx(entry, abs=1e-9)
        assert abs(event.impulse) < 1e-9 * values.get("wheel_inertia", 1e-3) * W * 1e3
        assert found["driver_speed"] == pytest.approx(before["driver_speed"], rel=1e-6)
        assert abs(found["wheel_speed"]) < 1e-4
        if values is STEADY:
            assert acceleration / W**2 == pytest.approx(-math.tan(math.pi / slots), rel=1e-5)


@pytest.mark.parametrize("slots", [3, 4, 6])
def test_whatever_the_drivers_speed_the_wheel_follows(slots):
    """A light driver that torques speed up and slow down, friction, a load: angle, speed and acceleration."""
    simulation = simulation_of(
        slot_count=slots,
        wheel_damping=1e-3,
        slot_friction=0.1,
        driver_angle_start=0.3,
        relative_tolerance=1e-11,
        **LIGHT,
    )
    moving = 0
    for time in np.arange(1, 601) * 0.005:
        simulation.set_input("drive_torque", 0.05 * math.cos(5 * time))
        simulation.set_input("load_torque", 0.02 * math.sin(9 * time))
        simulation.advance(time)
        found, driver, acceleration = accelerations(simulation)
        angle, rate, curvature = wheel(found["driver_angle"], slots)
        speed = found["driver_speed"]
        assert found["wheel_angle"] == pytest.approx(angle, abs=1e-9)
        assert found["wheel_speed"] == pytest.approx(rate * speed, abs=1e-8)
        expected = rate * driver + curvature * speed**2
        assert acceleration == pytest.approx(expected, abs=1e-5)
        moving += found["slot_active"]
        assert found["slot_active"] + found["locking_arc_active"] == 1
    assert moving > 50


@pytest.mark.parametrize("slots", [3, 4, 6])
def test_a_light_driver_moves_as_lagranges_equation_says(slots):
    simulation = simulation_of(
        slot_count=slots, wheel_damping=1e-3, driver_angle_start=0.3, relative_tolerance=1e-11, **LIGHT
    )
    simulation.set_input("drive_torque", 0.02)
    simulation.set_input("load_torque", 0.01)
    masses = Masses(driver=2e-3, wheel=1e-3, drive=0.02, load=0.01, damping=1e-3)
    for time in (0.4, 0.5, 1.3, 2.0):
        simulation.advance(time)
        found = simulation.read()
        angle, speed = motion(masses, slots, 0.3, W, time)
        assert found["driver_angle"] == pytest.approx(angle, abs=1e-8)
        assert found["driver_speed"] == pytest.approx(speed, abs=1e-7)


@pytest.mark.parametrize("sense", [1, -1])
def test_the_wheel_rests_exactly_between(sense):
    simulation = simulation_of(driver_speed_start=sense * W, drive_damping=10.0, driver_angle_start=0.3)
    simulation.set_input("drive_speed", sense * W)
    simulation.set_input("load_torque", 0.05)
    rests = 0
    for time in np.arange(1, 601) * 0.005:
        simulation.advance(time)
        found = simulation.read()
        if found["locking_arc_active"]:
            rests += 1
            station = (math.pi / 4 - found["wheel_angle"]) / (math.pi / 2)
            assert station == pytest.approx(round(station), abs=1e-13)
            assert abs(found["wheel_speed"]) < 1e-12
            assert found["locking_torque"] == pytest.approx(-0.05, abs=1e-9)
            assert found["pin_force"] == 0.0
    assert rests > 400


@pytest.mark.slow
@pytest.mark.parametrize("sense", [1, -1])
def test_no_drift_over_a_thousand_turns(sense):
    simulation = simulation_of(driver_speed_start=sense * W, drive_damping=10.0, driver_angle_start=sense * 0.3)
    simulation.set_input("drive_speed", sense * W)
    events = 0
    for turn in range(1, 1001):
        simulation.advance(turn)
        events += len(simulation.events_in_step())
    found = simulation.read()
    assert found["driver_angle"] == pytest.approx(sense * (0.3 + 2 * math.pi * 1000), abs=0.1)
    assert found["wheel_angle"] == pytest.approx(sense * (math.pi / 4 - 1000 * math.pi / 2), abs=1e-9)
    assert found["station"] == sense * 1000
    assert found["event_count"] == events == 3000


def test_energy_is_accounted_for():
    simulation = simulation_of(
        wheel_damping=1e-3, slot_friction=0.1, joint_friction_radius=1e-4, drive_damping=0.05, driver_angle_start=0.3
    )
    start = simulation.read()["kinetic_energy"]
    turned = 0.0
    for time in np.arange(1, 601) * 0.005:
        simulation.set_input("load_torque", 0.03 * math.sin(7 * time))
        before = simulation.read()["work_done"]
        simulation.advance(time)
        found = simulation.read()
        turned += abs(found["work_done"] - before)
        residual = found["kinetic_energy"] + found["energy_lost"] - start - found["work_done"]
        assert abs(residual) < 1e-8 * max(turned, start)
    assert found["energy_lost"] > 0.01


def test_the_communication_step_does_not_matter():
    names = ("driver_angle", "wheel_angle", "wheel_speed", "pin_force", "locking_torque", "station", "event_count")
    courses = []
    for parts in (1, 2, 7):
        simulation = simulation_of(**LIGHT, driver_angle_start=0.3)
        simulation.set_input("drive_torque", 0.02)
        course = []
        for last, time in pairwise(np.arange(0, 41) * 0.075):
            for point in np.linspace(last, time, parts + 1)[1:-1]:
                simulation.advance(point)
                simulation.read()
            simulation.advance(time)
            found = simulation.read()
            course.append([found[name] for name in names])
        courses.append(course)
    np.testing.assert_allclose(courses[1], courses[0], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(courses[2], courses[0], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("slots", [3, 4, 6])
def test_it_can_start_anywhere(slots, sense):
    pitch = 2 * math.pi / slots
    for degrees in (*range(-180, 541, 15), 90 + 180 / slots, 270 - 180 / slots):
        theta = math.radians(degrees)
        simulation = simulation_of(slot_count=slots, driver_angle_start=theta, driver_speed_start=sense * W, **STEADY)
        found = simulation.read()
        turns = round((wheel(theta, slots).angle - found["wheel_angle"]) / pitch)
        for time in np.arange(0, 13) * 0.083:
            simulation.advance(time)
            found = simulation.read()
            exact = wheel(theta + sense * W * time, slots)
            assert found["wheel_angle"] == pytest.approx(exact.angle - turns * pitch, abs=1e-9)
            assert found["wheel_speed"] == pytest.approx(sense * W * exact.rate, abs=3e-8)


def test_it_may_turn_back_anywhere():
    """A soft shaft moves the driver to and fro, through mouths and across the far side."""
    for middle, reach in ((math.pi, 1.5), (0.0, 2.0), (math.pi / 2 + math.pi / 4, 0.1)):
        simulation = simulation_of(
            drive_stiffness=20.0, drive_damping=0.1, driver_angle_start=middle, driver_speed_start=0.0
        )
        simulation.set_input("drive_speed", 0.0)
        shift = round((wheel(middle, 4).angle - simulation.read()["wheel_angle"]) / (math.pi / 2))
        for time in np.arange(1, 501) * 0.01:
            simulation.set_input("drive_angle", middle + reach * math.sin(3 * time))
            simulation.advance(time)
            found = simulation.read()
            exact = wheel(found["driver_angle"], 4).angle - shift * math.pi / 2
            assert found["wheel_angle"] == pytest.approx(exact, abs=1e-9)
        assert found["event_count"] >= 4


def test_the_backstop_takes_the_impact_of_a_driver_that_runs_back():
    simulation = simulation_of(backstop=True, backstop_restitution=0.5, driver_speed_start=-W, drive_damping=0.0)
    simulation.advance(0.1)
    found = simulation.read()
    assert found["impact_count"] == 1
    assert found["impact_closing_speed"] == pytest.approx(W, rel=1e-12)
    assert found["impact_driver_speed"] == pytest.approx(0.5 * W, rel=1e-12)
    assert found["impact_impulse"] == pytest.approx(1.5 * W * 1e-2, rel=1e-12)
    assert found["energy_lost"] == pytest.approx(0.75 * 0.5 * 1e-2 * W**2, rel=1e-12)


def test_the_reference_curve_is_met():
    curve = pd.read_csv(Path(__file__).parents[2] / "models" / "geneva" / "reference.csv")
    simulation = simulation_of(**STEADY)
    for row in curve.itertuples():
        simulation.advance(row.time)
        found, _, acceleration = accelerations(simulation)
        assert found["driver_angle"] == pytest.approx(row.driver_angle, abs=1e-9)
        assert found["wheel_angle"] == pytest.approx(row.wheel_angle, abs=1e-9)
        assert found["wheel_speed"] == pytest.approx(row.wheel_speed, abs=1e-8)
        # At entry and exit it jumps.
        if abs(math.cos(row.driver_angle) + math.sqrt(0.5)) > 1e-9:
            assert acceleration == pytest.approx(row.wheel_acceleration, abs=1e-6)
