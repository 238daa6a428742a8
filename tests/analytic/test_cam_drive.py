"""The cam drive against an independent solution on the pitch curve (benchmarks/cam_drive.py)."""

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from benchmarks.cam_drive import Cam, contact_force, follower, landing, lift_off, radius, rest_angle
from mechanism_fmu.simulation import Simulation
from models.cam_drive.geometry import radius_at
from models.cam_drive.model import MODEL

W = 2 * math.pi
#: A cam so heavy against its follower that its speed changes by less than 1e-11 of itself.
STEADY = {"cam_inertia": 1e6, "drive_damping": 0.0, "relative_tolerance": 1e-12}
CAMS = {
    "default": Cam(),
    "no dwell": Cam(rise=math.radians(200), dwell=0.0, back=math.radians(160)),
    "hollow": Cam(rise=math.radians(75), dwell=math.radians(90), back=math.radians(100), lift=0.015, roller=0.008),
    "long arm": Cam(base=0.04, lift=0.03, arm=0.1, distance=0.11, roller=0.015),
    "large roller": Cam(roller=0.035, distance=0.09, arm=0.07, lift=0.01),
}
FAST = 45.0


def values_of(cam):
    return {
        "base_radius": cam.base,
        "lift": cam.lift,
        "rise_angle": cam.rise,
        "dwell_angle": cam.dwell,
        "return_angle": cam.back,
        "roller_radius": cam.roller,
        "hinge_distance": cam.distance,
        "follower_length": cam.arm,
        "follower_inertia": cam.inertia,
        "spring_stiffness": cam.stiffness,
        "spring_preload": cam.preload,
        "follower_damping": cam.damping,
    }


def simulation_of(cam, **values):
    return Simulation(MODEL.build(MODEL.values(**values_of(cam), **values)))


@pytest.mark.parametrize("name", CAMS)
def test_the_profile_is_the_cycloidal_one(name):
    cam = CAMS[name]
    for degrees in range(-180, 541, 7):
        alpha = math.radians(degrees)
        assert radius_at(MODEL.values(**values_of(cam)), alpha) == pytest.approx(radius(cam, alpha)[0], rel=1e-14)


@pytest.mark.parametrize("speed", [W, -3.0])
@pytest.mark.parametrize("name", CAMS)
def test_the_follower_is_where_it_should_be_over_one_turn(name, speed):
    """Angle, speed, acceleration and force at the cam's angle, wherever it starts; rates agree to 1e-9 m/s there."""
    cam = CAMS[name]
    for theta in np.linspace(-math.pi, math.pi, 60, endpoint=False).tolist():
        start = {"cam_angle_start": theta, "cam_speed_start": speed, "baumgarte_alpha": 0.0}
        simulation = simulation_of(cam, **start, **STEADY)
        found, rates, exact = simulation.read(), simulation.read_rates(), follower(cam, theta)
        assert found["cam_angle"] == theta
        assert found["follower_angle"] == pytest.approx(exact.angle, abs=1e-11)
        assert found["follower_speed"] == pytest.approx(exact.rate * speed, abs=1e-9 / exact.lever)
        assert rates["follower_speed"] == pytest.approx(exact.curvature * speed**2, abs=1e-8)
        assert found["contact_force"] == pytest.approx(contact_force(cam, theta, speed), abs=1e-9)
        pressure = found["roller_contact_angle"] - 1.5 * math.pi
        assert math.cos(pressure) == pytest.approx(exact.lever / cam.arm, abs=1e-11)


@pytest.mark.parametrize("name", CAMS)
def test_a_steady_cam_swings_its_follower_as_the_independent_solution_says(name):
    cam = CAMS[name]
    simulation = simulation_of(cam, **STEADY)
    for time in np.arange(1, 251) * 0.005:
        simulation.advance(time)
        found, rates, exact = simulation.read(), simulation.read_rates(), follower(cam, W * time)
        assert found["follower_angle"] == pytest.approx(exact.angle, abs=1e-9)
        assert found["follower_speed"] == pytest.approx(exact.rate * W, abs=1e-8)
        assert rates["follower_speed"] == pytest.approx(exact.curvature * W**2, abs=1e-6)
        assert found["contact_force"] == pytest.approx(contact_force(cam, W * time, W), abs=1e-8)
        assert found["contact_gap"] == pytest.approx(0.0, abs=1e-10)


