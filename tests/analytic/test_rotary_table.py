"""The rotary table against matrix exponentials (benchmarks/rotary_table.py, independent of the library)."""

import math

import pytest
from hypothesis import given, settings, strategies as st

from benchmarks.rotary_table import Table, motion
from mechanism_fmu.model import MechanismError
from mechanism_fmu.simulation import Simulation
from models.rotary_table.model import MODEL

EXACT = {"relative_tolerance": 1e-11}


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
                brake_stiffness=table.k_b,
                brake_damping=table.c_b,
                **EXACT,
                **values,
            )
        ),
        inputs=(table.rate, table.alpha, table.T, table.M),
    )


@settings(deadline=None, max_examples=10)
@given(alpha=st.floats(-1, 1), most=st.floats(0.02, 0.5), load=st.floats(-0.5, 0.5))
def test_while_it_sticks_and_slips_it_is_the_exact_solution(alpha, most, load):
    table = Table(alpha=alpha, M=most, T=load)
    simulation = simulation_of(table)
    times = [0.0, 0.02, 0.1, 0.5, 2.0]
    for time, (angle, speed, friction, _) in zip(times, motion(table, times), strict=True):
        simulation.advance(time)
        found = simulation.read()
        assert found["table_angle"] == pytest.approx(angle, rel=1e-7, abs=1e-7)
        assert found["table_speed"] == pytest.approx(speed, rel=1e-7, abs=1e-6)
        assert found["friction_torque"] == pytest.approx(friction, rel=1e-6, abs=1e-6)


def test_with_a_stiff_brake_it_slips_in_half_swings_as_coulomb_says():
    """From rest each half swing of m x'' + k x = -+M about the shaft's end takes 2 M / k from the amplitude."""
    table = Table(alpha=0.5, M=0.2, c=0.0, k_b=2e5, c_b=10.0)
    simulation = simulation_of(table)
    period = 2 * math.pi * math.sqrt(table.J / table.k)
    amplitude = 0.5
    side = 1
    simulation.advance(0.0)
    for half in range(1, 3):
        amplitude -= 2 * table.M / table.k
        simulation.advance(half * period / 2)
        found = simulation.read()
        assert found["table_angle"] == pytest.approx(0.5 + side * amplitude, abs=1e-3)
        side = -side
    simulation.advance(3.0)
    rest = simulation.read()
    assert abs(rest["table_speed"]) < 1e-9
    assert rest["table_angle"] == pytest.approx(0.5 - amplitude, abs=1e-3)  # 0.1 rad, which the brake holds


def test_it_holds_a_load_for_an_hour_without_creeping():
    simulation = simulation_of(Table(alpha=0.0, k=0.0, c=0.0, T=0.13))
    simulation.advance(10.0)
    begin = simulation.read()
    simulation.advance(3600.0)
    end = simulation.read()
    assert end["table_angle"] == pytest.approx(begin["table_angle"], abs=1e-11)
    assert end["table_angle"] == pytest.approx(0.13 / 200, rel=1e-9)  # what the brake gives
    assert end["friction_torque"] == pytest.approx(-0.13, rel=1e-9)


def test_a_brake_that_is_let_go_lets_the_table_go():
    simulation = simulation_of(Table(alpha=0.0, k=0.0, c=0.0, T=0.15))
    simulation.advance(1.0)
    simulation.set_input("brake_torque", 0.0)
    simulation.advance(2.0)
    found = simulation.read()
    assert found["friction_torque"] == 0.0
    assert found["table_speed"] == pytest.approx(0.15 / 0.02, rel=1e-8)
    simulation.set_input("brake_torque", 0.3)
    simulation.advance(3.5)
    assert simulation.read()["table_speed"] == pytest.approx(0.0, abs=1e-5)


def test_energy_is_kept():
    simulation = simulation_of()
    for time in (0.02, 0.3, 1.0, 4.0):
        simulation.advance(time)
        found = simulation.read()
        stored = found["kinetic_energy"] + found["spring_energy"]
        assert stored == pytest.approx(found["work_done"] - found["energy_lost"], abs=1e-10)
    assert found["energy_lost"] > 0.01


def test_a_brake_that_takes_no_end_of_steps_is_refused():
    with pytest.raises(MechanismError, match="brake_damping / brake_stiffness = 1e-09 s is shorter than 1e-06 s"):
        MODEL.build(MODEL.values(brake_stiffness=1e9))
