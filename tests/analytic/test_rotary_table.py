"""The rotary table against its solution from stop to stop (benchmarks/rotary_table.py, independent of the library)."""

import math

import pytest
from hypothesis import given, settings, strategies as st

from benchmarks.rotary_table import State, Table, motion
from mechanism_fmu.simulation import Simulation
from models.rotary_table.model import MODEL

EXACT = {"relative_tolerance": 1e-11}
TIMES = [0.0, 0.02, 0.1, 0.5, 2.0]


def simulation_of(table=None, **values):
    """A table, with `inputs` in the order drive_speed, drive_angle, load_torque, brake_torque."""
    table = table or Table()
    return Simulation(
        MODEL.build(
            MODEL.values(
                table_inertia=table.J,
                table_damping=table.d,
                drive_stiffness=table.k,
                drive_damping=table.c,
                **EXACT,
                **values,
            )
        ),
        inputs=(table.rate, table.alpha, table.T, table.M),
    )


def assert_they_agree(simulation, table, wanted):
    found = simulation.read()
    assert found["table_angle"] == pytest.approx(wanted.angle, rel=1e-9, abs=1e-9)
    assert found["table_speed"] == pytest.approx(wanted.speed, rel=1e-9, abs=1e-8)
    assert found["friction_torque"] == pytest.approx(wanted.friction(table), rel=1e-9, abs=1e-8)
    assert bool(found["brake_sticks"]) == (wanted.side == 0)
    assert found["brake_slip_speed"] == (found["table_speed"] if wanted.side else 0.0)


@settings(deadline=None, max_examples=20)
@given(
    alpha=st.floats(-1, 1),
    most=st.floats(0.02, 0.5),
    load=st.floats(-0.5, 0.5),
    damping=st.sampled_from([0.0, 0.02, 1]),
)
def test_while_it_sticks_and_slips_it_is_the_exact_solution(alpha, most, load, damping):
    table = Table(alpha=alpha, M=most, T=load, d=damping)
    if abs(abs(table.load(0.0)) - most) < 1e-9:  # it would be rounding that says whether it starts
        return
    simulation = simulation_of(table)
    for time, wanted in zip(TIMES, motion(table, TIMES), strict=True):
        simulation.advance(time)
        assert_they_agree(simulation, table, wanted)


def test_it_slips_from_a_start_with_speed_against_its_load():
    """From 3 rad/s the brake and the load stop it, and the load turns it back: a reversal, without a stop between."""
    table, start = Table(k=0.0, c=0.0, T=-0.5), State(0.0, 3.0, 1)
    simulation = simulation_of(table, table_speed_start=3.0)
    stop = table.J * 3.0 / 0.7
    for time, wanted in zip([0.0, 0.05, 0.5], motion(table, [0.0, 0.05, 0.5], start), strict=True):
        simulation.advance(time)
        assert_they_agree(simulation, table, wanted)
    assert wanted.speed == pytest.approx(-(0.5 - stop) * 0.3 / table.J)
    (event,) = simulation.events_in_step()
    assert event.guard == "brake.sticks"
    assert event.time == pytest.approx(stop, rel=1e-11)


def test_each_half_swing_takes_from_the_amplitude_what_coulomb_says():
    """From rest each half swing of m x'' + k x = -+M about the shaft's end takes 2 M / k from the amplitude."""
    table = Table(alpha=0.5, M=0.2, c=0.0)
    simulation = simulation_of(table)
    period = 2 * math.pi * math.sqrt(table.J / table.k)
    amplitude = 0.5
    side = 1
    for half in range(1, 3):
        amplitude -= 2 * table.M / table.k
        simulation.advance(half * period / 2)
        found = simulation.read()
        assert found["table_angle"] == pytest.approx(0.5 + side * amplitude, abs=1e-10)
        side = -side
    simulation.advance(3.0)
    rest = simulation.read()
    assert rest["brake_slip_speed"] == 0.0
    assert rest["table_angle"] == pytest.approx(0.5 - amplitude, abs=1e-10)  # 0.1 rad, which the brake holds
    assert rest["friction_torque"] == pytest.approx(-table.k * amplitude, abs=1e-9)


def test_it_holds_a_load_for_an_hour_without_moving():
    simulation = simulation_of(Table(alpha=0.0, k=0.0, c=0.0, T=0.13))
    simulation.advance(3600.0)
    end = simulation.read()
    assert end["table_angle"] == 0.0
    assert end["friction_torque"] == pytest.approx(-0.13, rel=1e-12)
    assert end["brake_sticks"]
    assert end["energy_lost"] == 0.0


def test_a_brake_that_is_let_go_lets_the_table_go_and_one_that_is_set_stops_it():
    simulation = simulation_of(Table(alpha=0.0, k=0.0, c=0.0, T=0.15))
    simulation.advance(1.0)
    simulation.set_input("brake_torque", 0.0)
    simulation.advance(2.0)
    found = simulation.read()
    assert found["friction_torque"] == 0.0
    assert found["table_speed"] == pytest.approx(0.15 / 0.02, rel=1e-10)
    simulation.set_input("brake_torque", 0.3)
    simulation.advance(3.5)
    found = simulation.read()
    (event,) = simulation.events_in_step()
    assert event.time == pytest.approx(2.0 + 0.02 * 7.5 / 0.15, rel=1e-10)
    assert found["brake_slip_speed"] == 0.0
    assert found["friction_torque"] == pytest.approx(-0.15, rel=1e-10)


def test_energy_is_kept():
    simulation = simulation_of()
    for time in (0.02, 0.3, 1.0, 4.0):
        simulation.advance(time)
        found = simulation.read()
        assert found["kinetic_energy"] == pytest.approx(found["work_done"] - found["energy_lost"], abs=1e-10)
    assert found["energy_lost"] > 0.01