@pytest.mark.parametrize("name", CAMS)
def test_swing_and_timing_are_those_that_the_fmu_states(name):
    cam = CAMS[name]
    stated = {c.name: c.value for c in MODEL.mechanism(MODEL.values(**values_of(cam))).calculated}
    assert stated["follower_low_angle"] == pytest.approx(rest_angle(cam), rel=1e-14)
    for angle, at in (("low", "rise_start"), ("high", "rise_end"), ("high", "return_start"), ("low", "return_end")):
        exact = follower(cam, stated[f"{at}_angle"])
        assert exact.angle == pytest.approx(stated[f"follower_{angle}_angle"], abs=1e-12)
        assert exact.rate == pytest.approx(0.0, abs=1e-7)
    middle = follower(cam, (stated["rise_start_angle"] + stated["rise_end_angle"]) / 2)
    assert middle.rate > 0
    swing = stated["follower_high_angle"] - stated["follower_low_angle"]
    assert stated["follower_swing"] == pytest.approx(swing, rel=1e-15)


def test_the_default_swing_suits_the_ratchet():
    stated = {c.name: c.value for c in MODEL.mechanism(MODEL.values()).calculated}
    assert math.degrees(stated["follower_swing"]) == pytest.approx(20.8, abs=0.05)


def test_whatever_the_cams_speed_the_follower_follows():
    cam = Cam(damping=1e-4)
    simulation = simulation_of(cam, cam_inertia=1e-3, drive_damping=0.0, relative_tolerance=1e-11)
    for time in np.arange(1, 401) * 0.005:
        simulation.set_input("drive_torque", 0.03 * math.cos(5 * time))
        simulation.set_input("load_torque", 0.01 * math.sin(9 * time))
        simulation.advance(time)
        found, rates = simulation.read(), simulation.read_rates()
        exact, speed = follower(cam, found["cam_angle"]), found["cam_speed"]
        assert found["follower_angle"] == pytest.approx(exact.angle, abs=1e-9)
        assert found["follower_speed"] == pytest.approx(exact.rate * speed, abs=1e-8)
        acceleration = exact.rate * rates["cam_speed"] + exact.curvature * speed**2
        assert rates["follower_speed"] == pytest.approx(acceleration, abs=1e-6)
        spring = cam.stiffness * (exact.angle - rest_angle(cam)) + cam.preload
        torque = cam.inertia * acceleration + spring + cam.damping * exact.rate * speed - 0.01 * math.sin(9 * time)
        assert found["contact_force"] * exact.lever == pytest.approx(torque, abs=1e-8)


