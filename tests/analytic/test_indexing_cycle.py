"""The free ratchet really indexes: latches, clicks, ledger, no penetration, whatever the steps and the restitution."""

import math

import numpy as np
import pytest
from cycle import DRIVES, PERIOD, Drive, free_ratchet, strokes, swing
from hypothesis import given, settings, strategies as st

from mechanism_fmu import codes
from mechanism_fmu.simulation import Simulation
from models.ratchet.model import MODEL

LEDGER = ("kinetic_energy", "spring_energy", "work_done", "energy_lost")


def residual(found, initial):
    kinetic, spring, work, lost = (found[name] - initial[name] for name in LEDGER)
    return kinetic + spring - work + lost


@pytest.mark.parametrize("restitution", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("drive", DRIVES, ids=lambda drive: f"nt={drive.tooth_count}")
def test_one_tooth_a_stroke(drive, restitution):
    clicks, latches, initial = [], [75.0], None
    for simulation in strokes(drive, restitution=restitution):
        found = simulation.read()
        initial = initial or found
        if found["clicks"] > len(clicks):
            clicks.append(simulation.time)
            latches.append(math.degrees(found["latched_angle"]))
        assert found["wheel_angle"] >= found["latched_angle"] - 1e-9
        assert found["lost_motion"] == pytest.approx(found["wheel_angle"] - found["latched_angle"], abs=1e-14)
    pitch = 360 / drive.tooth_count
    assert latches == pytest.approx([75 + k * pitch for k in range(5)], abs=1e-12)
    assert [int(time // PERIOD) for time in clicks] == [0, 1, 2, 3]
    assert abs(residual(found, initial)) <= 1e-8 * abs(found["work_done"])


def clicks_of(hold_steps, until=18.0):
    """Times of the clicks when inputs change every 50 ms and each such stretch is cut into `hold_steps` steps."""
    drive, hold = DRIVES[0], 0.05
    simulation = Simulation(free_ratchet(drive, restitution=0.3))
    simulation.set_input("spring_preload", 3e-3)
    simulation.set_input("drive_torque", 0.0)
    found = []
    for k in range(round(until / hold)):
        swing(simulation, drive, (k + 0.5) * hold)
        for j in range(hold_steps):
            simulation.advance((k + (j + 1) / hold_steps) * hold)
            found += [event.time for event in simulation.events_in_step() if event.guard == "holding_pawl.click"]
    return found, simulation.field("y_end").copy()


def test_latch_times_do_not_depend_on_the_communication_step():
    reference, end = clicks_of(1)
    assert len(reference) == 2
    for cuts in (2, 7, 50):
        found, other_end = clicks_of(cuts)
        np.testing.assert_allclose(found, reference, rtol=0, atol=1e-6)
        np.testing.assert_allclose(other_end, end, rtol=0, atol=1e-7)


def test_tighter_tolerance_moves_the_latches_by_less():
    times = {}
    for tolerance in (1e-7, 1e-9, 1e-12):
        times[tolerance] = [
            event.time
            for simulation in strokes(until=18.0, restitution=0.3, hold=0.05, relative_tolerance=tolerance)
            for event in simulation.events_in_step()
            if event.guard == "holding_pawl.click"
        ]
    exact = np.array(times.pop(1e-12))
    for tolerance, found in times.items():
        assert np.abs(np.array(found) - exact).max() < 1e4 * tolerance


def first_impact(slope_angle, guided):
    changes = {"guided": guided, "holding_pawl": 0.0, "tooth_slope_angle": math.radians(slope_angle)}
    simulation = Simulation(MODEL.build(MODEL.values(**changes, relative_tolerance=1e-12)))
    simulation.advance(0.97)
    return simulation.field("last_impact").copy(), simulation.mode()


@pytest.mark.parametrize("slope_angle", [85, 90, 95])
def test_the_first_impact_of_a_free_pawl_is_the_guided_one(slope_angle):
    """Where the slope pushes up to the impact and in it, guided and free are the same motion."""
    (guided, _), (free, mode) = first_impact(slope_angle, 1.0), first_impact(slope_angle, 0.0)
    np.testing.assert_allclose(free, guided, rtol=1e-8, atol=1e-10)
    assert guided[codes.RECORD_CONTACT_IMPULSES] > 0
    assert "face" in mode


def test_where_the_guided_slope_would_pull_in_the_impact_the_free_pawl_leaves_it():
    """At (10, 100) eq (7) with a bilateral slope needs a pulling impulse; a one-sided slope gives none and opens."""
    (guided, _), (free, mode) = first_impact(100, 1.0), first_impact(100, 0.0)
    slope = codes.RECORD_CONTACT_IMPULSES
    assert guided[slope] < 0 == free[slope]
    assert free[codes.RECORD_TIME] == pytest.approx(guided[codes.RECORD_TIME], rel=1e-9)
    assert "slope" not in mode


def test_without_a_holding_pawl_the_spring_turns_the_wheel_back():
    *_, held = strokes(until=6.0)
    *_, loose = strokes(until=6.0, holding_pawl=0.0)
    assert held.read()["wheel_angle"] == pytest.approx(held.read()["latched_angle"], abs=1e-9)
    assert loose.read()["wheel_angle"] < held.read()["latched_angle"] - 1e-3
    assert loose.read()["clicks"] == 0


def test_a_heavy_wheel_with_little_damping_runs_over_several_teeth():
    """Driven hard once, it clicks on alone; the pawl rattles over the teeth and never gets inside one."""
    simulation = Simulation(
        free_ratchet(wheel_damping=1e-3, restitution=0.3, pawl_spring_torque=0.02, spring_stiffness=0.0)
    )
    simulation.set_input("drive_torque", 0.0)
    simulation.set_input("drive_angle", math.radians(95))
    simulation.set_input("load_torque", 0.5)
    while simulation.time < 2.0:
        simulation.advance(simulation.time + 0.01)
        found = simulation.read()
        assert min(found["face_gap"], found["slope_gap"]) >= -1e-9
    assert found["clicks"] >= 5
    assert found["wheel_angle"] >= found["latched_angle"] - 1e-9


SENSIBLE = st.fixed_dictionaries(
    {
        "tooth_count": st.integers(12, 30),
        "tooth_slope_angle": st.floats(math.radians(88), math.radians(102)),
        "restitution": st.floats(0.0, 0.8),
        "holding_pawl_restitution": st.floats(0.0, 0.5),
        "pawl_spring_torque": st.floats(1e-3, 2e-2),
        "wheel_damping": st.floats(0.0, 0.3),
        "friction": st.sampled_from([0.0, 0.0, 0.15]),
        "spring_stiffness": st.floats(0.0, 0.05),
    }
)


@pytest.mark.slow
@settings(deadline=None, max_examples=25)
@given(SENSIBLE, st.floats(80.0, 88.0), st.floats(4.0, 12.0), st.floats(1.0, 10.0))
def test_any_sensible_ratchet_runs_without_penetration_or_gain_of_energy(changes, mean, amplitude, hardness):
    drive = Drive(int(changes.pop("tooth_count")), math.degrees(changes.pop("tooth_slope_angle")), mean, amplitude)
    simulation = Simulation(
        free_ratchet(drive, crank_angle_start=math.radians(mean), drive_stiffness=0.4 * hardness, **changes)
    )
    simulation.set_input("drive_torque", 0.0)
    simulation.set_input("spring_preload", 3e-3)
    initial = simulation.read()
    lost, in_play = 0.0, 1e-3
    for k in range(160):
        swing(simulation, drive, 2.0 + 0.1 * k)
        simulation.advance(0.1 * (k + 1))
        found = simulation.read()
        lines = np.array([found["face_gap"], found["slope_gap"], found["wheel_angle"] - found["latched_angle"]])
        assert lines.min() >= -1e-9
        assert (
            found["energy_lost"] >= lost - 1e-9 * in_play
        )  # what the tolerance of the motion leaves of friction at rest
        lost = found["energy_lost"]
        in_play = max(in_play, abs(found["work_done"]), lost)
        assert abs(residual(found, initial)) <= 1e-7 * in_play
    assert np.isfinite(simulation.field("y_end")).all()