@pytest.mark.parametrize("speed", [FAST, 60.0, -FAST])
def test_the_free_roller_leaves_the_cam_just_when_the_guided_one_begins_to_pull(speed):
    cam = Cam()
    expected = lift_off(cam, 2.0, speed)
    start = {"cam_angle_start": 2.0, "cam_speed_start": speed}
    guided = simulation_of(cam, **start, **STEADY)
    guided.advance(1.2 * expected)
    assert guided.pulling_contacts() == {"contact": pytest.approx(expected, abs=1e-9)}
    assert guided.read()["contact_active"]
    free = simulation_of(cam, unilateral=True, **start, **STEADY)
    free.advance(expected + 1e-4)
    (event,) = free.events_in_step()
    assert event.guard == "contact.force"
    assert event.new_mode == ()
    assert event.time == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("restitution", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("speed", [FAST, 60.0])
def test_the_roller_lands_with_the_impact_it_should_have(speed, restitution):
    cam = Cam()
    exact = landing(cam, 2.0, speed)
    start = {"cam_angle_start": 2.0, "cam_speed_start": speed, **STEADY, "cam_inertia": 1e5}
    simulation = simulation_of(cam, unilateral=True, restitution=restitution, **start)
    simulation.advance(exact.time - 1e-4)
    before = simulation.read()
    assert before["impact_count"] == 0
    assert before["contact_gap"] > 0
    assert before["contact_force"] == 0
    simulation.advance(exact.time + 1e-7)
    found = simulation.read()
    impulse = (1 + restitution) * exact.closing_speed * cam.inertia / exact.lever**2
    assert found["impact_count"] == 1
    assert found["impact_time"] == pytest.approx(exact.time, abs=1e-9)
    assert found["impact_closing_speed"] == pytest.approx(exact.closing_speed, rel=1e-7)
    assert found["impact_impulse"] == pytest.approx(impulse, rel=1e-7)
    after = exact.follower_speed + impulse * exact.lever / cam.inertia
    assert found["impact_follower_speed"] == pytest.approx(after, rel=1e-7)
    assert found["impact_cam_speed"] == pytest.approx(speed, rel=1e-9)
    lost = (1 - restitution**2) / 2 * exact.closing_speed**2 * cam.inertia / exact.lever**2
    assert found["energy_lost"] == pytest.approx(lost, abs=1e-7)
    pushes = contact_force(cam, 2.0 + speed * exact.time, speed) > 0.0
    assert found["contact_active"] == (pushes and restitution == 0.0)


def test_a_slow_free_roller_stays_on_the_cam():
    cam = Cam()
    guided, free = (simulation_of(cam, unilateral=unilateral, **STEADY) for unilateral in (False, True))
    for time in np.arange(1, 51) * 0.02:
        guided.advance(time)
        free.advance(time)
        expected, found = guided.read(), free.read()
        for name in ("follower_angle", "follower_speed", "contact_force"):
            assert found[name] == pytest.approx(expected[name], abs=1e-9)
    assert found["event_count"] == 0


@pytest.mark.parametrize(
    "values",
    [
        {},
        {"unilateral": True, "restitution": 0.5, "cam_speed_start": FAST},
        {"unilateral": True, "joint_friction_radius": 1e-3, "cam_speed_start": FAST},
        {"drive_stiffness": 0.5, "joint_friction_radius": 1e-3},
    ],
    ids=str,
)
def test_energy_is_accounted_for(values):
    simulation = simulation_of(Cam(damping=1e-4), drive_damping=0.01, **values)
    simulation.set_input("drive_speed", values.get("cam_speed_start", W))

    def held(found):
        return found["kinetic_energy"] + found["spring_energy"] + found["energy_lost"] - found["work_done"]

    found = simulation.read()
    start, turned = held(found), found["kinetic_energy"]
    for time in np.arange(1, 201) * 0.01:
        simulation.set_input("load_torque", 0.01 * math.sin(9 * time))
        before = found["work_done"]
        simulation.advance(time)
        found = simulation.read()
        turned += abs(found["work_done"] - before)
        assert abs(held(found) - start) < 1e-8 * turned
    assert found["energy_lost"] > 0
    assert (found["impact_count"] > 0) == ("unilateral" in values)


def test_the_reference_curve_is_met():
    curve = pd.read_csv(Path(__file__).parents[2] / "models" / "cam_drive" / "reference.csv")
    simulation = simulation_of(Cam(), **STEADY)
    for row in curve.itertuples():
        simulation.advance(row.time)
        found, rates = simulation.read(), simulation.read_rates()
        assert found["cam_angle"] == pytest.approx(row.cam_angle, abs=1e-8)
        assert found["follower_angle"] == pytest.approx(row.follower_angle, abs=1e-9)
        assert found["follower_speed"] == pytest.approx(row.follower_speed, abs=1e-8)
        assert rates["follower_speed"] == pytest.approx(row.follower_acceleration, abs=1e-6)
        assert found["contact_force"] == pytest.approx(row.contact_force, abs=1e-8)
